//! A recorder of what a run reports, to compare runs bit by bit.

use ligament::run::{self, Posed};
use ligament::setup::Analysis;
use ligament_analysis::history::{Moment, Observer, ObserverError, Onward, StepRecord, View};
use rayon::ThreadPoolBuilder;

/// Reports of a run, and its checkpoints.
#[derive(Default)]
struct Recorder {
    /// A line for each record.
    lines: Vec<String>,
    /// Checkpoints, each with the number of lines before it.
    moments: Vec<(usize, Vec<u8>)>,
}

impl Observer for Recorder {
    fn step(&mut self, record: &StepRecord, view: &View<'_>) -> Result<(), ObserverError> {
        self.lines.push(format!("{record:?} {:?}", view.state));
        Ok(())
    }

    fn moment(&mut self, moment: &Moment<'_>) -> Result<Onward, ObserverError> {
        if moment.end.is_none() {
            self.moments.push((self.lines.len(), moment.bytes()));
        }
        Ok(Onward::Go)
    }
}

/// Number of checkpoints of a run that has the same bits on one and two threads, and goes on to the same bits from one of `stride` checkpoints.
///
/// # Panics
///
/// Panics if some bits differ, with the name of the run.
pub fn checkpoints_of_the_same_bits(
    name: &str,
    posed: Posed<'_>,
    analysis: &Analysis,
    stride: usize,
) -> usize {
    let recorded = |threads: usize| {
        let pool = ThreadPoolBuilder::new().num_threads(threads).build();
        pool.unwrap().install(|| {
            let mut recorder = Recorder::default();
            run::follow(posed, analysis, &mut recorder).unwrap();
            recorder
        })
    };
    let [one, two] = [1, 2].map(recorded);
    assert!(one.lines == two.lines, "{name}");
    for (from, checkpoint) in one.moments.iter().step_by(stride) {
        let mut rest = Recorder::default();
        let restored = run::restore(posed, analysis, &mut checkpoint.as_slice()).unwrap();
        restored.resume(&mut rest).unwrap();
        assert!(rest.lines[..] == one.lines[*from..], "{name}, from {from}");
    }
    one.moments.len()
}
