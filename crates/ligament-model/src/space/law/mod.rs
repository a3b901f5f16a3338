//! Bond laws in space: from materials and bond horizons to the stiffness densities of the bonds (our own, derived in `docs/space.md`).
//!
//! | law | k_n | k_t | k_theta | element |
//! |---|---|---|---|---|
//! | [`bbpd`] | c, of nu = 1/4 | | | spring |
//! | [`pds`] | c | 24 d/H^2 | | spring |
//! | [`nhpd`] | c | 24 d/H^2, or 12 d/l^2 | d/l | beam |
//! | [`mppd`] | c | 24 d/H^2 | a choice | beam |
//!
//! c = 6 E/(pi H^4 (1 - 2 nu)), d = E (1 - 4 nu)/(4 pi H^2 (1 + nu)(1 - 2 nu)), from integrals over a full ball of radius H;
//! [`calibration`] puts sums over the families of the points in their place.
//! Above nu = 1/4 d is negative, see [`stability`].

pub mod bbpd;
pub mod calibration;
pub mod mppd;
pub mod nhpd;
pub mod pds;
pub mod stability;

use std::f64::consts::PI;

use crate::law::CENTRAL_FORCE_TOLERANCE;
use crate::material::Isotropic;

/// c H^4 = 6 E/(pi (1 - 2 nu)), Pa: three times the bulk modulus K times 6/pi.
pub(super) fn axial_constant(material: &Isotropic) -> f64 {
    let Isotropic { young, poisson } = *material;
    6.0 * young / (PI * (1.0 - 2.0 * poisson))
}

/// d H^2 = E (1 - 4 nu)/(4 pi (1 + nu)(1 - 2 nu)), Pa; exactly zero where nu is 1/4 but for rounding.
pub(super) fn bending_constant(material: &Isotropic) -> f64 {
    let Isotropic { young, poisson } = *material;
    let distance_to_central = 1.0 - 4.0 * poisson;
    if distance_to_central.abs() < CENTRAL_FORCE_TOLERANCE {
        return 0.0;
    }
    young * distance_to_central / (4.0 * PI * (1.0 + poisson) * (1.0 - 2.0 * poisson))
}

/// Shear stiffness k_t of a bond over its length.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum ShearForm {
    /// k_t = 24 d/H^2, the same for all lengths. With a factor alpha that depends on the length, the ratio of shear to stretch stays
    /// right: the form of choice in space.
    #[default]
    Constant,
    /// k_t = 12 d/l^2, as a beam of Euler and Bernoulli has. NHPD's factor alpha, which falls with the length, makes the shear of the
    /// body 1.16 times too strong: nu = .2 becomes .192.
    Falling,
}

impl ShearForm {
    /// k_t for d (N/m^4), the length l and the horizon H of a bond (m).
    pub fn density(self, bending: f64, length: f64, horizon: f64) -> f64 {
        match self {
            Self::Constant => 24.0 * bending / (horizon * horizon),
            Self::Falling => 12.0 * bending / (length * length),
        }
    }
}

#[cfg(test)]
mod tests;
