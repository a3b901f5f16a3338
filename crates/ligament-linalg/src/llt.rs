//! Sparse L L^T through faer.

use std::sync::Arc;

use faer::linalg::cholesky::llt::factor::{LltError, LltRegularization};
use faer::{Par, Side};

use crate::factor_error::FactorError;
use crate::factorisation::{Factorisation, HalfSolved, Inertia};
use crate::matrix::SymmetricMatrix;
use crate::modification::VanishingPivot;
use crate::panels::Form;
use crate::rank_one::RankOne;
use crate::storage::Storage;
use crate::symbolic::Symbolic;

/// Factor L L^T of a positive definite matrix.
pub(crate) struct Llt(Storage);

impl Llt {
    /// Room for the factor; nothing is factorised yet.
    pub(crate) fn new(symbolic: Arc<Symbolic>) -> Result<Self, FactorError> {
        let request = symbolic
            .cholesky
            .factorize_numeric_llt_scratch::<f64>(Par::Seq, Default::default());
        Storage::new(Form::Llt, symbolic, request).map(Self)
    }

    fn not_positive_definite(&self, row: usize) -> FactorError {
        let unknown = self.0.symbolic.unknown_of_row()[row];
        FactorError::NotPositiveDefinite { unknown }
    }
}

impl Factorisation for Llt {
    fn refactorise(&mut self, matrix: &SymmetricMatrix) -> Result<(), FactorError> {
        let symbolic = self.0.symbolic.clone();
        let (structure, values, stack) = self.0.parts();
        let (regularization, parameters) = (LltRegularization::default(), Default::default());
        let outcome = structure.factorize_numeric_llt(
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
            Err(LltError::NonPositivePivot { index }) => Err(self.not_positive_definite(index)),
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
        half_solved.map_err(|VanishingPivot(row)| self.not_positive_definite(row))
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
