//! The stiffness E = Z^T K Z of a coarse space.

use std::sync::Arc;

use ligament_linalg::{FactorError, Pattern, RankOne, SymmetricMatrix};

use super::coarse_basis::CoarseBasis;
use super::operator::Operator;
use super::resistance::Block;

/// Equations E a = w for the amounts a of coarse motions with works w.
pub(super) trait CoarseEquations: Send {
    /// Solves for amounts in place of works (n_aggregates, n_motions).
    fn solve(&mut self, works: &mut Vec<f64>);

    /// Adds terms at coarse unknowns, ascending, those that add stiffness first. Returns whether that succeeded; if not, the
    /// equations must be rebuilt.
    fn change(&mut self, terms: &[RankOne]) -> bool;
}

/// Stiffness E of a coarse space.
pub(super) struct CoarseStiffness {
    /// Number of motions of an aggregate.
    pub(super) n_motions: usize,
    /// Blocks by aggregate of their columns; several of the same aggregates are added.
    pub(super) blocks: Vec<Vec<Block>>,
}

impl CoarseStiffness {
    /// Stiffness of `blocks` of bonds and restraints, and of the additional terms of an operator.
    pub(super) fn new(
        operator: &Operator<'_>,
        space: &CoarseBasis,
        mut blocks: Vec<Vec<Block>>,
    ) -> Self {
        let n = space.n_motions;
        for (weight, entries) in operator.beside {
            let works = space.works(entries);
            let of_aggregates: Vec<_> = works.chunk_by(|a, b| a.0 / n == b.0 / n).collect();
            for (place, of_second) in of_aggregates.iter().enumerate() {
                let second = of_second[0].0 / n;
                for of_first in &of_aggregates[..=place] {
                    let mut block = vec![0.0; n * n];
                    for &(column, one) in *of_second {
                        for &(row, other) in *of_first {
                            block[row % n * n + column % n] = weight * one * other;
                        }
                    }
                    let first = of_first[0].0 / n;
                    blocks[second].push(([first as u32, second as u32], block));
                }
            }
        }
        Self {
            n_motions: n,
            blocks,
        }
    }

    /// Assembles E, with a unit on the diagonal of unknowns without stiffness.
    ///
    /// # Errors
    ///
    /// If E has too many entries for their indices.
    pub(super) fn matrix(&self) -> Result<SymmetricMatrix, FactorError> {
        let n = self.n_motions;
        let mut matrix = SymmetricMatrix::zero(Arc::new(self.pattern()?));
        let pattern = matrix.pattern().clone();
        // The rows in the columns of an aggregate are blocks of ascending aggregates.
        for ([first, second], block) in self.blocks.iter().flatten() {
            let (first, second) = (*first as usize, *second as usize);
            let start = pattern.column_starts()[n * second];
            let end = pattern.column_starts()[n * second + 1];
            let rows = &pattern.rows()[start..end];
            let place = rows.partition_point(|&row| row < n * first);
            for column in 0..n {
                let start = pattern.column_starts()[n * second + column] + place;
                let last = if first == second { column + 1 } else { n };
                let values = &mut matrix.values[start..start + last];
                for (row, value) in values.iter_mut().enumerate() {
                    *value += block[row * n + column];
                }
            }
        }
        for unknown in 0..pattern.dimension() {
            let place = pattern.column_starts()[unknown + 1] - 1;
            if matrix.values[place] == 0.0 {
                matrix.values[place] = 1.0;
            }
        }
        Ok(matrix)
    }

    /// Sparsity pattern of E.
    fn pattern(&self) -> Result<Pattern, FactorError> {
        let n = self.n_motions;
        let (mut column_starts, mut rows) = (vec![0], Vec::new());
        for (aggregate, blocks) in self.blocks.iter().enumerate() {
            let mut above: Vec<u32> = blocks.iter().map(|([first, _], _)| *first).collect();
            above.push(aggregate as u32);
            above.sort_unstable();
            above.dedup();
            for column in 0..n {
                let blocks = above.iter().map(|&it| n * it as usize);
                let of_blocks = blocks.flat_map(|first| first..first + n);
                rows.extend(of_blocks.take_while(|row| *row <= n * aggregate + column));
                column_starts.push(rows.len());
            }
        }
        Pattern::new(column_starts, rows).map_err(|_| FactorError::IndexOverflow)
    }
}
