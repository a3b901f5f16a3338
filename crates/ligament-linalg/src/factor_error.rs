//! Reasons why a matrix has no factor.

use thiserror::Error;

/// Reasons why a matrix has no factor.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
pub enum FactorError {
    /// A pivot of L L^T is not positive.
    #[error("the matrix is not positive definite: pivot of unknown {unknown}")]
    NotPositiveDefinite {
        /// Index of the pivot in the matrix.
        unknown: usize,
    },
    /// A pivot of L D L^T is zero.
    #[error("the matrix is singular: pivot of unknown {unknown} is zero")]
    ZeroPivot {
        /// Index of the pivot in the matrix.
        unknown: usize,
    },
    /// Pivots of L D L^T vanish.
    #[error("the matrix is singular: {vanishing} pivots vanish")]
    Singular {
        /// Number of vanishing pivots.
        vanishing: usize,
    },
    /// The factor does not fit into memory.
    #[error("out of memory: the factor needs {bytes} bytes")]
    OutOfMemory {
        /// Bytes requested.
        bytes: usize,
    },
    /// The matrix is too large for the index type.
    #[error("the matrix is too large to be indexed")]
    IndexOverflow,
}
