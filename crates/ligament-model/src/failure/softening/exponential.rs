//! An exponential fall of the force.

use super::Softened;

/// Force, relative to that at the limit, at which a bond breaks: an exponential never gets to zero.
pub const LAST_FORCE: f64 = 1e-3;

/// mu = exp(-(kappa - 1)/f) with f = e_f/e_0, omega = mu/kappa; what is gone is twice the area under mu less that of unloading,
/// 1 + 2 f (1 - mu) - mu kappa. The papers print no such law; only that the force falls is theirs.
pub(super) fn at(scale: f64, kappa: f64) -> Softened {
    let force = (-(kappa - 1.0) / scale).exp();
    Softened {
        force,
        secant: force / kappa,
        dissipated: 1.0 + 2.0 * scale * (1.0 - force) - force * kappa,
    }
}

/// e/e_0 where the force has fallen to [`LAST_FORCE`].
pub(super) fn end(scale: f64) -> f64 {
    1.0 - scale * LAST_FORCE.ln()
}

/// 1 + 2 f without what lies beyond the end.
pub(super) fn total(scale: f64) -> f64 {
    1.0 + 2.0 * scale * (1.0 - LAST_FORCE)
}

/// e_f/e_0 for which the whole life of a bond takes `energy` times what it stores at its limit; None if that is not more than 1.
pub fn scale_for(energy: f64) -> Option<f64> {
    let scale = 0.5 * (energy - 1.0) / (1.0 - LAST_FORCE);
    (scale > 0.0).then_some(scale)
}
