//! What implicit steps can follow.

use super::clock::Clock;
use crate::motion::contact::{RigidBody, RigidMotion};
use crate::motion::{MotionError, MotionProblem, MotionSettings};
use crate::problem::Problem;

/// Refuses what implicit steps cannot follow.
pub(super) fn check(problem: &MotionProblem, settings: &MotionSettings) -> Result<(), MotionError> {
    let Problem {
        system,
        criteria,
        loads,
        ..
    } = &problem.problem;
    if !system.subdomain().is_whole() {
        return Err(MotionError::SeveralProcesses);
    }
    let is_free = |it: &RigidBody| matches!(it.motion, RigidMotion::Free { .. });
    let turns = |it: &RigidBody| match it.motion {
        RigidMotion::Free { inertia, .. } => inertia.is_finite(),
        RigidMotion::Prescribed { .. } => false,
    };
    let bodies = &problem.problem.contact.rigid_bodies;
    let is_refused =
        bodies.iter().any(turns) || criteria.soften() || settings.share_of_statics().is_some();
    if bodies.iter().any(is_free) && is_refused {
        return Err(MotionError::FreeRigidBody);
    }
    let is_heated = !loads.temperature_change(0.0).is_empty();
    let is_plain =
        system.is_linear() && !problem.problem.may_press() && !criteria.soften() && !is_heated;
    if settings.damping.stiffness > 0.0 && !is_plain {
        return Err(MotionError::StiffnessDamping);
    }
    let step = Clock::implicit(settings)?.step();
    settings.damping.check(step)
}
