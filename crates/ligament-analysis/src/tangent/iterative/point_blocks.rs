//! Block Jacobi: the inverses of the diagonal blocks of the points.

use ligament_linalg::{FactorError, VANISHING_PIVOT};
use ligament_model::parallel;

use super::operator::Operator;
use crate::vectors::CHUNK;

/// Least number of points of a parallel task.
const TASK: usize = 512;

/// Inverse diagonal block of each point, the stiffness of the point with all others fixed.
pub(super) struct PointBlocks {
    n_components: usize,
    /// Symmetric inverses, zero in rows and columns that are not free, shape (n_points, n_components, n_components).
    inverses: Vec<f64>,
    /// Diagonal of K, 1 where a degree of freedom is not free or has no stiffness, shape (n_degrees_of_freedom).
    diagonal: Vec<f64>,
}

impl PointBlocks {
    /// Computes the blocks of all points; also returns the degrees of freedom without stiffness.
    ///
    /// # Errors
    ///
    /// If a block is not definite.
    pub(super) fn new(operator: &Operator<'_>) -> Result<(Self, Vec<usize>), FactorError> {
        let n_components = operator.n_components();
        let n_points = operator.system.n_points();
        let mut blocks = Self {
            n_components,
            inverses: vec![0.0; n_points * n_components * n_components],
            diagonal: vec![1.0; n_points * n_components],
        };
        let beside = of_points_beside(operator);
        let size = n_components * n_components;
        let tasks = blocks.inverses.chunks_mut(TASK * size);
        let tasks = tasks.zip(blocks.diagonal.chunks_mut(TASK * n_components));
        let loose = parallel::map(tasks.enumerate(), |(task, (inverses, diagonals))| {
            let points = inverses.chunks_mut(size);
            let points = points.zip(diagonals.chunks_mut(n_components));
            (task * TASK..)
                .zip(points)
                .map(|(point, (inverse, diagonal))| {
                    invert(operator, point as u32, &beside, inverse, diagonal)
                })
                .collect::<Result<Vec<Vec<usize>>, FactorError>>()
        });
        let loose: Result<Vec<Vec<Vec<usize>>>, FactorError> = loose.into_iter().collect();
        Ok((blocks, loose?.concat().concat()))
    }

    /// Recomputes the blocks of some points; returns their degrees of freedom without stiffness.
    ///
    /// # Errors
    ///
    /// If a block is not definite.
    pub(super) fn renew(
        &mut self,
        operator: &Operator<'_>,
        points: impl Iterator<Item = u32>,
    ) -> Result<Vec<usize>, FactorError> {
        let beside = of_points_beside(operator);
        let (n, mut loose) = (self.n_components, Vec::new());
        for point in points {
            let place = point as usize;
            let inverse = &mut self.inverses[n * n * place..n * n * (place + 1)];
            let diagonal = &mut self.diagonal[n * place..n * (place + 1)];
            loose.extend(invert(operator, point, &beside, inverse, diagonal)?);
        }
        Ok(loose)
    }

    /// Diagonal of K, 1 where a degree of freedom is not free or has no stiffness, shape (n_degrees_of_freedom).
    pub(super) fn diagonal(&self) -> &[f64] {
        &self.diagonal
    }

    /// Product M^-1 f of the inverses with forces f, both of shape (n_degrees_of_freedom).
    pub(super) fn conditioned(&self, force: &[f64]) -> Vec<f64> {
        let mut motions = vec![0.0; force.len()];
        self.condition(force, &mut motions);
        motions
    }

    /// Overwrites motions with the product M^-1 f of the inverses with forces f, both of shape (n_degrees_of_freedom).
    pub(super) fn condition(&self, force: &[f64], motions: &mut [f64]) {
        // Number of degrees of freedom of the points of a chunk.
        let chunk = CHUNK / self.n_components * self.n_components;
        let chunks = motions.chunks_mut(chunk).zip(force.chunks(chunk));
        parallel::for_each(chunks.enumerate(), |(place, (motions, force))| {
            self.apply(place * chunk / self.n_components, force, motions);
        });
    }

    /// Product of the inverses with the forces of consecutive points from `first` on, both of shape (n, n_components).
    fn apply(&self, first: usize, forces: &[f64], motions: &mut [f64]) {
        match self.n_components {
            2 => self.apply_to::<2>(first, forces, motions),
            3 => self.apply_to::<3>(first, forces, motions),
            6 => self.apply_to::<6>(first, forces, motions),
            n => unreachable!("no point has {n} components"),
        }
    }

    fn apply_to<const M: usize>(&self, first: usize, forces: &[f64], motions: &mut [f64]) {
        let inverses = self.inverses[M * M * first..].as_chunks::<M>().0;
        let (forces, motions) = (forces.as_chunks::<M>().0, motions.as_chunks_mut::<M>().0);
        for ((inverse, force), motion) in inverses.chunks_exact(M).zip(forces).zip(motions) {
            for (value, row) in motion.iter_mut().zip(inverse) {
                *value = (0..M).map(|place| row[place] * force[place]).sum();
            }
        }
    }
}

/// An additional term at a point that it acts on: the point, its weight and its entries by degree of freedom.
type Beside<'a> = (u32, f64, &'a [(usize, f64)]);

/// Additional terms, sorted by the points that they act on.
fn of_points_beside<'a>(operator: &'a Operator<'_>) -> Vec<Beside<'a>> {
    let layout = operator.unknowns.layout();
    let mut of_points = Vec::new();
    for (weight, entries) in operator.beside {
        let mut points: Vec<u32> = entries.iter().map(|(dof, _)| layout.point(*dof)).collect();
        points.sort_unstable();
        points.dedup();
        of_points.extend((points.into_iter()).map(|point| (point, *weight, entries.as_slice())));
    }
    of_points.sort_by_key(|(point, ..)| *point);
    of_points
}

/// Inverts the block of a point; returns its degree of freedom without stiffness, if any.
///
/// # Errors
///
/// If the block is not definite: fixing a motion with negative stiffness would change the solution.
fn invert(
    operator: &Operator<'_>,
    point: u32,
    beside: &[Beside<'_>],
    inverse: &mut [f64],
    diagonal: &mut [f64],
) -> Result<Vec<usize>, FactorError> {
    let n = operator.n_components();
    let dofs = operator.unknowns.layout().range(point);
    let mut block = vec![0.0; n * n];
    operator.add_blocks(point, &[], &mut block);
    let from = beside.partition_point(|it| it.0 < point);
    for (_, weight, entries) in beside[from..].iter().take_while(|it| it.0 == point) {
        let own = || entries.iter().filter(|(dof, _)| dofs.contains(dof));
        for (row, one) in own() {
            for (column, other) in own() {
                block[(row - dofs.start) * n + column - dofs.start] += weight * one * other;
            }
        }
    }
    let free: Vec<usize> = (0..n)
        .filter(|&place| operator.free[dofs.start + place])
        .collect();
    for (place, value) in diagonal.iter_mut().enumerate() {
        let own = block[place * (n + 1)];
        *value = if free.contains(&place) && own > 0.0 {
            own
        } else {
            1.0
        };
    }
    inverse.fill(0.0);
    match invert_among(&free, n, &block, inverse) {
        Ok(()) => Ok(Vec::new()),
        Err(NoInverse::Vanishing(place)) => Ok(vec![dofs.start + place]),
        Err(NoInverse::Negative(place)) => {
            let unknown = operator.unknowns.number(dofs.start + place);
            Err(FactorError::NotPositiveDefinite {
                unknown: unknown.unwrap_or_default(),
            })
        }
    }
}

/// First of the rows and columns `free` of a symmetric block (n, n) whose pivot vanishes or is negative.
pub(in crate::tangent) fn vanishing_of_block(
    free: &[usize],
    n: usize,
    block: &[f64],
) -> Option<usize> {
    let inverted = invert_among(free, n, block, &mut vec![0.0; n * n]);
    let (NoInverse::Vanishing(place) | NoInverse::Negative(place)) = inverted.err()?;
    Some(place)
}

/// Inverts a symmetric block (n, n) without the rows and columns whose pivots vanish or are negative, where the inverse keeps its zeros.
pub(super) fn invert_without_vanishing(n: usize, block: &[f64], inverse: &mut [f64]) {
    let mut rows: Vec<usize> = (0..n).collect();
    inverse.fill(0.0);
    while let Err(NoInverse::Vanishing(place) | NoInverse::Negative(place)) =
        invert_among(&rows, n, block, inverse)
    {
        rows.retain(|it| *it != place);
    }
}

/// Reason why a block has no inverse, with the row of the pivot.
enum NoInverse {
    Vanishing(usize),
    Negative(usize),
}

/// Inverts the rows and columns `free` of a symmetric block (n, n).
fn invert_among(
    free: &[usize],
    n: usize,
    block: &[f64],
    inverse: &mut [f64],
) -> Result<(), NoInverse> {
    let size = free.len();
    let at = |row: usize, column: usize| block[free[row] * n + free[column]];
    let mut lower = vec![0.0; size * size];
    for column in 0..size {
        for row in column..size {
            let known: f64 = (0..column)
                .map(|k| lower[row * size + k] * lower[column * size + k])
                .sum();
            let rest = at(row, column) - known;
            if row > column {
                lower[row * size + column] = rest / lower[column * size + column];
            } else if rest > VANISHING_PIVOT * at(row, row).abs() {
                lower[row * size + row] = rest.sqrt();
            } else if rest < -VANISHING_PIVOT * at(row, row).abs() {
                return Err(NoInverse::Negative(free[column]));
            } else {
                return Err(NoInverse::Vanishing(free[column]));
            }
        }
    }
    for unit in 0..size {
        let mut x = vec![0.0; size];
        for row in unit..size {
            let known: f64 = (unit..row).map(|k| lower[row * size + k] * x[k]).sum();
            x[row] = (f64::from(u8::from(row == unit)) - known) / lower[row * size + row];
        }
        for row in (0..size).rev() {
            let known: f64 = (row + 1..size).map(|k| lower[k * size + row] * x[k]).sum();
            x[row] = (x[row] - known) / lower[row * size + row];
        }
        for (row, value) in x.into_iter().enumerate() {
            inverse[free[row] * n + free[unit]] = value;
        }
    }
    Ok(())
}
