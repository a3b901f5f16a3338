//! Supernodal left-looking factorisation (Ng and Peyton 1993): a panel is the matrix less the updates by all panels before it, and is then
//! factorised as a dense matrix.
//!
//! Branches of the elimination tree are factorised in parallel, and so are blocks of columns within the large panels near the root. Updates
//! are subtracted from an entry in the order of the supernodes: the results have the same bits on any number of threads.

use rayon::prelude::*;

use crate::branches::Branch;
use crate::dense;
use crate::panels::FactorKind;
use crate::subtraction::{Buffers, Source, Target};
use crate::symbolic::Symbolic;

/// Columns of a panel in one task.
const TILE: usize = 64;

/// A factorisation in progress.
#[derive(Clone, Copy)]
pub(crate) struct LeftLooking<'a> {
    pub(crate) kind: FactorKind,
    pub(crate) symbolic: &'a Symbolic,
    /// Values of the matrix in the order of its pattern.
    pub(crate) matrix: &'a [f64],
    /// Whether the panel of each supernode is computed, shape (n_supernodes); the other panels are already factors of the matrix.
    pub(crate) outdated: &'a [bool],
}

impl LeftLooking<'_> {
    /// Factorises into `values`; the error is the first row, in the order of elimination, without a valid pivot.
    pub(crate) fn factorise(self, values: &mut [f64]) -> Result<(), usize> {
        self.branch(self.symbolic.branch(), values)
    }

    /// Computes the panels of a branch.
    fn branch(self, branch: &Branch, values: &mut [f64]) -> Result<(), usize> {
        let supernodes = self.symbolic.supernodes();
        let first_value = supernodes.values_before(branch.supernodes().start);
        let mut rest = &mut *values;
        let of_parts: Vec<&mut [f64]> = (branch.parts.iter())
            .map(|part| {
                let range = part.supernodes();
                let n_values =
                    supernodes.values_before(range.end) - supernodes.values_before(range.start);
                rest.split_off_mut(..n_values).unwrap_or_default()
            })
            .collect();
        let made: Vec<Result<(), usize>> = (branch.parts.par_iter())
            .zip(of_parts)
            .with_max_len(1)
            .map(|(part, values)| self.branch(part, values))
            .collect();
        made.into_iter().collect::<Result<(), usize>>()?;
        let mut place_of_row = Vec::new();
        for supernode in (branch.stem.clone()).filter(|it| self.outdated[*it]) {
            place_of_row.resize(self.symbolic.pattern().dimension(), 0);
            let (before, rest) =
                values.split_at_mut(supernodes.values_before(supernode) - first_value);
            let panel = &mut rest[..supernodes.panel(supernode).len()];
            self.panel(supernode, panel, (before, first_value), &mut place_of_row)?;
        }
        Ok(())
    }

    /// Computes the panel of a supernode. `before` holds the factor's values from some position on, and this position; `place_of_row` (n)
    /// is
    /// working memory.
    fn panel(
        self,
        supernode: usize,
        panel: &mut [f64],
        before: (&[f64], usize),
        place_of_row: &mut [u32],
    ) -> Result<(), usize> {
        let supernodes = self.symbolic.supernodes();
        let columns = supernodes.columns(supernode);
        let below = supernodes.rows_below(supernode);
        for (place, row) in columns.clone().chain(below.iter().copied()).enumerate() {
            place_of_row[row] = place as u32;
        }
        let place_of_row = &*place_of_row;
        let height = columns.len() + below.len();
        // Tiles on the left have more rows than those on the right: each is a task, so that threads finish together.
        panel
            .par_chunks_mut(TILE * height)
            .enumerate()
            .with_max_len(1)
            .for_each_init(Buffers::default, |buffers, (tile, values)| {
                let first = columns.start + TILE * tile;
                let target = Target {
                    columns: first..first + values.len() / height,
                    place_of_row,
                    values,
                    height,
                };
                self.tile(supernode, target, before, buffers);
            });
        dense::factorise(self.kind, panel, columns.len()).map_err(|column| columns.start + column)
    }

    /// Sets some columns of a panel to the entries of the matrix and subtracts the updates by the panels before.
    fn tile(
        self,
        supernode: usize,
        mut target: Target<'_>,
        (before, first_value): (&[f64], usize),
        buffers: &mut Buffers,
    ) {
        target.values.fill(0.0);
        for (column, values) in
            (target.columns.clone()).zip(target.values.chunks_exact_mut(target.height))
        {
            for &[row, place] in self.symbolic.sources().column_entries(column) {
                values[target.place_of_row[row as usize] as usize] += self.matrix[place as usize];
            }
        }
        let supernodes = self.symbolic.supernodes();
        for &updating_supernodes in self.symbolic.updating_supernodes().supernodes(supernode) {
            let updating_supernodes = updating_supernodes as usize;
            let panel = supernodes.panel(updating_supernodes);
            let source = Source {
                values: &before[panel.start - first_value..panel.end - first_value],
                n_columns: supernodes.columns(updating_supernodes).len(),
                below: supernodes.rows_below(updating_supernodes),
            };
            target.subtract(self.kind, source, buffers);
        }
    }
}
