//! Schedule and content of the checkpoints of a run.

use std::time::{Duration, Instant};

use ligament_analysis::serial::{Serial, Sink};
use ligament_analysis::{Message, Termination};
use ligament_output::checkpoint::Checkpoint;
use ligament_output::folder::ResultFolder;
use ligament_output::results::OutputState;

/// Returns whether the run should stop; called after each equilibrium.
pub type IsStopped<'a> = &'a (dyn Fn() -> bool + Sync);

/// Requests of the user to end a run.
#[derive(Clone, Copy)]
pub(crate) struct StopRequests<'a> {
    /// Whether the run is to stop at its next state.
    pub(crate) is_stopped: IsStopped<'a>,
    /// Whether the run is to end at once, without a state of its own.
    pub(crate) is_aborted: IsStopped<'a>,
}

impl<'a> StopRequests<'a> {
    /// Requests that stop a run at its next state and never at once.
    pub(crate) fn at_next_state(is_stopped: IsStopped<'a>) -> Self {
        Self {
            is_stopped,
            is_aborted: &|| false,
        }
    }
}

/// Version of the program in a checkpoint.
pub(crate) const VERSION: &str = env!("CARGO_PKG_VERSION");

/// Default time between two checkpoints; longer where [`TIMES_ITS_COST`] demands.
const EVERY: Duration = Duration::from_secs(30);

/// Smallest ratio of the time between two checkpoints to the time that writing one takes, so that they cost a fiftieth of the run.
const TIMES_ITS_COST: u32 = 50;

/// The checkpoints of a run.
pub(crate) struct Checkpoints<'a> {
    folder: &'a ResultFolder,
    inputs: String,
    /// Time between two checkpoints, s, if given in the case.
    every: Option<f64>,
    last: Instant,
    cost: Duration,
    is_due: bool,
}

impl<'a> Checkpoints<'a> {
    /// The checkpoints of a run with these inputs; the first is due after one interval.
    pub(crate) fn new(folder: &'a ResultFolder, inputs: String, every: Option<f64>) -> Self {
        Self {
            folder,
            inputs,
            every,
            last: Instant::now(),
            cost: Duration::ZERO,
            is_due: false,
        }
    }

    /// Determines whether a checkpoint is due in the next state; `end` is the reason if the run ends there.
    pub(crate) fn decide(&mut self, end: Option<&Termination>) {
        let passed = self.last.elapsed();
        self.is_due = match (end, self.every) {
            (Some(end), every) => is_kept(end, every),
            (None, Some(0.0)) => false,
            (None, Some(every)) => passed.as_secs_f64() >= every,
            (None, None) => passed >= EVERY.max(TIMES_ITS_COST * self.cost),
        };
    }

    /// Whether a checkpoint is due.
    pub(crate) fn is_due(&self) -> bool {
        self.is_due
    }

    /// Writes a checkpoint, with a function that writes the solution; `start` is the start of the work on it.
    pub(crate) fn write(
        &mut self,
        start: Instant,
        solution: &dyn Fn(&mut dyn Sink),
        results: &OutputState,
        messages: &[Message],
    ) -> Result<(), ligament_output::Error> {
        let mut of_results = Vec::new();
        results.write(&mut of_results);
        let checkpoint = Checkpoint {
            version: VERSION.to_owned(),
            inputs: self.inputs.clone(),
            results: of_results,
            messages: messages.to_vec(),
        };
        checkpoint.write(self.folder.path(), solution)?;
        self.last = Instant::now();
        self.cost = self.last - start;
        Ok(())
    }

    /// Removes the checkpoints of a run that ended, unless they are kept.
    pub(crate) fn end(&self, end: &Termination) -> Result<(), ligament_output::Error> {
        if is_kept(end, self.every) {
            Ok(())
        } else {
            Checkpoint::remove(self.folder.path())
        }
    }
}

/// Whether a run keeps its checkpoint after this end, because it may continue with another stop rule.
fn is_kept(end: &Termination, every: Option<f64>) -> bool {
    *end == Termination::Stopped || (end.is_by_rule() && every != Some(0.0))
}
