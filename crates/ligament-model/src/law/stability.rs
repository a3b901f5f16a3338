//! Stability of bodies in space by Poisson's ratio.
//!
//! Above nu = 1/4 the bonds resist shear and rotation with negative stiffnesses: the energy is a maximum in the rotations of the points, and
//! its minimum over them stays semidefinite only up to some Poisson's ratio, which is much smaller in space than in the plane.

use std::fmt;

use super::ShearForm;
use crate::material::{Isotropic, Space};

/// Poisson's ratio from which irregular free bodies of micropolar bonds lose stability, by the form of the shear stiffness and the
/// horizon over the spacing (measured on irregular balls of 121 and 661 points: negative eigenvalues beyond one a rotation).
const UNSTABLE: [(ShearForm, f64, f64); 4] = [
    (ShearForm::Falling, 3.5, 0.28),
    (ShearForm::Falling, f64::INFINITY, 0.26),
    (ShearForm::Constant, 3.5, 0.30),
    (ShearForm::Constant, f64::INFINITY, 0.28),
];

/// Warning that bonds resist shear with a negative stiffness.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct NegativeShear {
    /// Largest Poisson's ratio of a material.
    pub poisson: f64,
    /// Poisson's ratio from which bodies of this kind were found to lose their stability; `None` for bonds without rotations, whose free
    /// bodies are ill-posed at any above 1/4.
    pub unstable_from: Option<f64>,
}

impl NegativeShear {
    /// The warning for a Poisson's ratio above 1/4.
    ///
    /// `form` is that of the shear stiffness of bonds between points with rotations, `None` for points without; `horizon_factor` is the
    /// horizon over the distance of the points.
    pub fn new(poisson: f64, form: Option<ShearForm>, horizon_factor: f64) -> Self {
        let suits =
            |(of, up_to, _): &&(ShearForm, f64, f64)| form == Some(*of) && horizon_factor <= *up_to;
        Self {
            poisson,
            unstable_from: UNSTABLE.iter().find(suits).map(|(_, _, from)| *from),
        }
    }

    /// Whether bodies of this kind were found to be unstable.
    pub fn is_past_stability(&self) -> bool {
        self.unstable_from.is_none_or(|from| self.poisson >= from)
    }
}

impl fmt::Display for NegativeShear {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self {
            poisson,
            unstable_from,
        } = self;
        let central = Isotropic::central_force_poisson(Space::Solid);
        write!(
            formatter,
            "Poisson's ratio {poisson} is above {central}: bonds in space then resist shear and rotation with negative stiffnesses, \
             "
        )?;
        match unstable_from {
            None => write!(
                formatter,
                "and without rotations of the points a rigid rotation gives energy away, so that a free body is ill-posed; take \
                 the law \"nhpd\", or a Poisson's ratio of at most {central}"
            ),
            Some(from) if poisson >= from => write!(
                formatter,
                "and irregular bodies of this horizon lose their stability from about {from}: the stiffness is checked before the \
                 first breakage, and results are not to be trusted where it fails; take a constant shear stiffness (stable to about \
                 0.3 with a horizon_factor up to 3), a smaller horizon_factor or a Poisson's ratio of at most {central}"
            ),
            Some(from) => write!(
                formatter,
                "which irregular bodies of this horizon bear up to about {from}: the stiffness is checked before the first breakage"
            ),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn forms_and_horizons_decide_what_is_past_stability() {
        let warning = NegativeShear::new(0.28, Some(ShearForm::Constant), 2.5);
        assert!(!warning.is_past_stability());
        assert!(warning.to_string().contains("up to about 0.3:"));
        let warning = NegativeShear::new(0.28, Some(ShearForm::Falling), 3.0);
        assert!(warning.is_past_stability());
        assert!(NegativeShear::new(0.26, None, 3.0).is_past_stability());
    }
}
