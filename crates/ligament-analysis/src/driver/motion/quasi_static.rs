//! Steps without inertia in an implicit motion: equilibria follow each other until a step would set more energy free than its bonds dissipate.
//!
//! A step sets free what the loads do and the bonds neither store nor dissipate, W - dE - dD, less what friction and contact take. Between equilibria with the same bonds that is
//! nothing; a bond that breaks at its limit sets free 1/2 u^T K_b (u' - u); an avalanche, a part that comes off and a load that jumps set free
//! what only a motion can carry away.
//!
//! A part that nothing holds has an equilibrium under a force only where it touches what resists it. One that a prescribed motion presses against
//! another without friction has one beside it as well, past which it cannot have slipped at once ([`slips`]). A step across a gap finds that one; what the
//! force does on the way counts as set free, but not what a prescribed motion seems to do there by the trapezoidal rule.

use super::clock::{Clock, HALVINGS, Pace};
use super::trial_step::TrialStep;
use crate::balanced::Balanced;
use crate::bond_numbers::sum_over_bonds;
use crate::driver::run::Run;
use crate::equilibrium::Equilibrium;
use crate::motion::{MotionProblem, MotionSettings};
use crate::problem::Problem;
use crate::state::State;
use ligament_model::tensor::{minus, norm};

/// Pace at time zero: without inertia where the settings have it so and the body is at rest.
pub(super) fn first_pace(problem: &MotionProblem, settings: &MotionSettings) -> Pace {
    let is_at_rest = problem.initial_velocity.iter().all(|it| *it == 0.0);
    match settings.share_of_statics() {
        Some(_) if is_at_rest => Pace::STATICS,
        Some(_) | None => Pace::MOTION,
    }
}

/// Pace without inertia between two steps of a clock, `tick` parts after a row: the longest steps that end at the next row.
pub(super) fn pace_from(tick: usize, clock: &Clock) -> Pace {
    let steps = (tick >> HALVINGS) + clock.steps_per_row;
    let longest = clock.steps_per_row.trailing_zeros();
    let halvings = longest - steps.trailing_zeros().min(longest);
    Pace {
        halvings: halvings as usize,
        ..Pace::STATICS
    }
}

/// Energy that an equilibrium sets free by rounding, J: where nothing resists a part yet, the work so far is no more than that, and a share of it says
/// nothing.
pub(super) fn rounding(equilibrium: &Equilibrium, balanced: &Balanced) -> f64 {
    let of_positions = equilibrium.energy_of_rounding(balanced.internal.force_scale);
    balanced.energy_floor.max(of_positions)
}

/// Share of the size of a body by which a part that nothing holds may move in a step beyond [`LEVER`] times what is prescribed: surfaces that
/// slip off each other move by their own size, parts in contact by the gaps between them.
const SLIP: f64 = 0.1;

/// Ratio of a motion at the end of a lever to the one that moves it.
const LEVER: f64 = 10.0;

/// Whether a part that nothing holds slips off what it touches in a step from a state to another one, for a body of a size (m).
pub(super) fn slips(problem: &Problem, size: f64, [before, after]: [&State; 2]) -> bool {
    if problem.contact.is_empty() || !after.held.contains(&true) {
        return false;
    }
    let layout = problem.system.layout;
    let way = |dof: usize| (after.displacement[dof] - before.displacement[dof]).abs();
    let moved = (0..after.displacement.len()).filter(|&dof| !layout.component(dof).is_rotation());
    let prescribed = moved
        .clone()
        .filter(|&dof| problem.loads.is_prescribed(dof));
    let prescribed = prescribed.map(way).fold(0.0, f64::max);
    let of_tools = problem.contact.rigid_bodies.iter().map(|it| {
        let [from, to] = [before, after].map(|it| it.load_factor);
        let [from, to] = [from, to].map(|time| it.motion.displacement(time));
        norm(minus(to, from))
    });
    let prescribed = of_tools.fold(prescribed, f64::max);
    moved.map(way).fold(0.0, f64::max) > SLIP * size + LEVER * prescribed
}

/// Energy that a step of a run sets free after a balanced state, J.
pub(super) fn set_free(run: &Run<'_>, last: &Balanced, taken: &TrialStep) -> f64 {
    let (problem, energies) = (&run.problem, &run.energies);
    let work = energies.work_to(problem, &taken.state, &taken.balanced);
    let stored = taken.balanced.stored_energy - last.stored_energy;
    let (before, after) = (&run.state.dissipated, &taken.state.dissipated);
    let dissipated = after
        .iter()
        .zip(before)
        .map(|(after, before)| after - before);
    let free = work - stored - sum_over_bonds(&*problem.system, dissipated);
    if problem.face_friction == 0.0 && problem.contact.is_empty() {
        return free;
    }
    let now = (&taken.state, &taken.balanced);
    let mut onward = energies.clone();
    let faces = onward.follow_contact(problem, now, &taken.broken);
    let surfaces = onward.follow_surfaces(problem, now.0);
    let kept = surfaces.stored - last.touching.energy();
    // Faces close and open without force on the way, which the trapezoidal rule counts as work.
    let closure = if taken.broken.is_empty() {
        faces.closure
    } else {
        0.0
    };
    let free = free + surfaces.driving - faces.friction - closure - surfaces.dissipated - kept;
    if !taken.state.held.contains(&true) {
        return free;
    }
    let moving = energies.work_of_motions_to(problem, &taken.state, &taken.balanced);
    let on_the_way = surfaces.excess + closure - (moving + surfaces.driving).max(0.0);
    free + on_the_way.max(0.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Of eight steps in a row, the next two after the second end at the fourth, and the next four after the fourth at the row.
    #[test]
    fn steps_end_together_with_rows() {
        let clock = Clock {
            duration: 1.0,
            rows: 1,
            steps_per_row: 8,
        };
        let halvings = |step: usize| pace_from(step << HALVINGS, &clock).halvings;
        let found: Vec<usize> = (0..8).map(halvings).collect();
        assert_eq!(found, [0, 3, 2, 3, 1, 3, 2, 3]);
    }
}
