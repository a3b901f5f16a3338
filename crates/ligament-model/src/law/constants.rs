//! Constants of isotropic materials common to the laws, from integrals over a full circle, in space over a full ball.
//!
//! | | c H^(D + 1) | d H^(D - 1) |
//! |---|---|---|
//! | plane stress | 6 E / (pi t (1 - nu)) | E (1 - 3 nu) / (6 pi t (1 - nu^2)) |
//! | plane strain | 6 E / (pi t (1 - 2 nu)(1 + nu)) | E (1 - 4 nu) / (6 pi t (1 - 2 nu)(1 + nu)) |
//! | space | 6 E / (pi (1 - 2 nu)) | E (1 - 4 nu) / (4 pi (1 + nu)(1 - 2 nu)) |
//!
//! Here c (N/m^6) is the axial stiffness density and d (N/m^4) the bending stiffness of the beam form (NHPD eq. 6, OMPPD eq. 22; in space
//! our own, derived in `docs/space.md`), with the bond horizon H and the thickness t.

use std::f64::consts::PI;

use super::CENTRAL_FORCE_TOLERANCE;
use crate::material::{Isotropic, Plane, Space};

/// Constant c H^(D + 1), N/m^3, in space Pa.
pub(crate) fn axial(material: &Isotropic, space: Space, thickness: f64) -> f64 {
    let Isotropic { young, poisson } = *material;
    match space {
        Space::Plane(Plane::Stress) => 6.0 * young / (PI * thickness * (1.0 - poisson)),
        Space::Plane(Plane::Strain) => {
            let reduction = (1.0 - 2.0 * poisson) * (1.0 + poisson);
            6.0 * young / (PI * thickness * reduction)
        }
        Space::Solid => 6.0 * young / (PI * (1.0 - 2.0 * poisson)),
    }
}

/// Constant c H^(D + 1) of central forces, which have a fixed Poisson's ratio.
pub(crate) fn central_axial(material: &Isotropic, space: Space, thickness: f64) -> f64 {
    axial(&material.with_central_forces(space), space, thickness)
}

/// Constant d H^(D - 1), N/m^3, in space Pa; exactly zero where the Poisson's ratio is that of central forces up to rounding.
pub(crate) fn bending(material: &Isotropic, space: Space, thickness: f64) -> f64 {
    let Isotropic { young, poisson } = *material;
    let (distance_to_central, reduction) = match space {
        Space::Plane(Plane::Stress) => {
            let reduction = 1.0 - poisson * poisson;
            (1.0 - 3.0 * poisson, 6.0 * PI * thickness * reduction)
        }
        Space::Plane(Plane::Strain) => {
            let reduction = (1.0 - 2.0 * poisson) * (1.0 + poisson);
            (1.0 - 4.0 * poisson, 6.0 * PI * thickness * reduction)
        }
        Space::Solid => (
            1.0 - 4.0 * poisson,
            4.0 * PI * (1.0 + poisson) * (1.0 - 2.0 * poisson),
        ),
    };
    if distance_to_central.abs() < CENTRAL_FORCE_TOLERANCE {
        return 0.0;
    }
    young * distance_to_central / reduction
}

/// Constant k_t H^(D + 1) of a shear stiffness that is the same for all lengths: 36 d H^(D - 1), in space 24 times. Its integral of k_t l^2
/// over the horizon is that of the beam form, k_t = 12 d/l^2.
pub(crate) fn shear(material: &Isotropic, space: Space, thickness: f64) -> f64 {
    let over_bending = match space {
        Space::Plane(_) => 36.0,
        Space::Solid => 24.0,
    };
    over_bending * bending(material, space, thickness)
}
