//! Motion in time: explicit and implicit steps in which bonds break.

mod clock;
mod explicit;
mod implicit;
mod inertia;
mod newmark;
mod quasi_static;
mod rates;
mod record;
mod rigid_step;
mod trial_step;

use std::io::Read;

use crate::error::SetupError;
use crate::history::Observer;
use crate::motion::{MotionProblem, MotionSettings, Scheme, critical_step};
use crate::solver::ExplicitChoice;

use super::{Outcome, Restored, Way};
use clock::Clock;

/// Begins a motion at time zero.
///
/// # Errors
///
/// If the motion cannot be computed ([`MotionError`](crate::motion::MotionError)), or an observer fails.
pub fn begin<'a>(
    problem: &MotionProblem,
    settings: &MotionSettings,
    observer: &'a mut dyn Observer,
) -> Result<Box<dyn Way + 'a>, SetupError> {
    Ok(match settings.scheme {
        Scheme::Explicit => Box::new(explicit::begin(problem, settings, observer)?),
        Scheme::Implicit | Scheme::Auto => Box::new(implicit::begin(problem, settings, observer)?),
    })
}

/// Follows a motion to its end.
///
/// # Errors
///
/// As in [`begin`], or if the motion fails.
pub fn run(
    problem: &MotionProblem,
    settings: &MotionSettings,
    observer: &mut dyn Observer,
) -> Result<Outcome, SetupError> {
    begin(problem, settings, observer)?.follow()
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
        Scheme::Explicit => Ok(explicit::chosen(problem, settings)?.1),
        Scheme::Implicit | Scheme::Auto => Ok(ExplicitChoice {
            step: Clock::implicit(settings)?.step(),
            critical: critical_step(problem, settings)?,
        }),
    }
}

/// Restores a motion from a checkpoint, to continue as if it had never stopped; the rules for a stop may differ from those before.
///
/// # Errors
///
/// If the checkpoint is damaged, or belongs to another body, to other times or to another scheme.
pub fn restore(
    problem: &MotionProblem,
    settings: &MotionSettings,
    checkpoint: &mut dyn Read,
) -> Result<Restored, SetupError> {
    match settings.scheme {
        Scheme::Explicit => explicit::restore(problem, settings, checkpoint),
        Scheme::Implicit | Scheme::Auto => implicit::restore(problem, settings, checkpoint),
    }
}
