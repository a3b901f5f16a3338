//! A straight fall of the force to zero (MPPD Fig. 7).

use super::law::{Fall, Law, Parameter};
use super::softened::Softened;

/// The force falls in a straight line to zero at r = e_u/e_0, the key `end`.
pub const LAW: Law = by_word("linear", "Its force falls in one straight line to zero.");

/// The law by its older word, which papers on concrete use for two lines.
pub const BILINEAR: Law = by_word(
    "bilinear",
    "Older word for `linear`: one straight line, not the two of `two-branch` that concrete has.",
);

const fn by_word(word: &'static str, words: &'static str) -> Law {
    Law {
        word,
        words,
        source: "MPPD eqs 45, 46, 50",
        force: "force falls in one straight line",
        parameter: Some(Parameter::end(1.0, 1.0)),
        softens: true,
        sliding_because: None,
        fall: Fall::Formula {
            at,
            end: |end| end,
            total: |end| end,
            for_energy: |energy| energy,
        },
    }
}

/// mu = (r - kappa)/(r - 1) with r = e_u/e_0 (MPPD eqs 45, 46, 50), omega = mu/kappa; the energy gone grows with the deformation,
/// r (kappa - 1)/(r - 1), and is r at the end.
fn at(end: f64, kappa: f64) -> Softened {
    let force = ((end - kappa) / (end - 1.0)).max(0.0);
    Softened {
        force,
        secant: force / kappa,
        dissipated: end * (kappa - 1.0) / (end - 1.0),
    }
}
