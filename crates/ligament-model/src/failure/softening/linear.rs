//! A straight fall of the force to zero (MPPD Fig. 7).

use super::law::{Law, Parameter, Softened};

/// The force falls in a straight line to zero at r = e_u/e_0, the key `end`.
pub const LAW: Law = Law {
    word: "linear",
    words: "Its force falls in one straight line to zero.",
    source: "MPPD eqs 45, 46, 50",
    force: "force falls in one straight line, to zero at",
    parameter: Some(Parameter {
        key: "end",
        above: 1.0,
        of_it_alone: "only a force that falls in straight lines, {} or \"two-branch\", has an end",
        least_energy: 1.0,
        for_energy: |energy| energy,
    }),
    softens: true,
    sliding_because: None,
    at,
    end: |end| end,
    total: |end| end,
};

/// The law by its older word, which papers on concrete use for two lines.
pub const BILINEAR: Law = Law {
    word: "bilinear",
    words: "Older word for `linear`: one straight line, not the two of `two-branch` that concrete has.",
    ..LAW
};

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
