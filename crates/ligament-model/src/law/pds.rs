//! Bonds that resist stretch and shear, without rotations of the points (PDS: Zhu and Ni 2017; MPPD section 2.1).

use std::f64::consts::PI;

use super::{BondStiffness, CENTRAL_FORCE_TOLERANCE, Densities, beam::axial_constant};
use crate::bonds::BondSet;
use crate::cloud::PointCloud;
use crate::material::{Isotropic, Plane};

/// Stiffness densities of every bond, MPPD eqs 7 and 21 (OMPPD eqs 54 to 57):
///
/// | | k_n (N/m^6) | k_t (N/m^6) |
/// |---|---|---|
/// | plane stress | 6 E / (pi t H^3 (1 - nu)) | 6 E (1 - 3 nu) / (pi t H^3 (1 - nu^2)) |
/// | plane strain | 6 E / (pi t H^3 (1 + nu)(1 - 2 nu)) | 6 E (1 - 4 nu) / (pi t H^3 (1 + nu)(1 - 2 nu)) |
pub fn stiffness(
    bonds: &BondSet,
    cloud: &PointCloud,
    materials: &[Isotropic],
    plane: Plane,
) -> BondStiffness {
    let constants: Vec<[f64; 2]> = materials
        .iter()
        .map(|material| {
            let shear = shear_constant(material, plane, cloud.thickness);
            [axial_constant(material, plane, cloud.thickness), shear]
        })
        .collect();
    BondStiffness::from_constants(bonds, cloud, &constants, |[axial, shear], bond| {
        let volume = bond.horizon.powi(3);
        Densities {
            axial: axial / volume,
            shear: shear / volume,
            rotational: 0.0,
        }
    })
}

/// k_t H^3, N/m^3.
fn shear_constant(material: &Isotropic, plane: Plane, thickness: f64) -> f64 {
    let Isotropic { young, poisson } = *material;
    let (distance_to_central, reduction) = match plane {
        Plane::Stress => (1.0 - 3.0 * poisson, 1.0 - poisson * poisson),
        Plane::Strain => (1.0 - 4.0 * poisson, (1.0 - 2.0 * poisson) * (1.0 + poisson)),
    };
    if distance_to_central.abs() < CENTRAL_FORCE_TOLERANCE {
        return 0.0;
    }
    6.0 * young * distance_to_central / (PI * thickness * reduction)
}
