//! Conjugate gradients with a two-level preconditioner: A-DEF2 (Tang 2009).
//!
//! With block Jacobi M^-1 and the coarse correction Q = Z E^-1 Z^T, the preconditioner maps a force r to M^-1 r + Q (r - K M^-1 r).
//! The iteration must start at Q f, else it stalls. The coefficient of the search direction is the one of Polak and Ribiere, which
//! remains valid where bonds broke since the coarse stiffness was built.

use super::coarse::Coarse;
use super::operator::Operator;
use super::point_blocks::PointBlocks;
use crate::tangent::UNRESISTED;
use crate::vectors::{CHUNK, add, dot_of_chunks, turn, weighted_square};
use ligament_model::parallel;

/// Largest number of iterations; the caller judges the result by its residual.
pub(super) const ITERATION_LIMIT: usize = 2000;

/// Share of the norm of the force at which the residual is rounding.
const ROUNDING: f64 = 1e-14;

/// Two-level preconditioner.
pub(super) struct TwoLevels {
    pub(super) blocks: PointBlocks,
    pub(super) coarse: Coarse,
}

/// Residual force allowed at the degrees of freedom.
pub(super) enum Limit {
    /// Norm over all degrees of freedom.
    Norm(f64),
    /// Largest size at each degree of freedom, shape (n_degrees_of_freedom).
    Sizes(Vec<f64>),
}

/// Result of conjugate gradients.
pub(super) struct Found {
    /// Solution, or a direction without stiffness, shape (n_degrees_of_freedom).
    pub(super) motions: Vec<f64>,
    pub(super) iterations: usize,
    /// Decades by which the norm of the residual force fell.
    pub(super) decades: f64,
    /// Whether the stiffness of every search direction exceeded the rounding of the stiffnesses of the points.
    pub(super) is_definite: bool,
    /// Whether the iteration ended at its limit, with a residual above the allowed one.
    pub(super) is_stalled: bool,
}

/// Coefficients of the last step.
#[derive(Clone, Copy)]
struct Last {
    /// Length of the step along its search direction.
    step: f64,
    /// Work of the residual force before the step on the preconditioned force.
    work: f64,
}

/// State of the iteration.
struct Iteration<'a> {
    operator: &'a Operator<'a>,
    levels: &'a mut TwoLevels,
    /// Number of degrees of freedom of the points of a chunk.
    chunk: usize,
    motions: Vec<f64>,
    /// Residual force, shape (n_degrees_of_freedom).
    force: Vec<f64>,
}

/// Solves K u = f for forces f that are zero at degrees of freedom that are not free (n_degrees_of_freedom), to a residual within a
/// limit.
pub(super) fn solve(
    operator: &Operator<'_>,
    levels: &mut TwoLevels,
    force: Vec<f64>,
    limit: &Limit,
) -> Found {
    let mut iteration = Iteration::begun(operator, levels, force);
    let norm = dot_of_chunks(&iteration.force, &iteration.force);
    iteration.go_to_coarse_solution();
    // Long arrays are allocated once: the system clears the memory of new ones.
    let array = || vec![0.0; iteration.force.len()];
    let (mut conditioned, mut way, mut pushed) = (array(), array(), array());
    let (mut iterations, mut is_definite) = (0, true);
    let mut last: Option<Last> = None;
    let rounding = Limit::Norm(ROUNDING * norm.sqrt());
    while iterations < ITERATION_LIMIT
        && !iteration.is_within(limit)
        && !iteration.is_within(&rounding)
    {
        iteration.condition(&mut conditioned);
        let mut work = dot_of_chunks(&conditioned, &iteration.force);
        // An outdated coarse stiffness may be indefinite for the present bonds.
        if work <= 0.0 {
            (iteration.levels.blocks).condition(&iteration.force, &mut conditioned);
            work = dot_of_chunks(&conditioned, &iteration.force);
            last = None;
        }
        let share = last.map_or(0.0, |last| {
            -last.step * dot_of_chunks(&conditioned, &pushed) / last.work
        });
        turn(&mut way, share, &conditioned);
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

    /// Sets the motions to the start Q f.
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
                let mut both = self.force.iter().zip(sizes);
                both.all(|(force, size)| force.abs() <= *size)
            }
        }
    }

    /// Overwrites motions with the preconditioned force M^-1 r + Q (r - K M^-1 r).
    fn condition(&mut self, motions: &mut [f64]) {
        self.levels.blocks.condition(&self.force, motions);
        let coarse = &mut self.levels.coarse;
        let amounts = coarse.amounts_after(self.operator, &self.force, motions);
        self.add_coarse(&amounts, motions);
    }

    /// Adds Z a to the motions of free degrees of freedom.
    fn add_coarse(&self, amounts: &[f64], motions: &mut [f64]) {
        let n_components = self.operator.n_components();
        let (space, chunk) = (self.levels.coarse.space(), self.chunk);
        let chunks = motions.chunks_mut(chunk);
        let chunks = chunks.zip(self.operator.free.chunks(chunk)).enumerate();
        parallel::for_each(chunks, |(place, (motions, free))| {
            space.add_motions(place * chunk / n_components, n_components, amounts, motions);
            // Degrees of freedom fixed since the coarse space was built.
            for (motion, free) in motions.iter_mut().zip(free) {
                if !free {
                    *motion = 0.0;
                }
            }
        });
    }

    /// Takes a step along a direction `way`, on which the stiffness exerts the forces `pushed`.
    fn go(&mut self, step: f64, way: &[f64], pushed: &[f64]) {
        add(step, way, &mut self.motions);
        add(-step, pushed, &mut self.force);
    }
}
