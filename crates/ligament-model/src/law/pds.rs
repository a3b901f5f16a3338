//! Bonds that resist stretch and shear, without rotations of the points (PDS; MPPD section 2.1).

use super::beam::{axial_constant, bending_constant};
use super::{BondStiffness, Densities};
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
            // k_t H^3 is 36 times the d H of the beam form: their integrals of k_t l^2 are the same.
            let shear = 36.0 * bending_constant(material, plane, cloud.thickness);
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
