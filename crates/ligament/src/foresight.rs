//! Prediction of the first bond at its limit from the first solutions of a run.

use ligament_analysis::driver::{self, Prediction, Problem};
use ligament_analysis::{Observer, Termination};

use crate::error::Error;
use crate::run::follow;
use crate::setup::Analysis;

/// Predicts the first bond at its limit under an analysis of loads; `None` for an elastic analysis, in which no bond breaks.
///
/// The observer receives the messages of a run before its first load step.
///
/// # Errors
///
/// If the equations cannot be set up, nothing resists the loads, or the analysis is of natural modes or a motion.
pub fn predict(
    problem: &Problem,
    analysis: &Analysis,
    observer: &mut dyn Observer,
) -> Result<Option<Prediction>, Error> {
    Ok(match analysis {
        Analysis::Stepped(settings) => Some(driver::stepped::predict(problem, settings, observer)?),
        Analysis::Event(settings) => Some(driver::event::predict(problem, settings, observer)?),
        Analysis::Elastic { .. } | Analysis::Modal(_) | Analysis::Motion(_) => {
            let outcome = follow(problem, analysis, observer)?;
            let part = outcome.history.last().map_or(0, |it| it.part);
            match outcome.termination {
                Termination::NoEquilibrium { reason, .. } => {
                    Some(Prediction::NoEquilibrium { part, reason })
                }
                end @ Termination::Unstable { .. } => Some(Prediction::Refused(end)),
                _ => None,
            }
        }
    })
}

/// Refuses, without a solution, problems that the analysis cannot treat.
///
/// # Errors
///
/// If the problem cannot be followed along its exact path.
pub fn refuse(problem: &Problem, analysis: &Analysis) -> Result<(), Error> {
    match analysis {
        Analysis::Event(_) => Ok(driver::event::refuse(problem)?),
        Analysis::Elastic { .. }
        | Analysis::Stepped(_)
        | Analysis::Modal(_)
        | Analysis::Motion(_) => Ok(()),
    }
}
