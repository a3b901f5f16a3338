//! Coarse space of the multipliers: multipliers that are linear over all points of an aggregate.
//!
//! The ends of a bond have opposite terms in the equations of forces, so multipliers that are equal at both ends cost nothing, and long
//! waves of them little: less, in a large body, than the regularisation. The residual that regularisation leaves in unsatisfiable equations
//! is local, at corners and points of few bonds; in long waves it would add up to forces, and to moments of forces about the centre of an
//! aggregate, which are its mean stress: the body would be too soft. So the points are divided into aggregates, over which multipliers may
//! be linear at hardly any cost, and the directions of Newton steps are solved exactly for such multipliers (a coarse space, Nicolaides
//! 1987).

use nalgebra::{Cholesky, DMatrix, DVector, Dyn};

use super::equations::{Equations, Multipliers};
use super::pairs::BLOCK;
use crate::cloud::{PointCloud, distance};
use crate::correction::sweep_order::SweepOrder;
use crate::parallel;

/// Largest number of multipliers of all aggregates: their dense matrix is to cost less than the products.
const MOST_MULTIPLIERS: usize = 720;

/// Smallest number of points of an aggregate, for the same reason.
const FEWEST_POINTS: usize = 64;

/// Ratio below which one of two distances or volumes is the smaller one in spite of rounding.
const TIE: f64 = 1.0 - 1e-9;

/// Regularisation of multipliers that are linear over aggregates, relative to other multipliers: it fixes multipliers that are constant over the
/// body, which have no equation.
const SHARE: f64 = 1e-3;

/// Part of the second moments of an aggregate below which it has no extent in a direction.
const FLAT: f64 = 1e-9;

/// Aggregates of points: each point belongs to the nearest of some seeds far from each other.
///
/// Distances decide, then volumes of the points where distances are equal: a body that is turned, or whose nodes are renumbered, has the
/// same aggregates. The numbers in the file matter only where a body is as symmetric as its mesh.
pub(crate) struct Aggregates<'a> {
    order: &'a SweepOrder<'a>,
    /// Number of the aggregate of each point, by index.
    aggregate: Vec<u32>,
    count: usize,
    /// Values of the functions of the aggregate of each point, `n_functions` for each: a constant and the coordinates, orthonormal over the
    /// aggregate in the weights of its points; zero where an aggregate has no extent.
    functions: Vec<f64>,
    n_functions: usize,
    /// Numbers per function: one for each equation of forces.
    width: usize,
}

impl<'a> Aggregates<'a> {
    /// Aggregates of the points of a cloud in the order of sweeps, with `width` equations of forces a point. The weights of owned points in
    /// the regularisation are given by index.
    pub(crate) fn new<const D: usize>(
        cloud: &PointCloud<D>,
        order: &'a SweepOrder<'a>,
        width: usize,
        weights: &[f64],
    ) -> Self {
        let n_functions = 1 + D;
        let most = MOST_MULTIPLIERS / (n_functions * width);
        let count = (cloud.subdomain.n_all() / FEWEST_POINTS).clamp(1, most);
        let aggregate = nearest_seeds(cloud, count);
        let by_index = order.all().iter().map(|&point| aggregate[point as usize]);
        let mut aggregates = Self {
            aggregate: by_index.collect(),
            order,
            count,
            functions: Vec::new(),
            n_functions,
            width,
        };
        aggregates.functions = aggregates.orthonormal(cloud, weights);
        aggregates
    }

    /// Values of the functions of each point, from a Cholesky factor of the second moments of each aggregate about its centre.
    fn orthonormal<const D: usize>(&self, cloud: &PointCloud<D>, weights: &[f64]) -> Vec<f64> {
        let mut sums = vec![[0.0; 4]; self.count];
        let mut moments = vec![[[0.0; D]; D]; self.count];
        let position = |index: usize| cloud.positions[self.order.all()[index] as usize];
        for (index, weight) in weights.iter().enumerate() {
            let [total, first @ ..] = &mut sums[self.aggregate[index] as usize];
            *total += weight;
            for (first, coordinate) in first.iter_mut().zip(position(index)) {
                *first += weight * coordinate;
            }
        }
        self.order.subdomain.all_reduce_sum(sums.as_flattened_mut());
        let from_centre = |index: usize| {
            let [total, first @ ..] = sums[self.aggregate[index] as usize];
            let position = position(index);
            std::array::from_fn::<f64, D, _>(|axis| position[axis] - first[axis] / total)
        };
        for (index, weight) in weights.iter().enumerate() {
            let from_centre = from_centre(index);
            let moments = &mut moments[self.aggregate[index] as usize];
            for (row, one) in moments.iter_mut().zip(from_centre) {
                for (entry, other) in row.iter_mut().zip(from_centre) {
                    *entry += weight * one * other;
                }
            }
        }
        let values = moments.as_flattened_mut().as_flattened_mut();
        self.order.subdomain.all_reduce_sum(values);
        let factors: Vec<_> = moments.into_iter().map(factor).collect();
        let indices = 0..self.aggregate.len();
        let of_point = |index: usize| {
            let aggregate = self.aggregate[index] as usize;
            let linear = solved(&factors[aggregate], from_centre(index));
            std::iter::once(1.0 / sums[aggregate][0].sqrt()).chain(linear)
        };
        indices.flat_map(of_point).collect()
    }

    /// Values of the functions of a point.
    #[inline(always)]
    fn functions(&self, index: usize) -> &[f64] {
        &self.functions[index * self.n_functions..][..self.n_functions]
    }

    /// Index of the first number of the aggregate of a point.
    #[inline(always)]
    fn first(&self, index: usize) -> usize {
        self.aggregate[index] as usize * self.n_functions * self.width
    }

    /// Multipliers of a point for given numbers of the aggregates.
    #[inline(always)]
    pub(super) fn at<const N: usize>(&self, of_aggregates: &[f64], index: usize) -> [f64; N] {
        let mut multipliers = [0.0; N];
        let numbers = of_aggregates[self.first(index)..].chunks_exact(self.width);
        for (function, numbers) in self.functions(index).iter().zip(numbers) {
            for (multiplier, number) in multipliers.iter_mut().zip(numbers) {
                *multiplier += function * number;
            }
        }
        multipliers
    }

    /// Sums over the points of each aggregate of the functions times values of owned points.
    pub(super) fn sums<const N: usize>(
        &self,
        value: impl Fn(usize) -> [f64; N] + Sync,
    ) -> Vec<f64> {
        let zeros = || vec![0.0; self.width * self.n_functions * self.count];
        let n_own = self.order.owned().len();
        let of_block = |block: usize| {
            let mut sums = zeros();
            for index in block * BLOCK..((block + 1) * BLOCK).min(n_own) {
                let values = value(index);
                let of_aggregate = sums[self.first(index)..].chunks_exact_mut(self.width);
                for (function, sums) in self.functions(index).iter().zip(of_aggregate) {
                    for (sum, value) in sums.iter_mut().zip(values) {
                        *sum += function * value;
                    }
                }
            }
            sums
        };
        let mut all = zeros();
        for sums in parallel::map(0..n_own.div_ceil(BLOCK), of_block) {
            for (all, sum) in all.iter_mut().zip(sums) {
                *all += sum;
            }
        }
        self.order.subdomain.all_reduce_sum(&mut all);
        all
    }
}

/// Number of the nearest of some seeds of all points: the point farthest from the centre of the body, and then one after the other the point
/// farthest from all seeds before.
fn nearest_seeds<const D: usize>(cloud: &PointCloud<D>, count: usize) -> Vec<u32> {
    let mut distance = vec![f64::INFINITY; cloud.len()];
    let mut aggregate = vec![0; cloud.len()];
    let mut seed = farthest(cloud, &distances_from(centroid(cloud), cloud));
    for number in 0..count {
        let from_seed = distances_from(seed, cloud);
        for (point, from_seed) in from_seed.into_iter().enumerate() {
            if from_seed < TIE * distance[point] {
                (distance[point], aggregate[point]) = (from_seed, number as u32);
            }
        }
        seed = farthest(cloud, &distance);
    }
    aggregate
}

/// Lower Cholesky factor L of second moments, with zeros in the rows of directions without extent.
fn factor<const D: usize>(moments: [[f64; D]; D]) -> [[f64; D]; D] {
    let extent = FLAT * (0..D).map(|axis| moments[axis][axis]).sum::<f64>();
    let mut lower = [[0.0; D]; D];
    for row in 0..D {
        for column in 0..=row {
            let known: f64 = (0..column).map(|k| lower[row][k] * lower[column][k]).sum();
            let left = moments[row][column] - known;
            lower[row][column] = match (row == column, lower[column][column]) {
                (true, _) if left > extent => left.sqrt(),
                (false, pivot) if pivot > 0.0 => left / pivot,
                _ => 0.0,
            };
        }
    }
    lower
}

/// Solution of L x = r; zero in the rows without extent.
fn solved<const D: usize>(lower: &[[f64; D]; D], mut right: [f64; D]) -> [f64; D] {
    for row in 0..D {
        let known: f64 = (0..row).map(|k| lower[row][k] * right[k]).sum();
        right[row] = match lower[row][row] {
            pivot if pivot > 0.0 => (right[row] - known) / pivot,
            _ => 0.0,
        };
    }
    right
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

/// Regularisation of the multipliers of each point about a centre: r/d^2 times their deviation from it, less that part of the deviation
/// which is linear over the aggregate.
pub(super) struct Regularisation<'a, const N: usize> {
    /// Regularisation r.
    pub(super) r: f64,
    /// Weights 1/d^2 of owned points, by index.
    pub(super) weights: &'a Multipliers<N>,
    pub(super) aggregates: &'a Aggregates<'a>,
}

impl<const N: usize> Regularisation<'_, N> {
    /// Linear parts of deviations (n_own) from a centre over the aggregates, reduced by the fraction that stays regularised.
    pub(super) fn deviations(&self, distance: impl Fn(usize) -> [f64; N] + Sync) -> Vec<f64> {
        let weighted = |index: usize| {
            let (distance, weight) = (distance(index), &self.weights[index]);
            std::array::from_fn(|k| weight[k] * distance[k])
        };
        let mut sums = self.aggregates.sums::<N>(weighted);
        sums.iter_mut().for_each(|sum| *sum *= 1.0 - SHARE);
        sums
    }

    /// Gradient of the regularisation at a point for its deviation from the centre.
    #[inline(always)]
    pub(super) fn force(&self, index: usize, distance: [f64; N], common: &[f64]) -> [f64; N] {
        let common: [f64; N] = self.aggregates.at(common, index);
        let weights = &self.weights[index];
        std::array::from_fn(|k| self.r * weights[k] * (distance[k] - common[k]))
    }
}

/// Hessian of the multipliers of forces that are linear over each aggregate.
pub(super) struct CoarseHessian {
    /// Cholesky factor; `None` if the matrix is not definite to rounding.
    factor: Option<Cholesky<f64, Dyn>>,
}

impl CoarseHessian {
    /// Assembles the matrix of the aggregates from the slopes of the pairs, with a regularisation r.
    pub(super) fn new<const N: usize, E: Equations<N>>(
        equations: &E,
        aggregates: &Aggregates<'_>,
        slopes: &[[f64; 2]],
        r: f64,
    ) -> Self {
        let n_numbers = aggregates.count * aggregates.n_functions * aggregates.width;
        let mut matrix = DMatrix::zeros(n_numbers, n_numbers);
        let mut terms = Vec::new();
        let pairs = equations.pairs();
        for index in 0..pairs.n_points() {
            for pair in pairs.inner(index).chain(pairs.outer(index)) {
                aggregates.terms(equations, index, pair, &mut terms);
                // A pair between two blocks stands in both.
                let share = if pairs.inner(index).contains(&pair) {
                    1.0
                } else {
                    0.5
                };
                let slopes = slopes[pair].map(|slope| share * slope);
                for &(column, one) in &terms {
                    let weighted = [slopes[0] * one[0], slopes[1] * one[1]];
                    for &(row, other) in &terms {
                        matrix[(row, column)] += weighted[0] * other[0] + weighted[1] * other[1];
                    }
                }
            }
        }
        pairs.order.subdomain.all_reduce_sum(matrix.as_mut_slice());
        for number in 0..n_numbers {
            matrix[(number, number)] += SHARE * r;
        }
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

impl Aggregates<'_> {
    /// Derivatives of both entries of G^T mu of a pair with respect to the numbers of the aggregates, with the index of each number.
    fn terms<const N: usize, E: Equations<N>>(
        &self,
        equations: &E,
        index: usize,
        pair: usize,
        terms: &mut Vec<(usize, [f64; 2])>,
    ) {
        terms.clear();
        let other = equations.pairs().other[pair] as usize;
        let [axial, shear] = [[1.0, 0.0], [0.0, 1.0]].map(|it| equations.forces(pair, it));
        let mut push = |first: usize, size: f64| {
            let rows = (0..self.width).map(|k| (first + k, [size * axial[k], size * shear[k]]));
            terms.extend(rows);
        };
        let firsts = [self.first(index), self.first(other)];
        let functions = self.functions(index).iter().zip(self.functions(other));
        for (number, (own, other)) in functions.enumerate() {
            let [own_first, other_first] = firsts.map(|first| first + number * self.width);
            if own_first != other_first {
                push(own_first, -own);
                push(other_first, *other);
            } else if number > 0 {
                push(own_first, other - own);
            }
        }
    }
}
