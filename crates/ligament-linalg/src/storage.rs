//! Memory of a supernodal factor.

use std::sync::Arc;

use faer::MatMut;
use faer::dyn_stack::{MemBuffer, MemStack, StackReq};
use faer::sparse::linalg::cholesky::SymbolicCholesky;

use crate::factorisation::FactorError;
use crate::symbolic::Symbolic;

/// Values of a factor and the workspace that factorising and solving need.
pub(crate) struct Storage {
    pub(crate) symbolic: Arc<Symbolic>,
    pub(crate) values: Vec<f64>,
    workspace: MemBuffer,
}

impl Storage {
    /// Room for a factor; `request` is the workspace of its numeric factorisation.
    pub(crate) fn new(symbolic: Arc<Symbolic>, request: StackReq) -> Result<Self, FactorError> {
        let solve = symbolic
            .cholesky
            .solve_in_place_scratch::<f64>(1, faer::Par::Seq);
        let request = request.or(solve);
        let bytes = request.unaligned_bytes_required();
        let workspace =
            MemBuffer::try_new(request).map_err(|_| FactorError::OutOfMemory { bytes })?;
        Ok(Self {
            values: zeros(symbolic.cholesky.len_val())?,
            symbolic,
            workspace,
        })
    }

    /// Structure, values and workspace at once.
    pub(crate) fn parts(&mut self) -> (&SymbolicCholesky<usize>, &mut [f64], &mut MemStack) {
        let stack = MemStack::new(&mut self.workspace);
        (&self.symbolic.cholesky, &mut self.values, stack)
    }
}

/// A vector as a matrix of one column.
pub(crate) fn column(vector: &mut [f64]) -> MatMut<'_, f64> {
    let n = vector.len();
    MatMut::from_column_major_slice_mut(vector, n, 1)
}

/// Memory of `count` zeros, or an error instead of an abort.
fn zeros(count: usize) -> Result<Vec<f64>, FactorError> {
    let bytes = count * size_of::<f64>();
    let mut values = Vec::new();
    values
        .try_reserve_exact(count)
        .map_err(|_| FactorError::OutOfMemory { bytes })?;
    values.resize(count, 0.0);
    Ok(values)
}
