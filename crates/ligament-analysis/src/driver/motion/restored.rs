//! Progress of a motion, and a motion restored from a checkpoint.

use super::body::Body;
use super::clock::Clock;
use super::inertia::Velocities;
use crate::bond_numbers::BondNumbers;
use crate::checkpoint::CheckpointError;
use crate::driver::course::{CheckValues, with_begun};
use crate::driver::recorder::Energies;
use crate::error::SetupError;
use crate::history::{InMotion, LargestOverlap, StepRecord};
use crate::motion::MotionProblem;
use crate::motion::contact::{ContactForces, ContactState};
use crate::serial;
use crate::serial::{Damaged, Serial};
use crate::state::State;

/// First byte of the checkpoint of a motion; those of statics begin with 0 or 1.
const MOTION: u8 = 2;

/// Progress of a motion.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Progress {
    pub(super) clock: Clock,
    /// Energies and number of time steps.
    pub(super) motion: InMotion,
    /// Forces of damping at the time (n_degrees_of_freedom), N and N m; empty where nothing damps.
    pub(super) damping_forces: Vec<f64>,
    pub(super) history: Vec<StepRecord>,
    /// Largest overlap of crack faces so far.
    pub(super) overlap: Option<LargestOverlap>,
}

serial!(Progress {
    clock,
    motion,
    damping_forces,
    history,
    overlap,
});

impl Progress {
    pub(super) fn at_start(clock: Clock) -> Self {
        Self {
            clock,
            motion: InMotion::default(),
            damping_forces: Vec::new(),
            history: Vec::new(),
            overlap: None,
        }
    }
}

/// Motion restored from a checkpoint, at a row of its history.
pub struct Restored {
    pub(super) problem: MotionProblem,
    pub(super) body: Body,
    pub(super) velocities: Velocities,
    pub(super) energies: Energies,
    pub(super) progress: Progress,
    pub(super) contacts: Option<ContactForces>,
}

impl Restored {
    /// Time of the restored state, s.
    pub fn time(&self) -> f64 {
        self.body.state.load_factor
    }

    /// Number of bonds broken up to the restored state.
    pub fn broken_bonds(&self) -> usize {
        self.body.broken
    }

    /// Appends a motion, from which it continues with the same bits.
    pub(super) fn write(
        body: &Body,
        velocities: &Velocities,
        energies: &Energies,
        (progress, contacts): (&Progress, Option<&ContactForces>),
    ) -> Vec<u8> {
        let mut out = Vec::new();
        MOTION.write(&mut out);
        body.state.write(&body.numbers, &mut out);
        velocities.write(&mut out);
        progress.write(&mut out);
        contacts.map(|it| it.state().clone()).write(&mut out);
        body.costs.write(&mut out);
        energies.write(&mut out);
        CheckValues::new(&body.problem, &body.balanced).write(&mut out);
        out
    }

    /// Restores the motion of a checkpoint.
    pub(super) fn read(problem: &MotionProblem, mut checkpoint: &[u8]) -> Result<Self, SetupError> {
        let from = &mut checkpoint;
        let damaged = CheckpointError::Damaged;
        if u8::read(from).map_err(damaged)? != MOTION {
            return Err(CheckpointError::OtherDriver.into());
        }
        let numbers = BondNumbers::new(&*problem.problem.system)?;
        let state = State::read(&numbers, from)?;
        let system = &*problem.problem.system;
        let n_bonds = system.ends().len();
        let n = state.displacement.len();
        let velocities: Velocities = Serial::read(from).map_err(damaged)?;
        let fits = state.fits(system, n_bonds, &problem.problem.criteria);
        if !fits || [velocities.half.len(), velocities.acceleration.len()] != [n; 2] {
            return Err(CheckpointError::OtherModel.into());
        }
        let progress: Progress = Serial::read(from).map_err(damaged)?;
        let contact: Option<ContactState> = Serial::read(from).map_err(damaged)?;
        let can_be = contact.as_ref().map(|it| it.fits(&problem.contact));
        if !can_be.unwrap_or(problem.contact.is_empty()) {
            return Err(CheckpointError::OtherModel.into());
        }
        let costs = Serial::read(from).map_err(damaged)?;
        let with_begun = with_begun(&problem.problem, &state)?;
        let mut body = Body::new(&with_begun, numbers, Some(state));
        body.costs = costs;
        body.measure();
        let resumed =
            |it| ContactForces::resumed(problem.contact.clone(), &body.state.displacement, it);
        let contacts = contact.map(resumed);
        if let Some(contacts) = &contacts {
            contacts.add_forces(-1.0, &mut body.balanced.internal.values);
        }
        let energies = Energies::read(&body.problem, &body.state, &body.balanced, from)?;
        let values_then = CheckValues::read(from).map_err(damaged)?;
        if !from.is_empty() {
            return Err(damaged(Damaged).into());
        }
        if !CheckValues::new(&body.problem, &body.balanced).agrees(&values_then) {
            return Err(CheckpointError::OtherArithmetic.into());
        }
        Ok(Self {
            problem: problem.clone(),
            body,
            velocities,
            energies,
            progress,
            contacts,
        })
    }
}
