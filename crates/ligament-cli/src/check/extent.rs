//! How far `ligament check` goes.

/// How far a check goes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Extent {
    /// Points, bonds and their correction; no matrix.
    Model,
    /// The symbolic analysis of the matrix as well, and the patch test of a body that is not too large.
    Matrix,
    /// The patch test as well, however large the body is.
    PatchTest,
}
