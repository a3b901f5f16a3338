//! Sparse L U through faer, with partial pivoting, for matrices without symmetry.

use faer::dyn_stack::{MemBuffer, MemStack};
use faer::sparse::linalg::LuError;
use faer::sparse::linalg::lu::{LuRef, NumericLu, SymbolicLu, factorize_symbolic_lu};
use faer::sparse::{FaerError, SparseColMatRef, SymbolicSparseColMatRef};
use faer::{Conj, MatMut, Par};

use crate::factorisation::FactorError;
use crate::general::GeneralMatrix;

/// Factors L U of a square matrix, with a fill-reducing order of columns and rows in the order of their pivots.
pub struct Lu {
    symbolic: SymbolicLu<usize>,
    numeric: NumericLu<usize, f64>,
    workspace: MemBuffer,
}

impl Lu {
    /// Factorises a matrix.
    ///
    /// # Errors
    ///
    /// [`FactorError::ZeroPivot`] if the matrix is structurally singular. A numerically singular matrix gives solutions that are not finite
    /// or not accurate, which the residual shows.
    pub fn factorise(matrix: &GeneralMatrix) -> Result<Self, FactorError> {
        let n = matrix.dimension();
        let out_of_memory = |bytes| FactorError::OutOfMemory { bytes };
        let of_faer = |error| match error {
            FaerError::IndexOverflow => FactorError::IndexOverflow,
            _ => out_of_memory(size_of::<f64>() * matrix.n_entries()),
        };
        let pattern =
            SymbolicSparseColMatRef::new_checked(n, n, matrix.column_starts(), None, matrix.rows());
        let symbolic = factorize_symbolic_lu(pattern, Default::default()).map_err(of_faer)?;
        let request = symbolic.factorize_numeric_lu_scratch::<f64>(Par::Seq, Default::default());
        let request = request.or(symbolic.solve_in_place_scratch::<f64>(1, Par::Seq));
        let bytes = request.unaligned_bytes_required();
        let mut workspace = MemBuffer::try_new(request).map_err(|_| out_of_memory(bytes))?;
        let mut numeric = NumericLu::new();
        let values = SparseColMatRef::new(pattern, matrix.values());
        let stack = MemStack::new(&mut workspace);
        symbolic
            .factorize_numeric_lu(&mut numeric, values, Par::Seq, stack, Default::default())
            .map_err(|error| match error {
                LuError::SymbolicSingular { index } => FactorError::ZeroPivot { unknown: index },
                LuError::Generic(error) => of_faer(error),
            })?;
        Ok(Self {
            symbolic,
            numeric,
            workspace,
        })
    }

    /// Solves A x = b in place, b of shape (n).
    pub fn solve_in_place(&mut self, right_hand_side: &mut [f64]) {
        let n = right_hand_side.len();
        let factor = LuRef::new_unchecked(&self.symbolic, &self.numeric);
        let column = MatMut::from_column_major_slice_mut(right_hand_side, n, 1);
        let stack = MemStack::new(&mut self.workspace);
        factor.solve_in_place_with_conj(Conj::No, column, Par::Seq, stack);
    }
}
