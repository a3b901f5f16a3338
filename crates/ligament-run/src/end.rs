//! Exit codes of runs, by the table of ends of the analysis.

pub use ligament_analysis::termination::End;

/// Whether a run with an exit code has results that a study may read.
pub fn leaves_results(exit_code: Option<i32>) -> bool {
    let ends = [End::Done, End::NoResult, End::NotAtRest];
    ends.iter()
        .any(|it| exit_code == Some(it.exit_code().into()))
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
