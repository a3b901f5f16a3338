//! Loads that break a body at once, in the first tenth of the first load step.

use thiserror::Error;

/// Loads that break the body at once, without meaningful results.
#[derive(Debug, Clone, Copy, PartialEq, Error)]
#[error(
    "the body breaks at once: its first bond reaches its limit at {share:.4} of the first load step, at whose end {beyond} of {bonds} bonds \
     would be beyond theirs; the loads are too large, or the steps too few (SI units: m, N, Pa)"
)]
pub struct AtOnce {
    /// Share of the first load step at which the first bond reaches its limit.
    pub share: f64,
    /// Number of bonds beyond their limits at the end of the step if none broke.
    pub beyond: usize,
    /// Total number of bonds.
    pub bonds: usize,
}
