//! Factors nearest to given ones that satisfy linear equations, by Newton's method on the dual problem.
//!
//! minimise sum over the bonds of q_0 h(q/q_0) under G q = f, with h' = z - z_0 and
//!
//! q(z) = q_0 (lo + (hi - lo)/(1 + exp(-z))), q(z_0) = q_0,
//!
//! This keeps every factor between lo q_0 and hi q_0. The problem is convex, and with one multiplier mu an equation its solution satisfies
//!
//! z = z_0 + G^T mu, G q(z) - f + r (mu - mu_k)/d^2 = 0,
//!
//! with the scales d of the equations; r relaxes equations that cannot be satisfied, and outer steps k, each from the multipliers mu_k of
//! the one before, remove its bias. Long waves of mu are left out of that term ([`Regularisation`]). A Newton step solves, with D = dq/dz
//! and the residual of the first condition, rho = z_0 + G^T mu - z,
//!
//! (G D G^T + r/d^2) delta mu = -(G (q + D rho) - f + r (mu - mu_k)/d^2).
//!
//! Then either z or q of a bond follows the tangent, whichever changes the bond less. With z alone, factors that have to grow several times,
//! at corners, would grow exponentially; with this choice no step needs to be shortened.

use super::aggregates::{Aggregates, CoarseHessian, Regularisation};
use super::equations::{Equations, Multipliers};
use super::newton::Hessian;
use super::pairs::{BLOCK, Pairs};
use super::settings::Settings;
use crate::cloud::PointCloud;
use crate::parallel;

/// Regularisation of the first outer step.
const FIRST_REGULARISATION: f64 = 1e-2;

/// Smallest and largest ratio of the regularisations of successive outer steps. Where the first step leaves little, two more reach the
/// regularisation of the default settings; where it leaves much, factors would run to their limits, from which they hardly return.
const RATIOS: [f64; 2] = [0.0025, 0.03];

/// Ratio of the regularisations of successive outer steps over the scaled residual after the first step, between the limits.
const RATIO_OF_RESIDUAL: f64 = 0.1;

/// Regularisation at which the iteration ends over the square of the scaled residual, and its largest ratio to that of the settings. Where
/// many equations cannot be satisfied, a smaller one scatters the factors, and takes several times the products for the same residual.
const OF_SQUARED_RESIDUAL: f64 = 0.05;
const LARGEST_RATIO_OF_UNSATISFIABLE: f64 = 10.0;

/// Reduction of the gradient in an outer step: half of it takes two to three times the products, for changes of a stiffness of 0.1 %.
const REDUCTION: f64 = 0.2;

/// Largest number of Newton steps of an outer step: two to four suffice, about ten where the equations cannot be satisfied. More show that
/// the change of the regularisation was too large.
const MOST_STEPS: usize = 20;

/// Largest number of products for the direction of a Newton step, at first and from the first outer step that failed on: on meshes that are graded
/// strongly directions take some 2,000, and with inaccurate ones Newton's method hardly converges.
const MOST_PRODUCTS: [usize; 2] = [400, 4000];

/// Growth of the gradient in an outer step that shows that the change of the regularisation was too large.
const GROWTH: f64 = 1e3;

/// Ratio of regularisations above which the change is not divided any further.
const SMALLEST_CHANGE: f64 = 0.7;

/// Smallest and largest relative accuracy of the direction of a Newton step: early steps are solved more accurately than the last ones.
const ACCURACIES: [f64; 2] = [0.1, 0.2];

/// Report of the iteration for the factors.
#[derive(Debug, Clone, PartialEq)]
pub struct Report {
    /// Number of Newton steps.
    pub steps: usize,
    /// Number of products with the Hessian.
    pub products: usize,
    /// Root mean square over the points of the scaled residual of their equations.
    pub left: f64,
    /// Largest residual force or moment at each point under a uniform strain of size one, over the size of its terms, shape (n_points).
    pub residual: Vec<f64>,
}

/// Factors of the bonds, with the residual of the equations.
pub(crate) struct Factors {
    /// First factors, of the axial stiffness, shape (n_bonds); `shear` alike.
    pub(crate) axial: Vec<f64>,
    pub(crate) shear: Vec<f64>,
    pub(crate) report: Report,
}

struct Dual<'a, E, const N: usize> {
    equations: &'a E,
    /// Weights 1/d^2 of the equations of owned points in the regularisation, by index.
    weights: Multipliers<N>,
    lowest: f64,
    span: f64,
    /// Argument z_0 of the uncorrected factors.
    offset: f64,
    aggregates: Aggregates<'a>,
}

/// An iterate of Newton's method.
struct Place<const N: usize> {
    /// Multipliers mu of the points, by index; arrays without bonds are over owned points only.
    mu: Multipliers<N>,
    /// Arguments z of the pairs.
    z: Vec<[f64; 2]>,
    /// Derivatives D of the pairs, times the squares of their stiffness.
    slopes: Vec<[f64; 2]>,
    /// Linearised residual G (q + D rho) - f.
    unbalanced: Multipliers<N>,
}

/// Factors of the bonds of a cloud that satisfy the equations as far as possible.
pub(crate) fn minimise<const D: usize, const N: usize, E: Equations<N>>(
    equations: &E,
    cloud: &PointCloud<D>,
    settings: &Settings,
) -> Factors {
    let order = &equations.pairs().order;
    let weights = weights(equations);
    let of_forces: Vec<f64> = weights.iter().map(|weights| weights[0]).collect();
    let aggregates = Aggregates::new(cloud, order, E::FORCES, &of_forces);
    let dual = Dual {
        equations,
        weights,
        lowest: settings.lowest,
        span: settings.highest - settings.lowest,
        offset: ((1.0 - settings.lowest) / (settings.highest - 1.0)).ln(),
        aggregates,
    };
    let mut place = dual.start();
    // The matrix of the first iterate serves for all: the slopes change little, and the largest part of the products is that of the last step.
    let coarse = CoarseHessian::new(
        equations,
        &dual.aggregates,
        &place.slopes,
        settings.regularisation,
    );
    let (mut steps, mut products) = (0, 0);
    let mut last = settings.regularisation;
    let mut r = FIRST_REGULARISATION.max(last);
    let mut reached = 1.0;
    let [mut most_products, more_products] = MOST_PRODUCTS;
    loop {
        let (centre, z) = (place.mu.clone(), place.z.clone());
        let outer = dual.outer_step(&mut place, (r, &centre), &coarse, most_products);
        (steps, products) = (steps + outer.steps, products + outer.products);
        if outer.has_converged {
            reached = r;
            if r <= last {
                return dual.factors(place, steps, products);
            }
            let left = dual.root_mean_square(&place.unbalanced);
            let largest_last = LARGEST_RATIO_OF_UNSATISFIABLE * settings.regularisation;
            last = (OF_SQUARED_RESIDUAL * left * left).clamp(settings.regularisation, largest_last);
            let [smallest, largest] = RATIOS;
            r = last.max((RATIO_OF_RESIDUAL * left).clamp(smallest, largest) * r);
        } else {
            // Restarts before the failed outer step, first with more accurate directions, then with a smaller change of the regularisation.
            let nowhere = vec![[0.0; N]; centre.len()];
            (place.mu, place.z) = (centre, z);
            dual.advance(&mut place, &nowhere);
            if most_products < more_products {
                most_products = more_products;
                continue;
            }
            if r > SMALLEST_CHANGE * reached {
                return dual.factors(place, steps, products);
            }
            r = (r * reached).sqrt();
        }
    }
}

/// Weights 1/d^2 of the equations of owned points, by index, from their scales d. In an equation without terms any positive weight keeps its
/// multiplier at zero.
fn weights<const N: usize, E: Equations<N>>(equations: &E) -> Multipliers<N> {
    let weight = |scale: f64| match scale > 0.0 {
        true => 1.0 / (scale * scale),
        false => 1.0,
    };
    let indices = 0..equations.pairs().n_points();
    indices
        .map(|index| equations.scale(index).map(weight))
        .collect()
}

/// Cost and outcome of an outer step.
struct OuterStep {
    steps: usize,
    products: usize,
    has_converged: bool,
}

impl<const N: usize> Place<N> {
    /// Right-hand side of a Newton step, with the opposite sign.
    fn gradient(
        &self,
        regularisation: &Regularisation<'_, N>,
        centre: &Multipliers<N>,
    ) -> Multipliers<N> {
        let away = |index: usize| {
            let (mu, centre) = (&self.mu[index], &centre[index]);
            std::array::from_fn(|k| mu[k] - centre[k])
        };
        let common = regularisation.deviations(away);
        let mut gradient = self.unbalanced.clone();
        for (index, gradient) in gradient.iter_mut().enumerate() {
            let force = regularisation.force(index, away(index), &common);
            (0..N).for_each(|k| gradient[k] += force[k]);
        }
        gradient
    }
}

impl<E: Equations<N>, const N: usize> Dual<'_, E, N> {
    /// Solves the equations with a regularisation r about a centre, from the current iterate, with a largest number of products for a direction.
    fn outer_step(
        &self,
        place: &mut Place<N>,
        (r, centre): (f64, &Multipliers<N>),
        coarse: &CoarseHessian,
        most_products: usize,
    ) -> OuterStep {
        let regularisation = Regularisation {
            r,
            weights: &self.weights,
            aggregates: &self.aggregates,
        };
        let first = self.root_mean_square(&place.unbalanced);
        let mut products = 0;
        for steps in 0..MOST_STEPS {
            let gradient = place.gradient(&regularisation, centre);
            let size = self.root_mean_square(&gradient);
            let has_converged = size <= REDUCTION * first;
            if has_converged || size.is_nan() || size > GROWTH * first {
                return OuterStep {
                    steps,
                    products,
                    has_converged,
                };
            }
            // The direction need not be more accurate than the reduction that remains.
            let [finest, coarsest] = ACCURACIES;
            let accuracy = (0.5 * REDUCTION * first / size).clamp(finest, coarsest);
            let hessian = Hessian::new(self.equations, &regularisation, &place.slopes, coarse);
            let (direction, done) = hessian.solve(gradient, accuracy, most_products);
            products += done;
            self.advance(place, &direction);
        }
        OuterStep {
            steps: MOST_STEPS,
            products,
            has_converged: false,
        }
    }

    /// Root mean square of values times their scales.
    fn root_mean_square(&self, values: &Multipliers<N>) -> f64 {
        let squares = (values.iter().enumerate()).map(|(index, values)| {
            let scaled = values.iter().zip(self.equations.scale(index));
            scaled
                .map(|(value, scale)| (value * scale).powi(2))
                .sum::<f64>()
        });
        let Pairs { order, n_all, .. } = self.equations.pairs();
        (order.subdomain.sum(squares.sum::<f64>()) / (n_all * N) as f64).sqrt()
    }

    /// The iterate of the uncorrected factors.
    fn start(&self) -> Place<N> {
        let pairs = self.equations.pairs();
        let zeros = vec![[0.0; N]; pairs.order.all().len()];
        let mut place = Place {
            mu: zeros.clone(),
            z: vec![[self.offset; 2]; pairs.len()],
            slopes: vec![[0.0; 2]; pairs.len()],
            unbalanced: Vec::new(),
        };
        self.advance(&mut place, &zeros);
        place
    }

    /// Advances the iterate along the direction of a Newton step.
    fn advance(&self, place: &mut Place<N>, direction: &Multipliers<N>) {
        let directions = direction.as_flattened().iter();
        for (mu, direction) in place.mu.as_flattened_mut().iter_mut().zip(directions) {
            *mu += direction;
        }
        let pairs = self.equations.pairs();
        pairs.order.update_ghosts(&mut place.mu);
        let mu = &place.mu;
        let (start, stiffness) = (self.equations.start(), self.equations.stiffness());
        let mut sums = self.minus_right();
        let of_pairs = pairs.blocks(&mut place.z).into_iter();
        let of_pairs = of_pairs.zip(pairs.blocks(&mut place.slopes));
        let blocks = sums.chunks_mut(BLOCK).zip(of_pairs).enumerate();
        parallel::for_each(blocks, |(block, (sums, (z, slopes)))| {
            let first = pairs.first(block);
            (self.equations).add(block, mu, sums, |pair, strains| {
                let (z, slopes) = (&mut z[pair - first], &mut slopes[pair - first]);
                let (start, stiffness) = (start[pair], stiffness[pair]);
                std::array::from_fn(|k| {
                    let target = self.offset + stiffness[k] * strains[k];
                    z[k] = after_tangent_step(z[k], target);
                    let share = logistic(z[k]);
                    let slope = start * self.span * share * (1.0 - share);
                    slopes[k] = stiffness[k] * stiffness[k] * slope;
                    let factor = start * (self.lowest + self.span * share);
                    stiffness[k] * (factor + slope * (target - z[k]))
                })
            });
        });
        place.unbalanced = sums;
    }

    fn minus_right(&self) -> Multipliers<N> {
        let right = self.equations.right_hand_sides().iter();
        right.map(|right| right.map(|it| -it)).collect()
    }

    /// Factors of an iterate, with the residual G q - f of the equations.
    fn factors(&self, place: Place<N>, steps: usize, products: usize) -> Factors {
        let (pairs, stiffness) = (self.equations.pairs(), self.equations.stiffness());
        let start = self.equations.start();
        let factors = parallel::values(start.len(), [0.0; 2], |pair| {
            place.z[pair].map(|z| start[pair] * (self.lowest + self.span * logistic(z)))
        });
        let mut left = self.minus_right();
        parallel::for_each(left.chunks_mut(BLOCK).enumerate(), |(block, left)| {
            (self.equations).add(block, &place.mu, left, |pair, _| {
                std::array::from_fn(|k| stiffness[pair][k] * factors[pair][k])
            });
        });
        let residual: Vec<f64> = (left.iter().enumerate())
            .map(|(index, left)| {
                let scaled = left.iter().zip(self.equations.scale(index));
                scaled.fold(0.0, |most: f64, (left, scale)| {
                    most.max((left * scale).abs())
                })
            })
            .collect();
        Factors {
            axial: pairs.bond_values(factors.iter().map(|&[axial, _]| axial)),
            shear: pairs.bond_values(factors.iter().map(|&[_, shear]| shear)),
            report: Report {
                steps,
                products,
                left: self.root_mean_square(&left),
                residual: pairs.order.of_points(&residual),
            },
        }
    }
}

/// New z for a tangent value `target` of z: the target itself, or the z whose q follows the tangent of q, if that is nearer.
///
/// The second, with s = 1/(1 + e^-z) and the change c of z, is z + log((1 + (1 - s) c)/(1 - s c)). It can be nearer only towards the middle
/// of the curve at z = 0, and does not exist where the tangent leaves the limits of the factors.
#[inline(always)]
fn after_tangent_step(z: f64, target: f64) -> f64 {
    let change = target - z;
    if change * z >= 0.0 {
        return target;
    }
    let share = logistic(z);
    let (upper, lower) = (1.0 + (1.0 - share) * change, 1.0 - share * change);
    let along_tangent = (upper / lower).ln();
    if upper > 0.0 && lower > 0.0 && along_tangent.abs() < change.abs() {
        z + along_tangent
    } else {
        target
    }
}

fn logistic(z: f64) -> f64 {
    1.0 / (1.0 + (-z).exp())
}
