//! Equilibrium of bonds that soften: a quasi-Newton iteration from their secant stiffness.

use super::curvature::{Curvature, dot};
use super::equations::{Equations, Iterate};
use super::line_search;
use super::residual::RESIDUAL_TOLERANCE;
use crate::balanced::Attempt;
use crate::breakage::Breakage;
use crate::history::{Observer, ObserverError};
use crate::state::State;

/// A residual above this is no equilibrium whatever the energies say: what is left at thousands of points adds up in the balance of
/// the external forces, and the falling stiffness of softening bonds magnifies it.
const LARGEST_RESIDUAL: f64 = 1e-8;

/// Iterations after which a solve is given up.
const ITERATION_LIMIT: usize = 1000;

/// Iterations after which a hold that carries a force carries it, where faces close.
const CARRIED_AFTER: usize = 60;

/// Iterations after which bonds keep the damage of the iterates: what has not settled by then is a sudden fall, in which bonds
/// take turns. Damage that only grows comes to an end.
const ONE_WAY_AFTER: usize = 150;

/// Brings a state with softening bonds into equilibrium at its load factor.
///
/// Every iterate decides what is left of the bonds. Their secants are positive, so that the stiffness K_s of what is left is definite
/// where the elastic one is; and since the energy of a bond bends down over the square of its deformation, the energy with the secants
/// lies above the true one. A correction by K_s therefore lowers the potential energy, if too timidly. Two things make it go as far as it
/// should: the stiffness that the last steps have shown ([`Curvature`]), and a search along it ([`line_search`]). Both
/// go down in energy, and end in an equilibrium that is stable. The factor may be off the secants by a little, because neither
/// asks for more than a stiffness that is near.
///
/// The first correction takes the bonds as they were in the last equilibrium: what prescribed motions do to bonds before their
/// surroundings follow says nothing about them. The iteration ends by NHPD's energy rule (eq. 21) with a residual below 1e-8, or with one below 1e-10.
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
    let mut curvature = Curvature::default();
    let has_followed = equations.follow(state, breakage);
    let mut iterations = usize::from(has_followed);
    let mut iterate = equations.measure(state);
    if has_followed || equations.is_small(&iterate.residual, RESIDUAL_TOLERANCE) {
        iterate = softened(equations, state, false);
    }
    loop {
        let residual = iterate.residual;
        if iterations > 0 {
            observer.iteration(iterations, residual.relative, iterate.stored_energy)?;
        }
        let energy_settled = equations.energy_settled(previous_energy, &iterate, LARGEST_RESIDUAL);
        let is_small = equations.is_small(&residual, RESIDUAL_TOLERANCE);
        // What a hold carries, faces that close may carry in the end.
        let may_close = equations.problem.system.faces_close() && iterations < CARRIED_AFTER;
        let is_carried = may_close && residual.carried.is_some();
        if (is_small || energy_settled) && !is_carried {
            state.softening.settle();
            equations.remember(iterate.extents);
            return Ok(equations.settled(iterate, iterations, mechanisms));
        }
        if iterations == ITERATION_LIMIT || !residual.relative.is_finite() {
            return Ok(equations.not_settled(&residual, iterations));
        }
        equations.solver.weaken(state, &mut equations.costs);
        match equations.make_ready(state, &iterate) {
            Ok(held) => mechanisms.extend(held),
            Err(unbalanced) => return Ok(Attempt::Unbalanced(unbalanced)),
        }
        previous_energy = iterate.stored_energy;
        let is_one_way = iterations > ONE_WAY_AFTER;
        iterate = next(equations, state, &iterate, &mut curvature, is_one_way);
        iterations += 1;
    }
}

/// The next iterate: the state goes along a correction as far as that lowers the energy.
fn next(
    equations: &mut Equations,
    state: &mut State,
    iterate: &Iterate,
    curvature: &mut Curvature,
    is_one_way: bool,
) -> Iterate {
    let force = equations.out_of_balance(state, iterate);
    let mut correction = curvature.correction(&force, |it| equations.solve(state, it));
    if dot(&force, &correction) <= 0.0 {
        curvature.forget();
        correction = equations.solve(state, force.clone());
    }
    let start = state.displacement.clone();
    let mut last = None;
    let part = line_search::part(dot(&force, &correction), |part| {
        state.displacement.clone_from(&start);
        equations.add_correction(state, part, &correction);
        let iterate = softened(equations, state, is_one_way);
        let force = equations.out_of_balance(state, &iterate);
        let work = dot(&force, &correction);
        last = Some((iterate, force));
        work
    });
    let Some((iterate, left)) = last else {
        return softened(equations, state, is_one_way);
    };
    let step = correction.iter().map(|it| part * it).collect();
    let change = force.iter().zip(&left).map(|(was, is)| was - is).collect();
    curvature.learn(step, change);
    iterate
}

/// Softens the bonds of an iterate and measures it.
fn softened(equations: &mut Equations, state: &mut State, is_one_way: bool) -> Iterate {
    let deformations = equations.deformations(state);
    let State {
        softening, intact, ..
    } = &mut *state;
    let criteria = &equations.problem.criteria;
    softening.follow(criteria, intact, &deformations, is_one_way);
    equations.measure_deformed(state, deformations)
}
