//! Steps without inertia in an implicit motion: equilibria follow each other until a step would set more energy free than its bonds dissipate.
//!
//! A step sets free what the loads do and the bonds neither store nor dissipate, W - dE - dD. Between equilibria with the same bonds that is
//! nothing; a bond that breaks at its limit sets free 1/2 u^T K_b (u' - u); an avalanche, a part that comes off and a load that jumps set free
//! what only a motion can carry away.

use super::clock::Clock;
use super::here::Here;
use super::stepping::{HALVINGS, Pace};
use super::taken::Taken;
use crate::bond_numbers::sum_over_bonds;
use crate::driver::recorder::Energies;
use crate::motion::{ImplicitSettings, MotionProblem};
use crate::problem::Problem;

/// Pace at time zero: without inertia where the settings have it so and the body is at rest.
pub(super) fn first_pace(problem: &MotionProblem, implicit: ImplicitSettings) -> Pace {
    let is_at_rest = problem.initial_velocity.iter().all(|it| *it == 0.0);
    match implicit.statics {
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

/// Energy that a step sets free, J.
pub(super) fn set_free(problem: &Problem, energies: &Energies, here: &Here, taken: &Taken) -> f64 {
    let work = energies.work_to(problem, &taken.state, &taken.balanced);
    let stored = taken.balanced.stored_energy - here.balanced.stored_energy;
    let (before, after) = (&here.state.dissipated, &taken.state.dissipated);
    let dissipated = after
        .iter()
        .zip(before)
        .map(|(after, before)| after - before);
    work - stored - sum_over_bonds(&*problem.system, dissipated)
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
