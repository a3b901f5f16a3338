//! The factor as dense panels, one for each supernode: a set of consecutive columns with the same rows.

use std::ops::Range;

use faer::sparse::linalg::cholesky::supernodal::SymbolicSupernodalCholesky;
use faer::sparse::linalg::cholesky::{SymbolicCholesky, SymbolicCholeskyRaw};

/// Positions of the panels of a supernodal factor. Rows and columns are counted in the order of elimination.
#[derive(Clone, Copy)]
pub(crate) struct Supernodes<'a>(Option<&'a SymbolicSupernodalCholesky<usize>>);

impl<'a> Supernodes<'a> {
    /// The supernodes of a symbolic analysis; none for a matrix without unknowns.
    pub(crate) fn from_analysis(cholesky: &'a SymbolicCholesky<usize>) -> Self {
        match cholesky.raw() {
            SymbolicCholeskyRaw::Supernodal(structure) => Self(Some(structure)),
            SymbolicCholeskyRaw::Simplicial(_) => Self(None),
        }
    }

    fn structure(self) -> &'a SymbolicSupernodalCholesky<usize> {
        match self.0 {
            Some(structure) => structure,
            None => unreachable!("there is no supernode to ask for"),
        }
    }

    /// Number of supernodes.
    pub(crate) fn len(self) -> usize {
        self.0.map_or(0, SymbolicSupernodalCholesky::n_supernodes)
    }

    /// Columns of a supernode, which are also the first rows of its panel.
    pub(crate) fn columns(self, supernode: usize) -> Range<usize> {
        let structure = self.structure();
        structure.supernode_begin()[supernode]..structure.supernode_end()[supernode]
    }

    /// Rows of the panel below its columns, ascending; the first belongs to the parent in the elimination tree.
    pub(crate) fn rows_below(self, supernode: usize) -> &'a [usize] {
        self.structure().supernode(supernode).pattern()
    }

    /// Range of the panel in the values of the factor: column-major, with as many rows as columns and rows below.
    pub(crate) fn panel(self, supernode: usize) -> Range<usize> {
        let starts = self.structure().col_ptr_for_val();
        starts[supernode]..starts[supernode + 1]
    }

    /// Number of values in the panels before a supernode.
    pub(crate) fn values_before(self, supernode: usize) -> usize {
        let starts = self.0.map(|structure| structure.col_ptr_for_val());
        starts.map_or(0, |starts| starts[supernode])
    }

    /// Number of columns before a supernode.
    pub(crate) fn columns_before(self, supernode: usize) -> usize {
        match supernode.checked_sub(1) {
            Some(last) => self.columns(last).end,
            None => 0,
        }
    }

    /// Supernode of each row, shape (n).
    pub(crate) fn supernode_of_rows(self) -> Vec<u32> {
        let n_rows = self.0.map_or(0, SymbolicSupernodalCholesky::nrows);
        let mut of_row = vec![0; n_rows];
        for supernode in 0..self.len() {
            of_row[self.columns(supernode)].fill(supernode as u32);
        }
        of_row
    }
}
