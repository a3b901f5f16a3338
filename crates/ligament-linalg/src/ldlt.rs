//! Sparse L D L^T through faer, with pivots in the order of elimination.

use std::sync::Arc;

use faer::linalg::cholesky::ldlt::factor::{LdltError, LdltRegularization};
use faer::{Par, Side};

use crate::factor_error::FactorError;
use crate::factorisation::{Factorisation, HalfSolved, Inertia};
use crate::matrix::SymmetricMatrix;
use crate::modification::VanishingPivot;
use crate::panels::Form;
use crate::rank_one::RankOne;
use crate::storage::Storage;
use crate::symbolic::Symbolic;

/// Factor L D L^T of a symmetric matrix that may be indefinite.
pub(crate) struct Ldlt(Storage);

impl Ldlt {
    /// Room for the factor; nothing is factorised yet.
    pub(crate) fn new(symbolic: Arc<Symbolic>) -> Result<Self, FactorError> {
        let request = symbolic
            .cholesky
            .factorize_numeric_ldlt_scratch::<f64>(Par::Seq, Default::default());
        Storage::new(Form::Ldlt, symbolic, request).map(Self)
    }

    fn zero_pivot(&self, row: usize) -> FactorError {
        let unknown = self.0.symbolic.unknown_of_row()[row];
        FactorError::ZeroPivot { unknown }
    }
}

impl Factorisation for Ldlt {
    fn refactorise(&mut self, matrix: &SymmetricMatrix) -> Result<(), FactorError> {
        let symbolic = self.0.symbolic.clone();
        let (structure, values, stack) = self.0.parts();
        let (regularization, parameters) = (LdltRegularization::default(), Default::default());
        let outcome = structure.factorize_numeric_ldlt(
            values,
            symbolic.view(matrix),
            Side::Upper,
            regularization,
            Par::Seq,
            stack,
            parameters,
        );
        match outcome {
            Ok(_) => {
                self.0.factorised(matrix);
                Ok(())
            }
            Err(LdltError::ZeroPivot { index }) => Err(self.zero_pivot(index)),
        }
    }

    fn solve_in_place(&mut self, right_hand_side: &mut [f64]) {
        self.0.solve_in_place(right_hand_side);
    }

    fn change(
        &mut self,
        terms: &[RankOne],
        right_hand_side: &[(usize, f64)],
    ) -> Result<HalfSolved, FactorError> {
        let half_solved = self.0.change(terms, right_hand_side);
        half_solved.map_err(|VanishingPivot(row)| self.zero_pivot(row))
    }

    fn finish(&self, half_solved: HalfSolved) -> Vec<f64> {
        self.0.finish(half_solved)
    }

    fn pivots(&self) -> Vec<f64> {
        self.0.pivots()
    }

    fn inertia(&self) -> Inertia {
        self.0.inertia()
    }
}
