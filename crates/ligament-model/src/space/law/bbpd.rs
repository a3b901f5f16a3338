//! Bond-based peridynamics in space: bonds that only resist stretch (Silling 2000).

use super::axial_constant;
use crate::bonds::BondSet;
use crate::cloud::PointCloud;
use crate::law::{BondStiffness, Densities};
use crate::material::Isotropic;

/// Poisson's ratio of central forces in space.
pub const POISSON: f64 = 0.25;

/// Stiffness densities of every bond: k_n = 12 E/(pi H^4) alone, N/m^6, which is 18 K/(pi H^4) with K = 2 E/3.
///
/// Poisson's ratio is 1/4, whatever that of the materials ([`central`]).
pub fn stiffness(
    bonds: &BondSet<3>,
    cloud: &PointCloud<3>,
    materials: &[Isotropic],
) -> BondStiffness {
    let constants: Vec<[f64; 1]> = (materials.iter())
        .map(|material| [axial_constant(&central(material))])
        .collect();
    BondStiffness::from_constants(bonds, cloud, &constants, |[c], bond| Densities {
        axial: c / bond.horizon.powi(4),
        shear: 0.0,
        rotational: 0.0,
    })
}

/// The material that central forces make of a material: its Young's modulus with the Poisson's ratio 1/4.
pub fn central(material: &Isotropic) -> Isotropic {
    Isotropic {
        young: material.young,
        poisson: POISSON,
    }
}
