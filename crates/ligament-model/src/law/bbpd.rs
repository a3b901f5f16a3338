//! Bond-based peridynamics: bonds that only resist stretch (Silling 2000, in the plane in the linear form of MPPD section 2).

use super::{BondStiffness, Densities, constants};
use crate::bonds::BondSet;
use crate::cloud::PointCloud;
use crate::material::{Isotropic, Space};

/// Stiffness densities of every bond: k_n alone,
///
/// k_n = 9 E / (pi t H^3) in plane stress, 48 E / (5 pi t H^3) in plane strain, 12 E / (pi H^4) in space (N/m^6).
///
/// Poisson's ratio is what central forces give, 1/3 or 1/4, whatever that of the materials ([`central`]).
pub fn stiffness<const D: usize>(
    bonds: &BondSet<D>,
    cloud: &PointCloud<D>,
    materials: &[Isotropic],
    space: Space,
) -> BondStiffness {
    let constant = |material| {
        [constants::axial(
            &central(material, space),
            space,
            cloud.thickness,
        )]
    };
    let constants: Vec<[f64; 1]> = materials.iter().map(constant).collect();
    BondStiffness::from_constants(bonds, cloud, &constants, |[c], bond| Densities {
        axial: c / bond.horizon.powi(D as i32 + 1),
        shear: 0.0,
        rotational: 0.0,
    })
}

/// The material that central forces make of a material: its Young's modulus with the Poisson's ratio 1/3 or 1/4.
pub fn central(material: &Isotropic, space: impl Into<Space>) -> Isotropic {
    Isotropic {
        young: material.young,
        poisson: Isotropic::central_force_poisson(space),
    }
}
