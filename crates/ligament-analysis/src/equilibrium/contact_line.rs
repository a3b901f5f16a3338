//! Equilibrium lines of a body whose contacts open and close: rates of the displacements with the load factor, and how far along them the
//! same contacts are closed.
//!
//! A contact with the gap g, linear in displacements and load factor, presses with k g where g < 0. Along a line a closed contact is a
//! spring, and an open one has no stiffness. A contact without a gap is closed where its gap decreases in the direction of the load: the
//! energy of the rates is then piecewise quadratic, like the energy of displacements, and its minimum is found in the same way
//! ([`active_set`]).

use super::active_set::{ACCEPTED_SLOPE, FALLS, ITERATION_LIMIT, Moved, REFINED, lowest};
use super::equations::{Equations, LineForces, at_one};
use super::residual::RESIDUAL_TOLERANCE;
use crate::contact::resisting::{self, Resisting};
use crate::load_program::LoadProgram;
use crate::state::State;
use crate::unbalanced::Unbalanced;
use ligament_model::contact::ClosedPair;

/// A direction of the load along a line, and the tolerance within which contacts open and close together.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Heading {
    /// 1 where the load grows, -1 where it falls.
    pub(crate) sign: f64,
    /// Gap, over the sizes of the motions that it is computed from, below which it is zero.
    pub(crate) tie_tolerance: f64,
}

/// A contact in a state on a line.
struct OnLine {
    /// Motion that the contact resists when it is closed.
    term: Resisting,
    /// Gap, m.
    gap: f64,
    /// Change of the gap with the load factor without motions, m.
    shift: f64,
    /// Whether it is closed; None at the gap zero, where the rates decide.
    is_closed: Option<bool>,
}

impl OnLine {
    /// Rate of the gap for rates of the motions (n_degrees_of_freedom), m.
    fn rate(&self, growth: &[f64]) -> f64 {
        let moved = self
            .term
            .row
            .iter()
            .map(|(dof, factor)| factor * growth[*dof]);
        moved.sum::<f64>() + self.shift
    }

    /// Whether it is closed along a line with a rate of its gap.
    fn is_closed(&self, rate: f64, heading: Heading) -> bool {
        self.is_closed.unwrap_or(heading.sign * rate <= 0.0)
    }
}

/// Rate of the displacements with the load factor in a direction of the load, shape (n_degrees_of_freedom), for the bonds of an
/// equilibrium state under loads at load factor 1.
///
/// # Errors
///
/// If the stiffness has no factor, the iteration does not converge, or an added support would carry a load.
pub(super) fn growth(
    equations: &mut Equations,
    state: &mut State,
    loads: &dyn LoadProgram,
    heading: Heading,
) -> Result<Vec<f64>, Unbalanced> {
    let contacts = on_line(equations, state, loads, heading);
    let (prescribed, _) = equations.rate(state, loads);
    let mut line = at_one(state, prescribed);
    let mut rates = rates_of(&contacts, &line);
    let mut forces = measured(equations, &line, loads, (&contacts, &rates, heading));
    let (mut before, mut is_carried) = (f64::INFINITY, false);
    let is_exact = equations.solver.tolerance().is_none();
    for iterations in 0..=ITERATION_LIMIT {
        let residual = forces.residual;
        let falls = is_exact && residual.relative < FALLS * before;
        let tolerance = if falls { REFINED } else { RESIDUAL_TOLERANCE };
        before = residual.relative;
        let is_over = iterations == ITERATION_LIMIT;
        // A force at an added support may in the end be carried by closed contacts, and leaves the softness of the support behind.
        let was_carried = std::mem::replace(&mut is_carried, residual.carried.is_some());
        let is_free = !was_carried && !is_carried;
        if residual.relative <= tolerance && (is_free || is_over) {
            return (equations.load_on_added_support(&forces)).map_or(Ok(line.displacement), Err);
        }
        if is_over || !residual.relative.is_finite() {
            break;
        }
        let closed = contacts.iter().zip(&rates);
        let closed = closed.filter(|(it, rate)| it.is_closed(**rate, heading));
        let closed = closed.map(|(it, _)| it.term.clone()).collect();
        equations.solver.close(closed, &mut equations.costs);
        equations.prepare_solver(state)?;
        let at = equations.loaded_by(loads, &line);
        let left = (equations.accuracy).left(at, forces.extents, RESIDUAL_TOLERANCE);
        let correction = equations.solve(state, forces.out_of_balance.clone(), left)?;
        equations.add_correction(&mut line, 1.0, &correction);
        let mut next_rates = rates_of(&contacts, &line);
        let mut next = measured(equations, &line, loads, (&contacts, &next_rates, heading));
        let slope = |at: &LineForces| -equations.dot(&at.out_of_balance, &correction);
        let (start, end) = (slope(&forces), slope(&next));
        if start < 0.0 && end > -ACCEPTED_SLOPE * start {
            let moved = moved(&contacts, [&rates, &next_rates], heading);
            let length = lowest(start, end, &moved);
            equations.add_correction(&mut line, length - 1.0, &correction);
            next_rates = rates_of(&contacts, &line);
            next = measured(equations, &line, loads, (&contacts, &next_rates, heading));
        }
        (forces, rates) = (next, next_rates);
    }
    Err(equations.unsettled(&forces.residual, ITERATION_LIMIT))
}

/// Change of the load factor, zero or more in the direction of the load, along rates of the displacements (n_degrees_of_freedom) from a state
/// to where the first contact opens or closes; infinite where none does.
pub(super) fn reach(
    equations: &mut Equations,
    state: &State,
    (loads, growth): (&dyn LoadProgram, &[f64]),
    heading: Heading,
) -> f64 {
    let contacts = on_line(equations, state, loads, heading);
    let changes = contacts.iter().filter_map(|it| {
        let rate = heading.sign * it.rate(growth);
        let changes = match it.is_closed? {
            true => rate > 0.0,
            false => rate < 0.0,
        };
        changes.then_some(it.gap.abs() / rate.abs())
    });
    changes.fold(f64::INFINITY, f64::min)
}

/// All contacts in a state, in the order of the keys of the resisted motions, with the loads at load factor 1.
fn on_line(
    equations: &mut Equations,
    state: &State,
    loads: &dyn LoadProgram,
    heading: Heading,
) -> Vec<OnLine> {
    let layout = equations.layout();
    let expansion = equations.problem.loads.thermal_strain(state.load_factor);
    let met = equations.contact.met(state, expansion);
    let contact = &equations.contact;
    let pairs = contact.faces.pairs().iter().zip(&met.gaps);
    let pairs: Vec<ClosedPair> = pairs
        .map(|(&pair, &gap)| ClosedPair {
            pair,
            gap,
            friction: None,
        })
        .collect();
    let terms = resisting::by_faces(&pairs, layout);
    let growth = loads.thermal_strain(1.0);
    let of_faces = pairs.iter().zip(terms).map(|(it, term)| {
        let shift = -it.pair.growth(growth);
        (term, it.gap, shift)
    });
    let of_surfaces = met.touching.gaps(contact.surfaces.problem());
    let of_contact = |(term, gap, shift): (Resisting, f64, f64)| {
        let motions = term.row.iter();
        let sizes = motions.map(|(dof, factor)| (factor * state.displacement[*dof]).abs());
        let size = sizes.sum::<f64>() + (shift * state.load_factor).abs();
        let is_zero = gap.abs() <= heading.tie_tolerance * size;
        OnLine {
            is_closed: (!is_zero).then_some(gap < 0.0),
            term,
            gap,
            shift,
        }
    };
    of_faces.chain(of_surfaces).map(of_contact).collect()
}

fn rates_of(contacts: &[OnLine], line: &State) -> Vec<f64> {
    contacts
        .iter()
        .map(|it| it.rate(&line.displacement))
        .collect()
}

/// Forces of a line, including its closed contacts, given the rates of the gaps.
fn measured(
    equations: &Equations,
    line: &State,
    loads: &dyn LoadProgram,
    (contacts, rates, heading): (&[OnLine], &[f64], Heading),
) -> LineForces {
    let closed = contacts.iter().zip(rates);
    let closed = closed.filter(|(it, rate)| it.is_closed(**rate, heading));
    let forces = closed.flat_map(|(OnLine { term, .. }, rate)| {
        let force = term.stiffness * rate;
        term.row
            .iter()
            .map(move |&(dof, factor)| (dof, force * factor))
    });
    let forces: Vec<(usize, f64)> = forces.collect();
    equations.line_forces(line, loads, &forces)
}

/// Contacts that may open or close along a correction of the rates, from the rates of their gaps before and after it.
fn moved(contacts: &[OnLine], [before, after]: [&[f64]; 2], heading: Heading) -> Vec<Moved> {
    let rates = before.iter().zip(after);
    let undecided = contacts
        .iter()
        .zip(rates)
        .filter(|(it, _)| it.is_closed.is_none());
    undecided
        .map(|(it, (before, after))| Moved {
            stiffness: it.term.stiffness,
            gap: heading.sign * before,
            change: heading.sign * (after - before),
        })
        .collect()
}
