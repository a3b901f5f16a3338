//! Checkpoints of motions: what is written at a row, and a motion restored from it.

use std::io::Read;

use super::body::Body;
use super::inertia::Velocities;
use super::motion_state::{Motion, MotionState, free_masses};
use super::record::{EXPLICIT, IMPLICIT, Progress};
use super::stepping::{Pace, Stepping, of_step, scheme};
use crate::bond_numbers::BondNumbers;
use crate::checkpoint::CheckpointError;
use crate::costs::Costs;
use crate::driver::checkpoint::CheckValues;
use crate::driver::energies::Energies;
use crate::equilibrium::Equilibrium;
use crate::error::SetupError;
use crate::motion::{MotionProblem, MotionSettings};
use crate::problem::Problem;
use crate::serial::{Serial, Sink, require_end};
use crate::state::State;

/// Motion in explicit steps at a time.
pub(super) struct ExplicitMotion {
    pub(super) problem: MotionProblem,
    pub(super) body: Body,
    pub(super) velocities: Velocities,
    pub(super) energies: Energies,
    pub(super) progress: Progress,
}

impl ExplicitMotion {
    /// Appends the motion at a row, with its forces: inertia and damping are in them, and do not follow from the state.
    pub(super) fn write(body: &Body, velocities: &Velocities, out: &mut dyn Sink) {
        body.state.write(&body.numbers, out);
        velocities.write(out);
        body.costs.write(out);
        CheckValues::new(&body.problem, &body.balanced).write(out);
        let internal = &body.balanced.internal;
        internal.values.write(out);
        internal.on_rigid_bodies.write(out);
    }

    /// Restores the motion of a problem at a row.
    fn read(
        problem: &MotionProblem,
        progress: Progress,
        from: &mut dyn Read,
    ) -> Result<Self, SetupError> {
        let damaged = CheckpointError::Damaged;
        let numbers = BondNumbers::new(&*problem.problem.system)?;
        let n_components = problem.problem.system.layout.components.len();
        let state = State::read((&numbers, n_components), &problem.problem.criteria, from)?;
        let velocities: Velocities = Serial::read(from).map_err(damaged)?;
        let costs = Serial::read(from).map_err(damaged)?;
        let system = &*problem.problem.system;
        let lengths = [velocities.half.len(), velocities.acceleration.len()];
        let fits = state.fits(system, system.ends.len(), &problem.problem.criteria);
        let contact = &problem.problem.contact;
        let n_rigid = contact.rigid_bodies.len();
        let can_touch = state.surfaces.fits(contact) && velocities.rigid.len() == n_rigid;
        if !fits || !can_touch || lengths != [state.displacement.len(); 2] {
            return Err(CheckpointError::OtherModel.into());
        }
        let mut body = Body::new(&problem.problem, numbers, Some(state));
        body.costs = costs;
        body.measure();
        let values_then = CheckValues::read(from).map_err(damaged)?;
        if !CheckValues::new(&body.problem, &body.balanced).agrees(&values_then) {
            return Err(CheckpointError::OtherArithmetic.into());
        }
        let values: Vec<f64> = Serial::read(from).map_err(damaged)?;
        if values.len() != body.state.displacement.len() {
            return Err(CheckpointError::OtherModel.into());
        }
        body.balanced.internal.values = values;
        body.balanced.internal.on_rigid_bodies = Serial::read(from).map_err(damaged)?;
        let energies = Energies::read(&problem.problem, &body.state, &body.balanced, from)?;
        Ok(Self {
            problem: problem.clone(),
            body,
            velocities,
            energies,
            progress,
        })
    }
}

/// Motion in implicit steps at a time.
pub(super) struct ImplicitMotion {
    pub(super) problem: MotionProblem,
    pub(super) here: MotionState,
    pub(super) stepping: Stepping,
    pub(super) pace: Pace,
    pub(super) energies: Energies,
    pub(super) progress: Progress,
}

impl ImplicitMotion {
    /// Appends the motion at a row.
    pub(super) fn write(
        problem: &Problem,
        here: &MotionState,
        (stepping, pace): (&Stepping, Pace),
        out: &mut dyn Sink,
    ) {
        here.state.write(stepping.equilibrium.numbers(), out);
        here.motion.write(out);
        pace.write(out);
        stepping.costs.write(out);
        stepping.equilibrium.write(out);
        CheckValues::new(problem, &here.balanced).write(out);
    }

    /// Restores the motion of a problem at a row.
    fn read(
        problem: &MotionProblem,
        settings: &MotionSettings,
        progress: Progress,
        from: &mut dyn Read,
    ) -> Result<Self, SetupError> {
        let clock = &progress.clock;
        let damaged = CheckpointError::Damaged;
        let numbers = BondNumbers::new(&*problem.problem.system)?;
        let n_components = problem.problem.system.layout.components.len();
        let state = State::read((&numbers, n_components), &problem.problem.criteria, from)?;
        let motion: Motion = Serial::read(from).map_err(damaged)?;
        let pace: Pace = Serial::read(from).map_err(damaged)?;
        let costs: Costs = Serial::read(from).map_err(damaged)?;
        let n = problem.problem.system.layout.n_degrees_of_freedom();
        let n_rigid = problem.problem.contact.rigid_bodies.len();
        let has_rates = motion.rigid.is_empty() || motion.rigid.len() == n_rigid;
        if !motion.fits(n) || !has_rates || pace.halvings > pace.most_halvings(clock) {
            return Err(CheckpointError::OtherModel.into());
        }
        let masses = free_masses(problem, settings.rotary_inertia);
        let scheme = scheme(settings, clock, pace);
        let (of_step, restraints) = of_step(problem, scheme, &masses);
        let tolerance = settings.breakages.energy_tolerance;
        let (equilibrium, state, balanced) =
            Equilibrium::restored(&of_step, tolerance, (numbers, state), from)?;
        let values_then = CheckValues::read(from).map_err(damaged)?;
        if !CheckValues::new(&of_step, &balanced).agrees(&values_then) {
            return Err(CheckpointError::OtherArithmetic.into());
        }
        let mut here = MotionState {
            broken: equilibrium.broken_bonds(&state),
            state,
            balanced,
            motion,
        };
        here.balance_forces(&problem.problem, &masses);
        let stepping = Stepping {
            scheme,
            restraints,
            equilibrium,
            costs,
        };
        let energies = Energies::read(&problem.problem, &here.state, &here.balanced, from)?;
        Ok(Self {
            problem: problem.clone(),
            here,
            stepping,
            pace,
            energies,
            progress,
        })
    }
}

/// Motion restored from a checkpoint, at a row of its history.
pub struct Restored(pub(super) RestoredMotion);

/// Motion of each scheme.
pub(super) enum RestoredMotion {
    Explicit(Box<ExplicitMotion>),
    Implicit(Box<ImplicitMotion>),
}

impl Restored {
    /// Time of the restored state, s.
    pub fn time(&self) -> f64 {
        match &self.0 {
            RestoredMotion::Explicit(it) => it.body.state.load_factor,
            RestoredMotion::Implicit(it) => it.here.state.load_factor,
        }
    }

    /// Number of bonds broken up to the restored state.
    pub fn broken_bonds(&self) -> usize {
        match &self.0 {
            RestoredMotion::Explicit(it) => it.body.broken,
            RestoredMotion::Implicit(it) => it.here.broken,
        }
    }

    /// Restores the motion of a checkpoint.
    pub(super) fn read(
        problem: &MotionProblem,
        settings: &MotionSettings,
        from: &mut dyn Read,
    ) -> Result<Self, SetupError> {
        let damaged = CheckpointError::Damaged;
        let scheme = u8::read(from).map_err(damaged)?;
        if !matches!(scheme, EXPLICIT | IMPLICIT) {
            return Err(CheckpointError::OtherDriver.into());
        }
        let progress: Progress = Serial::read(from).map_err(damaged)?;
        let restored = match (scheme, settings.is_explicit()) {
            (EXPLICIT, true) => {
                let motion = ExplicitMotion::read(problem, progress, from)?;
                RestoredMotion::Explicit(Box::new(motion))
            }
            (IMPLICIT, false) => {
                let motion = ImplicitMotion::read(problem, settings, progress, from)?;
                RestoredMotion::Implicit(Box::new(motion))
            }
            _ => return Err(CheckpointError::OtherDriver.into()),
        };
        require_end(from).map_err(damaged)?;
        Ok(Self(restored))
    }
}
