//! The fall of the force of normal concrete after Cornelissen, Hordijk and Reinhardt.

use std::sync::LazyLock;

use super::curve::Curve;
use super::law::{Fall, Law, Parameter};

/// Constants c_1 and c_2 of normal-weight concrete.
const CONSTANTS: [f64; 2] = [3.0, 6.93];

/// Straight lines that stand for the curve; they are within 1e-4 of the strength of it.
const LINES: u32 = 256;

/// Stress over the strength at an opening x over the last one:
/// y = (1 + (c_1 x)^3) exp(-c_2 x) - x (1 + c_1^3) exp(-c_2) (Cornelissen 1986).
fn stress(x: f64) -> f64 {
    let [c1, c2] = CONSTANTS;
    let falling = |x: f64| (1.0 + (c1 * x).powi(3)) * libm::exp(-c2 * x);
    falling(x) - x * falling(1.0)
}

static CURVE: LazyLock<Curve> = LazyLock::new(|| {
    let x = |line: u32| f64::from(line) / f64::from(LINES);
    let mut points: Vec<[f64; 2]> = (0..LINES).map(|it| [x(it), stress(x(it))]).collect();
    points.push([1.0, 0.0]);
    Curve::new(&points).expect("the curve falls from 1 to 0")
});

/// The force falls by the curve to zero at r = e_u/e_0, the key `end`. The area under the curve is .1947, so that w_c = 5.14 G/f_t.
pub const LAW: Law = Law {
    word: "cornelissen",
    words: "Its force falls by the curve of Cornelissen, Hordijk and Reinhardt, of concrete.",
    source: "Cornelissen 1986",
    force: "force falls by the curve of Cornelissen, Hordijk and Reinhardt",
    parameter: Some(Parameter::end(6.96, 2.71)),
    softens: true,
    sliding_because: None,
    fall: Fall::Named(|| &CURVE),
};
