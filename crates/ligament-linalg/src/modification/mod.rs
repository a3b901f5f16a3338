//! Changes of a factor in place: A + sum of c_i w_i w_i^T for w_i with few entries, and the solve that follows.
//!
//! A vector changes only the supernodes on the way from its first row to the root of the elimination tree, and the pattern
//! of the factor never grows as long as the entries of a vector are pairwise in the pattern of the matrix (Davis and Hager
//! 2001).
//! A right-hand side that is zero outside the same rows takes the same way, so the
//! forward substitution goes along while a panel is in the cache.

mod diagonal;
mod panel;

use std::cmp::Reverse;
use std::collections::BinaryHeap;

use pulp::{Arch, Simd, WithSimd};

use crate::panels::{FactorKind, Panels};
use crate::rank_one::RankOne;
use crate::substitution;
use crate::supernodes::Supernodes;
use panel::{TERMS_AT_ONCE, Terms};

pub(crate) use diagonal::DiagonalEntry;
pub use diagonal::VANISHING_PIVOT;

/// Working memory for changing a factor in place. Rows are in the order of elimination.
pub(crate) struct Modification {
    supernode_of_row: Vec<u32>,
    /// Terms on their way, row by row, shape (n, TERMS_AT_ONCE); zero between two changes.
    on_the_way: Vec<f64>,
    /// Supernodes still to be visited.
    touched: BinaryHeap<Reverse<u32>>,
    is_touched: Vec<bool>,
    terms: Terms,
    column: Vec<f64>,
}

/// The factor that is changed.
pub(crate) struct Target<'a> {
    pub(crate) kind: FactorKind,
    pub(crate) supernodes: Supernodes<'a>,
    pub(crate) values: &'a mut [f64],
    /// Diagonal of the matrix in the order of elimination, shape (n); changed along.
    pub(crate) diagonal: &'a mut [DiagonalEntry],
    /// Number of negative pivots; changed along.
    pub(crate) negative_pivots: &'a mut usize,
}

/// The row whose pivot vanished; the factor is then half changed and worthless.
pub(crate) struct VanishingPivot(pub(crate) usize);

impl Modification {
    pub(crate) fn new(supernodes: Supernodes<'_>) -> Self {
        let supernode_of_row = supernodes.of_rows();
        Self {
            on_the_way: vec![0.0; TERMS_AT_ONCE * supernode_of_row.len()],
            supernode_of_row,
            touched: BinaryHeap::new(),
            is_touched: vec![false; supernodes.len()],
            terms: Terms::default(),
            column: Vec::new(),
        }
    }

    /// Changes the factor by the terms, and replaces b by L'^-1 b with the new L', for a b (n) that is zero outside
    /// `rows_of_b`.
    pub(crate) fn apply(
        &mut self,
        target: &mut Target<'_>,
        terms: &[RankOne],
        row_of_unknown: &[usize],
        right_hand_side: &mut [f64],
        rows_of_b: &[usize],
    ) -> Result<(), VanishingPivot> {
        let arch = Arch::new();
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
            let walk = Walk {
                modification: self,
                target,
                right_hand_side,
            };
            if let Err(vanishing) = arch.dispatch(walk) {
                self.on_the_way.fill(0.0);
                self.is_touched.fill(false);
                self.touched.clear();
                return Err(vanishing);
            }
            if is_last {
                return Ok(());
            }
        }
    }

    /// Puts terms at the start of their way.
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
                let w = &mut self.on_the_way[TERMS_AT_ONCE * row + index];
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

/// One pass of terms through the factor, from the leaves to the root.
struct Walk<'a, 'b> {
    modification: &'a mut Modification,
    target: &'a mut Target<'b>,
    right_hand_side: Option<&'a mut [f64]>,
}

impl WithSimd for Walk<'_, '_> {
    type Output = Result<(), VanishingPivot>;

    #[inline(always)]
    fn with_simd<S: Simd>(mut self, simd: S) -> Self::Output {
        while let Some(Reverse(supernode)) = self.modification.touched.pop() {
            let supernode = supernode as usize;
            self.modification.is_touched[supernode] = false;
            self.change_panel(simd, supernode)?;
            let Target {
                kind,
                supernodes,
                values,
                ..
            } = &*self.target;
            if let Some(right_hand_side) = &mut self.right_hand_side {
                let panels = Panels {
                    kind: *kind,
                    supernodes: *supernodes,
                    values,
                };
                let column = &mut self.modification.column;
                let solution = &mut right_hand_side[supernodes.columns(supernode)];
                let additions = substitution::forward(simd, panels, supernode, solution, column);
                for (&row, value) in supernodes.rows_below(supernode).iter().zip(additions) {
                    right_hand_side[row] += value;
                }
            }
            if let Some(&parent_row) = supernodes.rows_below(supernode).first() {
                self.modification.touch(parent_row);
            }
        }
        Ok(())
    }
}

impl Walk<'_, '_> {
    #[inline(always)]
    fn change_panel<S: Simd>(&mut self, simd: S, supernode: usize) -> Result<(), VanishingPivot> {
        let Target {
            kind,
            supernodes,
            values,
            diagonal,
            negative_pivots,
        } = &mut *self.target;
        let Modification {
            on_the_way, terms, ..
        } = &mut *self.modification;
        let columns = supernodes.columns(supernode);
        let below = supernodes.rows_below(supernode);
        if !terms.gather(columns.clone(), below, on_the_way) {
            return Ok(());
        }
        let panel = &mut values[supernodes.panel(supernode)];
        let diagonal = &diagonal[columns.clone()];
        let change = terms.change(simd, *kind, panel, diagonal);
        match change {
            Ok(more_negative) => {
                **negative_pivots = negative_pivots.wrapping_add_signed(more_negative);
                terms.scatter(columns, below, on_the_way);
                Ok(())
            }
            Err(column) => Err(VanishingPivot(columns.start + column)),
        }
    }
}
