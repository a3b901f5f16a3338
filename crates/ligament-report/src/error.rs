//! Error of making a page.

use std::path::PathBuf;

use ligament_output::Error;
use thiserror::Error as ThisError;

/// Error of making a page.
#[derive(Debug, ThisError)]
pub enum ReportError {
    /// Results cannot be read, or the page cannot be written.
    #[error(transparent)]
    Results(#[from] Error),
    /// A measured curve is not a table of two columns.
    #[error(
        "{path} has {found} columns; a measured curve has two, and a header that names them with their units: opening (mm),force (kN)"
    )]
    Measured {
        /// Table of the measured curve.
        path: PathBuf,
        /// Number of its columns.
        found: usize,
    },
    /// The number of labels differs from the number of results.
    #[error(
        "{n_labels} labels for {n_results} results; give one label for each result, in the same order"
    )]
    Labels {
        /// Number of labels.
        n_labels: usize,
        /// Number of results.
        n_results: usize,
    },
}
