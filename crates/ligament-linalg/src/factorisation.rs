//! The interface of all factorisations.

use crate::factor_error::FactorError;
use crate::matrix::SymmetricMatrix;
use crate::parts::Part;
use crate::rank_one::RankOne;

/// A factorised symmetric matrix.
pub trait Factorisation: Send + Sync {
    /// Factorises a matrix with other values over the same pattern. After an error the factor must not be used before another call succeeds.
    fn refactorise(&mut self, matrix: &SymmetricMatrix) -> Result<(), FactorError>;

    /// Solves A x = b in place, b of shape (n).
    fn solve_in_place(&mut self, right_hand_side: &mut [f64]);

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
