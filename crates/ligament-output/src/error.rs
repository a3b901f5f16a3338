//! Errors of writing and reading results.

use std::fmt;
use std::io;
use std::path::{Path, PathBuf};

use crate::remedy::Remedy;

/// Location of the values of a field.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum FieldLocation {
    /// One value per point.
    Point,
    /// One value per cell.
    Cell,
}

impl fmt::Display for FieldLocation {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Point => "point",
            Self::Cell => "cell",
        })
    }
}

/// Error of writing or reading results, with the path of the file or folder.
#[derive(Debug, thiserror::Error)]
pub enum Error {
    /// The operating system refused an operation.
    #[error("cannot {action} {path}{}", advice(action, source))]
    System {
        /// The operation, a verb.
        action: &'static str,
        /// Path of the file or folder.
        path: PathBuf,
        /// Cause of the error in the operating system.
        source: io::Error,
    },
    /// A result file in another form than this program writes.
    #[error("cannot use {path}: {reason}")]
    Unreadable {
        /// Path of the file.
        path: PathBuf,
        /// Reason why the file cannot be used.
        reason: String,
    },
    /// A folder without the expected results of a run.
    #[error("{path} holds no results of a run: {reason}")]
    NoResults {
        /// Path of the folder.
        path: PathBuf,
        /// The reason, with advice.
        reason: String,
    },
    /// Values that readers of the file would refuse or misread, such as wrong lengths or duplicate names.
    #[error("{path}: {reason}")]
    Refused {
        /// Path of the file, which was not written.
        path: PathBuf,
        /// The mismatch, with its numbers.
        reason: String,
    },
    /// A run without the file of its model.
    #[error(
        "{0} holds no results of a run: it has no model.vtu: the case has `output.model = false`, or an earlier version ran it"
    )]
    NoModel(PathBuf, #[source] Remedy),
    /// The folder has the results of an earlier run and may not be replaced.
    #[error("{0} already holds the results of an earlier run")]
    ResultsExist(PathBuf, #[source] Remedy),
    /// Another process writes to the folder.
    #[error(
        "{path} is in use: {} writes its results there",
        process.map_or_else(|| "another run".to_owned(), |it| format!("another run (process {it})"))
    )]
    Busy {
        /// Path of the folder.
        path: PathBuf,
        /// Number of the process, where known.
        process: Option<u32>,
        /// Remedy for the user.
        #[source]
        remedy: Remedy,
    },
    /// The folder has files but no marker of results, so it is never replaced.
    #[error(
        "{path} exists and is not a result folder (it holds files, but no {marker}), so it is never replaced"
    )]
    NotAResultFolder {
        /// Path of the folder.
        path: PathBuf,
        /// Name of the missing marker file.
        marker: &'static str,
        /// Remedy for the user.
        #[source]
        remedy: Remedy,
    },
    /// The file to be written exists.
    #[error("{0} exists already")]
    FileExists(PathBuf, #[source] Remedy),
    /// The path of a file to be written is a folder, a disk or the like.
    #[error("{0} exists and is not a file, so nothing is written there")]
    NoPlaceForFile(PathBuf, #[source] Remedy),
    /// The path of the folder is not a folder.
    #[error("{0} exists and is not a folder")]
    NotAFolder(PathBuf, #[source] Remedy),
    /// The path of a file or folder of the program is a link, whose target may be anything.
    #[error(
        "{0} is a link, and results are neither read nor written through links: put the file itself in its place, or remove the link"
    )]
    Link(PathBuf),
    /// The path to which earlier results are moved during their replacement exists.
    #[error(
        "cannot move the old results aside: {0} exists, probably left by an interrupted run, and may hold what is needed"
    )]
    ReplacedExists(PathBuf, #[source] Remedy),
    /// A path such as `..` or `/`, without the name of a folder that could be renamed.
    #[error("{0} cannot be replaced because the path does not end in a folder name")]
    UnnamedFolder(PathBuf, #[source] Remedy),
}

/// Advice for an operation that the system refused.
fn advice(action: &str, source: &io::Error) -> &'static str {
    match source.kind() {
        io::ErrorKind::StorageFull | io::ErrorKind::QuotaExceeded => {
            ": free space on its disk, or choose a folder on another one"
        }
        io::ErrorKind::FileTooLarge => {
            ": its disk, or a limit such as `ulimit -f`, allows no file of that size; choose a folder on another one, or a higher limit"
        }
        io::ErrorKind::ReadOnlyFilesystem => {
            ": its disk cannot be written to; choose a folder on another one"
        }
        io::ErrorKind::PermissionDenied if matches!(action, "create" | "write") => {
            ": choose a folder with permission to write"
        }
        _ => "",
    }
}

impl Error {
    /// The error of an operation that the operating system refused, from its cause.
    pub fn system(action: &'static str, path: &Path) -> impl Fn(io::Error) -> Self {
        move |source| Self::System {
            action,
            path: path.to_path_buf(),
            source,
        }
    }
}
