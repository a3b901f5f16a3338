//! Factors of random sparse symmetric systems: solved, changed in place, broken and made anew.
#![allow(clippy::unwrap_used)]

mod changes;
mod dissection;
mod failures;
mod solving;
mod systems;
mod threads;

/// Unit roundoff times two.
const EPSILON: f64 = f64::EPSILON;
