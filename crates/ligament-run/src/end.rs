//! End of a run and its exit code, by one rule for all analyses.

use ligament_analysis::Termination;
use ligament_output::summary::Summary;

/// End of a run, by the use of its results.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum End {
    /// The loading was completed, a rule of the case ended the run, or the body separated.
    Done,
    /// A signal stopped the run, which can be resumed.
    Stopped,
    /// No state under load is in equilibrium: there is no result.
    NoResult,
    /// No equilibrium was found at a load, whether or not bonds were breaking; the results end before it.
    NoEquilibrium,
    /// The energies of a motion grew without cause, or are not numbers; the results reach up to there.
    Diverged,
    /// The run ended during breakage, other than by its user or a rule of its case: the last state is not a solution for its load.
    NotAtRest,
}

impl End {
    /// The end of a run by its summary.
    pub fn from_summary(summary: &Summary) -> Self {
        const ASKED_FOR: [&str; 2] = ["bonds-broken", "wall-time"];
        let termination = &*summary.termination;
        if termination == Termination::Stopped.name() {
            Self::Stopped
        } else if summary.without_equilibrium {
            Self::NoResult
        } else if termination == NO_EQUILIBRIUM {
            Self::NoEquilibrium
        } else if termination == ENERGY_GREW {
            Self::Diverged
        } else if summary.last_state_not_at_rest && !ASKED_FOR.contains(&termination) {
            Self::NotAtRest
        } else {
            Self::Done
        }
    }

    /// The exit code of the program.
    pub fn exit_code(self) -> u8 {
        match self {
            Self::Done => 0,
            Self::NoResult | Self::NoEquilibrium | Self::Diverged => 3,
            Self::Stopped => 4,
            Self::NotAtRest => 6,
        }
    }

    /// Whether a run with an exit code has results that a study may read.
    pub fn leaves_results(exit_code: Option<i32>) -> bool {
        let ends = [
            Self::Done,
            Self::NoResult,
            Self::NoEquilibrium,
            Self::Diverged,
            Self::NotAtRest,
        ];
        ends.iter()
            .any(|it| exit_code == Some(it.exit_code().into()))
    }
}

/// Error of a run that a signal stopped before its first solution, so that it cannot be resumed.
#[derive(Debug, Clone, Copy, thiserror::Error)]
#[error("stopped before the first solution: nothing was written")]
pub struct StoppedBeforeSolution;

impl StoppedBeforeSolution {
    /// The exit code of the program, the same as of every run that a signal stops.
    pub fn exit_code(self) -> u8 {
        End::Stopped.exit_code()
    }
}

/// Name in summaries of the end of a run without equilibrium.
pub const NO_EQUILIBRIUM: &str = "no-equilibrium";

/// Name in summaries of the end of a motion whose energies grow or are not numbers.
const ENERGY_GREW: &str = "energy-grew";

/// Message about a run that ended without equilibrium after other states.
pub(crate) const UP_TO_THERE: &str =
    "no equilibrium was found at the load where the run ended; the results reach up to there";
