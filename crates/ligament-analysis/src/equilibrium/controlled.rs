//! Equilibrium at a value of a motion, for bonds that are intact or broken: Newton-Raphson with the load factor as an unknown
//! ([`Target`]).

use super::equations::Equations;
use super::iterate::Iterate;
use super::line;
use super::target::Target;
use crate::balanced::Attempt;
use crate::breakage::Breakage;
use crate::history::{Observer, ObserverError};
use crate::state::State;
use crate::unbalanced::Unbalanced;

/// Largest number of iterations of a solve.
const ITERATION_LIMIT: usize = 1000;

/// Largest residual of an equilibrium accepted by the energy rule.
const LARGEST_RESIDUAL: f64 = 1e-8;

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
    let sought = equations.accuracy.sought(breakage);
    let largest = equations
        .solver
        .tolerance()
        .map_or(LARGEST_RESIDUAL, |_| sought);
    let mut previous_energy = f64::NAN;
    let mut iterations = usize::from(equations.follow(state, breakage));
    loop {
        let iterate = equations.measure(state);
        let (residual, energy) = (iterate.residual, iterate.stored_energy);
        if iterations > 0 {
            observer.iteration(iterations, residual.relative, energy)?;
        }
        let is_small = equations.is_small(&residual, sought)
            || equations.energy_settled(previous_energy, &iterate, largest);
        if is_small && target.is_met(&state.displacement) {
            equations.remember(iterate.extents);
            return Ok(equations.settled(iterate, iterations, mechanisms));
        }
        if iterations == ITERATION_LIMIT || !residual.relative.is_finite() {
            return Ok(equations.not_settled(&residual, iterations));
        }
        if equations.solver.is_changed() && iterations >= 2 {
            equations.solver.discard();
        }
        let corrected = correct(equations, state, &iterate, target, sought, &mut mechanisms);
        if let Err(unbalanced) = corrected {
            return Ok(Attempt::Unbalanced(unbalanced));
        }
        previous_energy = energy;
        iterations += 1;
    }
}

/// Corrects the displacements and the load factor of a state.
fn correct(
    equations: &mut Equations,
    state: &mut State,
    iterate: &Iterate,
    target: &Target,
    sought: f64,
    mechanisms: &mut Vec<u32>,
) -> Result<(), Unbalanced> {
    let mut correction = equations.correction(state, iterate, sought, mechanisms)?;
    let growth = line::growth(equations, state, &*target.rate)?;
    let moved = equations.at_degrees_of_freedom(&correction);
    let change = target.load_change(&state.displacement, &moved, &growth)?;
    for (&dof, value) in equations.degrees_of_freedom().iter().zip(&mut correction) {
        *value += change * growth[dof as usize];
    }
    equations.add_correction(state, 1.0, &correction);
    state.load_factor += change;
    equations.prescribe(state);
    Ok(())
}
