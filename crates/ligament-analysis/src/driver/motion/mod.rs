//! Motion in time: explicit steps in which bonds break.

mod body;
mod clock;
mod explicit;
mod inertia;
mod record;
mod restored;

use crate::error::SetupError;
use crate::history::Observer;
use crate::motion::{MotionProblem, MotionSettings, Scheme};
use crate::solver::ExplicitChoice;

use super::Outcome;
pub use restored::Restored;

/// Follows a motion to its end.
///
/// # Errors
///
/// If the motion cannot be computed ([`MotionError`](crate::motion::MotionError)), or an observer fails.
pub fn run(
    problem: &MotionProblem,
    settings: &MotionSettings,
    observer: &mut dyn Observer,
) -> Result<Outcome, SetupError> {
    match settings.scheme {
        Scheme::Explicit(explicit) => explicit::run(problem, settings, explicit, observer),
    }
}

/// Time step of a motion, with the critical one, as [`run`] chooses them.
///
/// # Errors
///
/// If the motion cannot be computed ([`MotionError`](crate::motion::MotionError)).
pub fn time_step(
    problem: &MotionProblem,
    settings: &MotionSettings,
) -> Result<ExplicitChoice, SetupError> {
    match settings.scheme {
        Scheme::Explicit(explicit) => Ok(explicit::chosen(problem, settings, explicit)?.1),
    }
}

/// Restores a motion from a checkpoint.
///
/// # Errors
///
/// If the checkpoint is damaged, or belongs to another body or to statics.
pub fn restore(problem: &MotionProblem, checkpoint: &[u8]) -> Result<Restored, SetupError> {
    Restored::read(problem, checkpoint)
}

/// Continues a motion as if it had never stopped; the rules for a stop may differ from those before.
///
/// # Errors
///
/// If its times differ from those of the checkpoint, or an observer fails.
pub fn resume(
    settings: &MotionSettings,
    restored: Restored,
    observer: &mut dyn Observer,
) -> Result<Outcome, SetupError> {
    match settings.scheme {
        Scheme::Explicit(explicit) => explicit::resume(settings, explicit, restored, observer),
    }
}
