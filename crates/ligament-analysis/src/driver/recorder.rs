//! Bookkeeping that every driver shares: energies, records and the peak.

use ligament_model::element::beam::BondDeformation;

use super::Problem;
use crate::connectivity::Fragments;
use crate::equilibrium::{Balanced, Stability};
use crate::history::{StepRecord, Termination};
use crate::state::State;
use crate::stiffness::Costs;
use crate::unknowns::COMPONENTS;

/// How a run went.
#[derive(Debug, Clone, PartialEq)]
pub struct Outcome {
    /// Records of all load steps.
    pub history: Vec<StepRecord>,
    /// The last state.
    pub state: State,
    /// Why it ended.
    pub termination: Termination,
    /// Force over displacement of the control load before the first breakage, N/m.
    pub elastic_stiffness: f64,
    /// Where the first bond breaks, if the loading gets there.
    pub first_break: Option<LoadPoint>,
    /// Inertia of the intact stiffness, where it may be indefinite.
    pub stability: Option<Stability>,
    /// What the equations cost.
    pub costs: Costs,
}

/// A point of the force-displacement curve.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LoadPoint {
    /// Displacement of the control load, m.
    pub displacement: f64,
    /// Its force, N.
    pub reaction: f64,
    /// Load factor.
    pub load_factor: f64,
}

impl Outcome {
    /// The load step at rest with the largest reaction.
    pub fn peak(&self) -> Option<LoadPoint> {
        let at_rest = self.history.iter().filter(|step| step.at_rest);
        let largest = at_rest.reduce(|best, step| {
            if step.reaction > best.reaction {
                step
            } else {
                best
            }
        });
        largest.map(LoadPoint::from)
    }

    /// The load step at rest with the largest reaction before the reaction first fell by more than `drop` of it.
    ///
    /// A body that is split may carry more load again, as the halves of a disk between platens do; this is the strength
    /// of the whole body. It is the peak where the load never falls so far.
    pub fn first_peak(&self, drop: f64) -> Option<LoadPoint> {
        let mut best: Option<&StepRecord> = None;
        for step in self.history.iter().filter(|step| step.at_rest) {
            match best {
                Some(peak) if step.reaction < (1.0 - drop) * peak.reaction => break,
                Some(peak) if step.reaction <= peak.reaction => {}
                _ => best = Some(step),
            }
        }
        best.map(LoadPoint::from)
    }
}

impl From<&StepRecord> for LoadPoint {
    fn from(step: &StepRecord) -> Self {
        Self {
            displacement: step.displacement,
            reaction: step.reaction,
            load_factor: step.load_factor,
        }
    }
}

/// Energies along the path.
///
/// Between two states of equilibrium with the same bonds everything is linear, so the trapezoidal rule gives the work
/// of supports and loads exactly; a breakage at fixed load releases 1/2 u^T K_b u' for each broken bond, with u before
/// and u' after it.
#[derive(Debug, Clone, Default)]
pub(super) struct Energies {
    pub(super) external_work: f64,
    pub(super) released: f64,
    applied_forces: Vec<f64>,
    displacement: Vec<f64>,
}

impl Energies {
    /// Adds the work from the last state to this one.
    pub(super) fn add_work(&mut self, problem: &Problem<'_>, state: &State, balanced: &Balanced) {
        let applied: Vec<f64> = (0..state.displacement.len())
            .map(|dof| match problem.boundary.prescribed[dof] {
                Some(_) => balanced.internal.values[dof],
                None => problem.boundary.force[dof] * state.load_factor,
            })
            .collect();
        if self.displacement.is_empty() {
            self.displacement = vec![0.0; applied.len()];
            self.applied_forces = vec![0.0; applied.len()];
        }
        self.external_work += (0..applied.len())
            .map(|dof| {
                let mean_force = 0.5 * (applied[dof] + self.applied_forces[dof]);
                mean_force * (state.displacement[dof] - self.displacement[dof])
            })
            .sum::<f64>();
        self.applied_forces = applied;
        self.displacement.clone_from(&state.displacement);
    }

    /// Adds what the breakage of bonds released, given their deformations before it.
    pub(super) fn add_released(
        &mut self,
        problem: &Problem<'_>,
        broken: &[(u32, BondDeformation)],
        balanced: &Balanced,
    ) {
        self.released += broken
            .iter()
            .map(|(bond, before)| {
                let bond = *bond as usize;
                problem
                    .system
                    .element(bond)
                    .mutual_energy(before, &balanced.deformations[bond])
            })
            .sum::<f64>();
    }
}

/// Counters of a load step.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct StepCounters {
    pub(super) step: usize,
    pub(super) broken_in_step: usize,
    pub(super) rounds: usize,
    pub(super) solves: usize,
    pub(super) at_rest: bool,
    pub(super) negative_eigenvalues: usize,
}

/// The record of a state of equilibrium.
pub(super) fn step_record(
    problem: &Problem<'_>,
    state: &State,
    balanced: &Balanced,
    energies: &Energies,
    fragments: &Fragments,
    critical_stretch: &[f64],
    counters: StepCounters,
) -> StepRecord {
    let control = &problem.boundary.control;
    let reactions = problem
        .boundary
        .reactions(state.load_factor, &balanced.internal.values);
    StepRecord {
        step: counters.step,
        load_factor: state.load_factor,
        displacement: control.displacement(state.load_factor, &state.displacement),
        reaction: control.force(state.load_factor, &reactions),
        stored_energy: balanced.stored_energy,
        released_energy: energies.released,
        external_work: energies.external_work,
        broken_bonds: state.broken_bonds(),
        broken_in_step: counters.broken_in_step,
        largest_ratio: largest_ratio(state, balanced, critical_stretch),
        rounds: counters.rounds,
        solves: counters.solves,
        fragments: fragments.points.len(),
        at_rest: counters.at_rest,
        negative_eigenvalues: counters.negative_eigenvalues,
        group_forces: group_forces(problem, state.load_factor, &reactions),
        probes: problem
            .probes
            .iter()
            .map(|probe| probe.reading.value(problem.system, state, balanced))
            .collect(),
    }
}

/// What each group exerts on the body: the reactions at its points and its own given forces.
fn group_forces(
    problem: &Problem<'_>,
    load_factor: f64,
    reactions: &[f64],
) -> Vec<[f64; COMPONENTS]> {
    let groups = problem.boundary.groups.iter();
    groups
        .map(|group| {
            let given = group.force.map(|force| load_factor * force);
            group.points.iter().fold(given, |sum, &point| {
                let reaction = &reactions[COMPONENTS * point as usize..];
                [0, 1, 2].map(|component| sum[component] + reaction[component])
            })
        })
        .collect()
}

/// Largest s/s_0 over the intact bonds; 0 without critical stretches.
pub(super) fn largest_ratio(state: &State, balanced: &Balanced, critical_stretch: &[f64]) -> f64 {
    critical_stretch
        .iter()
        .enumerate()
        .filter(|&(bond, _)| state.intact[bond])
        .map(|(bond, limit)| balanced.deformations[bond].stretch / limit)
        .fold(0.0, f64::max)
}
