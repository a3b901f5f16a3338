//! Why a study could not be read or run.

use std::io;
use std::path::PathBuf;

use ligament_case::case::{CaseError, Location};

/// Why a study cannot be run. Runs that fail are no such error: they are rows of the table.
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
        /// What is wrong.
        source: Box<CaseError>,
    },
    /// A file that a run takes cannot be read.
    #[error("{location}: the run {run} cannot read {}", path.display())]
    Input {
        /// The value in the study that names it, or the study.
        location: Location,
        /// Name of the run.
        run: String,
        /// The file.
        path: PathBuf,
        /// The system's reason.
        source: io::Error,
    },
    /// More runs than anybody means.
    #[error("{}: the axes have {runs} combinations, more than the {most} that a study may have", path.display())]
    TooMany {
        /// The study file.
        path: PathBuf,
        /// Number of combinations.
        runs: usize,
        /// The most allowed.
        most: usize,
    },
    /// The folder is in use.
    #[error(
        "another sweep works on {} ({what}); wait for its end, or give this one its own folder by --out", folder.display()
    )]
    Busy {
        /// The folder.
        folder: PathBuf,
        /// The sweep that uses it, in words.
        what: String,
    },
    /// The folder of the study cannot be used.
    #[error(transparent)]
    Folder(#[from] ligament_output::Error),
    /// A file of the study's folder cannot be used.
    #[error("cannot {action} {}", path.display())]
    File {
        /// What was tried.
        action: &'static str,
        /// The file or folder.
        path: PathBuf,
        /// The system's reason.
        source: io::Error,
    },
    /// There is nothing to collect.
    #[error("{} is no folder of a study (no {marker} in it): run the study first, or name its folders by --from", folder.display())]
    NoStudy {
        /// The folder.
        folder: PathBuf,
        /// The file by which it would be known.
        marker: &'static str,
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
