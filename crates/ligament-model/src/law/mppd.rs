//! The micropolar law with a constant shear stiffness (MPPD section 2); in space its rotational stiffness is that of bending and torsion.

use rayon::prelude::*;

use super::rotational::RotationalStiffness;
use super::{BondStiffness, pds};
use crate::bonds::BondSet;
use crate::cloud::PointCloud;
use crate::material::{Isotropic, Space};

/// Stiffness densities of every bond: k_n and k_t of [`pds`], and a chosen k_theta.
pub fn stiffness<const D: usize>(
    bonds: &BondSet<D>,
    cloud: &PointCloud<D>,
    materials: &[Isotropic],
    space: Space,
    rotational: RotationalStiffness,
) -> BondStiffness {
    let non_polar = pds::stiffness(bonds, cloud, materials, space);
    let rotational = (&non_polar.shear, &bonds.length, &bonds.horizon)
        .into_par_iter()
        .map(|(&shear, &length, &horizon)| rotational.density(shear, length, horizon))
        .collect();
    BondStiffness {
        rotational,
        ..non_polar
    }
}
