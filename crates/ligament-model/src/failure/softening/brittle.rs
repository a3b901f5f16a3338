//! No force at all after the limit.

use super::law::{Fall, Law};
use super::softened::Softened;

/// A bond that breaks at its limit (Silling and Askari 2005, prototype microelastic brittle).
pub const LAW: Law = Law {
    word: "brittle",
    words: "It breaks.",
    source: "",
    force: "brittle",
    parameter: None,
    softens: false,
    sliding_because: None,
    fall: Fall::Formula {
        at: |_, _| Softened::SOUND,
        end: |_| 1.0,
        total: |_| 1.0,
        for_energy: |_| f64::NAN,
    },
};

impl Default for Law {
    fn default() -> Self {
        LAW
    }
}
