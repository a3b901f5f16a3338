//! Records of the times of a run, as all drivers make them.

use serde::{Deserialize, Serialize};

use super::energies::Energies;
use super::way::LoadPoint;
use crate::balanced::Stability;
use crate::bond_numbers::sum_over_bonds;
use crate::connectivity::Fragments;
use crate::history::{ContactAtRest, StepRecord, Termination};
use crate::load_program::groups_of_reactions;
use crate::probe;
use crate::problem::Problem;
use crate::result_fields::Solution;

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

/// Results of the elastic solution.
#[derive(Clone, Serialize, Deserialize)]
pub(super) struct ElasticAnswer {
    /// Force over displacement of the control load, N/m; NaN where there is no equilibrium or nothing resists the load.
    pub(super) stiffness: f64,
    pub(super) first_break: Option<LoadPoint>,
    pub(super) stability: Option<Stability>,
}

impl ElasticAnswer {
    /// Without a solution.
    pub(super) const UNKNOWN: Self = Self {
        stiffness: f64::NAN,
        first_break: None,
        stability: None,
    };

    /// End of a run where the intact model is unstable, unless the problem allows that.
    pub(super) fn refused(&self, problem: &Problem) -> Option<Termination> {
        let stability = self.stability.filter(Stability::is_unstable)?;
        let Stability { negative, expected } = stability;
        let end = Termination::Unstable { negative, expected };
        (!problem.solver.allows_unstable).then_some(end)
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
    let (displacement, reaction) = problem.control(state, balanced);
    let reactions = loads.reactions(state.load_factor, &balanced.internal.values);
    StepRecord {
        step: counters.step,
        load_factor: state.load_factor,
        part: loads.course().map_or(0, |it| it.part),
        factors: loads
            .course()
            .map_or_else(Vec::new, |it| it.factors(state.load_factor)),
        displacement,
        reaction,
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
