//! What every factorisation does.

use crate::factor_error::FactorError;
use crate::matrix::SymmetricMatrix;
use crate::parts::Part;
use crate::rank_one::RankOne;

/// A factorised symmetric matrix.
pub trait Factorisation: Send + Sync {
    /// Factorises other values over the same pattern. After an error the factor must not be used before another call
    /// succeeded.
    fn refactorise(&mut self, matrix: &SymmetricMatrix) -> Result<(), FactorError>;

    /// Solves A x = b in place, b of shape (n).
    fn solve_in_place(&mut self, right_hand_side: &mut [f64]);

    /// Changes the matrix A by the terms c w w^T, in place of its factor, and does the first half of solving A' x = b for a
    /// b of few entries (unknown and value): the forward substitution.
    ///
    /// Terms go in one after the other, and each matrix on the way must have a factor: what adds stiffness belongs before
    /// what takes it. Entries of b for the same unknown add up. The cost is that of the parts of the factor that the terms
    /// and the entries reach.
    ///
    /// After an error (a pivot that vanished, [`VANISHING_PIVOT`](crate::VANISHING_PIVOT)) the factor must not be used
    /// before [`Factorisation::refactorise`] succeeded.
    ///
    /// # Panics
    ///
    /// Panics if there is no such unknown.
    fn change(
        &mut self,
        terms: &[RankOne],
        right_hand_side: &[(usize, f64)],
    ) -> Result<ForwardSubstituted, FactorError>;

    /// The other half, before the factor changes again: the backward substitution; x of shape (n).
    fn finish(&self, half_solved: ForwardSubstituted) -> Vec<f64>;

    /// The backward substitution in a part, in place: `vector` (n), in the order of elimination, holds the half-solved right-hand side in
    /// the rows of the part, and the solution in those of its border.
    fn solve_backward_part(&self, part: &Part, vector: &mut [f64]);

    /// Pivots in the order of the matrix (the entries of D in L D L^T), shape (n).
    fn pivots(&self) -> Vec<f64>;

    /// Numbers of positive and negative pivots. The eigenvalues have the same signs (Sylvester's law of inertia).
    fn inertia(&self) -> Inertia;

    /// A number that differs, as good as certainly, between factors whose values differ in a bit.
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
    /// Positive ones.
    pub positive: usize,
    /// Negative ones.
    pub negative: usize,
}
