//! The beam-like bond (Gerstle 2007, in the form of MPPD), which is also the law of NHPD eq. 6.

use std::f64::consts::PI;

use super::{BondStiffness, CENTRAL_FORCE_TOLERANCE, Densities};
use crate::bonds::BondSet;
use crate::cloud::PointCloud;
use crate::material::{Isotropic, Plane};

/// Stiffness densities of every bond, NHPD eq. 6, OMPPD eq. 22:
///
/// k_n = c, k_t = 12 d / l^2, k_theta = d / l, with the bond horizon H, the thickness t and
///
/// | | c (N/m^6) | d (N/m^4) |
/// |---|---|---|
/// | plane stress | 6 E / (pi t H^3 (1 - nu)) | E (1 - 3 nu) / (6 pi t H (1 - nu^2)) |
/// | plane strain | 6 E / (pi t H^3 (1 - 2 nu)(1 + nu)) | E (1 - 4 nu) / (6 pi t H (1 - 2 nu)(1 + nu)) |
///
/// `d` is negative for nu > 1/3 (plane stress) or nu > 1/4 (plane strain).
pub fn stiffness(
    bonds: &BondSet,
    cloud: &PointCloud,
    materials: &[Isotropic],
    plane: Plane,
) -> BondStiffness {
    // c H^3 and d H do not depend on the bond.
    let constants: Vec<[f64; 2]> = materials
        .iter()
        .map(|material| {
            let bending = bending_constant(material, plane, cloud.thickness);
            [axial_constant(material, plane, cloud.thickness), bending]
        })
        .collect();
    BondStiffness::from_constants(bonds, cloud, &constants, |[c, d], bond| {
        let (l, h) = (bond.length, bond.horizon);
        let d = d / h;
        Densities {
            axial: c / h.powi(3),
            shear: 12.0 * d / l.powi(2),
            rotational: d / l,
        }
    })
}

/// c H^3, N/m^3.
pub(crate) fn axial_constant(material: &Isotropic, plane: Plane, thickness: f64) -> f64 {
    let Isotropic { young, poisson } = *material;
    let reduction = match plane {
        Plane::Stress => 1.0 - poisson,
        Plane::Strain => (1.0 - 2.0 * poisson) * (1.0 + poisson),
    };
    6.0 * young / (PI * thickness * reduction)
}

/// d H, N/m^3.
pub(super) fn bending_constant(material: &Isotropic, plane: Plane, thickness: f64) -> f64 {
    let Isotropic { young, poisson } = *material;
    let (distance_to_central, reduction) = match plane {
        Plane::Stress => (1.0 - 3.0 * poisson, 1.0 - poisson * poisson),
        Plane::Strain => (1.0 - 4.0 * poisson, (1.0 - 2.0 * poisson) * (1.0 + poisson)),
    };
    if distance_to_central.abs() < CENTRAL_FORCE_TOLERANCE {
        return 0.0;
    }
    young * distance_to_central / (6.0 * PI * thickness * reduction)
}
