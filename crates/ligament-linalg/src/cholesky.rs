//! Supernodal factor, L L^T or L D L^T.

use std::sync::Arc;

use crate::digest::digest;
use crate::factorisation::{FactorError, Factorisation, ForwardSubstituted, Inertia, RankOne};
use crate::left_looking::LeftLooking;
use crate::matrix::SymmetricMatrix;
use crate::modification::{DiagonalEntry, Modification, Target, VanishingPivot};
use crate::panels::{FactorKind, Panels};
use crate::parts::Part;
use crate::substitution::{solve_backward, solve_backward_in, solve_forward};
use crate::symbolic::Symbolic;

/// A factor with its values, panel by panel.
pub(crate) struct Cholesky {
    symbolic: Arc<Symbolic>,
    kind: FactorKind,
    values: Vec<f64>,
    /// Diagonal of the matrix in the order of elimination, shape (n).
    diagonal: Vec<DiagonalEntry>,
    negative_pivots: usize,
    /// Working memory of updates in place, made at the first update.
    modification: Option<Modification>,
}

impl Cholesky {
    /// Memory for a factor that is not yet computed.
    pub(crate) fn new(kind: FactorKind, symbolic: Arc<Symbolic>) -> Result<Self, FactorError> {
        Ok(Self {
            kind,
            values: zeros(symbolic.cholesky.len_val())?,
            symbolic,
            diagonal: Vec::new(),
            negative_pivots: 0,
            modification: None,
        })
    }

    /// The error of an invalid pivot in a row, in the order of elimination.
    fn invalid_pivot_error(&self, row: usize) -> FactorError {
        let unknown = self.symbolic.unknown_of_row()[row];
        match self.kind {
            FactorKind::Llt => FactorError::NotPositiveDefinite { unknown },
            FactorKind::Ldlt => FactorError::ZeroPivot { unknown },
        }
    }

    /// Stores the diagonal of the matrix just factorised and counts the negative pivots.
    fn finish_factorisation(&mut self, matrix: &SymmetricMatrix) {
        let unknowns = self.symbolic.unknown_of_row().iter();
        let entries = unknowns.map(|&unknown| DiagonalEntry::new(matrix.diagonal(unknown)));
        self.diagonal = entries.collect();
        let diagonal = self.symbolic.diagonal(&self.values);
        self.negative_pivots = diagonal.iter().filter(|pivot| **pivot < 0.0).count();
    }

    fn panels(&self) -> Panels<'_> {
        Panels {
            kind: self.kind,
            supernodes: self.symbolic.supernodes(),
            values: &self.values,
        }
    }
}

impl Factorisation for Cholesky {
    fn refactorise(&mut self, matrix: &SymmetricMatrix) -> Result<(), FactorError> {
        debug_assert_eq!(matrix.pattern(), self.symbolic.pattern());
        let left_looking = LeftLooking {
            kind: self.kind,
            symbolic: &self.symbolic,
            matrix: &matrix.values,
        };
        let factorised = left_looking.factorise(&mut self.values);
        factorised.map_err(|row| self.invalid_pivot_error(row))?;
        self.finish_factorisation(matrix);
        Ok(())
    }

    fn inertia(&self) -> Inertia {
        Inertia {
            positive: self.diagonal.len() - self.negative_pivots,
            negative: self.negative_pivots,
        }
    }

    fn pivots(&self) -> Vec<f64> {
        let diagonal = self.symbolic.diagonal(&self.values);
        let rows = self.symbolic.row_of_unknown().iter();
        rows.map(|&row| match self.kind {
            FactorKind::Llt => diagonal[row] * diagonal[row],
            FactorKind::Ldlt => diagonal[row],
        })
        .collect()
    }

    fn copied(&self) -> Box<dyn Factorisation> {
        Box::new(Self {
            symbolic: self.symbolic.clone(),
            kind: self.kind,
            values: self.values.clone(),
            diagonal: self.diagonal.clone(),
            negative_pivots: self.negative_pivots,
            modification: None,
        })
    }

    fn digest(&self) -> u64 {
        digest(&self.values)
    }

    fn solve_in_place(&mut self, right_hand_side: &mut [f64]) {
        let unknowns = self.symbolic.unknown_of_row();
        let mut vector: Vec<f64> = unknowns.iter().map(|&i| right_hand_side[i]).collect();
        solve_forward(self.panels(), self.symbolic.branch(), &mut vector);
        solve_backward(self.panels(), self.symbolic.branch(), &mut vector);
        for (&unknown, value) in unknowns.iter().zip(vector) {
            right_hand_side[unknown] = value;
        }
    }

    fn change(
        &mut self,
        terms: &[RankOne],
        right_hand_side: &[(usize, f64)],
    ) -> Result<ForwardSubstituted, FactorError> {
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
            kind: self.kind,
            supernodes,
            values: &mut self.values,
            diagonal: &mut self.diagonal,
            negative_pivots: &mut self.negative_pivots,
        };
        modification
            .apply(&mut target, terms, rows, &mut vector, &rows_of_b)
            .map_err(|VanishingPivot(row)| self.invalid_pivot_error(row))?;
        Ok(ForwardSubstituted(vector))
    }

    fn finish(&self, ForwardSubstituted(mut vector): ForwardSubstituted) -> Vec<f64> {
        solve_backward(self.panels(), self.symbolic.branch(), &mut vector);
        let rows = self.symbolic.row_of_unknown();
        rows.iter().map(|&row| vector[row]).collect()
    }

    fn solve_backward_part(&self, part: &Part, vector: &mut [f64]) {
        solve_backward_in(self.panels(), part.supernodes.clone(), vector);
    }
}

/// Allocates `count` zeros, or returns an error instead of an abort.
///
/// The operating system zeroes pages at the first write, which the threads that compute the panels do in parallel; writing zeros here would
/// take a fifth of the time of a factorisation with two threads.
fn zeros(count: usize) -> Result<Vec<f64>, FactorError> {
    let bytes = count * size_of::<f64>();
    let is_there = Vec::<f64>::new().try_reserve_exact(count);
    is_there.map_err(|_| FactorError::OutOfMemory { bytes })?;
    Ok(vec![0.0; count])
}
