//! Clusters of aggregates, whose rigid motions span the coarser space of a third level.

use std::collections::BTreeMap;

use ligament_linalg::RankOne;
use ligament_model::parallel;

use super::aggregates::Aggregates;
use super::coarse_basis::CoarseBasis;
use super::coarse_stiffness::CoarseStiffness;
use super::operator::Operator;

/// Least number of clusters or aggregates of a parallel task.
const TASK: usize = 16;

/// The coarser space S: rigid motions of clusters, as amounts of the motions of their aggregates.
pub(super) struct Clusters {
    pub(super) n_motions: usize,
    /// Aggregates of each cluster, ascending.
    pub(super) aggregates: Vec<Vec<u32>>,
    /// Cluster of each aggregate, shape (n_aggregates).
    pub(super) of_aggregate: Vec<u32>,
    /// Rows of S, shape (n_aggregates, n_motions of the aggregate, n_motions of its cluster).
    pub(super) shapes: Vec<f64>,
}

impl Clusters {
    /// Clusters of at most `largest` points, more than an aggregate has, from the diagonal D of K (n_degrees_of_freedom). The
    /// amounts of a rigid motion R are S = Z^T D R, because the columns of the coarse space Z are orthonormal with these weights.
    pub(super) fn new(
        operator: &Operator<'_>,
        space: &CoarseBasis,
        diagonal: &[f64],
        largest: usize,
    ) -> Self {
        // Both divisions halve the same parts, so that the points of an aggregate are in one cluster.
        let clusters = Aggregates::new(operator.system, operator.bonds.intact, largest);
        let first_points = space.aggregates.points.iter().map(|it| it[0] as usize);
        let of_aggregate: Vec<u32> = first_points.map(|it| clusters.of_point[it]).collect();
        let mut aggregates = vec![Vec::new(); clusters.len()];
        for (aggregate, &cluster) in of_aggregate.iter().enumerate() {
            aggregates[cluster as usize].push(aggregate as u32);
        }
        let of_clusters: Vec<BTreeMap<u32, Vec<f64>>> = parallel::map(&clusters.points, |points| {
            shapes(operator, space, diagonal, points)
        });
        let size = space.n_motions * space.n_motions;
        let mut shapes = vec![0.0; size * space.aggregates.len()];
        for (aggregate, shape) in of_clusters.into_iter().flatten() {
            shapes[size * aggregate as usize..][..size].copy_from_slice(&shape);
        }
        Self {
            n_motions: space.n_motions,
            aggregates,
            of_aggregate,
            shapes,
        }
    }

    /// Rows of S of an aggregate, shape (n_motions, n_motions).
    fn shape(&self, aggregate: usize) -> &[f64] {
        let size = self.n_motions * self.n_motions;
        &self.shapes[size * aggregate..size * (aggregate + 1)]
    }

    /// Stiffness S^T E S of the coarser space.
    pub(super) fn stiffness(&self, stiffness: &CoarseStiffness) -> CoarseStiffness {
        let n = self.n_motions;
        let mut sums: Vec<BTreeMap<u32, Vec<f64>>> = vec![BTreeMap::new(); self.aggregates.len()];
        for ([first, second], block) in stiffness.blocks.iter().flatten() {
            let [one, other] = [*first, *second].map(|it| self.of_aggregate[it as usize]);
            let product = congruent(
                n,
                block,
                [*first, *second].map(|it| self.shape(it as usize)),
            );
            let sum = sums[one.max(other) as usize].entry(one.min(other));
            let sum = sum.or_insert_with(|| vec![0.0; n * n]);
            for row in 0..n {
                for column in 0..n {
                    let value = product[row * n + column];
                    if one <= other {
                        sum[row * n + column] += value;
                    }
                    if one > other || one == other && first != second {
                        sum[column * n + row] += value;
                    }
                }
            }
        }
        let of_cluster = |(second, sums): (usize, BTreeMap<u32, Vec<f64>>)| {
            let sums = sums.into_iter();
            let blocks = sums.map(|(first, sum)| ([first, second as u32], sum));
            blocks.collect()
        };
        CoarseStiffness {
            n_motions: n,
            blocks: sums.into_iter().enumerate().map(of_cluster).collect(),
        }
    }

    /// Term of the coarser space for a term of the amounts.
    pub(super) fn term(&self, term: &RankOne) -> RankOne {
        let n = self.n_motions;
        let mut works: BTreeMap<usize, f64> = BTreeMap::new();
        for &(unknown, value) in &term.entries {
            let (aggregate, motion) = (unknown / n, unknown % n);
            let first = n * self.of_aggregate[aggregate] as usize;
            let row = &self.shape(aggregate)[n * motion..n * (motion + 1)];
            for (place, share) in (first..).zip(row) {
                *works.entry(place).or_default() += share * value;
            }
        }
        RankOne {
            weight: term.weight,
            entries: works.into_iter().collect(),
        }
    }

    /// Works S^T w of works w (n_aggregates, n_motions), shape (n_clusters, n_motions).
    pub(super) fn works(&self, of_aggregates: &[f64]) -> Vec<f64> {
        let n = self.n_motions;
        let mut works = vec![0.0; n * self.aggregates.len()];
        let tasks = works.chunks_mut(TASK * n).zip(self.aggregates.chunks(TASK));
        parallel::for_each(tasks, |(works, clusters)| {
            for (works, aggregates) in works.chunks_mut(n).zip(clusters) {
                for &aggregate in aggregates {
                    let first = n * aggregate as usize;
                    let rows = self.shape(aggregate as usize).chunks_exact(n);
                    for (row, value) in rows.zip(&of_aggregates[first..]) {
                        for (work, share) in works.iter_mut().zip(row) {
                            *work += share * value;
                        }
                    }
                }
            }
        });
        works
    }

    /// Adds amounts S b of the motions of an aggregate for amounts b (n_clusters, n_motions).
    pub(super) fn add_amounts(&self, aggregate: usize, of_clusters: &[f64], amounts: &mut [f64]) {
        let n = self.n_motions;
        let of_cluster = &of_clusters[n * self.of_aggregate[aggregate] as usize..];
        let rows = self.shape(aggregate).chunks_exact(n);
        for (amount, row) in amounts.iter_mut().zip(rows) {
            let shares = row.iter().zip(of_cluster);
            *amount += shares.map(|(share, value)| share * value).sum::<f64>();
        }
    }
}

/// Amounts Z^T D R of the rigid motions R of a cluster of points, by aggregate, shape (n_motions, n_motions) each.
fn shapes(
    operator: &Operator<'_>,
    space: &CoarseBasis,
    diagonal: &[f64],
    points: &[u32],
) -> BTreeMap<u32, Vec<f64>> {
    let (n, k) = (space.n_motions, operator.n_components());
    let motions = operator.system.rigid_shapes(points);
    let mut shapes: BTreeMap<u32, Vec<f64>> = BTreeMap::new();
    for (place, &point) in points.iter().enumerate() {
        let aggregate = space.aggregates.of_point[point as usize];
        let shape = shapes.entry(aggregate);
        let shape = shape.or_insert_with(|| vec![0.0; n * n]);
        let rows = space.rows_of(point, k).chunks_exact(n);
        for (component, row) in rows.enumerate() {
            let weight = diagonal[k * point as usize + component];
            for (own, z) in shape.chunks_exact_mut(n).zip(row) {
                for (sum, motion) in own.iter_mut().zip(&motions) {
                    *sum += z * weight * motion[k * place + component];
                }
            }
        }
    }
    shapes
}

/// Product A^T B C of blocks A, B and C (n, n), for `[A, C]`.
fn congruent(n: usize, block: &[f64], [one, other]: [&[f64]; 2]) -> Vec<f64> {
    let mut half = vec![0.0; n * n];
    for (row, half) in block.chunks_exact(n).zip(half.chunks_exact_mut(n)) {
        for (value, row) in row.iter().zip(other.chunks_exact(n)) {
            for (sum, share) in half.iter_mut().zip(row) {
                *sum += value * share;
            }
        }
    }
    let mut product = vec![0.0; n * n];
    for (row, half) in one.chunks_exact(n).zip(half.chunks_exact(n)) {
        for (value, sums) in row.iter().zip(product.chunks_exact_mut(n)) {
            for (sum, share) in sums.iter_mut().zip(half) {
                *sum += value * share;
            }
        }
    }
    product
}
