//! Conjugate gradients with two levels: A-DEF2 (Tang 2009).
//!
//! With block Jacobi M^-1 and the coarse correction Q = Z E^-1 Z^T the preconditioner takes a force r to M^-1 r + Q (r - K M^-1 r). The
//! iteration begins at Q f: from elsewhere it stalls. The coefficient of the search is that of Polak and Ribiere, which holds
//! where bonds broke since the coarse stiffness was made.

use rayon::prelude::*;

use super::coarse::Coarse;
use super::operator::Operator;
use super::point_blocks::PointBlocks;
use crate::tangent::UNRESISTED;
use crate::vectors::{CHUNK, dot_of_chunks, weighted_square};

/// Iterations after which what there is has to do; those who asked find out by the residual.
pub(super) const ITERATION_LIMIT: usize = 2000;

/// Share of the norm of the force at which nothing but rounding is left.
const ROUNDING: f64 = 1e-14;

/// A preconditioner of two levels.
pub(super) struct TwoLevels {
    pub(super) blocks: PointBlocks,
    pub(super) coarse: Coarse,
}

/// The force that may be left at each degree of freedom.
pub(super) enum Limit {
    /// Norm of all.
    Norm(f64),
    /// Sizes, shape (n_degrees_of_freedom).
    Sizes(Vec<f64>),
}

/// What conjugate gradients found.
pub(super) struct Found {
    /// The solution, or the way that the stiffness does not resist, shape (n_degrees_of_freedom).
    pub(super) motions: Vec<f64>,
    pub(super) iterations: usize,
    /// Decades by which the norm of the force out of balance fell.
    pub(super) decades: f64,
    /// Whether the stiffness resisted every way: by more than the rounding of the stiffnesses of the points.
    pub(super) is_definite: bool,
    /// Whether the iteration ended at its limit, with more force left than may be.
    pub(super) is_stalled: bool,
}

/// What is kept of the last step.
#[derive(Clone, Copy)]
struct Last {
    /// Size of the step along its way.
    step: f64,
    /// Work of the force before it on what the preconditioner made of that force.
    work: f64,
}

/// The iteration on its way.
struct Iteration<'a> {
    operator: &'a Operator<'a>,
    levels: &'a mut TwoLevels,
    /// Points of a chunk times components.
    chunk: usize,
    motions: Vec<f64>,
    /// Force out of balance.
    force: Vec<f64>,
}

/// Solves K u = f for forces f that are zero where nothing is free (n_degrees_of_freedom), until what is left is within a limit.
pub(super) fn solve(
    operator: &Operator<'_>,
    levels: &mut TwoLevels,
    force: Vec<f64>,
    limit: &Limit,
) -> Found {
    let mut iteration = Iteration::begun(operator, levels, force);
    let norm = dot_of_chunks(&iteration.force, &iteration.force);
    iteration.go_to_coarse_solution();
    let mut way = vec![0.0; iteration.force.len()];
    let mut pushed = vec![0.0; iteration.force.len()];
    let (mut iterations, mut is_definite) = (0, true);
    let mut last: Option<Last> = None;
    let rounding = Limit::Norm(ROUNDING * norm.sqrt());
    while iterations < ITERATION_LIMIT
        && !iteration.is_within(limit)
        && !iteration.is_within(&rounding)
    {
        let mut conditioned = iteration.conditioned();
        let mut work = dot_of_chunks(&conditioned, &iteration.force);
        // A coarse stiffness that is out of date need not be definite with what is left of the body.
        if work <= 0.0 {
            conditioned = iteration.levels.blocks.conditioned(&iteration.force);
            work = dot_of_chunks(&conditioned, &iteration.force);
            last = None;
        }
        let share = last.map_or(0.0, |last| {
            -last.step * dot_of_chunks(&conditioned, &pushed) / last.work
        });
        (way.par_chunks_mut(CHUNK))
            .zip(conditioned.par_chunks(CHUNK))
            .for_each(|(way, conditioned)| {
                for (way, value) in way.iter_mut().zip(conditioned) {
                    *way = value + share * *way;
                }
            });
        operator.multiply(&way, &mut pushed);
        let curvature = dot_of_chunks(&way, &pushed);
        let of_points = weighted_square(iteration.levels.blocks.diagonal(), &way);
        if curvature.is_nan() || curvature <= UNRESISTED * of_points {
            is_definite = false;
            iteration.motions = way;
            break;
        }
        let step = dot_of_chunks(&way, &iteration.force) / curvature;
        iteration.go(step, &way, &pushed);
        last = Some(Last { step, work });
        iterations += 1;
    }
    let left = dot_of_chunks(&iteration.force, &iteration.force);
    let is_stalled = iterations == ITERATION_LIMIT && !iteration.is_within(limit);
    Found {
        motions: iteration.motions,
        iterations,
        decades: 0.5 * (norm / left).log10(),
        is_definite,
        is_stalled,
    }
}

impl<'a> Iteration<'a> {
    fn begun(operator: &'a Operator<'a>, levels: &'a mut TwoLevels, force: Vec<f64>) -> Self {
        let n_components = operator.n_components();
        Self {
            chunk: CHUNK / n_components * n_components,
            motions: vec![0.0; force.len()],
            operator,
            levels,
            force,
        }
    }

    /// Goes to the start Q f.
    fn go_to_coarse_solution(&mut self) {
        let amounts = self.levels.coarse.amounts(&self.force);
        let mut motions = std::mem::take(&mut self.motions);
        self.add_coarse(&amounts, &mut motions);
        let mut product = vec![0.0; motions.len()];
        self.operator.multiply(&motions, &mut product);
        for (force, product) in self.force.iter_mut().zip(&product) {
            *force -= product;
        }
        self.motions = motions;
    }

    fn is_within(&self, limit: &Limit) -> bool {
        match limit {
            Limit::Norm(norm) => dot_of_chunks(&self.force, &self.force) <= norm * norm,
            Limit::Sizes(sizes) => {
                let chunks = self.force.par_chunks(CHUNK).zip(sizes.par_chunks(CHUNK));
                chunks.all(|(force, sizes)| {
                    let mut both = force.iter().zip(sizes);
                    both.all(|(force, size)| force.abs() <= *size)
                })
            }
        }
    }

    /// M^-1 r + Q (r - K M^-1 r).
    fn conditioned(&mut self) -> Vec<f64> {
        let mut motions = self.levels.blocks.conditioned(&self.force);
        let coarse = &mut self.levels.coarse;
        let amounts = coarse.amounts_after(self.operator, &self.force, &motions);
        self.add_coarse(&amounts, &mut motions);
        motions
    }

    /// Adds Z a to motions, where they are free.
    fn add_coarse(&self, amounts: &[f64], motions: &mut [f64]) {
        let n_components = self.operator.n_components();
        let (space, chunk) = (self.levels.coarse.space(), self.chunk);
        motions
            .par_chunks_mut(chunk)
            .zip(self.operator.free.par_chunks(chunk))
            .enumerate()
            .for_each(|(place, (motions, free))| {
                space.add_motions(place * chunk / n_components, n_components, amounts, motions);
                // What is held since the coarse space was made.
                for (motion, free) in motions.iter_mut().zip(free) {
                    if !free {
                        *motion = 0.0;
                    }
                }
            });
    }

    /// Goes a step along a way, which pushes back by some forces.
    fn go(&mut self, step: f64, way: &[f64], pushed: &[f64]) {
        (self.motions.par_chunks_mut(CHUNK))
            .zip(way.par_chunks(CHUNK))
            .zip(self.force.par_chunks_mut(CHUNK))
            .zip(pushed.par_chunks(CHUNK))
            .for_each(|(((motions, way), force), pushed)| {
                for (motion, value) in motions.iter_mut().zip(way) {
                    *motion += step * value;
                }
                for (force, value) in force.iter_mut().zip(pushed) {
                    *force -= step * value;
                }
            });
    }
}
