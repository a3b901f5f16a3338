//! Equilibrium of bonds that soften, by a quasi-Newton iteration from their secant stiffness.

use super::curvature::Curvature;
use super::earlier_equilibria::EarlierEquilibria;
use super::equations::Equations;
use super::iterate::Iterate;
use super::line;
use super::line_search;
use super::residual::RESIDUAL_TOLERANCE;
use super::target::Target;
use crate::balanced::Attempt;
use crate::breakage::Breakage;
use crate::history::{Observer, ObserverError};
use crate::state::State;
use crate::tangent::AllowedResidual;
use crate::unbalanced::Unbalanced;
use crate::vectors::dot_of_all;

/// Largest residual of an equilibrium accepted by the energy rule: residuals of thousands of points add up in the balance of the
/// external forces, and the falling stiffness of softening bonds magnifies them.
const LARGEST_RESIDUAL: f64 = 1e-8;

/// Largest residual of an equilibrium accepted by the energy rule where a motion is prescribed or faces close: energies of a run
/// then balance to 1e-8, against 2e-8 with a residual of 1e-8.
const LARGEST_FOLLOWING: f64 = 2e-9;

/// Residual up to which an extrapolated state begins the iteration where a motion is prescribed; a residual without extrapolation
/// is then no measure.
const LARGEST_AHEAD: f64 = 0.2;

/// Relative residual that an iterative solver may leave. The stiffness of the secants is only near the tangent, and the recorded curvature
/// belongs to the steps that are taken: with 1e-6 a run needs nearly as many corrections, and three times as long.
const SOLVED: f64 = 0.3;

/// Number of corrections for which an iterative solver solves for the growth with the load once.
const GROWTH_EVERY: usize = 5;

/// Largest number of iterations of a solve.
const ITERATION_LIMIT: usize = 1000;

/// Largest number of trials of a line search; where surfaces meet, friction turns round and contacts close within a small part of a correction,
/// and the search goes on.
const TRIES: usize = 5;
const TRIES_IN_CONTACT: usize = 53;

/// Number of iterations after which a force at an added support is accepted where faces close.
const CARRIED_AFTER: usize = 60;

/// Number of iterations after which damage of the iterates no longer heals: a solution that has not converged by then is a sudden
/// drop in which bonds alternate, and damage that only grows terminates.
const ONE_WAY_AFTER: usize = 150;

/// Number of iterations from which a state may count as diverging, and how many times farther than the body is large, or its supports move
/// it, some point has then moved. Before that a part that hangs by nothing may have moved as far, and is held.
const DIVERGING: (usize, f64) = (20, 1e6);

/// Brings a state with softening bonds into equilibrium at its load factor.
///
/// Every iterate determines the remaining stiffness of the bonds. The secants are positive, so that the secant stiffness K_s is
/// positive definite where the elastic one is; and since the energy of a bond is concave in the square of its deformation, the
/// energy with the secants lies above the true one. A correction by K_s therefore lowers the potential energy, but is too short.
/// Two measures lengthen it: the curvature along the last steps ([`Curvature`]), including steps of earlier equilibria, and a line
/// search ([`line_search`]). Both lower the energy and end in a stable equilibrium. The factor may differ from the secants, because
/// both need only an approximate stiffness.
///
/// A load step begins at the extrapolation of the last one if that has the smaller residual. Where faces close, nothing is taken
/// from earlier equilibria, and after a breakage no curvature. Otherwise the first correction takes the bonds of the last
/// equilibrium, because bonds next to prescribed motions deform too much until their surroundings follow. The iteration ends by
/// NHPD's energy rule (eq. 21) with a residual below 1e-8, or with a residual below 1e-10. Extremes of iterates do not count unless
/// equilibrium is reached ([`Softening::follow`](crate::softening::Softening::follow)).
pub(super) fn balance(
    equations: &mut Equations,
    state: &mut State,
    breakage: &Breakage,
    observer: &mut dyn Observer,
) -> Result<Attempt, ObserverError> {
    sought(equations, state, breakage, None, observer)
}

/// Brings a state with softening bonds into equilibrium at the value of a motion, and finds its load factor: the iteration of
/// [`balance`] in the plane of displacements with that motion, for a body that is stable under such control.
pub(super) fn balance_at(
    equations: &mut Equations,
    state: &mut State,
    breakage: &Breakage,
    target: &Target,
    observer: &mut dyn Observer,
) -> Result<Attempt, ObserverError> {
    sought(equations, state, breakage, Some(target), observer)
}

fn sought(
    equations: &mut Equations,
    state: &mut State,
    breakage: &Breakage,
    target: Option<&Target>,
    observer: &mut dyn Observer,
) -> Result<Attempt, ObserverError> {
    let mut earlier = applicable_precedents(equations, breakage);
    let (mut iterate, mut iterations) = begun(equations, state, breakage, target, &earlier);
    let mut growth = None;
    let mut mechanisms = Vec::new();
    let mut previous_energy = f64::NAN;
    let faces_close = equations.problem.may_press();
    let largest_residual = largest_residual(target.is_some() || faces_close);
    loop {
        let residual = iterate.residual;
        if iterations > 0 {
            observer.iteration(iterations, residual.relative, iterate.stored_energy)?;
        }
        let energy_settled = equations.energy_settled(previous_energy, &iterate, largest_residual);
        let is_small = equations.is_small(&residual, RESIDUAL_TOLERANCE);
        let is_met = target.is_none_or(|it| it.is_met(&state.displacement));
        // A force at an added support may in the end be carried by closed faces.
        let may_close = faces_close && iterations < CARRIED_AFTER;
        let is_carried = may_close && residual.carried.is_some();
        if (is_small || energy_settled) && is_met && !is_carried {
            state.softening.settle();
            equations.remember(iterate.extents);
            earlier.learn(state, !breakage.bonds.is_empty());
            equations.earlier = earlier;
            return Ok(equations.settled(iterate, iterations, mechanisms));
        }
        let layout = equations.problem.system.layout();
        let diverges = iterations >= DIVERGING.0
            && (equations.accuracy).moves_beyond(layout, state, DIVERGING.1);
        if iterations == ITERATION_LIMIT || diverges || !residual.relative.is_finite() {
            return Ok(equations.not_settled(&residual, iterations));
        }
        previous_energy = iterate.stored_energy;
        let is_one_way = iterations > ONE_WAY_AFTER;
        let curvature = &mut earlier.curvature;
        equations
            .solver
            .update_for_softening(state, &mut equations.costs);
        let next = equations.make_ready(state, &iterate).and_then(|held| {
            if !held.is_empty() {
                curvature.discard();
                growth = None;
            }
            mechanisms.extend(held);
            let directions = (curvature, &mut growth);
            next(equations, state, &iterate, directions, target, is_one_way)
        });
        iterate = match next {
            Ok(next) => next,
            Err(unbalanced) => return Ok(Attempt::Unbalanced(unbalanced)),
        };
        iterations += 1;
    }
}

/// Largest residual of an equilibrium accepted by the energy rule; `follows` where a motion is prescribed or faces close.
fn largest_residual(follows: bool) -> f64 {
    if follows {
        LARGEST_FOLLOWING
    } else {
        LARGEST_RESIDUAL
    }
}

/// Precedents that apply to the equilibrium to be found.
///
/// Pairs that close and open change the stiffness at once; and where one breakage causes another, curvature from before it would
/// affect where the drop ends.
fn applicable_precedents(equations: &mut Equations, breakage: &Breakage) -> EarlierEquilibria {
    let mut earlier = std::mem::take(&mut equations.earlier);
    if equations.problem.may_press() {
        return EarlierEquilibria::default();
    }
    if !breakage.bonds.is_empty() {
        earlier.curvature.discard();
    }
    earlier
}

/// First iterate, and the number of corrections made to reach it.
fn begun(
    equations: &mut Equations,
    state: &mut State,
    breakage: &Breakage,
    target: Option<&Target>,
    earlier: &EarlierEquilibria,
) -> (Iterate, usize) {
    equations.prescribe(state);
    let has_followed = equations.follow(state, breakage);
    let iterate = equations.measure(state);
    let is_small = equations.is_small(&iterate.residual, RESIDUAL_TOLERANCE);
    if has_followed || (is_small && target.is_none()) {
        return (softened(equations, state, false), usize::from(has_followed));
    }
    let is_new = breakage.bonds.is_empty();
    let ahead = is_new.then(|| earlier.ahead(state, target)).flatten();
    let Some(mut ahead) = ahead else {
        return (iterate, 0);
    };
    equations.prescribe(&mut ahead);
    let there = softened(equations, &mut ahead, false);
    let most = target.map_or(iterate.residual.relative, |_| LARGEST_AHEAD);
    if there.residual.relative < most {
        *state = ahead;
        return (there, 0);
    }
    (iterate, 0)
}

/// Correction of a state, with the residual force that it removes.
struct Correction {
    /// Residual force at the corrected load factor, shape (n_unknowns), N.
    force: Vec<f64>,
    /// Change of the unknowns, shape (n_unknowns).
    step: Vec<f64>,
    load_change: f64,
}

/// Growth of a state with the load factor.
struct Growth {
    /// Residual force that the loads cause at load factor 1, shape (n_unknowns), N.
    force: Vec<f64>,
    /// Rate of the displacements, shape (n_degrees_of_freedom).
    motion: Vec<f64>,
    /// Number of corrections made with it.
    used: usize,
}

/// What earlier corrections say of the stiffness.
type Directions<'a> = (&'a mut Curvature, &'a mut Option<Growth>);

/// Correction by the stiffness with the recorded curvature. The growth with the load of an earlier correction is near enough for an
/// iterative solver: the motion reaches its value along any growth.
fn correction(
    equations: &mut Equations,
    state: &State,
    force: &[f64],
    curvature: &Curvature,
    target: Option<&Target>,
    last: &mut Option<Growth>,
) -> Result<Correction, Unbalanced> {
    let mut step = solved(equations, state, force, curvature)?;
    let mut force = force.to_vec();
    let mut load_change = 0.0;
    if let Some(target) = target {
        let is_iterative = equations.solver.tolerance().is_some();
        let recent = last
            .take()
            .filter(|it| is_iterative && it.used < GROWTH_EVERY);
        let mut grown = match recent {
            Some(grown) => grown,
            None => growth(equations, state, curvature, target)?,
        };
        grown.used += 1;
        let moved = equations.at_degrees_of_freedom(&step);
        load_change = target.load_change(&state.displacement, &moved, &grown.motion)?;
        let dofs = equations.degrees_of_freedom();
        for (value, &dof) in step.iter_mut().zip(dofs) {
            *value += load_change * grown.motion[dof as usize];
        }
        for (value, rate) in force.iter_mut().zip(&grown.force) {
            *value += load_change * rate;
        }
        *last = Some(grown);
    }
    Ok(Correction {
        force,
        step,
        load_change,
    })
}

/// Growth of a state with the load factor, for the bonds of the state.
fn growth(
    equations: &mut Equations,
    state: &State,
    curvature: &Curvature,
    target: &Target,
) -> Result<Growth, Unbalanced> {
    let (mut motion, force) = line::rate(equations, state, &*target.rate);
    let grown = solved(equations, state, &force, curvature)?;
    for (&dof, value) in equations.degrees_of_freedom().iter().zip(&grown) {
        motion[dof as usize] = *value;
    }
    Ok(Growth {
        force,
        motion,
        used: 0,
    })
}

/// Change of the unknowns for a residual force, both of shape (n_unknowns).
fn solved(
    equations: &mut Equations,
    state: &State,
    force: &[f64],
    curvature: &Curvature,
) -> Result<Vec<f64>, Unbalanced> {
    let subdomain = equations.subdomain().clone();
    let dot = |one: &[f64], other: &[f64]| dot_of_all(&subdomain, one, other);
    let solve = |it| equations.solve(state, it, AllowedResidual::Share(SOLVED));
    curvature.correction(force, &dot, solve)
}

/// Computes the next iterate: corrects the load factor and moves the state along the correction as far as that lowers the energy.
fn next(
    equations: &mut Equations,
    state: &mut State,
    iterate: &Iterate,
    directions: Directions<'_>,
    target: Option<&Target>,
    is_one_way: bool,
) -> Result<Iterate, Unbalanced> {
    let (curvature, growth) = directions;
    let force = equations.out_of_balance(state, iterate);
    // A motion reaches its value by a whole correction, for which curvature recorded elsewhere may be wrong.
    let is_searched = target.is_none_or(|it| it.is_met(&state.displacement));
    if !is_searched {
        curvature.discard();
    }
    let mut found = correction(equations, state, &force, curvature, target, growth)?;
    if equations.dot(&found.force, &found.step) <= 0.0 {
        curvature.discard();
        *growth = None;
        found = correction(equations, state, &force, curvature, target, growth)?;
    }
    let is_short = shorten(equations, &mut found.step);
    let tries = match equations.meeting.surfaces.is_empty() {
        true => TRIES,
        false => TRIES_IN_CONTACT,
    };
    let Correction { force, step, .. } = &found;
    state.load_factor += found.load_change;
    let start = state.displacement.clone();
    let subdomain = equations.subdomain().clone();
    let mut go = |part: f64| {
        state.displacement.clone_from(&start);
        equations.add_correction(state, part, step);
        equations.prescribe(state);
        let iterate = softened(equations, state, is_one_way);
        let force = equations.out_of_balance(state, &iterate);
        (iterate, force)
    };
    let (mut iterate, mut left) = go(1.0);
    let mut part = 1.0;
    let works = [force, &left].map(|it| dot_of_all(&subdomain, it, step));
    // Beyond the end of a shortened correction surfaces would not see each other.
    if is_searched && !(is_short && works[1] >= 0.0) {
        part = line_search::part(works[0], works[1], tries, |part| {
            (iterate, left) = go(part);
            dot_of_all(&subdomain, &left, step)
        });
    }
    let change: Vec<f64> = force.iter().zip(&left).map(|(was, is)| was - is).collect();
    let taken: Vec<f64> = step.iter().map(|it| part * it).collect();
    let work = equations.dot(&taken, &change);
    curvature.learn(taken, change, work);
    Ok(iterate)
}

/// Shortens a correction where surfaces would move too far at once to see each other; returns whether it does.
fn shorten(equations: &Equations, step: &mut [f64]) -> bool {
    let surfaces = &equations.meeting.surfaces;
    if surfaces.is_empty() {
        return false;
    }
    let part = surfaces.part_within_reach(&equations.at_degrees_of_freedom(step), &[]);
    step.iter_mut().for_each(|it| *it *= part);
    part < 1.0
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
