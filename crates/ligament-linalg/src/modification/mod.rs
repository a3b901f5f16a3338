//! Updates of a factor in place: A + sum of c_i w_i w_i^T for sparse w_i, and the forward substitution that follows.
//!
//! A vector changes only the supernodes on the path from its first row to the root of the elimination tree, and the pattern of the factor
//! never grows as long as the entries of a vector are pairwise in the pattern of the matrix (Davis and Hager 2001). A right-hand side that
//! is zero outside the same rows follows the same path, so the forward substitution is done while a panel is in the cache.

mod panel;
mod rotation;
mod square;
mod terms;

use std::cmp::Reverse;
use std::collections::BinaryHeap;

use panel::Panel;
use square::Rows;
use terms::{TERMS_AT_ONCE, Terms};

use crate::factorisation::RankOne;
use crate::panels::{FactorKind, Panels};
use crate::substitution;
use crate::supernodes::Supernodes;

pub(crate) use square::DiagonalEntry;
pub use square::VANISHING_PIVOT;

/// Working memory for changing a factor in place. Rows are in the order of elimination.
pub(crate) struct Modification {
    supernode_of_row: Vec<u32>,
    /// Terms in progress, row by row, shape (n, TERMS_AT_ONCE); zero between two updates.
    terms_in_progress: Vec<f64>,
    /// Supernodes still to be visited, smallest first.
    touched: BinaryHeap<Reverse<u32>>,
    is_touched: Vec<bool>,
    terms: Terms,
    column: Vec<f64>,
}

/// The factor to be updated.
pub(crate) struct Target<'a> {
    pub(crate) kind: FactorKind,
    pub(crate) supernodes: Supernodes<'a>,
    pub(crate) values: &'a mut [f64],
    /// Diagonal of the matrix in the order of elimination, shape (n); updated with the factor.
    pub(crate) diagonal: &'a mut [DiagonalEntry],
    /// Number of negative pivots; updated with the factor.
    pub(crate) negative_pivots: &'a mut usize,
    /// Digest of the entries from which each panel was computed, shape (n_supernodes); None after an update.
    pub(crate) entry_digests: &'a mut [Option<u64>],
}

impl Target<'_> {
    fn panels(&self) -> Panels<'_> {
        Panels {
            kind: self.kind,
            supernodes: self.supernodes,
            values: self.values,
        }
    }
}

/// Row of a vanishing pivot; the factor is then partly updated and unusable.
pub(crate) struct VanishingPivot(pub(crate) usize);

impl Modification {
    pub(crate) fn new(supernodes: Supernodes<'_>) -> Self {
        let supernode_of_row = supernodes.supernode_of_rows();
        Self {
            terms_in_progress: vec![0.0; TERMS_AT_ONCE * supernode_of_row.len()],
            supernode_of_row,
            touched: BinaryHeap::new(),
            is_touched: vec![false; supernodes.len()],
            terms: Terms::default(),
            column: Vec::new(),
        }
    }

    /// Updates the factor by the terms, and replaces b by L'^-1 b with the new L', for a b (n) that is zero outside `rows_of_b`.
    pub(crate) fn apply(
        &mut self,
        target: &mut Target<'_>,
        terms: &[RankOne],
        row_of_unknown: &[usize],
        right_hand_side: &mut [f64],
        rows_of_b: &[usize],
    ) -> Result<(), VanishingPivot> {
        let mut chunks = terms.chunks(TERMS_AT_ONCE).peekable();
        loop {
            let chunk = chunks.next().unwrap_or_default();
            self.scatter(chunk, row_of_unknown, target.diagonal);
            let is_last = chunks.peek().is_none();
            if is_last {
                for &row in rows_of_b {
                    self.touch(row);
                }
            }
            let right_hand_side = is_last.then_some(&mut *right_hand_side);
            let pass = TreePass {
                modification: self,
                target,
                right_hand_side,
            };
            if let Err(vanishing) = pass.pass() {
                self.terms_in_progress.fill(0.0);
                self.is_touched.fill(false);
                self.touched.clear();
                return Err(vanishing);
            }
            if is_last {
                return Ok(());
            }
        }
    }

    /// Writes terms into the working memory at their first rows.
    fn scatter(
        &mut self,
        terms: &[RankOne],
        row_of_unknown: &[usize],
        diagonal: &mut [DiagonalEntry],
    ) {
        self.terms.start(terms.iter().map(|term| term.weight));
        for (index, term) in terms.iter().enumerate() {
            for &(unknown, value) in &term.entries {
                let row = row_of_unknown[unknown];
                let w = &mut self.terms_in_progress[TERMS_AT_ONCE * row + index];
                diagonal[row].add(term.weight * value * (2.0 * *w + value));
                *w += value;
                self.touch(row);
            }
        }
    }

    fn touch(&mut self, row: usize) {
        let supernode = self.supernode_of_row[row];
        if !std::mem::replace(&mut self.is_touched[supernode as usize], true) {
            self.touched.push(Reverse(supernode));
        }
    }
}

/// One pass of terms up the elimination tree, from the leaves to the root.
struct TreePass<'a, 'b> {
    modification: &'a mut Modification,
    target: &'a mut Target<'b>,
    right_hand_side: Option<&'a mut [f64]>,
}

impl TreePass<'_, '_> {
    fn pass(mut self) -> Result<(), VanishingPivot> {
        while let Some(Reverse(supernode)) = self.modification.touched.pop() {
            let supernode = supernode as usize;
            self.modification.is_touched[supernode] = false;
            self.visit(supernode)?;
            let below = self.target.supernodes.rows_below(supernode);
            if let Some(&parent_row) = below.first() {
                self.modification.touch(parent_row);
            }
        }
        Ok(())
    }

    /// Updates the panel of a supernode and applies it to the right-hand side.
    fn visit(&mut self, supernode: usize) -> Result<(), VanishingPivot> {
        let Modification {
            terms_in_progress,
            terms,
            column,
            ..
        } = &mut *self.modification;
        let supernodes = self.target.supernodes;
        let columns = supernodes.columns(supernode);
        let below = supernodes.rows_below(supernode);
        column.clear();
        if let Some(right_hand_side) = &self.right_hand_side {
            column.extend_from_slice(&right_hand_side[columns.clone()]);
            column.resize(columns.len() + below.len(), 0.0);
        }
        if terms.gather(columns.clone(), below, terms_in_progress) {
            let right_hand_side = self.right_hand_side.is_some().then_some(&mut column[..]);
            change_panel(self.target, supernode, terms, right_hand_side)?;
            terms.scatter(columns.clone(), below, terms_in_progress);
        } else if self.right_hand_side.is_some() {
            substitution::forward_in(self.target.panels(), supernode, column);
        }
        if let Some(right_hand_side) = &mut self.right_hand_side {
            let (solved, additions) = column.split_at(columns.len());
            right_hand_side[columns].copy_from_slice(solved);
            for (&row, value) in below.iter().zip(additions) {
                right_hand_side[row] += value;
            }
        }
        Ok(())
    }
}

/// Applies terms to the panel of a supernode, and the panel to a right-hand side at its rows.
fn change_panel(
    target: &mut Target<'_>,
    supernode: usize,
    terms: &mut Terms,
    right_hand_side: Option<&mut [f64]>,
) -> Result<(), VanishingPivot> {
    let columns = target.supernodes.columns(supernode);
    let height = columns.len() + target.supernodes.rows_below(supernode).len();
    let (weights, of_terms) = terms.in_panel();
    let values = &mut target.values[target.supernodes.panel(supernode)];
    let panel = Panel {
        kind: target.kind,
        diagonal: &target.diagonal[columns.clone()],
        weights,
        rows: Rows {
            columns: values.chunks_exact_mut(height).collect(),
            terms: of_terms,
            right_hand_side,
        },
    };
    target.entry_digests[supernode] = None;
    let more_negative = panel.change();
    let more_negative = more_negative.map_err(|column| VanishingPivot(columns.start + column))?;
    *target.negative_pivots = target.negative_pivots.wrapping_add_signed(more_negative);
    Ok(())
}
