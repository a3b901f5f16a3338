//! Equilibrium at a given value of a motion, with the load factor as an unknown: what a test does that is controlled by the opening of
//! a crack.
//!
//! With the forces r that are not in balance, the growth u_B of the displacements with the load factor and the motion c . u that is to be
//! c*, an iterate (u, lambda) is corrected by du = K^-1 r + d_lambda u_B with
//!
//! d_lambda = (c* - c . u - c . K^-1 r)/(c . u_B),
//!
//! so that the motion is c* from the first correction on (Batoz and Dhatt 1979). K is the stiffness of the bonds that are left, by their
//! secants where they soften: it stays definite where the load falls, past peaks and where the load snaps back.

use std::sync::Arc;

use super::anderson::Mixing;
use super::equations::{Equations, Iterate};
use super::residual::RESIDUAL_TOLERANCE;
use crate::balanced::Attempt;
use crate::breakage::Breakage;
use crate::history::{Observer, ObserverError};
use crate::load_program::LoadProgram;
use crate::state::State;
use crate::unbalanced::Unbalanced;

/// Iterations after which a solve is given up.
const ITERATION_LIMIT: usize = 1000;

/// A residual above this is no equilibrium whatever the energies say.
const LARGEST_RESIDUAL: f64 = 1e-8;

/// Iterations after which corrections are mixed, and iterations after which bonds keep the damage of the iterates.
const MIXING_FROM: usize = 15;
const ONE_WAY_AFTER: usize = 150;

/// What a motion may miss its value by, relative to the way that it goes in its stage.
const MISSED: f64 = 1e-9;

/// Growth of the controlled motion with the load factor, relative to the largest growth of a displacement, below which the load does not
/// move it.
const UNMOVED: f64 = 1e-12;

/// A motion with its value, which a load is to bring about.
#[derive(Debug, Clone)]
pub(crate) struct Target {
    /// What grows with the load factor, for a load factor of one.
    pub(crate) rate: Arc<dyn LoadProgram>,
    /// Degrees of freedom with their weights in the motion.
    pub(crate) weights: Vec<(u32, f64)>,
    /// The value of the motion, m or rad.
    pub(crate) value: f64,
    /// The way that the motion goes in its stage, m or rad.
    pub(crate) way: f64,
}

impl Target {
    /// The motion in displacements (n_degrees_of_freedom).
    pub(super) fn motion(&self, displacement: &[f64]) -> f64 {
        let terms = self.weights.iter();
        let terms = terms.map(|&(dof, weight)| weight * displacement[dof as usize]);
        terms.sum()
    }
}

/// Brings a state into equilibrium at the value of a motion, and finds its load factor.
pub(super) fn balance(
    equations: &mut Equations,
    state: &mut State,
    breakage: &Breakage,
    target: &Target,
    observer: &mut dyn Observer,
) -> Result<Attempt, ObserverError> {
    equations.prescribe(state);
    let mut mechanisms = Vec::new();
    let mut previous = (f64::NAN, f64::INFINITY);
    let mut mixing: Option<Mixing> = None;
    let mut iterations = usize::from(equations.follow(state, breakage));
    loop {
        let is_one_way = iterations > ONE_WAY_AFTER;
        let iterate = measure(equations, state, is_one_way);
        let (residual, energy) = (iterate.residual, iterate.stored_energy);
        if iterations > 0 {
            observer.iteration(iterations, residual.relative, energy)?;
        }
        let missing = target.value - target.motion(&state.displacement);
        let is_small = equations.is_small(&residual, RESIDUAL_TOLERANCE)
            || equations.energy_settled(previous.0, &iterate, LARGEST_RESIDUAL);
        if is_small && missing.abs() <= MISSED * target.way.abs() {
            state.softening.settle();
            equations.remember(iterate.extents);
            return Ok(equations.settled(iterate, iterations, mechanisms));
        }
        if iterations == ITERATION_LIMIT || !residual.relative.is_finite() {
            return Ok(equations.not_settled(&residual, iterations));
        }
        if !state.softening.remaining.is_empty() {
            equations.solver.weaken(state, &mut equations.costs);
        } else if equations.solver.is_changed() && iterations >= 2 {
            equations.solver.forget();
        }
        let (mut correction, scale) =
            match correction(equations, state, &iterate, target, &mut mechanisms) {
                Ok(found) => found,
                Err(unbalanced) => return Ok(Attempt::Unbalanced(unbalanced)),
            };
        if iterations >= MIXING_FROM && !is_one_way {
            let mixing = mixing.get_or_insert_with(|| Mixing::new(scale));
            if residual.relative > previous.1 {
                mixing.restart();
            }
            correction = mixing.step(at_unknowns(equations, state), correction);
        }
        take(equations, state, &correction);
        previous = (energy, residual.relative);
        iterations += 1;
    }
}

/// Softens the bonds of an iterate where they do, and measures it.
fn measure(equations: &mut Equations, state: &mut State, is_one_way: bool) -> Iterate {
    let deformations = equations.deformations(state);
    let State {
        softening, intact, ..
    } = &mut *state;
    if !softening.remaining.is_empty() {
        let criteria = &equations.problem.criteria;
        softening.follow(criteria, intact, &deformations, is_one_way);
    }
    equations.measure_deformed(state, deformations)
}

/// The correction of the unknowns with that of the load factor at its end, and what makes all of them comparable, both shape
/// (n_unknowns + 1).
fn correction(
    equations: &mut Equations,
    state: &mut State,
    iterate: &Iterate,
    target: &Target,
    mechanisms: &mut Vec<u32>,
) -> Result<(Vec<f64>, Vec<f64>), Unbalanced> {
    let mut correction = equations.correction(state, iterate, mechanisms)?;
    let growth = equations.growth(state, &*target.rate)?;
    let largest = growth.iter().fold(0.0_f64, |size, it| size.max(it.abs()));
    let mut moved = vec![0.0; growth.len()];
    for (&dof, value) in equations.degrees_of_freedom().iter().zip(&correction) {
        moved[dof as usize] = *value;
    }
    let gained = target.motion(&growth);
    let missing = target.value - target.motion(&state.displacement) - target.motion(&moved);
    let load_factor = missing / gained;
    if gained.abs() <= UNMOVED * largest || !load_factor.is_finite() {
        return Err(Unbalanced::Unmoved);
    }
    let mut scale = vec![1.0; correction.len()];
    for (&dof, value) in equations.degrees_of_freedom().iter().zip(&mut correction) {
        *value += load_factor * growth[dof as usize];
    }
    correction.push(load_factor);
    scale.push(largest);
    Ok((correction, scale))
}

/// Displacements and rotations of a state at the unknowns and its load factor, shape (n_unknowns + 1).
fn at_unknowns(equations: &Equations, state: &State) -> Vec<f64> {
    let dofs = equations.degrees_of_freedom().iter();
    let displacements = dofs.map(|&dof| state.displacement[dof as usize]);
    displacements.chain([state.load_factor]).collect()
}

/// Adds a correction (n_unknowns + 1) to a state.
fn take(equations: &Equations, state: &mut State, correction: &[f64]) {
    let Some((load_factor, displacements)) = correction.split_last() else {
        return;
    };
    equations.add_correction(state, 1.0, displacements);
    state.load_factor += load_factor;
    equations.prescribe(state);
}
