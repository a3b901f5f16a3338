//! An exponential fall of the force.

use super::law::{Fall, Law, Parameter};
use super::softened::Softened;

/// Force, relative to that at the limit, at which a bond breaks: an exponential never gets to zero.
pub const LAST_FORCE: f64 = 1e-3;

/// The force falls exponentially over f = e_f/e_0, the key `scale`, to [`LAST_FORCE`]. The whole life takes 1 + 2 f without what
/// lies beyond the end.
pub const LAW: Law = Law {
    word: "exponential",
    words: "Its force falls exponentially.",
    source: "",
    force: "force falls exponentially",
    parameter: Some(Parameter {
        key: "scale",
        words: ", with a scale of",
        above: 0.0,
        exclusive_reason: "only a force that falls exponentially, {}, has a scale",
        least_energy: 1.0,
    }),
    softens: true,
    sliding_because: None,
    fall: Fall::Formula {
        at,
        end: |scale| 1.0 - scale * LAST_FORCE.ln(),
        total: |scale| 1.0 + 2.0 * scale * (1.0 - LAST_FORCE),
        for_energy: |energy| 0.5 * (energy - 1.0) / (1.0 - LAST_FORCE),
    },
};

/// mu = exp(-(kappa - 1)/f) with f = e_f/e_0, omega = mu/kappa; what is gone is twice the area under mu less that of unloading,
/// 1 + 2 f (1 - mu) - mu kappa. The papers print no such law; only that the force falls is theirs.
fn at(scale: f64, kappa: f64) -> Softened {
    let force = (-(kappa - 1.0) / scale).exp();
    Softened {
        force,
        secant: force / kappa,
        dissipated: 1.0 + 2.0 * scale * (1.0 - force) - force * kappa,
    }
}
