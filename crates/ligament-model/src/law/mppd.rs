//! The micropolar law with a constant shear stiffness (MPPD section 2).

use rayon::prelude::*;

use super::rotational::RotationalStiffness;
use super::{BondStiffness, pds};
use crate::bonds::BondSet;
use crate::cloud::PointCloud;
use crate::material::{Isotropic, Plane};

/// Stiffness densities of every bond: k_n and k_t of [`pds`], and a chosen k_theta.
pub fn stiffness(
    bonds: &BondSet,
    cloud: &PointCloud,
    materials: &[Isotropic],
    plane: Plane,
    rotational: RotationalStiffness,
) -> BondStiffness {
    let non_polar = pds::stiffness(bonds, cloud, materials, plane);
    let rotational = (&non_polar.shear, &bonds.length, &bonds.horizon)
        .into_par_iter()
        .map(|(&shear, &length, &horizon)| rotational.density(shear, length, horizon))
        .collect();
    BondStiffness {
        rotational,
        ..non_polar
    }
}
