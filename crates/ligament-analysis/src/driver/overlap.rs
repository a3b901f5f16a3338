//! Faces of cracks that pass through each other, where nothing keeps them from it.

use ligament_model::contact::Overlap;

use crate::connectivity::Fragments;
use crate::problem::Problem;
use crate::state::State;

/// Overlap of two faces, relative to the largest displacement of a point, from which results are not those of a body with a crack. A
/// part of a sound body as long as a horizon shortens by less.
const LARGEST: f64 = 0.1;

/// The largest overlap of faces in a state, if it is more than results bear.
///
/// A part that nothing holds at all lies where it came loose, so that what passes through it says nothing.
pub(super) fn largest(problem: &Problem, state: &State, fragments: &Fragments) -> Option<Overlap> {
    let system = &*problem.system;
    let layout = system.layout();
    let displacements = layout.displacements(&state.displacement);
    let displacement = displacements.fold(0.0, |largest: f64, it| largest.max(it.abs()));
    if displacement == 0.0 {
        return None;
    }
    let mut holds = vec![0; fragments.points.len()];
    for (dof, _) in state.held.iter().enumerate().filter(|(_, held)| **held) {
        holds[fragments.of_point[layout.point(dof) as usize] as usize] += 1;
    }
    let is_held = |fragment: &u32| holds[*fragment as usize] < layout.components.len();
    let asked: Vec<bool> = fragments.of_point.iter().map(is_held).collect();
    let expansion = problem.loads.thermal_strain(state.load_factor);
    let beyond = LARGEST * displacement;
    system.overlap(
        &state.intact,
        &state.displacement,
        expansion,
        beyond,
        &asked,
    )
}
