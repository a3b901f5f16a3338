//! Sparse L L^T of a positive definite matrix through faer.

use faer::dyn_stack::{MemStack, StackReq};
use faer::linalg::cholesky::llt::factor::{LltError, LltRegularization};
use faer::{Par, Side};

use crate::matrix::SymmetricMatrix;
use crate::symbolic::Symbolic;

/// The workspace that factorising needs.
pub(crate) fn workspace(symbolic: &Symbolic) -> StackReq {
    let cholesky = &symbolic.cholesky;
    cholesky.factorize_numeric_llt_scratch::<f64>(Par::Seq, Default::default())
}

/// Factorises into `values`; the error is the row, in the order of elimination, of a pivot that is not positive.
pub(crate) fn factorise(
    symbolic: &Symbolic,
    matrix: &SymmetricMatrix,
    values: &mut [f64],
    stack: &mut MemStack,
) -> Result<(), usize> {
    let (regularization, parameters) = (LltRegularization::default(), Default::default());
    let outcome = symbolic.cholesky.factorize_numeric_llt(
        values,
        symbolic.view(matrix),
        Side::Upper,
        regularization,
        Par::Seq,
        stack,
        parameters,
    );
    match outcome {
        Ok(_) => Ok(()),
        Err(LltError::NonPositivePivot { index }) => Err(index),
    }
}
