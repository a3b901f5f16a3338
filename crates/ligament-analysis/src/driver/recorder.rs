//! Bookkeeping that every driver shares: energies and records.

use ligament_model::element::{BondDeformation, Remaining};
use ligament_model::failure::Criteria;
use rayon::prelude::*;

use super::Problem;
use crate::boundary::Boundary;
use crate::breakage::Breakage;
use crate::connectivity::Fragments;
use crate::equilibrium::Balanced;
use crate::history::StepRecord;
use crate::state::State;
use crate::unknowns::COMPONENTS;

/// Energies along the path.
///
/// Between two states of equilibrium with the same bonds everything is linear, so the trapezoidal rule gives the work
/// of supports and loads exactly; a breakage at fixed load releases 1/2 u^T K_b u' for each broken bond, with u before
/// and u' after it. A bond whose secant falls from omega to omega' releases the same with (omega - omega') K_b: with the
/// trapezoidal rule that leaves nothing over, whatever the step.
#[derive(Debug, Clone)]
pub(super) struct Energies {
    pub(super) external_work: f64,
    pub(super) released: f64,
    loaded: Vec<Loaded>,
    /// Load factor and [`InternalForces::thermal`] in the last state.
    thermal: [f64; 2],
    /// Deformations and what was left of the bonds in the last state; empty where no bond softens.
    last: Vec<(BondDeformation, Remaining)>,
}

/// A degree of freedom that something moves or loads, with its force and displacement in the last state.
#[derive(Debug, Clone)]
struct Loaded {
    degree_of_freedom: usize,
    force: f64,
    displacement: f64,
}

impl Energies {
    /// Those of the unloaded body.
    pub(super) fn unloaded(boundary: &Boundary) -> Self {
        let loaded = boundary.loaded_degrees_of_freedom();
        Self {
            external_work: 0.0,
            released: 0.0,
            thermal: [0.0; 2],
            last: Vec::new(),
            loaded: (loaded.into_iter())
                .map(|degree_of_freedom| Loaded {
                    degree_of_freedom,
                    force: 0.0,
                    displacement: 0.0,
                })
                .collect(),
        }
    }

    /// Adds the work from the last state to this one.
    pub(super) fn add_work(&mut self, problem: &Problem<'_>, state: &State, balanced: &Balanced) {
        let mut work = 0.0;
        for loaded in &mut self.loaded {
            let dof = loaded.degree_of_freedom;
            let force = match problem.boundary.prescribed[dof] {
                Some(_) => balanced.internal.values[dof],
                None => problem.boundary.force[dof] * state.load_factor,
            };
            let mean_force = 0.5 * (force + loaded.force);
            work += mean_force * (state.displacement[dof] - loaded.displacement);
            (loaded.force, loaded.displacement) = (force, state.displacement[dof]);
        }
        let [load_factor, force] = self.thermal;
        self.thermal = [state.load_factor, balanced.internal.thermal];
        work += 0.5 * (force + self.thermal[1]) * (state.load_factor - load_factor);
        self.external_work += work;
    }

    /// Adds what a breakage released, and what softening did since the last state.
    pub(super) fn add_released(
        &mut self,
        problem: &Problem<'_>,
        state: &State,
        breakage: &Breakage,
        balanced: &Balanced,
    ) {
        let expansion = problem.boundary.thermal_strain_at(state.load_factor);
        let remaining = &state.softening.remaining;
        self.released += breakage.released(&state.displacement, expansion);
        for (bond, (before, left_before)) in self.last.iter().enumerate() {
            let lost = left_before.lost(&remaining[bond]);
            if state.intact[bond] && lost != Remaining::NOTHING {
                let both = [before, &balanced.deformations[bond]];
                self.released += (problem.system).mutual_energy(&state.intact, bond, &lost, both);
            }
        }
        let now = balanced.deformations.iter().zip(remaining);
        self.last.clear();
        self.last
            .extend(now.map(|(deformation, left)| (*deformation, *left)));
    }
}

/// Counters of a load step.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct StepCounters {
    pub(super) step: usize,
    pub(super) broken: usize,
    pub(super) broken_in_step: usize,
    pub(super) rounds: usize,
    pub(super) solves: usize,
    pub(super) at_rest: bool,
    pub(super) negative_eigenvalues: usize,
    pub(super) largest_ratio: f64,
}

/// The record of a state of equilibrium.
pub(super) fn step_record(
    problem: &Problem<'_>,
    state: &State,
    balanced: &Balanced,
    energies: &Energies,
    fragments: &Fragments,
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
        reaction: problem
            .boundary
            .control_force(state.load_factor, &balanced.internal),
        stored_energy: balanced.stored_energy,
        released_energy: energies.released,
        external_work: energies.external_work,
        dissipated_energy: state.dissipated.iter().sum(),
        broken_bonds: counters.broken,
        broken_in_step: counters.broken_in_step,
        largest_ratio: counters.largest_ratio,
        rounds: counters.rounds,
        solves: counters.solves,
        fragments: fragments.points.len(),
        at_rest: counters.at_rest,
        negative_eigenvalues: counters.negative_eigenvalues,
        group_forces: group_forces(problem, state.load_factor, &reactions),
        probes: problem
            .probes
            .iter()
            .map(|probe| probe.reading.value(problem, state, balanced))
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

/// Largest utilisation of the intact bonds; 0 without criteria.
pub(super) fn largest_ratio(state: &State, balanced: &Balanced, criteria: &Criteria) -> f64 {
    (&state.intact, &balanced.deformations)
        .into_par_iter()
        .enumerate()
        .filter(|(_, (intact, _))| **intact)
        .map(|(bond, (_, deformation))| criteria.utilisation(bond, deformation))
        .reduce(|| 0.0, f64::max)
}
