//! Direction of a Newton step, by conjugate gradients preconditioned with the blocks of the points and the matrix of the aggregates.

use super::aggregates::{CoarseHessian, Regularisation};
use super::equations::{Equations, Multipliers};
use super::pairs::BLOCK;
use crate::parallel;

/// Hessian G D G^T with the regularisation.
pub(super) struct Hessian<'a, E, const N: usize> {
    equations: &'a E,
    regularisation: &'a Regularisation<'a, N>,
    /// Derivatives D of the pairs, times the squares of their stiffness.
    slopes: &'a [[f64; 2]],
    /// Inverses of the blocks of owned points, by index; single precision would round them along the axes, and factors of a turned body
    /// would differ.
    inverses: Vec<[[f64; N]; N]>,
    coarse: &'a CoarseHessian,
}

/// The preconditioner applied to a residual.
struct Solved<const N: usize> {
    /// Solution of the blocks of the points.
    points: Multipliers<N>,
    /// Solution of the aggregates, `width` numbers for each.
    aggregates: Vec<f64>,
}

impl<'a, E: Equations<N>, const N: usize> Hessian<'a, E, N> {
    /// The Hessian with the inverses of its blocks.
    pub(super) fn new(
        equations: &'a E,
        regularisation: &'a Regularisation<'a, N>,
        slopes: &'a [[f64; 2]],
        coarse: &'a CoarseHessian,
    ) -> Self {
        let mut hessian = Self {
            equations,
            regularisation,
            slopes,
            inverses: Vec::new(),
            coarse,
        };
        let mut inverses = vec![[[0.0; N]; N]; regularisation.weights.len()];
        let blocks = inverses.chunks_mut(BLOCK).enumerate();
        parallel::for_each(blocks, |(block, inverses)| {
            hessian.add_blocks(block, inverses);
            inverses.iter_mut().for_each(invert);
        });
        hessian.inverses = inverses;
        hessian
    }

    /// Adds the diagonal blocks of the points in a block of points.
    fn add_blocks(&self, block: usize, sums: &mut [[[f64; N]; N]]) {
        let pairs = self.equations.pairs();
        let indices = pairs.indices(block);
        let first = indices.start;
        for index in indices {
            let own = &mut sums[index - first];
            for (k, weight) in self.regularisation.weights[index].iter().enumerate() {
                own[k][k] += self.regularisation.r * weight;
            }
            for pair in pairs.inner(index).chain(pairs.outer(index)) {
                let rows = [[1.0, 0.0], [0.0, 1.0]].map(|it| self.equations.forces(pair, it));
                add_squares(
                    &mut sums[index - first],
                    rows.map(E::at_own),
                    self.slopes[pair],
                );
                if pairs.inner(index).contains(&pair) {
                    let other = pairs.other[pair] as usize;
                    add_squares(&mut sums[other - first], rows, self.slopes[pair]);
                }
            }
        }
    }

    /// Solution for the negative gradient on the right, to an accuracy in the norm of the preconditioner or by the largest number of products, and
    /// the number of products needed.
    pub(super) fn solve(
        &self,
        gradient: Multipliers<N>,
        accuracy: f64,
        most_products: usize,
    ) -> (Multipliers<N>, usize) {
        let zeros = vec![[0.0; N]; gradient.len()];
        let mut left = gradient;
        left.as_flattened_mut().iter_mut().for_each(|it| *it = -*it);
        let mut solved = Solved {
            points: zeros.clone(),
            aggregates: Vec::new(),
        };
        let n_points = self.equations.pairs().order.all().len();
        let mut direction = vec![[0.0; N]; n_points];
        let (mut step, mut product) = (zeros.clone(), zeros);
        let way = SearchDirection {
            direction: &direction,
            product: &product,
        };
        let mut size = self.step_along(0.0, way, &mut step, &mut left, &mut solved);
        let target = accuracy * accuracy * size;
        let mut share = 0.0;
        for done in 1..=most_products {
            self.update_direction(&mut direction, share, &solved);
            let length = size / self.multiply(&direction, &mut product);
            let way = SearchDirection {
                direction: &direction,
                product: &product,
            };
            let next = self.step_along(length, way, &mut step, &mut left, &mut solved);
            if next <= target {
                return (step, done);
            }
            share = next / size;
            size = next;
        }
        (step, most_products)
    }

    /// Next direction: the preconditioned residual plus `share` times the last direction.
    fn update_direction(&self, direction: &mut Multipliers<N>, share: f64, solved: &Solved<N>) {
        let blocks = direction.chunks_mut(BLOCK).zip(solved.points.chunks(BLOCK));
        parallel::for_each(blocks.enumerate(), |(block, (directions, of_points))| {
            let points = directions.iter_mut().zip(of_points);
            for (index, (direction, solved_here)) in (block * BLOCK..).zip(points) {
                let aggregates = self.regularisation.aggregates;
                let common: [f64; N] = aggregates.at(&solved.aggregates, index);
                for k in 0..N {
                    direction[k] = solved_here[k] + share * direction[k] + common[k];
                }
            }
        });
        self.equations.pairs().order.update_ghosts(direction);
    }

    /// Computes the product of the Hessian with values by index, and returns the inner product of both.
    fn multiply(&self, values: &Multipliers<N>, product: &mut Multipliers<N>) -> f64 {
        let common = self.regularisation.deviations(|index| values[index]);
        let of_block = |(block, product): (usize, &mut [[f64; N]])| {
            let indices = self.equations.pairs().indices(block);
            for (index, product) in indices.clone().zip(product.iter_mut()) {
                *product = self.regularisation.force(index, values[index], &common);
            }
            (self.equations).add(block, values, product, |pair, [axial, shear]| {
                let slopes = self.slopes[pair];
                [slopes[0] * axial, slopes[1] * shear]
            });
            dot(values[indices].as_flattened(), product.as_flattened())
        };
        let of_blocks = parallel::map(product.chunks_mut(BLOCK).enumerate(), of_block);
        self.equations
            .pairs()
            .order
            .subdomain
            .sum(of_blocks.iter().sum())
    }

    /// Takes a step of a given length along a direction with a known product: updates the solution and the residual, applies the
    /// preconditioner, and returns the inner product of the residual and the preconditioned residual.
    fn step_along(
        &self,
        length: f64,
        way: SearchDirection<'_, N>,
        step: &mut Multipliers<N>,
        left: &mut Multipliers<N>,
        solved: &mut Solved<N>,
    ) -> f64 {
        let SearchDirection { direction, product } = way;
        let of_point = |index: usize, step: &mut [f64; N], left: &mut [f64; N]| {
            let mut solved = [0.0; N];
            for k in 0..N {
                step[k] += length * direction[index][k];
                left[k] -= length * product[index][k];
                for (solved, entry) in solved.iter_mut().zip(self.inverses[index][k]) {
                    *solved += entry * left[k];
                }
            }
            solved
        };
        let blocks = (step.chunks_mut(BLOCK).zip(left.chunks_mut(BLOCK)))
            .zip(solved.points.chunks_mut(BLOCK));
        let sums = parallel::map(blocks.enumerate(), |(block, ((step, left), solved))| {
            for (k, index) in self.equations.pairs().indices(block).enumerate() {
                solved[k] = of_point(index, &mut step[k], &mut left[k]);
            }
            dot(left.as_flattened(), solved.as_flattened())
        });
        let of_points: f64 = sums.iter().sum();
        let of_points = self.equations.pairs().order.subdomain.sum(of_points);
        let of_aggregates = self.regularisation.aggregates.sums(|index| left[index]);
        solved.aggregates = self.coarse.solve(&of_aggregates);
        of_points + dot(&of_aggregates, &solved.aggregates)
    }
}

/// A search direction with its product with the matrix.
#[derive(Clone, Copy)]
struct SearchDirection<'a, const N: usize> {
    direction: &'a Multipliers<N>,
    product: &'a Multipliers<N>,
}

/// Adds the outer squares of two rows, with weights.
#[inline(always)]
fn add_squares<const N: usize>(
    sums: &mut [[f64; N]; N],
    [one, other]: [[f64; N]; 2],
    weights: [f64; 2],
) {
    for (row, sums) in sums.iter_mut().enumerate() {
        let (of_one, of_other) = (weights[0] * one[row], weights[1] * other[row]);
        for k in 0..N {
            sums[k] += of_one * one[k] + of_other * other[k];
        }
    }
}

/// Inverts a positive definite matrix in place, by Gauss-Jordan elimination without pivoting.
fn invert<const N: usize>(matrix: &mut [[f64; N]; N]) {
    for k in 0..N {
        let inverse = 1.0 / matrix[k][k];
        matrix[k][k] = 1.0;
        let pivots = matrix[k].map(|entry| inverse * entry);
        matrix[k] = pivots;
        for (i, row) in matrix.iter_mut().enumerate() {
            if i != k {
                let factor = std::mem::replace(&mut row[k], 0.0);
                for (entry, pivot) in row.iter_mut().zip(pivots) {
                    *entry -= factor * pivot;
                }
            }
        }
    }
}

fn dot(one: &[f64], other: &[f64]) -> f64 {
    one.iter().zip(other).map(|(one, other)| one * other).sum()
}
