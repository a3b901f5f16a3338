//! Supernodal factor, L L^T or L D L^T.

use std::sync::Arc;

use rayon::prelude::*;

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
    /// Digest of the entries of the matrix in the columns of each supernode from which its panel was computed, shape (n_supernodes); None
    /// for a panel that was changed since, or was not computed.
    entry_digests: Vec<Option<u64>>,
    /// Working memory of updates in place, made at the first update.
    modification: Option<Modification>,
}

impl Cholesky {
    /// Allocates a factor that is not yet computed.
    pub(crate) fn new(kind: FactorKind, symbolic: Arc<Symbolic>) -> Result<Self, FactorError> {
        Ok(Self {
            kind,
            values: zeros(symbolic.cholesky.len_val())?,
            entry_digests: vec![None; symbolic.supernodes().len()],
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

    /// Whether the panel of each supernode must be computed anew for a matrix, shape (n_supernodes): because the matrix has other entries in its
    /// columns, by their digests, because it was changed in place, or because a panel is outdated below it in the elimination tree.
    fn outdated(&mut self, matrix: &SymmetricMatrix) -> Vec<bool> {
        let supernodes = self.symbolic.supernodes();
        let of_row = supernodes.supernode_of_rows();
        let entries = |supernode: usize| {
            let columns = supernodes.columns(supernode);
            let entries = columns.flat_map(|it| self.symbolic.sources().column_entries(it));
            let values = entries.map(|&[_, place]| matrix.values[place as usize]);
            Some(digest(&values.collect::<Vec<f64>>()))
        };
        let numbers = (0..supernodes.len()).into_par_iter();
        let digests: Vec<Option<u64>> = numbers.map(entries).collect();
        let both = digests.iter().zip(&self.entry_digests);
        let mut outdated: Vec<bool> = both.map(|(one, other)| one != other).collect();
        for supernode in 0..supernodes.len() {
            if let (true, Some(&parent_row)) = (
                outdated[supernode],
                supernodes.rows_below(supernode).first(),
            ) {
                outdated[of_row[parent_row] as usize] = true;
            }
        }
        self.entry_digests = digests;
        outdated
    }

    /// Solves A x = b in place for N right-hand sides b of shape (n) in one pass over the factor.
    fn solve_all<const N: usize>(&self, right_hand_sides: [&mut [f64]; N]) {
        let unknowns = self.symbolic.unknown_of_row();
        let in_order = |it: &&mut [f64]| unknowns.iter().map(|&i| it[i]).collect::<Vec<f64>>();
        let mut vectors = right_hand_sides.each_ref().map(in_order);
        let branch = self.symbolic.branch();
        let all = vectors.each_mut().map(Vec::as_mut_slice);
        solve_forward(self.panels(), branch, all);
        let all = vectors.each_mut().map(Vec::as_mut_slice);
        solve_backward(self.panels(), branch, all);
        for (right_hand_side, vector) in right_hand_sides.into_iter().zip(vectors) {
            for (&unknown, value) in unknowns.iter().zip(vector) {
                right_hand_side[unknown] = value;
            }
        }
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
        let outdated = self.outdated(matrix);
        let left_looking = LeftLooking {
            kind: self.kind,
            symbolic: &self.symbolic,
            matrix: &matrix.values,
            outdated: &outdated,
        };
        let factorised = left_looking.factorise(&mut self.values);
        if let Err(row) = factorised {
            let both = self.entry_digests.iter_mut().zip(outdated);
            both.filter(|(_, outdated)| *outdated)
                .for_each(|(entry_digests, _)| *entry_digests = None);
            return Err(self.invalid_pivot_error(row));
        }
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
            entry_digests: self.entry_digests.clone(),
            modification: None,
        })
    }

    fn digest(&self) -> u64 {
        digest(&self.values)
    }

    fn solve_in_place(&mut self, right_hand_side: &mut [f64]) {
        self.solve_all([right_hand_side]);
    }

    fn solve_both_in_place(&mut self, right_hand_sides: [&mut [f64]; 2]) {
        self.solve_all(right_hand_sides);
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
            entry_digests: &mut self.entry_digests,
        };
        modification
            .apply(&mut target, terms, rows, &mut vector, &rows_of_b)
            .map_err(|VanishingPivot(row)| self.invalid_pivot_error(row))?;
        Ok(ForwardSubstituted(vector))
    }

    fn finish(&self, ForwardSubstituted(mut vector): ForwardSubstituted) -> Vec<f64> {
        solve_backward(self.panels(), self.symbolic.branch(), [&mut vector]);
        let rows = self.symbolic.row_of_unknown();
        rows.iter().map(|&row| vector[row]).collect()
    }

    fn solve_backward_part(&self, part: &Part, vector: &mut [f64]) {
        solve_backward_in(self.panels(), part.supernodes.clone(), [vector]);
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
