//! The stiffness E = Z^T K Z of a coarse space, and its factor.

use std::collections::BTreeSet;
use std::sync::Arc;

use ligament_linalg::{
    Elimination, FactorError, FactorKind, Factorisation, Pattern, Symbolic, SymmetricMatrix,
    VANISHING_PIVOT,
};

use super::coarse_basis::CoarseBasis;
use super::operator::Operator;
use super::resistance::Block;

/// Data from which the stiffness of a coarse space is assembled.
pub(super) struct CoarseStiffness<'a> {
    pub(super) operator: &'a Operator<'a>,
    pub(super) space: &'a CoarseBasis,
    /// Blocks of the columns of each aggregate.
    pub(super) blocks: Vec<Vec<Block>>,
}

impl CoarseStiffness<'_> {
    /// Assembles E.
    ///
    /// # Errors
    ///
    /// If E has too many entries for their indices.
    pub(super) fn matrix(&self) -> Result<SymmetricMatrix, FactorError> {
        let n = self.space.n_motions;
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
        for (weight, entries) in self.operator.beside {
            matrix.add_outer(*weight, &self.space.works(entries));
        }
        for unknown in 0..pattern.dimension() {
            let place = pattern.column_starts()[unknown + 1] - 1;
            if matrix.values[place] == 0.0 {
                matrix.values[place] = 1.0;
            }
        }
        Ok(matrix)
    }

    /// Sparsity pattern of E for the blocks and the additional terms.
    fn pattern(&self) -> Result<Pattern, FactorError> {
        let n = self.space.n_motions;
        let mut above: Vec<Vec<u32>> = vec![Vec::new(); self.space.aggregates.len()];
        for ([first, second], _) in self.blocks.iter().flatten() {
            above[*second as usize].push(*first);
        }
        for (_, entries) in self.operator.beside {
            let unknowns = self.space.works(entries);
            let mut of: Vec<u32> = unknowns.iter().map(|(it, _)| (it / n) as u32).collect();
            of.dedup();
            for (place, second) in of.iter().enumerate() {
                above[*second as usize].extend(&of[..place]);
            }
        }
        let (mut column_starts, mut rows) = (vec![0], Vec::new());
        for (aggregate, above) in above.iter_mut().enumerate() {
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

/// Factor of E.
pub(super) struct Factored {
    pub(super) factor: Box<dyn Factorisation>,
    /// Motions without stiffness beyond those before them, as those of mechanisms; decoupled in the factor.
    pub(super) left_out: BTreeSet<usize>,
}

impl Factored {
    /// Factorises E.
    ///
    /// # Errors
    ///
    /// If the factor does not fit into memory.
    pub(super) fn new(mut matrix: SymmetricMatrix) -> Result<Self, FactorError> {
        let symbolic = Symbolic::analyse(matrix.pattern().clone(), Elimination::MinimumDegree)?;
        let symbolic = Arc::new(symbolic);
        let mut left_out = BTreeSet::new();
        loop {
            let without = match FactorKind::Llt.factorise(&symbolic, &matrix) {
                Ok(factor) => {
                    let pivots = factor.pivots().into_iter().enumerate();
                    let vanishes =
                        |(i, pivot): &(usize, f64)| *pivot < VANISHING_PIVOT * matrix.diagonal(*i);
                    let vanishing: Vec<usize> = pivots.filter(vanishes).map(|it| it.0).collect();
                    if vanishing.is_empty() {
                        return Ok(Self { factor, left_out });
                    }
                    vanishing
                }
                Err(
                    FactorError::NotPositiveDefinite { unknown }
                    | FactorError::ZeroPivot { unknown },
                ) => vec![unknown],
                Err(other) => return Err(other),
            };
            left_out.extend(without);
            cut_off(&mut matrix, &left_out);
        }
    }
}

/// Decouples unknowns from the others, with a unit on the diagonal.
fn cut_off(matrix: &mut SymmetricMatrix, unknowns: &BTreeSet<usize>) {
    let pattern = matrix.pattern().clone();
    for column in 0..pattern.dimension() {
        let range = pattern.column_starts()[column]..pattern.column_starts()[column + 1];
        let is_out = unknowns.contains(&column);
        for (&row, value) in pattern.rows()[range.clone()]
            .iter()
            .zip(&mut matrix.values[range])
        {
            if is_out || unknowns.contains(&row) {
                *value = f64::from(u8::from(row == column));
            }
        }
    }
}
