//! What every factorisation does, and the choice among them.

use std::sync::Arc;

use thiserror::Error;

use crate::ldlt::Ldlt;
use crate::llt::Llt;
use crate::matrix::SymmetricMatrix;
use crate::modification::RankOne;
use crate::symbolic::Symbolic;

/// A factorised symmetric matrix.
pub trait Factorisation {
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
    ) -> Result<HalfSolved, FactorError>;

    /// The other half, before the factor changes again: the backward substitution; x of shape (n).
    fn finish(&self, half_solved: HalfSolved) -> Vec<f64>;

    /// Pivots in the order of the matrix (the entries of D in L D L^T), shape (n).
    fn pivots(&self) -> Vec<f64>;

    /// Numbers of positive and negative pivots. The eigenvalues have the same signs (Sylvester's law of inertia).
    fn inertia(&self) -> Inertia;
}

/// A right-hand side after the forward substitution, in the order of elimination.
#[derive(Debug, Clone, PartialEq)]
pub struct HalfSolved(pub(crate) Vec<f64>);

/// Numbers of eigenvalues by sign.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Inertia {
    /// Positive ones.
    pub positive: usize,
    /// Negative ones.
    pub negative: usize,
}

/// The factorisations to choose from.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum FactorKind {
    /// L L^T, for positive definite matrices.
    Llt,
    /// L D L^T without pivoting, for matrices that may be indefinite.
    Ldlt,
}

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

impl FactorKind {
    /// Factorises a matrix whose pattern was analysed before.
    pub fn factorise(
        self,
        symbolic: &Arc<Symbolic>,
        matrix: &SymmetricMatrix,
    ) -> Result<Box<dyn Factorisation>, FactorError> {
        let mut factor: Box<dyn Factorisation> = match self {
            Self::Llt => Box::new(Llt::new(symbolic.clone())?),
            Self::Ldlt => Box::new(Ldlt::new(symbolic.clone())?),
        };
        factor.refactorise(matrix)?;
        Ok(factor)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::matrix::{Pattern, PatternError};
    use crate::symbolic::Elimination;

    /// Upper triangle of
    /// ```text
    /// [ 4  1  0  2 ]
    /// [ 1  5  3  0 ]
    /// [ 0  3  d  1 ]
    /// [ 2  0  1  7 ]
    /// ```
    /// positive definite for d = 6, indefinite for d = -6.
    fn four_by_four(d: f64) -> SymmetricMatrix {
        let pattern =
            Pattern::new(vec![0, 1, 3, 5, 8], vec![0, 0, 1, 1, 2, 0, 2, 3]).expect("pattern");
        let mut matrix = SymmetricMatrix::zero(Arc::new(pattern));
        matrix.values = vec![4.0, 1.0, 5.0, 3.0, d, 2.0, 1.0, 7.0];
        matrix
    }

    fn product(d: f64, x: [f64; 4]) -> Vec<f64> {
        vec![
            4.0 * x[0] + x[1] + 2.0 * x[3],
            x[0] + 5.0 * x[1] + 3.0 * x[2],
            3.0 * x[1] + d * x[2] + x[3],
            2.0 * x[0] + x[2] + 7.0 * x[3],
        ]
    }

    /// Both solve the same system; condition numbers below 100 leave 13 digits.
    #[test]
    fn both_kinds_solve_and_count_signs() {
        let x = [1.0, -2.0, 0.5, 3.0];
        for (kind, d, negative) in [
            (FactorKind::Llt, 6.0, 0),
            (FactorKind::Ldlt, 6.0, 0),
            (FactorKind::Ldlt, -6.0, 1),
        ] {
            let matrix = four_by_four(d);
            let symbolic = Arc::new(
                Symbolic::analyse(matrix.pattern().clone(), Elimination::MinimumDegree)
                    .expect("analysis"),
            );
            let mut factor = kind.factorise(&symbolic, &matrix).expect("factor");
            let mut solution = product(d, x);
            factor.solve_in_place(&mut solution);
            for (got, expected) in solution.iter().zip(x) {
                assert!((got - expected).abs() < 1e-13, "{kind:?} {d}: {solution:?}");
            }
            assert_eq!(
                factor.inertia(),
                Inertia {
                    positive: 4 - negative,
                    negative
                }
            );
            // The product of the pivots is the determinant, 113 d - 247 by expansion along the third row.
            let determinant: f64 = factor.pivots().iter().product();
            assert!((determinant / (113.0 * d - 247.0) - 1.0).abs() < 1e-12);
        }
    }

    #[test]
    fn llt_refuses_an_indefinite_matrix_and_recovers() {
        let matrix = four_by_four(6.0);
        let symbolic = Arc::new(
            Symbolic::analyse(matrix.pattern().clone(), Elimination::MinimumDegree)
                .expect("analysis"),
        );
        let mut factor = FactorKind::Llt
            .factorise(&symbolic, &matrix)
            .expect("factor");
        let refused = factor.refactorise(&four_by_four(-6.0));
        assert!(matches!(
            refused,
            Err(FactorError::NotPositiveDefinite { .. })
        ));
        factor.refactorise(&matrix).expect("factor");
        let mut solution = product(6.0, [1.0; 4]);
        factor.solve_in_place(&mut solution);
        assert!(solution.iter().all(|value| (value - 1.0).abs() < 1e-13));
    }

    #[test]
    fn patterns_are_checked() {
        assert!(matches!(
            Pattern::new(vec![0, 1], vec![1]),
            Err(PatternError::Rows { column: 0 })
        ));
        assert!(matches!(
            Pattern::new(vec![0, 2], vec![0]),
            Err(PatternError::ColumnStarts { .. })
        ));
    }
}
