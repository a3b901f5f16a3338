//! What a record gives reason to tell the user, once a run.

use ligament_model::contact::Overlap;

use crate::connectivity::Fragments;
use crate::history::{LargestOverlap, Notice, StepRecord};
use crate::problem::Problem;
use crate::state::State;

/// What work and energies may miss each other by, relative to the work: both are exact between two equilibria, and these are solved
/// for to 1e-10.
const ENERGY_ERROR: f64 = 1e-6;

/// Limit of the same error where bonds soften: equilibria are known to 1e-6 of the forces.
const SOFTENING_ENERGY_ERROR: f64 = 1e-4;

/// Share of the largest work by which bonds may have dissipated more than was spent on the body, so that its load steps are not called too
/// coarse: where bonds soften, work and released energy follow the chords of a step and what is dissipated the curves between them.
const DISSIPATED_BEYOND: f64 = 0.05;

/// Overlap of two faces, relative to the largest displacement of a point, from which results are not those of a body with a crack. A
/// part of a sound body as long as a horizon shortens by less.
const LARGEST: f64 = 0.1;

/// Overlap over the distance of points that is rounding, in a body that is unloaded again.
const ROUNDING: f64 = 1e-12;

/// What to tell of the first record whose energies do not balance, with the record before it; forces without an energy have none that
/// would.
pub(super) fn energies(
    problem: &Problem,
    record: &StepRecord,
    last: Option<&StepRecord>,
) -> Option<Notice> {
    let system = &problem.system;
    if !system.is_linear() || !system.has_energy() {
        return None;
    }
    let limit = if problem.criteria.soften() {
        SOFTENING_ENERGY_ERROR
    } else {
        ENERGY_ERROR
    };
    // An error that is not a number is no balance either.
    let is_balanced = |it: &StepRecord| it.energy_error().abs() <= limit;
    let is_first = !is_balanced(record) && last.is_none_or(is_balanced);
    is_first.then(|| Notice::EnergyUnbalanced {
        step: record.step,
        error: record.energy_error().abs(),
    })
}

/// What to tell of the first record at which bonds have dissipated more than work less stored energy can have paid for.
pub(super) fn dissipation(record: &StepRecord, before: &[StepRecord]) -> Option<Notice> {
    let work = |it: &StepRecord| it.external_work.abs();
    let largest = before.iter().map(work).fold(work(record), f64::max);
    let beyond = |it: &StepRecord| it.dissipated_energy - (it.external_work - it.stored_energy);
    let is_beyond = |it: &StepRecord| beyond(it) > DISSIPATED_BEYOND * largest;
    let is_first = is_beyond(record) && !before.last().is_some_and(is_beyond);
    is_first.then(|| Notice::DissipatedBeyondWork {
        step: record.step,
        share: beyond(record) / largest,
    })
}

/// What to tell of the first state in which faces of cracks pass through each other; keeps the largest overlap so far.
pub(super) fn overlap(
    problem: &Problem,
    state: &State,
    fragments: &Fragments,
    step: usize,
    largest_so_far: &mut Option<LargestOverlap>,
) -> Option<Notice> {
    let Overlap { depth, ends } = largest(problem, state, fragments)?;
    let now = LargestOverlap { depth, ends, step };
    let is_first = largest_so_far.is_none();
    if largest_so_far.is_none_or(|before| before.depth < depth) {
        *largest_so_far = Some(now);
    }
    is_first.then_some(Notice::Overlap(now))
}

/// The largest overlap of faces in a state, if it is more than results bear.
///
/// A part that nothing holds at all lies where it came loose, so that what passes through it says nothing.
fn largest(problem: &Problem, state: &State, fragments: &Fragments) -> Option<Overlap> {
    let system = &*problem.system;
    let layout = system.layout();
    let displacements = layout.displacements(&state.displacement);
    let displacement = displacements.fold(0.0, |largest: f64, it| largest.max(it.abs()));
    let displacement = system.subdomain().max(displacement);
    let mut holds = vec![0; fragments.points.len()];
    for (dof, _) in state.held.iter().enumerate().filter(|(_, held)| **held) {
        holds[fragments.of_point[layout.point(dof) as usize] as usize] += 1;
    }
    let is_held = |fragment: &u32| holds[*fragment as usize] < layout.components.len();
    let asked: Vec<bool> = fragments.of_point.iter().map(is_held).collect();
    let expansion = problem.loads.thermal_strain(state.load_factor);
    let spacing = system.spacing().iter().copied().fold(0.0, f64::max);
    let beyond = (LARGEST * displacement).max(ROUNDING * spacing);
    system.overlap(
        &state.intact,
        &state.displacement,
        expansion,
        beyond,
        &asked,
    )
}
