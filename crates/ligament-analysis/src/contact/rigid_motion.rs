//! Rigid bodies of a problem in a motion: their rates at time zero and their steps of velocity Verlet.

use ligament_model::surface::Pose;

use super::problem::ContactProblem;
use super::rigid_body::{Resultant, RigidBody, RigidMotion, RigidRates};
use super::surfaces::Touching;

impl ContactProblem {
    /// Rates of the rigid bodies at time zero under the loads of the contacts then.
    pub fn rates_at_start(&self, touching: &Touching) -> Vec<RigidRates> {
        let loads = touching.on_rigid_bodies(self);
        let rates = |(body, load): (&RigidBody, Resultant)| {
            let before = match body.motion {
                RigidMotion::Prescribed { .. } => RigidRates::default(),
                RigidMotion::Free { velocity, .. } => RigidRates {
                    velocity,
                    ..RigidRates::default()
                },
            };
            body.motion.accelerated(0.0, &before, load)
        };
        self.rigid_bodies.iter().zip(loads).map(rates).collect()
    }

    /// Moves the free rigid bodies by a step (s) of velocity Verlet.
    pub fn advance(&self, step: f64, rates: &[RigidRates], poses: &mut Vec<Pose>) {
        poses.resize(self.rigid_bodies.len(), Pose::default());
        for ((body, rates), pose) in self.rigid_bodies.iter().zip(rates).zip(poses) {
            body.motion.advance(step, rates, pose);
        }
    }

    /// Moves the rates of the rigid bodies to the end of a step (s) of velocity Verlet, with the contacts there.
    pub fn accelerate(&self, step: f64, touching: &Touching, rates: &mut [RigidRates]) {
        let loads = touching.on_rigid_bodies(self);
        for ((body, load), rates) in self.rigid_bodies.iter().zip(loads).zip(rates) {
            *rates = body.motion.accelerated(step, rates, load);
        }
    }

    /// Kinetic energy of the free rigid bodies, J: with the velocities half a step (s) before and after, or at the time with a step of zero.
    pub fn kinetic_energy(&self, step: f64, rates: &[RigidRates]) -> f64 {
        let both = self.rigid_bodies.iter().zip(rates);
        both.map(|(body, rates)| body.motion.kinetic_energy(step, rates))
            .fold(0.0, |sum, it| sum + it)
    }
}
