//! A straight fall of the force to zero (MPPD Fig. 7).

use super::Softened;

/// mu = (r - kappa)/(r - 1) with r = e_u/e_0 (MPPD eqs 45, 46, 50), omega = mu/kappa; the energy gone grows with the deformation,
/// r (kappa - 1)/(r - 1), and is r at the end.
pub(super) fn at(end: f64, kappa: f64) -> Softened {
    let force = ((end - kappa) / (end - 1.0)).max(0.0);
    Softened {
        force,
        secant: force / kappa,
        dissipated: end * (kappa - 1.0) / (end - 1.0),
    }
}

pub(super) fn total(end: f64) -> f64 {
    end
}

/// e_u/e_0 for which the whole life of a bond takes `energy` times what it stores at its limit; None if that is not more than 1.
pub fn end_for(energy: f64) -> Option<f64> {
    (energy > 1.0).then_some(energy)
}
