//! The choice among the factorisations of symmetric matrices.

use std::sync::Arc;

use crate::cholesky::Cholesky;
use crate::factorisation::{FactorError, Factorisation};
use crate::matrix::SymmetricMatrix;
use crate::panels::FactorKind;
use crate::symbolic::Symbolic;

impl FactorKind {
    /// Factorises a matrix whose pattern has been analysed.
    pub fn factorise(
        self,
        symbolic: &Arc<Symbolic>,
        matrix: &SymmetricMatrix,
    ) -> Result<Box<dyn Factorisation>, FactorError> {
        let mut factor = Box::new(Cholesky::new(self, symbolic.clone())?);
        factor.refactorise(matrix)?;
        Ok(factor)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::factorisation::Inertia;
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

    /// Both kinds of factors solve the same system; condition numbers below 100 leave 13 digits.
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
