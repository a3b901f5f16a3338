//! Sparse L L^T through faer.

use std::sync::Arc;

use faer::dyn_stack::{MemBuffer, MemStack};
use faer::linalg::cholesky::llt::factor::{LltError, LltRegularization};
use faer::sparse::linalg::cholesky::LltRef;
use faer::{Conj, MatMut, Par, Side};

use crate::factorisation::{FactorError, Factorisation};
use crate::matrix::SymmetricMatrix;
use crate::symbolic::{Symbolic, reserve_values};

/// Factor L L^T of a positive definite matrix.
pub(crate) struct Llt {
    symbolic: Arc<Symbolic>,
    values: Vec<f64>,
    workspace: MemBuffer,
}

impl Llt {
    /// Room for the factor; nothing is factorised yet.
    pub(crate) fn new(symbolic: Arc<Symbolic>) -> Result<Self, FactorError> {
        let structure = &symbolic.cholesky;
        let request = structure
            .factorize_numeric_llt_scratch::<f64>(Par::Seq, Default::default())
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

impl Factorisation for Llt {
    fn refactorise(&mut self, matrix: &SymmetricMatrix) -> Result<(), FactorError> {
        let outcome = self.symbolic.cholesky.factorize_numeric_llt(
            &mut self.values,
            self.symbolic.view(matrix),
            Side::Upper,
            LltRegularization::default(),
            Par::Seq,
            MemStack::new(&mut self.workspace),
            Default::default(),
        );
        match outcome {
            Ok(_) => Ok(()),
            Err(LltError::NonPositivePivot { index }) => Err(FactorError::NotPositiveDefinite {
                unknown: self.symbolic.unknown_of_row(index),
            }),
        }
    }

    fn solve_in_place(&mut self, right_hand_side: &mut [f64]) {
        let n = right_hand_side.len();
        LltRef::new(&self.symbolic.cholesky, &self.values).solve_in_place_with_conj(
            Conj::No,
            MatMut::from_column_major_slice_mut(right_hand_side, n, 1),
            Par::Seq,
            MemStack::new(&mut self.workspace),
        );
    }

    fn pivots(&self) -> Vec<f64> {
        let diagonal = self.symbolic.diagonal(&self.values);
        diagonal.into_iter().map(|entry| entry * entry).collect()
    }
}
