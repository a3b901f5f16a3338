//! A way to follow a load program, and the loop that all ways have in common.

use super::outcome::Outcome;
use crate::error::SetupError;
use crate::history::{StepRecord, Termination};
use crate::state::State;

/// A way to follow a load program: elastic solutions, load steps, the exact path, or a motion in explicit or implicit steps.
///
/// Who calls [`advance`](Self::advance) by hand sees the body between two rows of the history, and decides when to stop.
pub trait Way {
    /// Goes on by a row of the history: a load step, an event of the exact path, or a row of times.
    ///
    /// # Errors
    ///
    /// Where the run ended, or failed.
    fn advance(&mut self) -> Result<(), Stop>;

    /// The present state of the body.
    fn state(&self) -> &State;

    /// The records so far.
    fn history(&self) -> &[StepRecord];

    /// Result of a run that ended.
    ///
    /// # Errors
    ///
    /// If the observer fails.
    fn outcome(self: Box<Self>, end: Termination) -> Result<Outcome, SetupError>;

    /// Follows the load program to the end of the run.
    ///
    /// # Errors
    ///
    /// If the run fails.
    fn follow(mut self: Box<Self>) -> Result<Outcome, SetupError> {
        loop {
            match self.advance() {
                Ok(()) => {}
                Err(Stop::End(end)) => return self.outcome(end),
                Err(Stop::Failed(error)) => return Err(error),
            }
        }
    }
}

/// Reason why a run does not go on.
#[derive(Debug)]
pub enum Stop {
    /// The run ended.
    End(Termination),
    /// The run failed.
    Failed(SetupError),
}

impl<E: Into<SetupError>> From<E> for Stop {
    fn from(error: E) -> Self {
        Self::Failed(error.into())
    }
}
