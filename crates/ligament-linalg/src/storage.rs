//! Memory of a supernodal factor, and what both forms of it do in the same way.

use std::sync::Arc;

use faer::dyn_stack::{MemBuffer, MemStack, StackReq};
use faer::sparse::linalg::cholesky::SymbolicCholesky;

use crate::factor_error::FactorError;
use crate::factorisation::{HalfSolved, Inertia};
use crate::matrix::SymmetricMatrix;
use crate::modification::{DiagonalEntry, Modification, Target, VanishingPivot};
use crate::panels::{Form, Panels};
use crate::rank_one::RankOne;
use crate::substitution::{solve_backward, solve_forward};
use crate::symbolic::Symbolic;

/// Values of a factor and the workspace that factorising needs.
pub(crate) struct Storage {
    pub(crate) symbolic: Arc<Symbolic>,
    form: Form,
    values: Vec<f64>,
    workspace: MemBuffer,
    /// Diagonal of the matrix in the order of elimination, shape (n).
    diagonal: Vec<DiagonalEntry>,
    negative_pivots: usize,
    /// Made when the factor is first changed in place.
    modification: Option<Modification>,
}

impl Storage {
    /// Room for a factor; `request` is the workspace of its numeric factorisation.
    pub(crate) fn new(
        form: Form,
        symbolic: Arc<Symbolic>,
        request: StackReq,
    ) -> Result<Self, FactorError> {
        let bytes = request.unaligned_bytes_required();
        let workspace =
            MemBuffer::try_new(request).map_err(|_| FactorError::OutOfMemory { bytes })?;
        Ok(Self {
            form,
            values: zeros(symbolic.cholesky.len_val())?,
            symbolic,
            workspace,
            diagonal: Vec::new(),
            negative_pivots: 0,
            modification: None,
        })
    }

    /// Structure, values and workspace at once.
    pub(crate) fn parts(&mut self) -> (&SymbolicCholesky<usize>, &mut [f64], &mut MemStack) {
        let stack = MemStack::new(&mut self.workspace);
        (&self.symbolic.cholesky, &mut self.values, stack)
    }

    /// Takes note of the matrix that was just factorised.
    pub(crate) fn factorised(&mut self, matrix: &SymmetricMatrix) {
        let unknowns = self.symbolic.unknown_of_row().iter();
        let entries = unknowns.map(|&unknown| DiagonalEntry::new(matrix.diagonal(unknown)));
        self.diagonal = entries.collect();
        let diagonal = self.symbolic.diagonal(&self.values);
        self.negative_pivots = diagonal.iter().filter(|pivot| **pivot < 0.0).count();
    }

    pub(crate) fn inertia(&self) -> Inertia {
        Inertia {
            positive: self.diagonal.len() - self.negative_pivots,
            negative: self.negative_pivots,
        }
    }

    /// Pivots in the order of the matrix, shape (n).
    pub(crate) fn pivots(&self) -> Vec<f64> {
        let diagonal = self.symbolic.diagonal(&self.values);
        let rows = self.symbolic.row_of_unknown().iter();
        rows.map(|&row| match self.form {
            Form::Llt => diagonal[row] * diagonal[row],
            Form::Ldlt => diagonal[row],
        })
        .collect()
    }

    pub(crate) fn solve_in_place(&self, right_hand_side: &mut [f64]) {
        let unknowns = self.symbolic.unknown_of_row();
        let mut vector: Vec<f64> = unknowns.iter().map(|&i| right_hand_side[i]).collect();
        solve_forward(self.panels(), &mut vector);
        solve_backward(self.panels(), &mut vector);
        for (&unknown, value) in unknowns.iter().zip(vector) {
            right_hand_side[unknown] = value;
        }
    }

    pub(crate) fn change(
        &mut self,
        terms: &[RankOne],
        right_hand_side: &[(usize, f64)],
    ) -> Result<HalfSolved, VanishingPivot> {
        let rows = self.symbolic.row_of_unknown();
        let mut vector = vec![0.0; rows.len()];
        for &(unknown, value) in right_hand_side {
            vector[rows[unknown]] += value;
        }
        let rows_of_b: Vec<usize> = right_hand_side.iter().map(|&(i, _)| rows[i]).collect();
        let supernodes = self.symbolic.supernodes();
        let modification = self
            .modification
            .get_or_insert_with(|| Modification::new(supernodes));
        let mut target = Target {
            form: self.form,
            supernodes,
            values: &mut self.values,
            diagonal: &mut self.diagonal,
            negative_pivots: &mut self.negative_pivots,
        };
        modification.apply(&mut target, terms, rows, &mut vector, &rows_of_b)?;
        Ok(HalfSolved(vector))
    }

    pub(crate) fn finish(&self, HalfSolved(mut vector): HalfSolved) -> Vec<f64> {
        solve_backward(self.panels(), &mut vector);
        let rows = self.symbolic.row_of_unknown();
        rows.iter().map(|&row| vector[row]).collect()
    }

    fn panels(&self) -> Panels<'_> {
        Panels {
            form: self.form,
            supernodes: self.symbolic.supernodes(),
            values: &self.values,
        }
    }
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
