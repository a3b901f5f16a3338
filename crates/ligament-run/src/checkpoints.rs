//! When a run writes checkpoints, and what goes into them.

use std::time::{Duration, Instant};

use ligament_analysis::Termination;
use ligament_analysis::serial::Serial;
use ligament_output::checkpoint::Checkpoint;
use ligament_output::folder::ResultFolder;
use ligament_output::results::OutputState;

/// The wish that a run stop, which is asked for after each equilibrium.
pub type IsStopped<'a> = &'a (dyn Fn() -> bool + Sync);

/// Version of the program, which a checkpoint names.
pub(crate) const VERSION: &str = env!("CARGO_PKG_VERSION");

/// Time between two checkpoints where the case says nothing, ...
const EVERY: Duration = Duration::from_secs(30);

/// ... and how many times what the last one took, so that all take a fiftieth of the time.
const TIMES_ITS_COST: u32 = 50;

/// The checkpoints of a run.
pub(crate) struct Checkpoints<'a> {
    folder: &'a ResultFolder,
    inputs: String,
    /// Time between two, s, if the case has it.
    every: Option<f64>,
    last: Instant,
    cost: Duration,
    is_due: bool,
}

impl<'a> Checkpoints<'a> {
    /// The checkpoints of a run with these inputs; the first is due after the time between two.
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

    /// Finds out whether one is due in the next moment, in which the run ends, perhaps, for a reason.
    pub(crate) fn ask(&mut self, end: Option<&Termination>) {
        let passed = self.last.elapsed();
        self.is_due = match (end, self.every) {
            (Some(end), every) => is_kept(end, every),
            (None, Some(0.0)) => false,
            (None, Some(every)) => passed.as_secs_f64() >= every,
            (None, None) => passed >= EVERY.max(TIMES_ITS_COST * self.cost),
        };
    }

    /// Whether one is due.
    pub(crate) fn is_due(&self) -> bool {
        self.is_due
    }

    /// Writes one, the work on which began at an instant.
    pub(crate) fn write(
        &mut self,
        begun: Instant,
        solution: Vec<u8>,
        results: &OutputState,
        notices: &[String],
    ) -> Result<(), ligament_output::Error> {
        let mut of_results = Vec::new();
        results.write(&mut of_results);
        let checkpoint = Checkpoint {
            version: VERSION.to_owned(),
            inputs: self.inputs.clone(),
            solution,
            results: of_results,
            notices: notices.to_vec(),
        };
        checkpoint.write(self.folder.path())?;
        self.last = Instant::now();
        self.cost = self.last - begun;
        Ok(())
    }

    /// Removes the checkpoints of a run that came to its end.
    pub(crate) fn end(&self, end: &Termination) -> Result<(), ligament_output::Error> {
        if is_kept(end, self.every) {
            Ok(())
        } else {
            Checkpoint::remove(self.folder.path())
        }
    }
}

/// Whether a run that ended so keeps a checkpoint, for it may go on with another rule.
fn is_kept(end: &Termination, every: Option<f64>) -> bool {
    *end == Termination::Stopped || (end.is_by_rule() && every != Some(0.0))
}
