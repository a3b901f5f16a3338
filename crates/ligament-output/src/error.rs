//! What can go wrong when results are written or read.

use std::fmt;
use std::io;
use std::path::PathBuf;

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

/// A failure to write results, or to read them back. The path is that of the file or folder meant, the cause is in `source`.
#[derive(Debug, thiserror::Error)]
pub enum Error {
    /// The operating system refused to write a file.
    #[error("cannot write {path}")]
    WriteFile {
        /// The file meant.
        path: PathBuf,
        /// The cause.
        source: io::Error,
    },
    /// The operating system refused to read a file.
    #[error("cannot read {path}")]
    ReadFile {
        /// The file meant.
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
    /// A grid without points or without cells, which VTU readers do not accept.
    #[error(
        "{path}: a VTU file needs points and cells, got {n_points} points and {n_cells} cells; write no file instead"
    )]
    EmptyGrid {
        /// The file meant.
        path: PathBuf,
        /// Points given.
        n_points: usize,
        /// Cells given.
        n_cells: usize,
    },
    /// A cell that names a point which does not exist.
    #[error(
        "{path}: cell {cell} names point {point}, but there are only {n_points} points (counted from 0)"
    )]
    PointOutOfRange {
        /// The file meant.
        path: PathBuf,
        /// Index of the cell.
        cell: usize,
        /// The point that the cell names.
        point: u32,
        /// Points given.
        n_points: usize,
    },
    /// A field whose length is not that of the points or cells.
    #[error(
        "{path}: {location} field '{field}' has {found} values, expected {expected}, one per {location}"
    )]
    FieldLength {
        /// The file meant.
        path: PathBuf,
        /// Point or cell field.
        location: FieldLocation,
        /// Name of the field.
        field: String,
        /// Number of points or cells.
        expected: usize,
        /// Values given.
        found: usize,
    },
    /// Two fields of one name; readers would keep one of them only.
    #[error("{path}: two {location} fields are named '{field}'; give each its own name")]
    DuplicateField {
        /// The file meant.
        path: PathBuf,
        /// Point or cell field.
        location: FieldLocation,
        /// The name given twice.
        field: String,
    },
    /// An output time that no reader can place on a time axis.
    #[error("{path}: the time of {file} is {time}; a collection needs finite times")]
    TimeNotFinite {
        /// The collection meant.
        path: PathBuf,
        /// The file to be listed.
        file: String,
        /// The time given.
        time: f64,
    },
    /// A row that does not fit the header.
    #[error("{path}: a row has {found} values, expected {expected}, one per column of the header")]
    RowLength {
        /// The table meant.
        path: PathBuf,
        /// Columns of the header.
        expected: usize,
        /// Values given.
        found: usize,
    },
    /// The folder holds the results of an earlier run and may not be replaced.
    #[error(
        "{path} already holds the results of an earlier run; choose another folder with --out, or replace them with --force"
    )]
    ResultsExist {
        /// The folder meant.
        path: PathBuf,
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
    /// Something other than a folder is in the place of the folder.
    #[error("{path} exists and is not a folder; choose another folder with --out")]
    NotAFolder {
        /// The folder meant.
        path: PathBuf,
    },
    /// The place the old results are moved to while they are replaced is taken.
    #[error(
        "cannot move the old results aside: {path} exists, probably left by an interrupted run; look into it, then \
         remove or rename it, or choose another folder with --out"
    )]
    ReplacedExists {
        /// The folder in the way.
        path: PathBuf,
    },
    /// A path such as `..` or `/`, which names no folder that could be moved aside.
    #[error(
        "{path} cannot be replaced because the path does not end in a folder name; choose a named folder with --out"
    )]
    UnnamedFolder {
        /// The folder meant.
        path: PathBuf,
    },
    /// The operating system refused an operation on a folder.
    #[error("cannot {action} {path}")]
    Folder {
        /// The operation, a verb.
        action: &'static str,
        /// The folder meant.
        path: PathBuf,
        /// The cause.
        source: io::Error,
    },
}
