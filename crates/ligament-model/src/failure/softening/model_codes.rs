//! Falls of the force in two straight lines by the model codes of concrete.

use std::sync::LazyLock;

use super::curve::Curve;
use super::law::{Fall, Law, Parameter};

fn kinked(at: [f64; 2]) -> Curve {
    Curve::kinked(at).expect("the kink lies between strength and end")
}

/// Kink at w_1 = 2 G/f_t - .15 w_c and .15 f_t with w_c = alpha G/f_t, alpha = 7 for aggregates of 16 mm (CEB-FIP 1990, 2.1.4.4.2).
static CEB_FIP_1990: LazyLock<Curve> = LazyLock::new(|| kinked([2.0 / 7.0 - 0.15, 0.15]));

/// Kink at w_1 = G/f_t and .2 f_t, with w_c = 5 G/f_t (FIB 2010, 5.1.8.2).
static MODEL_CODE_2010: LazyLock<Curve> = LazyLock::new(|| kinked([0.2, 0.2]));

/// Two lines to zero at r = e_u/e_0, the key `end`, which meet at .15 of the strength.
pub const CEB_FIP: Law = Law {
    word: "ceb-fip",
    words: "Its force falls in two straight lines, to .15 and then to zero (CEB-FIP Model Code 1990, aggregates of 16 mm).",
    source: "CEB-FIP 1990",
    force: "force falls to .15 and then to zero, in two straight lines (CEB-FIP Model Code 1990)",
    parameter: Some(Parameter::end(6.27, 1.791)),
    softens: true,
    sliding_because: None,
    fall: Fall::Named(|| &CEB_FIP_1990),
};

/// Two lines to zero at r = e_u/e_0, the key `end`, which meet at a fifth of the strength and of the last opening.
pub const FIB: Law = Law {
    word: "model-code-2010",
    words: "Its force falls in two straight lines, to a fifth and then to zero (fib Model Code 2010).",
    source: "FIB 2010",
    force: "force falls to a fifth and then to zero, in two straight lines (Model Code 2010)",
    parameter: Some(Parameter::end(4.0, 1.6)),
    softens: true,
    sliding_because: None,
    fall: Fall::Named(|| &MODEL_CODE_2010),
};
