//! The coarse space spanned by the rigid motions of aggregates.

use std::collections::BTreeMap;

use ligament_model::parallel;

use super::aggregates::Aggregates;
use super::operator::Operator;
use crate::vectors::dot;

/// Share of a rigid motion below which its part orthogonal to the others counts as zero: an aggregate with many fixed degrees of
/// freedom has fewer motions.
const RANK_TOLERANCE: f64 = 1e-6;

/// Least number of aggregates of a parallel task.
const TASK: usize = 32;

/// The coarse space Z.
///
/// A column of Z is a rigid motion of an aggregate at its free degrees of freedom. Columns of missing motions are zero, with a unit
/// on the diagonal of E.
pub(super) struct CoarseBasis {
    pub(super) aggregates: Aggregates,
    /// Number of rigid motions of an aggregate.
    pub(super) n_motions: usize,
    /// Rows of Z, shape (n_degrees_of_freedom, n_motions).
    rows: Vec<f64>,
}

impl CoarseBasis {
    /// Coarse space of aggregates of at most `largest` points, from the diagonal of K (n_degrees_of_freedom).
    pub(super) fn new(operator: &Operator<'_>, diagonal: &[f64], largest: usize) -> Self {
        let aggregates = Aggregates::new(operator.system, operator.bonds.intact, largest);
        let shapes: Vec<Vec<Vec<f64>>> = parallel::map(&aggregates.points, |points| {
            shapes(operator, diagonal, points)
        });
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
        Self {
            aggregates,
            n_motions,
            rows,
        }
    }

    /// Rows of Z at a point, shape (n_components, n_motions).
    pub(super) fn rows_of(&self, point: u32, n_components: usize) -> &[f64] {
        let size = self.n_motions * n_components;
        &self.rows[size * point as usize..size * (point as usize + 1)]
    }

    /// Work of entries at degrees of freedom on the coarse motions, by coarse unknown, ascending.
    pub(super) fn works(&self, entries: &[(usize, f64)]) -> Vec<(usize, f64)> {
        let n = self.n_motions;
        let n_components = self.rows.len() / n / self.aggregates.of_point.len();
        let mut works: BTreeMap<usize, f64> = BTreeMap::new();
        for &(dof, value) in entries {
            let aggregate = self.aggregates.of_point[dof / n_components] as usize;
            let row = &self.rows[n * dof..n * (dof + 1)];
            for (motion, z) in row.iter().enumerate() {
                *works.entry(n * aggregate + motion).or_default() += z * value;
            }
        }
        works.into_iter().collect()
    }

    /// Work Z^T f of forces f (n_degrees_of_freedom) on the coarse motions, shape (n_aggregates, n_motions).
    pub(super) fn works_of_all(&self, forces: &[f64]) -> Vec<f64> {
        let n = self.n_motions;
        let n_components = forces.len() / self.aggregates.of_point.len();
        let mut works = vec![0.0; self.aggregates.len() * n];
        let tasks = works.chunks_mut(TASK * n);
        let tasks = tasks.zip(self.aggregates.points.chunks(TASK));
        parallel::for_each(tasks, |(works, aggregates)| {
            for (works, points) in works.chunks_mut(n).zip(aggregates) {
                for &point in points {
                    let first = n_components * point as usize;
                    let rows = self.rows_of(point, n_components).chunks_exact(n);
                    for (row, force) in rows.zip(&forces[first..]) {
                        for (work, value) in works.iter_mut().zip(row) {
                            *work += value * force;
                        }
                    }
                }
            }
        });
        works
    }

    /// Adds motions Z a for amounts a (n_aggregates, n_motions) at consecutive points from `first` on, shape (n, n_components).
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

/// Rigid motions of the free degrees of freedom of an aggregate, orthonormal with the diagonal of K as weights; zero where there
/// are fewer motions, shape (n_motions, degrees of freedom of the points).
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
        // Two passes suffice for any angle between the motions.
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
