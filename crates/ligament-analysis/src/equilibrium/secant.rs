//! Equilibrium of bonds that soften: iteration with their secant stiffness, mixed by Anderson's method.

use super::anderson::Mixing;
use super::equations::{Equations, Iterate};
use super::residual::RESIDUAL_TOLERANCE;
use crate::balanced::Attempt;
use crate::breakage::Breakage;
use crate::history::{Observer, ObserverError};
use crate::state::State;

/// Iterations after which a solve is given up.
const ITERATION_LIMIT: usize = 1000;

/// Iterations after which corrections are mixed. The first ones alone decide which bonds soften: mixed ones go too far, and take
/// bonds past their limits that equilibrium would spare.
const MIXING_FROM: usize = 15;

/// Iterations after which bonds keep the damage of the iterates: what has not settled by then is a sudden fall, in which bonds
/// take turns. Damage that only grows comes to an end.
const ONE_WAY_AFTER: usize = 150;

/// Brings a state with softening bonds into equilibrium at its load factor.
///
/// Every iterate decides what is left of the bonds, and K is that of what is left: the secants. These are positive, so that
/// K is definite where the elastic one is, and each correction solves the equations of the present secants exactly; what
/// remains as a residual is that the secants moved. It shrinks by a factor an iteration, slower the steeper bonds fall. The
/// iteration ends by NHPD's energy rule (eq. 21) with a residual below 1e-6, or with one below 1e-10.
///
/// Extremes of iterates do not count unless equilibrium holds ([`Softening::follow`](crate::softening::Softening::follow)).
pub(super) fn balance(
    equations: &mut Equations,
    state: &mut State,
    breakage: &Breakage,
    observer: &mut dyn Observer,
) -> Result<Attempt, ObserverError> {
    equations.prescribe(state);
    let mut mechanisms = Vec::new();
    let mut previous_energy = f64::NAN;
    let mut previous_residual = f64::INFINITY;
    let mut mixing = Mixing::new(lengths(equations));
    let mut iterations = usize::from(equations.follow(state, breakage));
    loop {
        let is_one_way = iterations > ONE_WAY_AFTER;
        let (is_settled, iterate) = measure(equations, state, is_one_way);
        let residual = iterate.residual;
        if iterations > 0 {
            observer.iteration(iterations, residual.relative, iterate.stored_energy)?;
        }
        let energy_settled = equations.energy_settled(previous_energy, &iterate);
        if equations.is_small(&residual, RESIDUAL_TOLERANCE) || energy_settled {
            state.softening.settle();
            equations.remember(iterate.extents);
            return Ok(equations.settled(iterate, iterations, mechanisms));
        }
        if iterations == ITERATION_LIMIT || !residual.relative.is_finite() {
            return Ok(equations.not_settled(&residual, iterations));
        }
        let correction = match equations.correction(state, &iterate, &mut mechanisms) {
            Ok(correction) => correction,
            Err(unbalanced) => return Ok(Attempt::Unbalanced(unbalanced)),
        };
        let may_mix = iterations >= MIXING_FROM && !is_one_way && is_settled;
        if !may_mix || residual.relative > previous_residual {
            mixing.restart();
        }
        let step = mixing.step(at_unknowns(equations, state), correction);
        equations.add_correction(state, &step);
        (previous_residual, previous_energy) = (residual.relative, iterate.stored_energy);
        iterations += 1;
    }
}

/// Softens the bonds of an iterate and measures it; tells whether the same bonds go on along their laws as before.
fn measure(equations: &mut Equations, state: &mut State, is_one_way: bool) -> (bool, Iterate) {
    let deformations = equations.deformations(state);
    let State {
        softening, intact, ..
    } = &mut *state;
    let criteria = &equations.problem.criteria;
    let is_settled = softening.follow(criteria, intact, &deformations, is_one_way);
    equations.solver.weaken(state, &mut equations.costs);
    (is_settled, equations.measure_deformed(state, deformations))
}

/// Displacements and rotations of a state at the unknowns, shape (n_unknowns).
fn at_unknowns(equations: &Equations, state: &State) -> Vec<f64> {
    let dofs = equations.degrees_of_freedom().iter();
    dofs.map(|&dof| state.displacement[dof as usize]).collect()
}

/// 1 at displacements and the spacing of the point at rotations, which makes lengths of both, shape (n_unknowns).
fn lengths(equations: &Equations) -> Vec<f64> {
    let system = &equations.problem.system;
    let (layout, spacing) = (system.layout(), system.spacing());
    let length = |&dof: &u32| {
        if layout.component(dof as usize).is_rotation() {
            spacing[layout.point(dof as usize) as usize]
        } else {
            1.0
        }
    };
    equations.degrees_of_freedom().iter().map(length).collect()
}
