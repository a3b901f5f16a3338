//! Coarse space of the multipliers: multipliers that are constant over all points of an aggregate.
//!
//! The ends of a bond have opposite terms in the equations of forces, so multipliers that are equal at both ends cost nothing, and long
//! waves of them little: less, in a large body, than the regularisation. The residual that regularisation leaves in unsatisfiable equations
//! is local, at corners and points of few bonds; in long waves it would add up to forces, and the body would be too soft. So the points are
//! divided into aggregates, over which multipliers may be constant at hardly any cost, and the directions of Newton steps are solved exactly
//! for such multipliers (a coarse space, Nicolaides 1987).

use nalgebra::{Cholesky, DMatrix, DVector, Dyn};
use rayon::prelude::*;

use super::equations::{Equations, Multipliers};
use super::pairs::BLOCK;
use crate::cloud::{PointCloud, distance};
use crate::correction::sweep_order::SweepOrder;

/// Largest number of aggregates: the dense matrix of their multipliers is to cost less than a product.
const MOST: usize = 64;

/// Smallest number of points of an aggregate: fewer are hardly more than the block of a point covers.
const FEWEST_POINTS: usize = 32;

/// Ratio below which one of two distances or volumes is the smaller one in spite of rounding.
const TIE: f64 = 1.0 - 1e-9;

/// Regularisation of multipliers that are constant over aggregates relative to that of others: it fixes those that are constant over the
/// body, which have no equation.
const SHARE: f64 = 1e-3;

/// Aggregates of points: each point belongs to the nearest of some seeds far from each other.
///
/// Distances decide, then volumes of the points where distances are equal: a body that is turned, or whose nodes are renumbered, has the
/// same aggregates. The numbers in the file matter only where a body is as symmetric as its mesh.
pub(crate) struct Aggregates<'a> {
    order: &'a SweepOrder<'a>,
    /// Index of the first number of the aggregate of each point.
    first: Vec<u32>,
    count: usize,
    /// Numbers per aggregate: one for each equation of forces.
    width: usize,
}

impl<'a> Aggregates<'a> {
    /// Aggregates of the points of a cloud in the order of sweeps, with `width` numbers each.
    pub(crate) fn new<const D: usize>(
        cloud: &PointCloud<D>,
        order: &'a SweepOrder<'a>,
        width: usize,
    ) -> Self {
        let count = (cloud.subdomain.n_all() / FEWEST_POINTS).clamp(1, MOST);
        let mut distance = vec![f64::INFINITY; cloud.len()];
        let mut aggregate = vec![0; cloud.len()];
        let mut seed = farthest(cloud, &distances_from(centroid(cloud), cloud));
        for number in 0..count {
            let from_seed = distances_from(seed, cloud);
            for (point, from_seed) in from_seed.into_iter().enumerate() {
                if from_seed < TIE * distance[point] {
                    (distance[point], aggregate[point]) = (from_seed, number);
                }
            }
            seed = farthest(cloud, &distance);
        }
        let first = |&point: &u32| (width * aggregate[point as usize]) as u32;
        Self {
            first: order.all().iter().map(first).collect(),
            order,
            count,
            width,
        }
    }

    /// Numbers of the aggregate of a point.
    #[inline(always)]
    pub(super) fn at<'b>(&self, of_aggregates: &'b [f64], index: usize) -> &'b [f64] {
        &of_aggregates[self.first[index] as usize..][..self.width]
    }

    /// Sums over the points of each aggregate, from the values of owned points.
    pub(super) fn sums<const N: usize>(
        &self,
        value: impl Fn(usize) -> [f64; N] + Sync,
    ) -> Vec<f64> {
        let zeros = || vec![0.0; self.width * self.count];
        let of_block = |(block, firsts): (usize, &[u32])| {
            let mut sums = zeros();
            for (index, &first) in (block * BLOCK..).zip(firsts) {
                let values = value(index);
                let of_aggregate = &mut sums[first as usize..][..self.width];
                for (sum, value) in of_aggregate.iter_mut().zip(values) {
                    *sum += value;
                }
            }
            sums
        };
        let own = &self.first[..self.order.owned().len()];
        let blocks = own.par_chunks(BLOCK).enumerate().map(of_block);
        let mut all = zeros();
        for sums in blocks.collect::<Vec<_>>() {
            for (all, sum) in all.iter_mut().zip(sums) {
                *all += sum;
            }
        }
        self.order.subdomain.all_reduce_sum(&mut all);
        all
    }
}

/// Volume-weighted mean of the positions, m.
fn centroid<const D: usize>(cloud: &PointCloud<D>) -> [f64; D] {
    let owned = || cloud.subdomain.owned().map(|it| it as usize);
    let total = cloud
        .subdomain
        .sum(owned().map(|it| cloud.volumes[it]).sum());
    let moment = |axis: usize| owned().map(move |it| cloud.volumes[it] * cloud.positions[it][axis]);
    let mut moments: [f64; D] = std::array::from_fn(|axis| moment(axis).sum());
    cloud.subdomain.all_reduce_sum(&mut moments);
    moments.map(|it| it / total)
}

/// Distances of all points from a position, m.
fn distances_from<const D: usize>(place: [f64; D], cloud: &PointCloud<D>) -> Vec<f64> {
    let from_place = |&position: &[f64; D]| distance(position, place);
    cloud.positions.iter().map(from_place).collect()
}

/// Position of the point of the body with the largest of some distances (n_points); of several at equal distance the one of the largest
/// volume, and of those the first in the file, m.
fn farthest<const D: usize>(cloud: &PointCloud<D>, distances: &[f64]) -> [f64; D] {
    let subdomain = &cloud.subdomain;
    let owned = || subdomain.owned().map(|it| it as usize);
    let largest = subdomain.max(owned().map(|it| distances[it]).fold(0.0, f64::max));
    let farthest = owned().filter(|&point| distances[point] >= TIE * largest);
    let rows = farthest.map(|point| {
        let [x, y, z] = [0, 1, 2].map(|k| cloud.positions[point].get(k).copied().unwrap_or(0.0));
        let in_file = f64::from(cloud.numbering.in_file(point as u32));
        [in_file, cloud.volumes[point], x, y, z]
    });
    let mut of_all = subdomain.all_gather_list(rows.collect());
    of_all.sort_unstable_by(|one, other| one[0].total_cmp(&other[0]));
    let best = of_all.into_iter().reduce(|best, row| {
        let is_larger = TIE * row[1] > best[1];
        if is_larger { row } else { best }
    });
    std::array::from_fn(|axis| best.map_or(0.0, |it| it[2 + axis]))
}

/// Regularisation of the multipliers of each point about a centre: r/d^2 times their deviation from it, less the mean deviation of the
/// aggregate.
pub(super) struct Regularisation<'a, const N: usize> {
    /// Weights r/d^2 of owned points, by index.
    pub(super) of_points: Multipliers<N>,
    pub(super) aggregates: &'a Aggregates<'a>,
    /// Sums of r/d^2 over the aggregates.
    totals: Vec<f64>,
}

impl<'a, const N: usize> Regularisation<'a, N> {
    pub(super) fn new(of_points: Multipliers<N>, aggregates: &'a Aggregates<'a>) -> Self {
        let totals = aggregates.sums(|index| of_points[index]);
        Self {
            of_points,
            aggregates,
            totals,
        }
    }

    /// Weighted means over the aggregates of deviations (n_own) from a centre, reduced by the fraction that stays regularised.
    pub(super) fn common(&self, distance: impl Fn(usize) -> [f64; N] + Sync) -> Vec<f64> {
        let weighted = |index: usize| {
            let (distance, weight) = (distance(index), &self.of_points[index]);
            std::array::from_fn(|k| weight[k] * distance[k])
        };
        let sums = self.aggregates.sums::<N>(weighted);
        let means = sums.iter().zip(&self.totals);
        means
            .map(|(sum, total)| (1.0 - SHARE) * sum / total)
            .collect()
    }

    /// Gradient of the regularisation at a point for its deviation from the centre.
    #[inline(always)]
    pub(super) fn force(&self, index: usize, mut distance: [f64; N], common: &[f64]) -> [f64; N] {
        let of_aggregate = self.aggregates.at(common, index);
        for (distance, common) in distance.iter_mut().zip(of_aggregate) {
            *distance -= common;
        }
        std::array::from_fn(|k| self.of_points[index][k] * distance[k])
    }
}

/// Hessian of the multipliers of forces that are constant over each aggregate.
pub(super) struct CoarseHessian {
    /// Cholesky factor; `None` if the matrix is not definite to rounding.
    factor: Option<Cholesky<f64, Dyn>>,
}

impl CoarseHessian {
    /// Assembles the matrix of the aggregates from the slopes of the pairs.
    pub(super) fn new<const N: usize, E: Equations<N>>(
        equations: &E,
        regularisation: &Regularisation<'_, N>,
        slopes: &[[f64; 2]],
    ) -> Self {
        let (pairs, aggregates) = (equations.pairs(), regularisation.aggregates);
        let mut held = DVector::from_vec(regularisation.totals.clone());
        if !pairs.order.subdomain.communicator().is_root() {
            held.fill(0.0);
        }
        let mut matrix = SHARE * DMatrix::from_diagonal(&held);
        for index in 0..pairs.n_points() {
            let own = aggregates.first[index] as usize;
            for pair in pairs.inner(index).chain(pairs.outer(index)) {
                let other = aggregates.first[pairs.other[pair] as usize] as usize;
                if other == own {
                    continue;
                }
                let is_inner = pairs.inner(index).contains(&pair);
                let rows = [[1.0, 0.0], [0.0, 1.0]].map(|it| equations.forces(pair, it));
                for i in 0..aggregates.width {
                    let weighted = [0, 1].map(|factor| slopes[pair][factor] * rows[factor][i]);
                    for k in 0..aggregates.width {
                        let square = weighted[0] * rows[0][k] + weighted[1] * rows[1][k];
                        matrix[(own + i, own + k)] += square;
                        matrix[(own + i, other + k)] -= square;
                        if is_inner {
                            matrix[(other + i, other + k)] += square;
                            matrix[(other + i, own + k)] -= square;
                        }
                    }
                }
            }
        }
        pairs.order.subdomain.all_reduce_sum(matrix.as_mut_slice());
        Self {
            factor: Cholesky::new(matrix),
        }
    }

    /// Multipliers of the aggregates for sums over their points; zero without a factor.
    pub(super) fn solve(&self, sums: &[f64]) -> Vec<f64> {
        let Some(factor) = &self.factor else {
            return vec![0.0; sums.len()];
        };
        factor.solve(&DVector::from_column_slice(sums)).data.into()
    }
}
