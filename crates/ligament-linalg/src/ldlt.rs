//! Sparse L D L^T through faer, with pivots in the order of elimination.

use std::sync::Arc;

use faer::linalg::cholesky::ldlt::factor::{LdltError, LdltRegularization};
use faer::sparse::linalg::cholesky::LdltRef;
use faer::{Conj, Par, Side};

use crate::factorisation::{FactorError, Factorisation};
use crate::matrix::SymmetricMatrix;
use crate::storage::{Storage, column};
use crate::symbolic::Symbolic;

/// Factor L D L^T of a symmetric matrix that may be indefinite.
pub(crate) struct Ldlt(Storage);

impl Ldlt {
    /// Room for the factor; nothing is factorised yet.
    pub(crate) fn new(symbolic: Arc<Symbolic>) -> Result<Self, FactorError> {
        let request = symbolic
            .cholesky
            .factorize_numeric_ldlt_scratch::<f64>(Par::Seq, Default::default());
        Storage::new(symbolic, request).map(Self)
    }
}

impl Factorisation for Ldlt {
    fn refactorise(&mut self, matrix: &SymmetricMatrix) -> Result<(), FactorError> {
        let view = self.0.symbolic.view(matrix);
        let (structure, values, stack) = self.0.parts();
        let (regularization, parameters) = (LdltRegularization::default(), Default::default());
        let outcome = structure.factorize_numeric_ldlt(
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
            Err(LdltError::ZeroPivot { index }) => {
                let unknown = self.0.symbolic.unknown_of_row(index);
                Err(FactorError::ZeroPivot { unknown })
            }
        }
    }

    fn solve_in_place(&mut self, right_hand_side: &mut [f64]) {
        let (structure, values, stack) = self.0.parts();
        let factor = LdltRef::new(structure, values);
        factor.solve_in_place_with_conj(Conj::No, column(right_hand_side), Par::Seq, stack);
    }

    fn pivots(&self) -> Vec<f64> {
        self.0.symbolic.diagonal(&self.0.values)
    }
}
