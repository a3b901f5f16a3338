//! Sparse L D L^T of a symmetric matrix that may be indefinite through faer, with pivots in the order of elimination.

use faer::dyn_stack::{MemStack, StackReq};
use faer::linalg::cholesky::ldlt::factor::{LdltError, LdltRegularization};
use faer::{Par, Side};

use crate::matrix::SymmetricMatrix;
use crate::symbolic::Symbolic;

/// The workspace that factorising needs.
pub(crate) fn workspace(symbolic: &Symbolic) -> StackReq {
    let cholesky = &symbolic.cholesky;
    cholesky.factorize_numeric_ldlt_scratch::<f64>(Par::Seq, Default::default())
}

/// Factorises into `values`; the error is the row, in the order of elimination, of a pivot that is zero.
pub(crate) fn factorise(
    symbolic: &Symbolic,
    matrix: &SymmetricMatrix,
    values: &mut [f64],
    stack: &mut MemStack,
) -> Result<(), usize> {
    let (regularization, parameters) = (LdltRegularization::default(), Default::default());
    let outcome = symbolic.cholesky.factorize_numeric_ldlt(
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
        Err(LdltError::ZeroPivot { index }) => Err(index),
    }
}
