//! Bond-based peridynamics: bonds that only resist stretch (Silling 2000, in the linear form of MPPD section 2).

use super::{BondStiffness, Densities, beam::axial_constant};
use crate::bonds::BondSet;
use crate::cloud::PointCloud;
use crate::material::{Isotropic, Plane};

/// Stiffness densities of every bond: k_n alone,
///
/// k_n = 9 E / (pi t H^3) in plane stress, 48 E / (5 pi t H^3) in plane strain (N/m^6).
///
/// Poisson's ratio is what central forces give, 1/3 or 1/4, whatever that of the materials ([`central`]).
pub fn stiffness(
    bonds: &BondSet,
    cloud: &PointCloud,
    materials: &[Isotropic],
    plane: Plane,
) -> BondStiffness {
    let constant = |material| {
        [axial_constant(
            &central(material, plane),
            plane,
            cloud.thickness,
        )]
    };
    let constants: Vec<[f64; 1]> = materials.iter().map(constant).collect();
    BondStiffness::from_constants(bonds, cloud, &constants, |[c], bond| Densities {
        axial: c / bond.horizon.powi(3),
        shear: 0.0,
        rotational: 0.0,
    })
}

/// The material that central forces make of a material: its Young's modulus with the Poisson's ratio 1/3 or 1/4.
pub fn central(material: &Isotropic, plane: Plane) -> Isotropic {
    Isotropic {
        young: material.young,
        poisson: Isotropic::central_force_poisson(plane),
    }
}
