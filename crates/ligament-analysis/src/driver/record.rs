//! Records and checkpoints of the times of a run, as all drivers make them.

use std::cell::Cell;

use ligament_model::failure::CriteriaInState;
use rayon::prelude::*;
use serde::{Deserialize, Serialize};

use super::energies::Energies;
use super::run_messages;
use crate::balanced::Balanced;
use crate::bond_numbers::{BondNumbers, sum_over_bonds};
use crate::connectivity::Fragments;
use crate::costs::Costs;
use crate::history::{
    ContactAtRest, LargestOverlap, Moment, Observer, ObserverError, Onward, Rates, StepRecord,
    Termination, View,
};
use crate::load_program::groups_of_reactions;
use crate::probe;
use crate::problem::Problem;
use crate::result_fields::Solution;
use crate::serial::Sink;
use crate::softened::SoftenedOfAll;
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

/// A body at a time of its run, as records and observers see it.
#[derive(Clone, Copy)]
pub(super) struct RunView<'a> {
    pub(super) problem: &'a Problem,
    pub(super) numbers: &'a BondNumbers,
    pub(super) fragments: &'a Fragments,
    pub(super) state: &'a State,
    pub(super) balanced: &'a Balanced,
    pub(super) energies: &'a Energies,
    pub(super) costs: &'a Costs,
    /// Velocities and accelerations of a motion; None in statics.
    pub(super) rates: Option<Rates<'a>>,
}

impl RunView<'_> {
    /// Record of the time.
    pub(super) fn record(&self, counters: StepCounters) -> StepRecord {
        let solution = Solution {
            motion: self.rates,
            ..self.problem.solution(self.state, self.balanced)
        };
        step_record(
            self.problem,
            solution,
            self.energies,
            self.fragments,
            counters,
        )
    }

    /// Passes a record to the observer; without `is_whole` displacements are known at supported and loaded points alone.
    pub(super) fn show(
        &self,
        record: &StepRecord,
        [is_last, is_whole]: [bool; 2],
        observer: &mut dyn Observer,
    ) -> Result<(), ObserverError> {
        let Self {
            problem,
            fragments,
            state,
            balanced,
            costs,
            ..
        } = *self;
        let criteria = problem.criteria_in(state, balanced);
        let view = View {
            softened: self.softened(),
            system: &*problem.system,
            state,
            balanced,
            loads: &*problem.loads,
            criteria: &criteria,
            fragments,
            costs,
            motion: self.rates,
            is_last,
            is_whole,
        };
        observer.step(record, &view)
    }

    /// Numbers of softened bonds. Collective.
    pub(super) fn softened(&self) -> SoftenedOfAll {
        SoftenedOfAll::in_state(self.state, self.numbers, &self.problem.system.ends)
    }

    /// Tells the observer where the faces of cracks overlap more than in the records before.
    pub(super) fn report_overlap(
        &self,
        step: usize,
        largest: &mut Option<LargestOverlap>,
        observer: &mut dyn Observer,
    ) -> Result<(), ObserverError> {
        let message =
            run_messages::overlap(self.problem, self.state, self.fragments, step, largest);
        message.map_or(Ok(()), |it| observer.message(it))
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
        ..
    } = solution;
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
        contact: problem.has_contact_at_rest().then_some(ContactAtRest {
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
        motion: None,
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

/// Offers a state to the observer as one from which the run can continue, by what `checkpoint` writes. Returns the reason why the run ends there:
/// `end`, or a stop by the observer. Collective.
pub(super) fn offer(
    observer: &mut dyn Observer,
    numbers: &BondNumbers,
    end: Option<Termination>,
    checkpoint: &dyn Fn(&mut dyn Sink),
) -> Result<Option<Termination>, ObserverError> {
    let asked = observer.asks(end.as_ref())?;
    let has_taken_part = Cell::new(false);
    let written = |out: &mut dyn Sink| {
        has_taken_part.set(true);
        checkpoint(out);
    };
    let all_take_part = numbers.subdomain().any(asked) && !numbers.subdomain().is_whole();
    let moment = Moment {
        end: end.as_ref(),
        checkpoint: &written,
    };
    let onward = observer.moment(&moment)?;
    if all_take_part && !has_taken_part.get() {
        checkpoint(&mut ());
    }
    Ok(end.or_else(|| (onward == Onward::Stop).then_some(Termination::Stopped)))
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
