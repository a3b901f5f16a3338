//! Checkpoint of an implicit motion.

use std::io::Read;

use super::clock::Clock;
use super::here::{Here, Motion, free_masses};
use super::stepping::{Pace, Stepping, of_step, scheme};
use crate::bond_numbers::BondNumbers;
use crate::checkpoint::CheckpointError;
use crate::costs::Costs;
use crate::driver::course::CheckValues;
use crate::equilibrium::Equilibrium;
use crate::error::SetupError;
use crate::motion::{MotionProblem, MotionSettings};
use crate::problem::Problem;
use crate::serial::{Serial, Sink};
use crate::state::State;

/// Motion in implicit steps as a checkpoint has it.
pub(super) struct ImplicitKept {
    pub(super) here: Here,
    pub(super) stepping: Stepping,
    pub(super) pace: Pace,
}

impl ImplicitKept {
    /// Appends the motion at a row.
    pub(super) fn write(
        problem: &Problem,
        here: &Here,
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
    pub(super) fn read(
        problem: &MotionProblem,
        settings: &MotionSettings,
        clock: &Clock,
        from: &mut dyn Read,
    ) -> Result<Self, SetupError> {
        let damaged = CheckpointError::Damaged;
        let numbers = BondNumbers::new(&*problem.problem.system)?;
        let n_components = problem.problem.system.layout().components.len();
        let state = State::read((&numbers, n_components), &problem.problem.criteria, from)?;
        let motion: Motion = Serial::read(from).map_err(damaged)?;
        let pace: Pace = Serial::read(from).map_err(damaged)?;
        let costs: Costs = Serial::read(from).map_err(damaged)?;
        let n = problem.problem.system.layout().n_degrees_of_freedom();
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
        let mut here = Here {
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
        Ok(Self {
            here,
            stepping,
            pace,
        })
    }
}
