//! Error of making a page.

use ligament_output::Error;
use ligament_plot::picture::PictureError;
use thiserror::Error as ThisError;

/// Error of making a page.
#[derive(Debug, ThisError)]
pub enum ReportError {
    /// Results cannot be read, or the page cannot be written.
    #[error(transparent)]
    Results(#[from] Error),
    /// A solid cannot be drawn.
    #[error(transparent)]
    Picture(#[from] PictureError),
    /// The number of labels differs from that of the results.
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
