//! Checkpoints: the progress of a run beside its state, and the run restored from one.
//!
//! A checkpoint has the kind of the way and its position, the state, the progress, the equations, the energies and check values.

use std::io::Read;

use serde::{Deserialize, Serialize};

use super::energies::Energies;
use super::record::ElasticAnswer;
use super::way::{Outcome, Way};
use crate::balanced::Balanced;
use crate::bond_numbers::BondNumbers;
use crate::checkpoint::CheckpointError;
use crate::equilibrium::Equilibrium;
use crate::error::SetupError;
use crate::history::{LargestOverlap, Observer, StepRecord};
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
    /// Whether a part has turned beyond small angles in a motion.
    pub(super) has_turned: bool,
}

impl Progress {
    /// Progress at the beginning of a run of a problem, with what an elastic solution told.
    pub(super) fn new(problem: &Problem, elastic: ElasticAnswer) -> Self {
        Self {
            elastic,
            broken: 0,
            history: Vec::new(),
            peak: 0.0,
            energy_was_negative: false,
            solves: [0; 2],
            negative_eigenvalues: 0,
            part_start: problem
                .loads
                .course()
                .map_or_else(Vec::new, LoadCourse::start),
            part: 0,
            control_start: 0.0,
            largest_force: 0.0,
            overlap: None,
            has_turned: false,
        }
    }

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

/// Kind of a way, by which a checkpoint begins.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub(super) enum WayKind {
    ExactPath,
    LoadSteps,
    CentralDifferences,
    Newmark,
}

/// A run as a checkpoint restores it, before it has an observer, with its position on its way.
pub(super) struct RestoredRun<P, E = Equilibrium> {
    pub(super) problem: Problem,
    pub(super) position: P,
    pub(super) state: State,
    pub(super) progress: Progress,
    pub(super) equations: E,
    /// The state in balance.
    pub(super) balanced: Balanced,
    pub(super) energies: Energies,
}

/// Global numbers of the bonds of a checkpoint, and its state.
pub(super) type NumberedState = (BondNumbers, State);

impl<P: Serial, E> RestoredRun<P, E> {
    /// Restores the run of a checkpoint of a way of this kind; `equations` restores them at a position, with their state in balance.
    pub(super) fn read(
        kind: WayKind,
        problem: &Problem,
        from: &mut dyn Read,
        equations: impl FnOnce(
            (&Problem, &P),
            NumberedState,
            &mut dyn Read,
        ) -> Result<(E, State, Balanced), SetupError>,
    ) -> Result<Self, SetupError> {
        let damaged = CheckpointError::Damaged;
        if WayKind::read(from).map_err(damaged)? != kind {
            return Err(CheckpointError::OtherDriver.into());
        }
        let position = P::read(from).map_err(damaged)?;
        let numbers = BondNumbers::new(&*problem.system)?;
        let n_components = problem.system.layout.components.len();
        let state = State::read((&numbers, n_components), &problem.criteria, from)?;
        let progress: Progress = Serial::read(from).map_err(damaged)?;
        let problem = progress
            .problem(problem)
            .ok_or(CheckpointError::OtherModel)?;
        let broken = numbers.count(state.intact.iter().map(|intact| !intact));
        let (equations, state, balanced) =
            equations((&problem, &position), (numbers, state), from)?;
        let energies = Energies::read(&problem, &state, &balanced, from)?;
        let values_then = CheckValues::read(from).map_err(damaged)?;
        require_end(from).map_err(damaged)?;
        if broken != progress.broken {
            return Err(damaged(Damaged).into());
        }
        if !CheckValues::new(&problem, &balanced).agrees(&values_then) {
            return Err(CheckpointError::OtherArithmetic.into());
        }
        Ok(Self {
            problem,
            position,
            state,
            progress,
            equations,
            balanced,
            energies,
        })
    }
}

impl<P: Serial> RestoredRun<P> {
    /// Restores a run of equilibria up to a step, whose number the position gives where it is one.
    pub(super) fn of_equilibria(
        kind: WayKind,
        (problem, energy_tolerance): (&Problem, f64),
        from: &mut dyn Read,
        step: impl FnOnce(&P) -> Option<usize>,
    ) -> Result<Self, SetupError> {
        let restored = Self::read(kind, problem, from, |(problem, _), numbered, from| {
            Equilibrium::restored(problem, energy_tolerance, numbered, from)
        })?;
        // Redundant data agree: the numbers of records and solves.
        let Progress {
            solves: [last, recorded],
            ref history,
            ..
        } = restored.progress;
        let agrees = step(&restored.position) == Some(history.len())
            && recorded <= last
            && last <= restored.equations.costs().solves;
        match agrees {
            true => Ok(restored),
            false => Err(CheckpointError::Damaged(Damaged).into()),
        }
    }
}

/// Gives the way of a restored run to an observer.
type Observed = dyn for<'a> FnOnce(&'a mut (dyn Observer + 'a)) -> Box<dyn Way + 'a>;

/// A restored run, ready to continue.
pub struct Restored {
    load_factor: f64,
    broken_bonds: usize,
    observed: Box<Observed>,
}

impl Restored {
    /// A restored run whose way `observed` gives to an observer.
    pub(super) fn new<P: 'static, E: 'static>(
        run: RestoredRun<P, E>,
        observed: impl for<'a> FnOnce(
            RestoredRun<P, E>,
            &'a mut (dyn Observer + 'a),
        ) -> Box<dyn Way + 'a>
        + 'static,
    ) -> Self {
        Self {
            load_factor: run.state.load_factor,
            broken_bonds: run.progress.broken,
            observed: Box::new(move |observer| observed(run, observer)),
        }
    }

    /// Load factor of the restored state, in a motion the time, s.
    pub fn load_factor(&self) -> f64 {
        self.load_factor
    }

    /// Number of bonds broken up to the restored state.
    pub fn broken_bonds(&self) -> usize {
        self.broken_bonds
    }

    /// Continues the run as if it had never stopped.
    ///
    /// # Errors
    ///
    /// If the run or the observer fails.
    pub fn resume(self, observer: &mut dyn Observer) -> Result<Outcome, SetupError> {
        (self.observed)(observer).follow()
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
