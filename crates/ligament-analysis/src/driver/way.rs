//! A way to follow a load program, and the loop that all ways have in common.

use super::outcome::Outcome;
use crate::error::SetupError;
use crate::history::Termination;

/// A way to follow a load program: load steps, the exact path, or a motion in explicit or implicit steps.
pub(super) trait Way: Sized {
    /// Goes on to the next row of the history.
    fn advance(&mut self) -> Result<(), Stop>;

    /// Result of a run that ended.
    ///
    /// # Errors
    ///
    /// If an observer fails.
    fn outcome(self, end: Termination) -> Result<Outcome, SetupError>;

    /// Follows the load program to the end of the run.
    ///
    /// # Errors
    ///
    /// If the run fails.
    fn follow(mut self) -> Result<Outcome, SetupError> {
        loop {
            match self.advance() {
                Ok(()) => {}
                Err(Stop::End(end)) => return self.outcome(end),
                Err(Stop::Failed(error)) => return Err(error),
            }
        }
    }
}

/// Reason why a run does not go on: it ended, or it failed.
pub(super) enum Stop {
    End(Termination),
    Failed(SetupError),
}

impl<E: Into<SetupError>> From<E> for Stop {
    fn from(error: E) -> Self {
        Self::Failed(error.into())
    }
}
