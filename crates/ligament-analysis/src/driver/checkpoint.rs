//! Progress of a run: contents of a checkpoint other than the state, and the run restored from one.

use std::io::Read;

use serde::{Deserialize, Serialize};

use super::energies::Energies;
use super::record::StepCounters;
use super::start::ElasticAnswer;
use crate::balanced::Balanced;
use crate::bond_numbers::BondNumbers;
use crate::checkpoint::CheckpointError;
use crate::equilibrium::Equilibrium;
use crate::error::SetupError;
use crate::history::{LargestOverlap, StepRecord};
use crate::load_program::LoadCourse;
use crate::problem::Problem;
use crate::serial::{Damaged, Serial, require_end};
use crate::state::State;

/// Progress of a run.
#[derive(Serialize, Deserialize)]
pub(super) struct Progress {
    pub(super) elastic: ElasticAnswer,
    pub(super) broken: usize,
    pub(super) history: Vec<StepRecord>,
    pub(super) peak: f64,
    pub(super) energy_was_negative: bool,
    /// Numbers of solves up to the last equilibrium and up to the last record.
    pub(super) solves: [usize; 2],
    pub(super) negative_eigenvalues: usize,
    /// Load factors at the start of the present part of a programme; empty without a programme.
    pub(super) part_start: Vec<f64>,
    /// Index of the present part of the programme; 0 without a programme.
    pub(super) part: usize,
    /// Value of the controlling motion or energy at the start of the present part, m, rad or J; 0 without control.
    pub(super) control_start: f64,
    /// Largest force at a point in any record, N.
    pub(super) largest_force: f64,
    /// Largest overlap of crack faces so far.
    pub(super) overlap: Option<LargestOverlap>,
}

impl Progress {
    /// Problem with the loads of the present part of its programme; None where the progress belongs to another programme.
    fn problem(&self, problem: &Problem) -> Option<Problem> {
        let mut problem = problem.clone();
        let Some(first) = problem.loads.course() else {
            return self.part_start.is_empty().then_some(problem);
        };
        let programme = first.programme.clone();
        let fits =
            self.part < programme.parts.len() && self.part_start.len() == programme.names.len();
        let here = fits.then(|| LoadCourse::new(programme, self.part, &self.part_start))?;
        problem.loads = problem.loads.in_course(here)?;
        Some(problem)
    }
}

/// Position of a driver.
#[derive(Serialize, Deserialize)]
pub(super) enum Place {
    /// Before an event of the exact path.
    Event(ToEvent),
    /// Within a load step.
    LoadStep(InLoadStep),
}

/// Position before an event.
#[derive(Serialize, Deserialize)]
pub(super) struct ToEvent {
    /// Number of the event.
    pub(super) step: usize,
    /// Rate of the displacements with the load factor, shape (n_degrees_of_freedom); empty where they are proportional to it.
    pub(super) growth: Vec<f64>,
}

/// Position within a load step.
#[derive(Serialize, Deserialize)]
pub(super) struct InLoadStep {
    pub(super) counters: StepCounters,
    /// Load factors of the steps up to the present one, that of the unloaded body first.
    pub(super) load_factors: Vec<f64>,
}

/// A restored run, in equilibrium and ready to continue.
pub struct Restored {
    pub(super) problem: Problem,
    pub(super) place: Place,
    pub(super) state: State,
    pub(super) progress: Progress,
    pub(super) equilibrium: Equilibrium,
    pub(super) balanced: Balanced,
    pub(super) energies: Energies,
}

impl Restored {
    /// Load factor of the restored state.
    pub fn load_factor(&self) -> f64 {
        self.state.load_factor
    }

    /// Number of bonds broken up to the restored state.
    pub fn broken_bonds(&self) -> usize {
        self.progress.broken
    }

    /// Restores the run of a checkpoint.
    pub(super) fn read(
        problem: &Problem,
        energy_tolerance: f64,
        from: &mut dyn Read,
    ) -> Result<Self, SetupError> {
        let damaged = CheckpointError::Damaged;
        let place = Serial::read(from).map_err(damaged)?;
        let numbers = BondNumbers::new(&*problem.system)?;
        let n_components = problem.system.layout.components.len();
        let state = State::read((&numbers, n_components), &problem.criteria, from)?;
        let progress: Progress = Serial::read(from).map_err(damaged)?;
        let problem = progress
            .problem(problem)
            .ok_or(CheckpointError::OtherModel)?;
        let (equilibrium, state, balanced) =
            Equilibrium::restored(&problem, energy_tolerance, (numbers, state), from)?;
        let energies = Energies::read(&problem, &state, &balanced, from)?;
        let proof_then = CheckValues::read(from).map_err(damaged)?;
        let restored = Self {
            problem,
            place,
            state,
            progress,
            equilibrium,
            balanced,
            energies,
        };
        require_end(from).map_err(damaged)?;
        if !restored.agrees() {
            return Err(damaged(Damaged).into());
        }
        let proof_now = CheckValues::new(&restored.problem, &restored.balanced);
        if !proof_now.agrees(&proof_then) {
            return Err(CheckpointError::OtherArithmetic.into());
        }
        Ok(restored)
    }

    /// Whether redundant data agree: the numbers of records, broken bonds and solves.
    fn agrees(&self) -> bool {
        let step = match &self.place {
            Place::Event(it) => it.step,
            Place::LoadStep(it) => it.counters.step,
        };
        let is_in_steps = match &self.place {
            Place::Event(it) => it.step > 0,
            Place::LoadStep(it) => it.load_factors.len().checked_sub(1) == Some(step),
        };
        let Progress {
            solves: [last, recorded],
            broken,
            ..
        } = self.progress;
        is_in_steps
            && self.progress.history.len() == step
            && broken == self.equilibrium.broken_bonds(&self.state)
            && recorded <= last
            && last <= self.equilibrium.costs().solves
    }
}

/// Relative difference of sums over the bonds that is accepted between different numbers of processes.
const OTHER_SUMS: f64 = 1e-9;

/// Check values of an equilibrium, which hardly agree for another one.
#[derive(Serialize, Deserialize)]
pub(super) struct CheckValues {
    /// Number of processes over which the body is divided; 0 where one has all of it.
    n_ranks: usize,
    stored_energy: f64,
    force_scale: f64,
}

impl CheckValues {
    /// Check values of an equilibrium of a problem.
    pub(super) fn new(problem: &Problem, balanced: &Balanced) -> Self {
        let subdomain = &problem.system.subdomain;
        Self {
            n_ranks: subdomain.n_ranks(),
            stored_energy: balanced.stored_energy,
            force_scale: balanced.internal.force_scale,
        }
    }

    /// Whether the check values agree, bit for bit where the number of processes is equal.
    pub(super) fn agrees(&self, then: &Self) -> bool {
        let numbers = |it: &Self| [it.stored_energy, it.force_scale];
        let mut both = numbers(self).into_iter().zip(numbers(then));
        let is_same = self.n_ranks == then.n_ranks;
        both.all(|(now, then)| match is_same {
            true => now.to_bits() == then.to_bits(),
            false => (now - then).abs() <= OTHER_SUMS * then.abs(),
        })
    }
}
