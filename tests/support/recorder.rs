//! A recorder of what a run tells, to compare runs bit by bit.

use ligament_analysis::history::{Moment, Observer, ObserverError, Onward, StepRecord, View};
use rayon::ThreadPoolBuilder;

/// What a run tells, and its checkpoints.
#[derive(Default)]
pub struct Recorder {
    /// A line for each record.
    pub lines: Vec<String>,
    /// Checkpoints, each with the number of lines before it.
    pub moments: Vec<(usize, Vec<u8>)>,
}

impl Observer for Recorder {
    fn step(&mut self, record: &StepRecord, view: &View<'_>) -> Result<(), ObserverError> {
        self.lines.push(format!("{record:?} {:?}", view.state));
        Ok(())
    }

    fn moment(&mut self, moment: &Moment<'_>) -> Result<Onward, ObserverError> {
        if moment.end.is_none() {
            self.moments.push((self.lines.len(), (moment.checkpoint)()));
        }
        Ok(Onward::Go)
    }
}

/// What some work returns on a number of threads.
pub fn on_threads<T: Send>(count: usize, work: impl FnOnce() -> T + Send) -> T {
    let pool = ThreadPoolBuilder::new().num_threads(count).build().unwrap();
    pool.install(work)
}
