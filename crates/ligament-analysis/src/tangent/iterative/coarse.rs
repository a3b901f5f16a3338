//! The coarse space of the rigid motions of aggregates, and the factor of the stiffness in it.

use std::collections::BTreeMap;
use std::sync::Arc;

use ligament_linalg::{
    Elimination, FactorError, FactorKind, Factorisation, Pattern, Symbolic, SymmetricMatrix,
    VANISHING_PIVOT,
};
use rayon::prelude::*;

use super::aggregates::Aggregates;
use super::operator::Operator;
use crate::vectors::dot;

/// Share of a rigid motion below which what is left of it beside the others counts as none: an aggregate that is mostly held has
/// fewer motions.
const RANK_TOLERANCE: f64 = 1e-6;

/// The coarse space Z and the factor of E = Z^T K Z.
pub(super) struct Coarse {
    space: Space,
    factor: Box<dyn Factorisation>,
}

/// The coarse space Z.
///
/// A column of Z is a rigid motion of an aggregate where it is free. Those that an aggregate has not are zero, with a unit on the
/// diagonal of E.
pub(super) struct Space {
    aggregates: Aggregates,
    /// Rigid motions of an aggregate.
    n_motions: usize,
    /// Rows of Z by degree of freedom, shape (n_degrees_of_freedom, n_motions).
    rows: Vec<f64>,
}

/// A block of E: its aggregates, first not above second, and its values (n_motions, n_motions).
type Block = ([u32; 2], Vec<f64>);

impl Coarse {
    /// The coarse space of the bonds of an operator, with the stiffness of each degree of freedom by itself
    /// (n_degrees_of_freedom).
    ///
    /// # Errors
    ///
    /// If E does not fit into memory.
    pub(super) fn new(
        operator: &Operator<'_>,
        diagonal: &[f64],
        largest: usize,
    ) -> Result<Self, FactorError> {
        let aggregates = Aggregates::new(operator.system, operator.bonds.intact, largest);
        let shapes: Vec<Vec<Vec<f64>>> = (aggregates.points.par_iter())
            .map(|points| shapes(operator, diagonal, points))
            .collect();
        let n_motions = shapes.first().map_or(0, Vec::len);
        let n_components = operator.n_components();
        let mut rows = vec![0.0; operator.free.len() * n_motions];
        for (points, shapes) in aggregates.points.iter().zip(shapes) {
            for (motion, shape) in shapes.iter().enumerate() {
                for (&point, values) in points.iter().zip(shape.chunks_exact(n_components)) {
                    let first = n_components * point as usize;
                    for (dof, value) in (first..).zip(values) {
                        rows[dof * n_motions + motion] = *value;
                    }
                }
            }
        }
        let space = Space {
            aggregates,
            n_motions,
            rows,
        };
        let stiffness = CoarseStiffness {
            operator,
            space: &space,
        };
        let factor = factorised(stiffness.matrix()?)?;
        Ok(Self { space, factor })
    }

    /// The space.
    pub(super) fn space(&self) -> &Space {
        &self.space
    }

    /// Amounts E^-1 Z^T f of the motions for forces f (n_degrees_of_freedom), shape (n_aggregates, n_motions).
    pub(super) fn amounts(&mut self, forces: &[f64]) -> Vec<f64> {
        let Space {
            aggregates,
            n_motions,
            rows,
        } = &self.space;
        let n_motions = *n_motions;
        let n_components = forces.len() / aggregates.of_point.len();
        let mut amounts = vec![0.0; aggregates.len() * n_motions];
        amounts
            .par_chunks_mut(n_motions)
            .zip(&aggregates.points)
            .with_min_len(32)
            .for_each(|(amounts, points)| {
                for &point in points {
                    let first = n_components * point as usize;
                    for dof in first..first + n_components {
                        let row = &rows[dof * n_motions..(dof + 1) * n_motions];
                        for (amount, value) in amounts.iter_mut().zip(row) {
                            *amount += value * forces[dof];
                        }
                    }
                }
            });
        self.factor.solve_in_place(&mut amounts);
        amounts
    }
}

impl Space {
    /// Adds motions Z a for amounts a (n_aggregates, n_motions) at a range of points from a first one on, shape (n, components).
    pub(super) fn add_motions(
        &self,
        first: usize,
        n_components: usize,
        amounts: &[f64],
        motions: &mut [f64],
    ) {
        let n = self.n_motions;
        for (point, motion) in (first..).zip(motions.chunks_exact_mut(n_components)) {
            let aggregate = self.aggregates.of_point[point] as usize;
            let amounts = &amounts[n * aggregate..n * (aggregate + 1)];
            let rows = &self.rows[n * n_components * point..n * n_components * (point + 1)];
            for (value, row) in motion.iter_mut().zip(rows.chunks_exact(n)) {
                *value += row.iter().zip(amounts).map(|(z, a)| z * a).sum::<f64>();
            }
        }
    }
}

/// The rigid motions of the free degrees of freedom of an aggregate, orthonormal with the stiffness of each degree of freedom by itself
/// as weights; zero where there is no further one, shape (n_motions, degrees of freedom of the points).
fn shapes(operator: &Operator<'_>, diagonal: &[f64], points: &[u32]) -> Vec<Vec<f64>> {
    let layout = operator.unknowns.layout();
    let dofs = || points.iter().flat_map(|&point| layout.range(point));
    let weights: Vec<f64> = dofs().map(|dof| diagonal[dof]).collect();
    let weighted = |shape: &[f64]| -> Vec<f64> {
        let both = shape.iter().zip(&weights);
        both.map(|(value, weight)| value * weight).collect()
    };
    let mut shapes = operator.system.rigid_shapes(points);
    for motion in 0..shapes.len() {
        let (before, rest) = shapes.split_at_mut(motion);
        let shape = &mut rest[0];
        for (value, dof) in shape.iter_mut().zip(dofs()) {
            if !operator.free[dof] {
                *value = 0.0;
            }
        }
        let size = dot(shape, &weighted(shape)).sqrt();
        // Twice is enough, whatever the angle.
        for other in before.iter().chain(before.iter()) {
            let share = dot(shape, &weighted(other));
            for (value, other) in shape.iter_mut().zip(other) {
                *value -= share * other;
            }
        }
        let left = dot(shape, &weighted(shape)).sqrt();
        let factor = if left > RANK_TOLERANCE * size {
            left.recip()
        } else {
            0.0
        };
        shape.iter_mut().for_each(|value| *value *= factor);
    }
    shapes
}

/// The factor of E. A motion that costs nothing beside those before it, as that of a mechanism, is left out of the space.
fn factorised(mut matrix: SymmetricMatrix) -> Result<Box<dyn Factorisation>, FactorError> {
    let symbolic = Symbolic::analyse(matrix.pattern().clone(), Elimination::MinimumDegree)?;
    let symbolic = Arc::new(symbolic);
    loop {
        let without = match FactorKind::Llt.factorise(&symbolic, &matrix) {
            Ok(factor) => {
                let pivots = factor.pivots().into_iter().enumerate();
                let vanishes =
                    |(i, pivot): &(usize, f64)| *pivot < VANISHING_PIVOT * matrix.diagonal(*i);
                let vanishing: Vec<usize> = pivots.filter(vanishes).map(|it| it.0).collect();
                if vanishing.is_empty() {
                    return Ok(factor);
                }
                vanishing
            }
            Err(
                FactorError::NotPositiveDefinite { unknown } | FactorError::ZeroPivot { unknown },
            ) => vec![unknown],
            Err(other) => return Err(other),
        };
        leave_out(&mut matrix, &without);
    }
}

/// Cuts unknowns off from the others, with a unit on the diagonal.
fn leave_out(matrix: &mut SymmetricMatrix, unknowns: &[usize]) {
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

/// The stiffness in a coarse space, to be made.
struct CoarseStiffness<'a> {
    operator: &'a Operator<'a>,
    space: &'a Space,
}

impl CoarseStiffness<'_> {
    /// E = Z^T K Z, by the aggregates of the columns on all threads.
    fn matrix(&self) -> Result<SymmetricMatrix, FactorError> {
        let of_columns: Vec<Vec<Block>> = (0..self.space.aggregates.len())
            .into_par_iter()
            .map(|aggregate| self.blocks_of(aggregate as u32))
            .collect();
        let n = self.space.n_motions;
        let mut matrix = SymmetricMatrix::zero(Arc::new(self.pattern(&of_columns)?));
        let pattern = matrix.pattern().clone();
        // The rows of the columns of an aggregate are blocks that ascend: of which aggregates?
        for ([first, second], block) in of_columns.iter().flatten() {
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
            matrix.add_outer(*weight, &self.in_space(entries));
        }
        for unknown in 0..pattern.dimension() {
            let place = pattern.column_starts()[unknown + 1] - 1;
            if matrix.values[place] == 0.0 {
                matrix.values[place] = 1.0;
            }
        }
        Ok(matrix)
    }

    /// The work of entries at degrees of freedom on the motions, by coarse unknown.
    fn in_space(&self, entries: &[(usize, f64)]) -> Vec<(usize, f64)> {
        let (layout, n) = (self.operator.unknowns.layout(), self.space.n_motions);
        let mut works: BTreeMap<usize, f64> = BTreeMap::new();
        for &(dof, value) in entries {
            let aggregate = self.space.aggregates.of_point[layout.point(dof) as usize] as usize;
            let row = &self.space.rows[n * dof..n * (dof + 1)];
            for (motion, z) in row.iter().enumerate() {
                *works.entry(n * aggregate + motion).or_default() += z * value;
            }
        }
        works.into_iter().collect()
    }

    /// The blocks that the columns of the points of an aggregate add to, in the order of their aggregates.
    fn blocks_of(&self, aggregate: u32) -> Vec<Block> {
        let (n, n_components) = (self.space.n_motions, self.operator.n_components());
        let size = n_components * n_components;
        let mut sums: BTreeMap<u32, Vec<f64>> = BTreeMap::new();
        let mut blocks = Vec::new();
        let mut product = vec![0.0; n_components * n];
        for &point in &self.space.aggregates.points[aggregate as usize] {
            let lower = self.operator.lower_points(point);
            blocks.clear();
            blocks.resize((lower.len() + 1) * size, 0.0);
            self.operator.add_blocks(point, &lower, &mut blocks);
            let of_column = self.rows_of(point);
            for (&other, block) in lower.iter().chain([&point]).zip(blocks.chunks_exact(size)) {
                let of = self.space.aggregates.of_point[other as usize];
                let sum = sums.entry(of).or_insert_with(|| vec![0.0; n * n]);
                multiply(block, of_column, n, &mut product);
                add_transposed_product(self.rows_of(other), &product, n, sum);
                if of == aggregate && other != point {
                    // The same couple the other way round.
                    add_transposed_product(&product, self.rows_of(other), n, sum);
                }
            }
        }
        // Across a crack the blocks are zero.
        let sums = sums.into_iter();
        let kept = sums.filter(|(_, sum)| sum.iter().any(|value| *value != 0.0));
        let ordered = kept.map(|(of, sum)| match of <= aggregate {
            true => ([of, aggregate], sum),
            false => {
                let transposed = (0..n * n).map(|it| sum[it % n * n + it / n]).collect();
                ([aggregate, of], transposed)
            }
        });
        ordered.collect()
    }

    fn rows_of(&self, point: u32) -> &[f64] {
        let size = self.space.n_motions * self.operator.n_components();
        &self.space.rows[size * point as usize..size * (point as usize + 1)]
    }

    /// The pattern of E for some blocks and the terms beside.
    fn pattern(&self, of_columns: &[Vec<Block>]) -> Result<Pattern, FactorError> {
        let n = self.space.n_motions;
        let mut above: Vec<Vec<u32>> = vec![Vec::new(); self.space.aggregates.len()];
        for ([first, second], _) in of_columns.iter().flatten() {
            above[*second as usize].push(*first);
        }
        for (_, entries) in self.operator.beside {
            let unknowns = self.in_space(entries);
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

/// The product of a block (k, k) with rows (k, n).
fn multiply(block: &[f64], rows: &[f64], n: usize, product: &mut [f64]) {
    product.fill(0.0);
    let k = rows.len() / n;
    for (of_block, sums) in block.chunks_exact(k).zip(product.chunks_exact_mut(n)) {
        for (factor, row) in of_block.iter().zip(rows.chunks_exact(n)) {
            for (sum, value) in sums.iter_mut().zip(row) {
                *sum += factor * value;
            }
        }
    }
}

/// Adds A^T B of rows A and B (k, n) to a block (n, n).
fn add_transposed_product(one: &[f64], other: &[f64], n: usize, sum: &mut [f64]) {
    for (one, other) in one.chunks_exact(n).zip(other.chunks_exact(n)) {
        for (factor, sums) in one.iter().zip(sum.chunks_exact_mut(n)) {
            for (sum, value) in sums.iter_mut().zip(other) {
                *sum += factor * value;
            }
        }
    }
}
