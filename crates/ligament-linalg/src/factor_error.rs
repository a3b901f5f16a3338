//! Why a matrix has no factor.

use thiserror::Error;

/// Why a matrix has no factor.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
pub enum FactorError {
    /// L L^T met a pivot that is not positive.
    #[error("the matrix is not positive definite: pivot of unknown {unknown}")]
    NotPositiveDefinite {
        /// Index of the pivot in the matrix.
        unknown: usize,
    },
    /// L D L^T met a pivot that is zero.
    #[error("the matrix is singular: pivot of unknown {unknown} is zero")]
    ZeroPivot {
        /// Index of the pivot in the matrix.
        unknown: usize,
    },
    /// L D L^T met pivots that vanish.
    #[error("the matrix is singular: {vanishing} pivots vanish")]
    Singular {
        /// Number of these pivots.
        vanishing: usize,
    },
    /// The factor does not fit into memory.
    #[error("out of memory: the factor needs {bytes} bytes")]
    OutOfMemory {
        /// Bytes that were asked for.
        bytes: usize,
    },
    /// The matrix is too large for the index type.
    #[error("the matrix is too large to be indexed")]
    IndexOverflow,
}
