//! A change of a matrix of rank one.

use serde::{Deserialize, Serialize};

/// A term c w w^T of a change of the matrix.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct RankOne {
    /// Factor c: positive where stiffness is added, negative where it is removed.
    pub weight: f64,
    /// Unknowns and values of w; values of a repeated unknown add up. Every pair of unknowns must be in the pattern of the matrix.
    pub entries: Vec<(usize, f64)>,
}
