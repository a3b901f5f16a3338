//! Supernodal factorisation, left-looking (Ng and Peyton 1993): a panel is the matrix less what all panels before it add to it, and is
//! then factorised as a dense matrix.
//!
//! Branches of the elimination tree are made at the same time, and within the large panels near the root blocks of columns are. An
//! entry takes what is subtracted from it in the order of the supernodes, whichever thread does it: the bits are those of one thread.

use rayon::prelude::*;

use crate::branches::Branch;
use crate::dense;
use crate::panels::FactorKind;
use crate::subtraction::{Buffers, Source, Target};
use crate::symbolic::Symbolic;

/// Columns of a panel that are one task.
const TILE: usize = 64;

/// A factorisation under way.
#[derive(Clone, Copy)]
pub(crate) struct LeftLooking<'a> {
    pub(crate) kind: FactorKind,
    pub(crate) symbolic: &'a Symbolic,
    /// Values of the matrix in the order of its pattern.
    pub(crate) matrix: &'a [f64],
}

impl LeftLooking<'_> {
    /// Factorises into `values`; the error is the first row, in the order of elimination, that has no pivot.
    pub(crate) fn factorise(self, values: &mut [f64]) -> Result<(), usize> {
        self.branch(self.symbolic.branch(), values)
    }

    /// Makes the panels of a branch.
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
        let mut place_of_row = vec![0; self.symbolic.pattern().dimension()];
        for supernode in branch.stem.clone() {
            let (before, rest) =
                values.split_at_mut(supernodes.values_before(supernode) - first_value);
            let panel = &mut rest[..supernodes.panel(supernode).len()];
            self.panel(supernode, panel, (before, first_value), &mut place_of_row)?;
        }
        Ok(())
    }

    /// Makes the panel of a supernode, with the values of the factor before it from a place on, and a table by rows (n) to write in.
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
        // The first tiles have more rows than the last: each is a task, so that threads end together.
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

    /// Puts entries of the matrix into some columns of a panel, and subtracts what the panels before it have for them.
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
            for &[row, place] in self.symbolic.sources().of_column(column) {
                values[target.place_of_row[row as usize] as usize] += self.matrix[place as usize];
            }
        }
        let supernodes = self.symbolic.supernodes();
        for &reaching in self.symbolic.reaching().supernodes(supernode) {
            let reaching = reaching as usize;
            let panel = supernodes.panel(reaching);
            let source = Source {
                values: &before[panel.start - first_value..panel.end - first_value],
                n_columns: supernodes.columns(reaching).len(),
                below: supernodes.rows_below(reaching),
            };
            target.subtract(self.kind, source, buffers);
        }
    }
}
