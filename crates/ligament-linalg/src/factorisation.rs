//! The interface of all factorisations, the terms by which they change, and their errors.

use serde::{Deserialize, Serialize};
use thiserror::Error;

use crate::matrix::SymmetricMatrix;
use crate::parts::Part;

/// A factorised symmetric matrix.
pub trait Factorisation: Send + Sync {
    /// Factorises a matrix with other values over the same pattern. Only the columns of the factor that differ are computed: those on the
    /// paths of the elimination tree from changed columns of the matrix to the root. They have the bits of a new factor.
    ///
    /// After an error the factor must not be used before another call succeeds.
    fn refactorise(&mut self, matrix: &SymmetricMatrix) -> Result<(), FactorError>;

    /// Solves A x = b in place, b of shape (n).
    fn solve_in_place(&mut self, right_hand_side: &mut [f64]);

    /// Solves A x = b in place for two b of shape (n) in one pass over the factor, to the bits of
    /// [`solve_in_place`](Factorisation::solve_in_place). A pass takes its time to read the factor, so the second solution costs little.
    fn solve_both_in_place(&mut self, right_hand_sides: [&mut [f64]; 2]);

    /// Adds the terms c w w^T to the matrix A by updating its factor in place, and does the forward substitution of A' x = b for a sparse b,
    /// given as (unknown, value).
    ///
    /// Terms are applied one after the other, and each intermediate matrix must have a factor: terms that add stiffness must precede terms
    /// that remove it. Entries of b for the same unknown add up. Only the supernodes that the terms and the entries reach are visited.
    ///
    /// After an error (a vanishing pivot, [`VANISHING_PIVOT`](crate::VANISHING_PIVOT)) the factor must not be used before
    /// [`Factorisation::refactorise`] succeeds.
    ///
    /// # Panics
    ///
    /// Panics if an unknown does not exist.
    fn change(
        &mut self,
        terms: &[RankOne],
        right_hand_side: &[(usize, f64)],
    ) -> Result<ForwardSubstituted, FactorError>;

    /// Backward substitution of a half-solved right-hand side, before the factor changes again; returns x, shape (n).
    fn finish(&self, half_solved: ForwardSubstituted) -> Vec<f64>;

    /// Backward substitution in a part, in place: in `vector` (n), in the order of elimination, the rows of the part enter with the
    /// half-solved right-hand side and leave with the solution; the rows of its border already have the solution.
    fn solve_backward_part(&self, part: &Part, vector: &mut [f64]);

    /// Pivots in the order of the matrix (the entries of D in L D L^T), shape (n).
    fn pivots(&self) -> Vec<f64>;

    /// Numbers of positive and negative pivots. The eigenvalues have the same signs (Sylvester's law of inertia).
    fn inertia(&self) -> Inertia;

    /// An independent copy of the factor.
    fn copied(&self) -> Box<dyn Factorisation>;

    /// A hash of the values of the factor: values that differ in a bit give, almost certainly, different hashes.
    fn digest(&self) -> u64;
}

/// A right-hand side after the forward substitution, in the order of elimination.
#[derive(Debug, Clone, PartialEq)]
pub struct ForwardSubstituted(pub(crate) Vec<f64>);

impl ForwardSubstituted {
    /// The values by row, shape (n).
    pub fn by_row(&self) -> &[f64] {
        &self.0
    }
}

/// Numbers of eigenvalues by sign.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Inertia {
    /// Number of positive eigenvalues.
    pub positive: usize,
    /// Number of negative eigenvalues.
    pub negative: usize,
}

/// A term c w w^T of a change of the matrix.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct RankOne {
    /// Factor c: positive where stiffness is added, negative where it is removed.
    pub weight: f64,
    /// Unknowns and values of w; values of a repeated unknown add up. Every pair of unknowns must be in the pattern of the matrix.
    pub entries: Vec<(usize, f64)>,
}

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
