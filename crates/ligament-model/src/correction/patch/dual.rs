//! The factors nearest to given ones for which linear equations hold: Newton's method on the dual problem.
//!
//! minimise sum over the bonds of q_0 h(q/q_0) under G q = f, with h' = z - z_0 and
//!
//! q(z) = q_0 (lo + (hi - lo)/(1 + exp(-z))), q(z_0) = q_0,
//!
//! which keeps every factor between lo q_0 and hi q_0. It is convex. With one multiplier mu an equation z = z_0 + G^T mu, and its
//! dual is smooth:
//!
//! minimise sum of q_0 [lo z + (hi - lo) log(1 + e^z)] - f.mu + r/2 |(mu - mu_k)/d|^2
//!
//! with the scales d of the equations, the gradient G q - f + r (mu - mu_k)/d^2 and the Hessian G diag(dq/dz) G^T + r/d^2. Outer
//! steps k (of multipliers) take the bias of r away.

use nalgebra::{Cholesky, Const, SMatrix, SVector};
use rayon::prelude::*;

use super::settings::Settings;
use crate::correction::members::{BLOCK, Members};

/// Linear equations in two factors a bond, N a point. Points go by their ranks, bonds by the members of families.
pub(super) trait Equations<const N: usize>: Sync {
    /// The members of the families.
    fn members(&self) -> &Members<'_>;

    /// Uncorrected factors q_0 of the members.
    fn start(&self) -> &[f64];

    /// Right-hand sides f, shape (n_points, N).
    fn right(&self) -> &[[f64; N]];

    /// Scales d of the equations of a point.
    fn scale(&self, rank: usize) -> [f64; N];

    /// The entries of G^T mu of a member's bond, from the multipliers of its point and of the other end.
    fn exponents(&self, member: usize, own: &[f64; N], other: &[f64; N]) -> [f64; 2];

    /// Adds what a member with the given factors has in the equations of its point.
    fn add(&self, member: usize, factors: [f64; 2], sum: &mut [f64; N]);

    /// Coefficients of the two factors of a member in the equations of its point.
    fn rows(&self, member: usize) -> [[f64; N]; 2] {
        [[1.0, 0.0], [0.0, 1.0]].map(|factors| {
            let mut row = [0.0; N];
            self.add(member, factors, &mut row);
            row
        })
    }
}

/// Regularisation of the first outer step.
const FIRST_REGULARISATION: f64 = 1e-2;

/// Reduction of the gradient in an outer step.
const REDUCTION: f64 = 0.1;

/// Newton steps of an outer step at most.
const MOST_STEPS: usize = 60;

/// Share of a Newton step below which none is tried: the value is then as low as rounding lets it be.
const SHORTEST: f64 = 1e-6;

/// Share of the slope by which a Newton step must lower the value (Armijo's rule with its usual constant).
const SUFFICIENT: f64 = 1e-4;

/// Rounding of the value, a sum over all bonds: some hundred times the precision of a number.
const ROUNDING: f64 = 1e-13;

/// Products for the direction of a Newton step at most.
const MOST_PRODUCTS: usize = 400;

/// The iteration for the factors.
#[derive(Debug, Clone, PartialEq)]
pub struct Report {
    /// Newton steps.
    pub steps: usize,
    /// Products with the Hessian.
    pub products: usize,
    /// Root mean square over the points of what is left of their equations.
    pub left: f64,
    /// Largest force or moment that is left at each point under a uniform strain of size one, over the size of its terms, shape
    /// (n_points).
    pub residual: Vec<f64>,
}

/// Factors of the bonds, and what they leave of the equations.
pub(super) struct Factors {
    /// First and second factors, each of shape (n_bonds).
    pub(super) axial: Vec<f64>,
    pub(super) shear: Vec<f64>,
    pub(super) report: Report,
}

struct Dual<'a, E, const N: usize> {
    equations: &'a E,
    lowest: f64,
    span: f64,
    /// z_0.
    offset: f64,
    /// mu_k.
    centre: Multipliers<N>,
    /// r/d^2.
    regularisation: Multipliers<N>,
}

/// A number for each equation, by rank.
type Multipliers<const N: usize> = Vec<[f64; N]>;

/// A place on the way, around the centre of its outer step.
struct Place<const N: usize> {
    mu: Multipliers<N>,
    /// z of the members.
    z: Vec<[f64; 2]>,
    value: f64,
}

/// The factors that meet the equations as far as they can.
pub(super) fn minimise<const N: usize, E: Equations<N>>(
    equations: &E,
    settings: &Settings,
) -> Factors {
    let mut dual = Dual {
        equations,
        lowest: settings.lowest,
        span: settings.highest - settings.lowest,
        offset: ((1.0 - settings.lowest) / (settings.highest - 1.0)).ln(),
        centre: vec![[0.0; N]; equations.members().n_points()],
        regularisation: Vec::new(),
    };
    let (mut steps, mut products) = (0, 0);
    let mut r = FIRST_REGULARISATION.max(settings.regularisation);
    loop {
        dual.regularise(r);
        let mut place = dual.place(dual.centre.clone());
        let mut gradient = dual.gradient(&place);
        let first = dual.root_mean_square(&gradient);
        for _ in 0..MOST_STEPS {
            let size = dual.root_mean_square(&gradient);
            if size <= REDUCTION * first {
                break;
            }
            // The direction need be no better than what is still to be won.
            let accuracy = (size / first)
                .sqrt()
                .min(0.1)
                .max(0.5 * REDUCTION * first / size);
            let (direction, done) = dual.newton_direction(&place.z, &gradient, accuracy);
            (steps, products) = (steps + 1, products + done);
            place = dual.lower(place, &gradient, &direction);
            gradient = dual.gradient(&place);
        }
        dual.centre = place.mu;
        if r <= settings.regularisation {
            break;
        }
        r = (0.1 * r).max(settings.regularisation);
    }
    dual.factors(steps, products)
}

impl<const N: usize, E: Equations<N>> Dual<'_, E, N> {
    fn regularise(&mut self, r: f64) {
        let of_rank = |rank: usize| {
            self.equations.scale(rank).map(|scale| {
                if scale > 0.0 {
                    r / (scale * scale)
                } else {
                    // An equation without terms: any positive number keeps its multiplier at zero.
                    1.0
                }
            })
        };
        self.regularisation = (0..self.equations.members().n_points())
            .map(of_rank)
            .collect();
    }

    /// Root mean square of scaled numbers.
    fn root_mean_square(&self, values: &Multipliers<N>) -> f64 {
        let squares = (values.iter().enumerate()).map(|(rank, values)| {
            let scaled = values.iter().zip(self.equations.scale(rank));
            scaled
                .map(|(value, scale)| (value * scale).powi(2))
                .sum::<f64>()
        });
        (squares.sum::<f64>() / (values.len() * N) as f64).sqrt()
    }

    /// z of the two factors of every member.
    fn exponents(&self, mu: &Multipliers<N>) -> Vec<[f64; 2]> {
        let members = self.equations.members();
        let mut z = vec![[0.0; 2]; members.neighbour.len()];
        members.over_blocks(&mut z, |rank, z| {
            let own = &mu[rank];
            for (member, z) in members.family(rank).zip(z) {
                let other = &mu[members.neighbour[member] as usize];
                *z = self
                    .equations
                    .exponents(member, own, other)
                    .map(|it| it + self.offset);
            }
        });
        z
    }

    /// A sum over the family of each point.
    fn sums(&self, sum: impl Fn(usize) -> [f64; N] + Sync + Send) -> Multipliers<N> {
        let n = self.equations.members().n_points();
        (0..n).into_par_iter().with_min_len(64).map(sum).collect()
    }

    /// What is left of the equations, G q - f.
    fn left(&self, z: &[[f64; 2]]) -> Multipliers<N> {
        let (members, start) = (self.equations.members(), self.equations.start());
        self.sums(|rank| {
            let mut sum = self.equations.right()[rank].map(|right| -right);
            for member in members.family(rank) {
                let q = z[member].map(|z| start[member] * self.share(z));
                self.equations.add(member, q, &mut sum);
            }
            sum
        })
    }

    /// The place of multipliers, with the value of the dual there.
    fn place(&self, mu: Multipliers<N>) -> Place<N> {
        let z = self.exponents(&mu);
        let value = self.value(&z, &mu);
        Place { mu, z, value }
    }

    /// The first place in a direction, at a half of the length before each, where the value is low enough.
    fn lower(
        &self,
        from: Place<N>,
        gradient: &Multipliers<N>,
        direction: &Multipliers<N>,
    ) -> Place<N> {
        let slope = dot(gradient, direction);
        let mut length = 1.0;
        loop {
            let mut mu = from.mu.clone();
            add(&mut mu, direction, length);
            let place = self.place(mu);
            // Near the end values differ by their rounding only.
            let enough = SUFFICIENT * length * slope + ROUNDING * from.value.abs();
            if place.value <= from.value + enough || length < SHORTEST {
                return place;
            }
            length *= 0.5;
        }
    }

    fn gradient(&self, place: &Place<N>) -> Multipliers<N> {
        let mut gradient = self.left(&place.z);
        let mu = place
            .mu
            .as_flattened()
            .iter()
            .zip(self.centre.as_flattened());
        let mu = mu.zip(self.regularisation.as_flattened());
        for (gradient, ((mu, centre), r)) in gradient.as_flattened_mut().iter_mut().zip(mu) {
            *gradient += r * (mu - centre);
        }
        gradient
    }

    /// The value of the dual.
    fn value(&self, z: &[[f64; 2]], mu: &Multipliers<N>) -> f64 {
        let start = self.equations.start();
        let of_member = |(z, start): (&[f64; 2], &f64)| {
            start
                * z.iter()
                    .map(|&z| self.lowest * z + self.span * softplus(z))
                    .sum::<f64>()
        };
        let of_members: Vec<f64> = (z.par_chunks(BLOCK).zip(start.par_chunks(BLOCK)))
            .map(|(z, start)| z.iter().zip(start).map(of_member).sum())
            .collect();
        let right = self.equations.right().as_flattened();
        let mu = mu.as_flattened().iter().zip(self.centre.as_flattened());
        let of_equations = mu.zip(self.regularisation.as_flattened()).zip(right);
        let of_equations: f64 = of_equations
            .map(|(((mu, centre), r), right)| 0.5 * r * (mu - centre).powi(2) - right * mu)
            .sum();
        // Every bond stands in two families.
        0.5 * of_members.iter().sum::<f64>() + of_equations
    }

    /// The factors at the centre, and what they leave.
    fn factors(&self, steps: usize, products: usize) -> Factors {
        let (members, start) = (self.equations.members(), self.equations.start());
        let z = self.exponents(&self.centre);
        let left = self.left(&z);
        let residual: Vec<f64> = (left.iter().enumerate())
            .map(|(rank, left)| {
                let scaled = left.iter().zip(self.equations.scale(rank));
                scaled.fold(0.0, |most: f64, (left, scale)| {
                    most.max((left * scale).abs())
                })
            })
            .collect();
        let of_bonds = |k: usize| {
            let factors: Vec<f64> = z
                .iter()
                .zip(start)
                .map(|(z, start)| start * self.share(z[k]))
                .collect();
            members.of_bonds(&factors)
        };
        Factors {
            axial: of_bonds(0),
            shear: of_bonds(1),
            report: Report {
                steps,
                products,
                left: self.root_mean_square(&left),
                residual: members.of_points(&residual),
            },
        }
    }

    /// q/q_0.
    fn share(&self, z: f64) -> f64 {
        self.lowest + self.span * logistic(z)
    }

    /// Conjugate gradients for the Newton step, with the blocks of the points as preconditioner.
    fn newton_direction(
        &self,
        z: &[[f64; 2]],
        gradient: &Multipliers<N>,
        accuracy: f64,
    ) -> (Multipliers<N>, usize) {
        let members = self.equations.members();
        let slopes: Vec<[f64; 2]> = (z.par_iter().zip(self.equations.start()))
            .map(|(z, start)| z.map(|z| start * self.span * logistic(z) * logistic(-z)))
            .collect();
        let blocks = self.blocks(&slopes);
        let n = gradient.len();
        let mut step = vec![[0.0; N]; n];
        let mut left: Multipliers<N> = gradient.iter().map(|it| it.map(|it| -it)).collect();
        let mut solved = precondition(&blocks, &left);
        let mut direction = solved.clone();
        let mut size = dot(&left, &solved);
        let target = accuracy * accuracy * size;
        let mut products = 0;
        while products < MOST_PRODUCTS {
            let product = self.sums(|rank| {
                let own = &direction[rank];
                let regularisation = &self.regularisation[rank];
                let mut sum = std::array::from_fn(|k| regularisation[k] * own[k]);
                for member in members.family(rank) {
                    let other = &direction[members.neighbour[member] as usize];
                    let z = self.equations.exponents(member, own, other);
                    let slope = slopes[member];
                    self.equations
                        .add(member, [z[0] * slope[0], z[1] * slope[1]], &mut sum);
                }
                sum
            });
            products += 1;
            let length = size / dot(&direction, &product);
            add(&mut step, &direction, length);
            add(&mut left, &product, -length);
            solved = precondition(&blocks, &left);
            let next = dot(&left, &solved);
            if next <= target {
                break;
            }
            let share = next / size;
            size = next;
            direction
                .par_iter_mut()
                .zip(&solved)
                .with_min_len(BLOCK)
                .for_each(|(direction, solved)| {
                    for k in 0..N {
                        direction[k] = solved[k] + share * direction[k];
                    }
                });
        }
        (step, products)
    }

    fn blocks(&self, slopes: &[[f64; 2]]) -> Vec<SMatrix<f64, N, N>> {
        let members = self.equations.members();
        (0..members.n_points())
            .into_par_iter()
            .map(|rank| {
                let diagonal = SVector::<f64, N>::from(self.regularisation[rank]);
                let mut block = SMatrix::<f64, N, N>::from_diagonal(&diagonal);
                for member in members.family(rank) {
                    let rows = self.equations.rows(member);
                    for (row, slope) in rows.iter().zip(slopes[member]) {
                        let row = SVector::<f64, N>::from(*row);
                        block.ger(slope, &row, &row, 1.0);
                    }
                }
                Cholesky::<f64, Const<N>>::new(block)
                    .map_or_else(SMatrix::identity, |it| it.inverse())
            })
            .collect()
    }
}

fn precondition<const N: usize>(
    blocks: &[SMatrix<f64, N, N>],
    values: &Multipliers<N>,
) -> Multipliers<N> {
    (blocks.par_iter().zip(values))
        .with_min_len(BLOCK)
        .map(|(block, value)| <[f64; N]>::from(block * SVector::<f64, N>::from(*value)))
        .collect()
}

fn logistic(z: f64) -> f64 {
    1.0 / (1.0 + (-z).exp())
}

/// log(1 + e^z).
fn softplus(z: f64) -> f64 {
    z.max(0.0) + (-z.abs()).exp().ln_1p()
}

fn dot<const N: usize>(one: &Multipliers<N>, other: &Multipliers<N>) -> f64 {
    let parts: Vec<f64> = (one.par_chunks(BLOCK).zip(other.par_chunks(BLOCK)))
        .map(|(one, other)| {
            (one.as_flattened().iter().zip(other.as_flattened()))
                .map(|(one, other)| one * other)
                .sum()
        })
        .collect();
    parts.iter().sum()
}

fn add<const N: usize>(values: &mut Multipliers<N>, other: &Multipliers<N>, factor: f64) {
    values
        .par_iter_mut()
        .zip(other)
        .with_min_len(BLOCK)
        .for_each(|(value, other)| {
            for k in 0..N {
                value[k] += factor * other[k];
            }
        });
}
