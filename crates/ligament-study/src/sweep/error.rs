//! Errors of reading and running a study.

use std::io;
use std::path::PathBuf;

use ligament_case::case::{CaseError, Location};

/// Error of a study. Failed runs are rows of the table, not errors.
#[derive(Debug, thiserror::Error)]
pub enum StudyError {
    /// The study file could not be read.
    #[error("cannot read the study file {}", path.display())]
    Read {
        /// The study file.
        path: PathBuf,
        /// The system's reason.
        source: io::Error,
    },
    /// A key or value of the study, or its base case, is wrong.
    #[error(transparent)]
    Case(#[from] CaseError),
    /// The case of a run is wrong.
    #[error("{location}: no case for the run {run}")]
    Run {
        /// The value in the study.
        location: Location,
        /// Name of the run.
        run: String,
        /// Error of the case.
        source: Box<CaseError>,
    },
    /// An input file of a run cannot be read.
    #[error("{location}: the run {run} cannot read {}", path.display())]
    Input {
        /// The value in the study that names the file, or the study.
        location: Location,
        /// Name of the run.
        run: String,
        /// File that cannot be read.
        path: PathBuf,
        /// The system's reason.
        source: io::Error,
    },
    /// Too many runs.
    #[error("{}: the axes have {runs} combinations, more than the {most} that a study may have", path.display())]
    TooMany {
        /// The study file.
        path: PathBuf,
        /// Number of combinations.
        runs: usize,
        /// Largest allowed number.
        most: usize,
    },
    /// Runs failed.
    #[error("{failed} of {total} runs failed; the same command repeats them")]
    Failed {
        /// Number of failed runs.
        failed: usize,
        /// Number of runs.
        total: usize,
    },
}
