//! Sparse L L^T through faer.

use std::sync::Arc;

use faer::linalg::cholesky::llt::factor::{LltError, LltRegularization};
use faer::sparse::linalg::cholesky::LltRef;
use faer::{Conj, Par, Side};

use crate::factorisation::{FactorError, Factorisation};
use crate::matrix::SymmetricMatrix;
use crate::storage::{Storage, column};
use crate::symbolic::Symbolic;

/// Factor L L^T of a positive definite matrix.
pub(crate) struct Llt(Storage);

impl Llt {
    /// Room for the factor; nothing is factorised yet.
    pub(crate) fn new(symbolic: Arc<Symbolic>) -> Result<Self, FactorError> {
        let request = symbolic
            .cholesky
            .factorize_numeric_llt_scratch::<f64>(Par::Seq, Default::default());
        Storage::new(symbolic, request).map(Self)
    }
}

impl Factorisation for Llt {
    fn refactorise(&mut self, matrix: &SymmetricMatrix) -> Result<(), FactorError> {
        let view = self.0.symbolic.view(matrix);
        let (structure, values, stack) = self.0.parts();
        let (regularization, parameters) = (LltRegularization::default(), Default::default());
        let outcome = structure.factorize_numeric_llt(
            values,
            view,
            Side::Upper,
            regularization,
            Par::Seq,
            stack,
            parameters,
        );
        match outcome {
            Ok(_) => Ok(()),
            Err(LltError::NonPositivePivot { index }) => {
                let unknown = self.0.symbolic.unknown_of_row(index);
                Err(FactorError::NotPositiveDefinite { unknown })
            }
        }
    }

    fn solve_in_place(&mut self, right_hand_side: &mut [f64]) {
        let (structure, values, stack) = self.0.parts();
        let factor = LltRef::new(structure, values);
        factor.solve_in_place_with_conj(Conj::No, column(right_hand_side), Par::Seq, stack);
    }

    fn pivots(&self) -> Vec<f64> {
        let diagonal = self.0.symbolic.diagonal(&self.0.values);
        diagonal.into_iter().map(|entry| entry * entry).collect()
    }
}
