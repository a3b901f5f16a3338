//! What a loading comes to first, before it is followed: the first bond at its limit, told by the first solutions of the run itself.

use ligament_analysis::driver::{self, Prediction, Problem};
use ligament_analysis::{Observer, Termination};

use crate::error::Error;
use crate::run::follow;
use crate::setup::Analysis;

/// What a problem comes to first under an analysis of loads; none where it has an elastic answer and nothing breaks.
///
/// The observer hears what a run would tell it before its first load step.
///
/// # Errors
///
/// If the run would be refused: its equations cannot be set up, nothing resists the loads, or the analysis is of natural modes.
pub fn predict(
    problem: &Problem,
    analysis: &Analysis,
    observer: &mut dyn Observer,
) -> Result<Option<Prediction>, Error> {
    Ok(match analysis {
        Analysis::Stepped(settings) => Some(driver::stepped::predict(problem, settings, observer)?),
        Analysis::Event(settings) => Some(driver::event::predict(problem, settings, observer)?),
        Analysis::Elastic { .. } | Analysis::Modal(_) => {
            let outcome = follow(problem, analysis, observer)?;
            let part = outcome.history.last().map_or(0, |it| it.part);
            match outcome.termination {
                Termination::NoEquilibrium { reason, .. } => {
                    Some(Prediction::NoEquilibrium { part, reason })
                }
                _ => None,
            }
        }
    })
}

/// Refuses, without a solution, what the analysis of a problem does not take.
///
/// # Errors
///
/// If the problem cannot be followed along its exact path.
pub fn refuse(problem: &Problem, analysis: &Analysis) -> Result<(), Error> {
    match analysis {
        Analysis::Event(_) => Ok(driver::event::refuse(problem)?),
        Analysis::Elastic { .. } | Analysis::Stepped(_) | Analysis::Modal(_) => Ok(()),
    }
}
