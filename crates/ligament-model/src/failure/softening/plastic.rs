//! A force that stays at its limit; unloading goes to the origin, not parallel to the elastic line.

use super::Softened;

/// mu = 1, omega = 1/kappa (MPPD eq. 50 with gamma_u to infinity); the energy gone is 2 (kappa - 1) + 1 - kappa = kappa - 1.
pub(super) fn at(kappa: f64) -> Softened {
    Softened {
        force: 1.0,
        secant: 1.0 / kappa,
        dissipated: kappa - 1.0,
    }
}
