//! A force that stays at its limit; unloading goes to the origin, not parallel to the elastic line.

use super::law::{Fall, Law};
use super::softened::Softened;

/// The force stays for good.
pub const LAW: Law = Law {
    word: "plastic",
    words: "Its force stays; of `sliding` alone.",
    source: "",
    force: "force stays",
    parameter: None,
    softens: true,
    sliding_because: Some("only bonds that slide, {}, keep their force"),
    fall: Fall::Formula {
        at,
        end: |_| f64::INFINITY,
        total: |_| f64::INFINITY,
        for_energy: |_| f64::NAN,
    },
};

/// mu = 1, omega = 1/kappa (MPPD eq. 50 with gamma_u to infinity); the energy gone is 2 (kappa - 1) + 1 - kappa = kappa - 1.
fn at(_: f64, kappa: f64) -> Softened {
    Softened {
        force: 1.0,
        secant: 1.0 / kappa,
        dissipated: kappa - 1.0,
    }
}
