//! Sparse L D L^T through faer, with pivots in the order of elimination.

use std::sync::Arc;

use faer::dyn_stack::{MemBuffer, MemStack};
use faer::linalg::cholesky::ldlt::factor::{LdltError, LdltRegularization};
use faer::sparse::linalg::cholesky::LdltRef;
use faer::{Conj, MatMut, Par, Side};

use crate::factorisation::{FactorError, Factorisation};
use crate::matrix::SymmetricMatrix;
use crate::symbolic::{Symbolic, reserve_values};

/// Factor L D L^T of a symmetric matrix that may be indefinite.
pub(crate) struct Ldlt {
    symbolic: Arc<Symbolic>,
    values: Vec<f64>,
    workspace: MemBuffer,
}

impl Ldlt {
    /// Room for the factor; nothing is factorised yet.
    pub(crate) fn new(symbolic: Arc<Symbolic>) -> Result<Self, FactorError> {
        let structure = &symbolic.cholesky;
        let request = structure
            .factorize_numeric_ldlt_scratch::<f64>(Par::Seq, Default::default())
            .or(structure.solve_in_place_scratch::<f64>(1, Par::Seq));
        let workspace = MemBuffer::try_new(request).map_err(|_| FactorError::OutOfMemory {
            bytes: request.unaligned_bytes_required(),
        })?;
        Ok(Self {
            values: reserve_values(structure.len_val())?,
            symbolic,
            workspace,
        })
    }
}

impl Factorisation for Ldlt {
    fn refactorise(&mut self, matrix: &SymmetricMatrix) -> Result<(), FactorError> {
        let outcome = self.symbolic.cholesky.factorize_numeric_ldlt(
            &mut self.values,
            self.symbolic.view(matrix),
            Side::Upper,
            LdltRegularization::default(),
            Par::Seq,
            MemStack::new(&mut self.workspace),
            Default::default(),
        );
        match outcome {
            Ok(_) => Ok(()),
            Err(LdltError::ZeroPivot { index }) => Err(FactorError::ZeroPivot {
                unknown: self.symbolic.unknown_of_row(index),
            }),
        }
    }

    fn solve_in_place(&mut self, right_hand_side: &mut [f64]) {
        let n = right_hand_side.len();
        LdltRef::new(&self.symbolic.cholesky, &self.values).solve_in_place_with_conj(
            Conj::No,
            MatMut::from_column_major_slice_mut(right_hand_side, n, 1),
            Par::Seq,
            MemStack::new(&mut self.workspace),
        );
    }

    fn pivots(&self) -> Vec<f64> {
        self.symbolic.diagonal(&self.values)
    }
}
