//! What can go wrong when results are written or read.

use std::fmt;
use std::io;
use std::path::{Path, PathBuf};

/// Where the values of a field live.
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

/// A failure to write results, or to read them back. The path is that of the file or folder meant.
#[derive(Debug, thiserror::Error)]
pub enum Error {
    /// The operating system refused an operation.
    #[error("cannot {action} {path}{}", remedy(action, source))]
    System {
        /// The operation, a verb.
        action: &'static str,
        /// The file or folder meant.
        path: PathBuf,
        /// The cause.
        source: io::Error,
    },
    /// A result file that is not as this program writes it.
    #[error("cannot use {path}: {reason}")]
    Unreadable {
        /// The file meant.
        path: PathBuf,
        /// The reason why the file cannot be used.
        reason: String,
    },
    /// A folder that should hold the results of a run and does not.
    #[error("{path} holds no results of a run: {reason}")]
    NoResults {
        /// The folder meant.
        path: PathBuf,
        /// The reason, and what to do.
        reason: String,
    },
    /// Values that readers of the file would refuse or take for something else: lengths that do not fit, names given twice.
    #[error("{path}: {reason}")]
    Refused {
        /// The file meant, which was not written.
        path: PathBuf,
        /// What does not fit, with its numbers.
        reason: String,
    },
    /// The folder holds the results of an earlier run and may not be replaced.
    #[error(
        "{0} already holds the results of an earlier run; choose another folder with --out, or replace them with --force"
    )]
    ResultsExist(PathBuf),
    /// Another process writes to the folder.
    #[error(
        "{path} is in use: {} writes its results there; wait for its end, or choose another folder with --out",
        process.map_or_else(|| "another run".to_owned(), |it| format!("another run (process {it})"))
    )]
    Busy {
        /// The folder meant.
        path: PathBuf,
        /// Number of the process, where it has told.
        process: Option<u32>,
    },
    /// The folder holds files, but nothing shows that they are results, so it is never replaced.
    #[error(
        "{path} exists and is not a result folder (it holds files, but no {marker}), so \
         not even --force replaces it; choose another folder with --out, or remove it yourself"
    )]
    NotAResultFolder {
        /// The folder meant.
        path: PathBuf,
        /// The file that would show it.
        marker: &'static str,
    },
    /// A file is in the place of a file that was asked for.
    #[error("{0} is there already: write to another file with --out, or replace it with --force")]
    FileExists(PathBuf),
    /// A folder, a disk or the like is in the place of a file that was asked for.
    #[error(
        "{0} exists and is not a file, so nothing is written there; choose another file with --out"
    )]
    NoPlaceForFile(PathBuf),
    /// Something other than a folder is in the place of the folder.
    #[error("{0} exists and is not a folder; choose another folder with --out")]
    NotAFolder(PathBuf),
    /// A link in the place of a file or folder of the program's own, which may lead anywhere.
    #[error(
        "{0} is a link, and results are neither read nor written through links: put the file itself in its place, or remove the link"
    )]
    Link(PathBuf),
    /// The place the old results are moved to while they are replaced is taken.
    #[error(
        "cannot move the old results aside: {0} exists, probably left by an interrupted run; look into it, then \
         remove or rename it, or choose another folder with --out"
    )]
    ReplacedExists(PathBuf),
    /// A path such as `..` or `/`, which names no folder that could be moved aside.
    #[error(
        "{0} cannot be replaced because the path does not end in a folder name; choose a named folder with --out"
    )]
    UnnamedFolder(PathBuf),
}

/// What to do about an operation that the system refused.
fn remedy(action: &str, source: &io::Error) -> &'static str {
    match source.kind() {
        io::ErrorKind::StorageFull | io::ErrorKind::QuotaExceeded => {
            ": make room on its disk, or take a folder on another one"
        }
        io::ErrorKind::FileTooLarge => {
            ": its disk, or a limit such as `ulimit -f`, takes no file of that size; take a folder on another one, or a higher limit"
        }
        io::ErrorKind::ReadOnlyFilesystem => {
            ": its disk cannot be written to; take a folder on another one"
        }
        io::ErrorKind::PermissionDenied if matches!(action, "create" | "write") => {
            ": take a folder that you may write to"
        }
        _ => "",
    }
}

impl Error {
    /// The error of an operation that the operating system refused, from its cause.
    pub(crate) fn system(action: &'static str, path: &Path) -> impl Fn(io::Error) -> Self {
        move |source| Self::System {
            action,
            path: path.to_path_buf(),
            source,
        }
    }
}
