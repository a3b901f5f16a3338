//! Extent of `ligament check`.

/// Extent of a check.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Extent {
    /// Points, bonds and their correction, without a matrix.
    Model,
    /// The model, the symbolic analysis of the matrix, and the patch test of a body that is not too large.
    Matrix,
    /// The model, the matrix, and the patch test of a body of any size.
    PatchTest,
}
