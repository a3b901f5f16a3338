//! Why there is no page.

use ligament_output::Error;
use ligament_plot::picture::PictureError;
use thiserror::Error as ThisError;

/// Why there is no page.
#[derive(Debug, ThisError)]
pub enum ReportError {
    /// Results cannot be read, or the page cannot be written.
    #[error(transparent)]
    Results(#[from] Error),
    /// A solid cannot be drawn.
    #[error(transparent)]
    Picture(#[from] PictureError),
    /// There are as many labels as results, or none.
    #[error("{n_labels} labels for {n_results} results; give one for each, in their order")]
    Labels {
        /// Labels given.
        n_labels: usize,
        /// Results given.
        n_results: usize,
    },
}
