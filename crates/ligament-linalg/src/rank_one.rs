//! A change of a matrix of rank one.

/// A term c w w^T of a change of the matrix.
#[derive(Debug, Clone, PartialEq)]
pub struct RankOne {
    /// The factor c: positive where stiffness is added, negative where it leaves.
    pub weight: f64,
    /// Unknowns and values of w, which add up where an unknown comes twice; every pair of unknowns must be in the pattern
    /// of the matrix.
    pub entries: Vec<(usize, f64)>,
}
