//! Checkpoint of an explicit motion.

use std::io::Read;

use super::body::Body;
use super::face_friction::FaceFriction;
use super::inertia::Velocities;
use crate::bond_numbers::BondNumbers;
use crate::checkpoint::CheckpointError;
use crate::driver::course::CheckValues;
use crate::error::SetupError;
use crate::friction::Anchored;
use crate::motion::MotionProblem;
use crate::motion::contact::{ContactForces, ContactState};
use crate::serial::{Serial, Sink};
use crate::state::State;

/// Motion in explicit steps as a checkpoint has it.
pub(super) struct ExplicitKept {
    pub(super) body: Body,
    pub(super) velocities: Velocities,
    pub(super) contacts: Option<ContactForces>,
}

impl ExplicitKept {
    /// Appends the motion at a row, with its forces: inertia and damping are in them, and do not follow from the state.
    pub(super) fn write(
        body: &Body,
        velocities: &Velocities,
        contacts: Option<&ContactForces>,
        out: &mut dyn Sink,
    ) {
        body.state.write(&body.numbers, out);
        velocities.write(out);
        let anchored = body.friction.pairs.iter();
        let anchored: Vec<(u32, Anchored)> = anchored.map(|(pair, it)| (*pair, *it)).collect();
        anchored.write(out);
        contacts.map(|it| it.state().clone()).write(out);
        body.costs.write(out);
        CheckValues::new(&body.problem, &body.balanced).write(out);
        let internal = &body.balanced.internal;
        internal.values.write(out);
        internal.on_rigid_bodies.write(out);
    }

    /// Restores the motion of a problem at a row.
    pub(super) fn read(problem: &MotionProblem, from: &mut dyn Read) -> Result<Self, SetupError> {
        let damaged = CheckpointError::Damaged;
        let numbers = BondNumbers::new(&*problem.problem.system)?;
        let n_components = problem.problem.system.layout().components.len();
        let state = State::read((&numbers, n_components), &problem.problem.criteria, from)?;
        let velocities: Velocities = Serial::read(from).map_err(damaged)?;
        let anchored: Vec<(u32, Anchored)> = Serial::read(from).map_err(damaged)?;
        let contact: Option<ContactState> = Serial::read(from).map_err(damaged)?;
        let costs = Serial::read(from).map_err(damaged)?;
        let system = &*problem.problem.system;
        let lengths = [velocities.half.len(), velocities.acceleration.len()];
        let fits = state.fits(system, system.ends().len(), &problem.problem.criteria);
        let can_touch = match &contact {
            Some(contact) => contact.fits(&problem.problem.contact),
            None => problem.problem.contact.is_empty(),
        };
        if !fits || !can_touch || lengths != [state.displacement.len(); 2] {
            return Err(CheckpointError::OtherModel.into());
        }
        let friction = FaceFriction::new(
            problem.problem.face_friction,
            anchored.into_iter().collect(),
        );
        let mut body = Body::new(&problem.problem, numbers, friction, Some(state));
        body.costs = costs;
        body.measure();
        let resumed = |it| {
            let motions = &body.state.displacement;
            ContactForces::resumed(problem.problem.contact.clone(), motions, it, body.bonded())
        };
        let contacts = contact.map(resumed);
        if let Some(contacts) = &contacts {
            contacts.add_forces(-1.0, &mut body.balanced.internal.values);
        }
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
        Ok(Self {
            body,
            velocities,
            contacts,
        })
    }
}
