//! The micropolar law in space with a constant shear stiffness and a chosen rotational one.

use rayon::prelude::*;

use super::pds;
use crate::bonds::BondSet;
use crate::cloud::PointCloud;
use crate::law::BondStiffness;
use crate::law::rotational::RotationalStiffness;
use crate::material::Isotropic;

/// Stiffness densities of every bond: k_n and k_t of [`pds`], and a chosen k_theta for bending and torsion.
pub fn stiffness(
    bonds: &BondSet<3>,
    cloud: &PointCloud<3>,
    materials: &[Isotropic],
    rotational: RotationalStiffness,
) -> BondStiffness {
    let non_polar = pds::stiffness(bonds, cloud, materials);
    let rotational = (&non_polar.shear, &bonds.length, &bonds.horizon)
        .into_par_iter()
        .map(|(&shear, &length, &horizon)| rotational.density(shear, length, horizon))
        .collect();
    BondStiffness {
        rotational,
        ..non_polar
    }
}
