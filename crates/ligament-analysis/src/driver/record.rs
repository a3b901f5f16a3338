//! Records of the times of a run, as all drivers make them.

use ligament_model::failure::CriteriaInState;
use rayon::prelude::*;
use serde::{Deserialize, Serialize};

use super::energies::Energies;
use crate::balanced::Balanced;
use crate::bond_numbers::sum_over_bonds;
use crate::connectivity::Fragments;
use crate::history::{ContactAtRest, StepRecord};
use crate::load_program::groups_of_reactions;
use crate::probe;
use crate::problem::Problem;
use crate::result_fields::Solution;
use crate::state::State;

/// Counters of a load step.
#[derive(Debug, Clone, Copy, Default, Serialize, Deserialize)]
pub struct StepCounters {
    /// Number of the step.
    pub step: usize,
    /// Number of bonds broken so far.
    pub broken: usize,
    /// Number of bonds that break in the step.
    pub broken_in_step: usize,
    /// Number of rounds of breaking in the step.
    pub rounds: usize,
    /// Number of solves since the last record.
    pub solves: usize,
    /// Whether no bond is left to break.
    pub at_rest: bool,
    /// Number of negative eigenvalues of the stiffness.
    pub negative_eigenvalues: usize,
    /// Largest utilisation of the intact bonds.
    pub largest_ratio: f64,
}

impl StepCounters {
    /// Counts a round in which bonds break; returns the step and the round.
    pub(super) fn next_round(&mut self, n_bonds: usize) -> [usize; 2] {
        self.rounds += 1;
        self.broken_in_step += n_bonds;
        [self.step, self.rounds]
    }
}

/// Record of an equilibrium.
pub(super) fn step_record(
    problem: &Problem,
    solution: Solution<'_>,
    energies: &Energies,
    fragments: &Fragments,
    counters: StepCounters,
) -> StepRecord {
    let Solution {
        state,
        balanced,
        loads,
        motion,
        ..
    } = solution;
    let is_static = motion.is_none() && problem.has_contact_at_rest();
    let reactions = loads.reactions(state.load_factor, &balanced.internal.values);
    StepRecord {
        step: counters.step,
        load_factor: state.load_factor,
        part: loads.course().map_or(0, |it| it.part),
        factors: loads
            .course()
            .map_or_else(Vec::new, |it| it.factors(state.load_factor)),
        displacement: loads.control_displacement(state.load_factor, &state.displacement),
        reaction: loads.control_force(state.load_factor, &balanced.internal),
        stored_energy: balanced.stored_energy,
        released_energy: energies.released,
        contact: is_static.then_some(ContactAtRest {
            contact_energy: energies.in_contact,
            friction_energy: energies.friction,
        }),
        external_work: energies.external_work,
        energy_floor: balanced.energy_floor.max(energies.floor()),
        dissipated_energy: sum_over_bonds(&*problem.system, state.dissipated.iter().copied()),
        broken_bonds: counters.broken,
        broken_in_step: counters.broken_in_step,
        largest_ratio: counters.largest_ratio,
        rounds: counters.rounds,
        solves: counters.solves,
        fragments: fragments.len(),
        at_rest: counters.at_rest,
        negative_eigenvalues: counters.negative_eigenvalues,
        closed_pairs: balanced.closed.len(),
        motion: motion.map(|_| energies.in_motion()),
        contacts: balanced.touching.readings(&problem.contact),
        rigid_bodies: balanced.touching.rigid_states(&problem.contact),
        group_forces: group_forces(problem, state.load_factor, &reactions),
        probes: probe::values(&problem.probes, solution),
    }
}

/// Forces and moments of each group on the body: the reactions that count for it and its own given forces.
fn group_forces(problem: &Problem, load_factor: f64, reactions: &[f64]) -> Vec<Vec<f64>> {
    let layout = problem.system.layout;
    let groups = problem.loads.groups();
    let owners = groups_of_reactions(groups, layout);
    let numbered = groups.iter().enumerate();
    numbered
        .zip(problem.loads.given_resultants(load_factor))
        .map(|((number, group), mut sum)| {
            for &point in &group.points {
                for (sum, dof) in sum.iter_mut().zip(layout.range(point)) {
                    if owners[dof] == Some(number) {
                        *sum += reactions[dof];
                    }
                }
            }
            sum
        })
        .collect()
}

/// Largest utilisation of the intact bonds; 0 without criteria.
pub(super) fn largest_ratio(problem: &Problem, state: &State, balanced: &Balanced) -> f64 {
    largest_ratio_by(
        &problem.criteria_in(state, balanced),
        problem,
        state,
        balanced,
    )
}

/// Largest utilisation of the intact bonds by some criteria.
pub(super) fn largest_ratio_by(
    criteria: &CriteriaInState<'_>,
    problem: &Problem,
    state: &State,
    balanced: &Balanced,
) -> f64 {
    let ratio = (&state.intact, balanced.deformations.measured())
        .into_par_iter()
        .enumerate()
        .filter(|(_, (intact, _))| **intact)
        .map(|(bond, (_, deformation))| criteria.utilisation(bond, deformation))
        .reduce(|| 0.0, f64::max);
    problem.system.subdomain.max(ratio)
}
