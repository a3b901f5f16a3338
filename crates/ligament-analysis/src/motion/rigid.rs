//! Rigid bodies that move by velocity Verlet or as prescribed.

use ligament_model::surface::{Pose, Vector};
use ligament_model::tensor::{dot, minus};

use crate::load_program::Amplitude;
use crate::serial;

/// A rigid body.
#[derive(Debug, Clone, PartialEq)]
pub struct RigidBody {
    /// Name in results.
    pub name: String,
    /// How it moves.
    pub motion: RigidMotion,
}

/// Motion of a rigid body.
#[derive(Debug, Clone, PartialEq)]
pub enum RigidMotion {
    /// A prescribed velocity.
    Prescribed {
        /// Velocity at amplitude 1, m/s; in statics the load factor is the time, and this is the displacement at load factor 1.
        velocity: Vector,
        /// Factor as a function of time.
        amplitude: Amplitude,
    },
    /// A mass that contacts and a constant acceleration move.
    Free {
        /// Mass, kg.
        mass: f64,
        /// Moment of inertia about its middle, kg m^2; infinite where it does not turn. In the plane about z.
        inertia: f64,
        /// Velocity at time zero, m/s.
        velocity: Vector,
        /// Acceleration without contacts, such as gravity, m/s^2.
        acceleration: Vector,
    },
}

/// State of a rigid body.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct RigidState {
    /// Displacement since time zero, m.
    pub displacement: Vector,
    /// Velocity, m/s.
    pub velocity: Vector,
    /// Force of the contacts on it, N.
    pub force: Vector,
    /// Angles about the axes since time zero, rad.
    pub rotation: Vector,
    /// Angular velocity, rad/s.
    pub angular_velocity: Vector,
    /// Moment of the contacts about its middle, N m.
    pub moment: Vector,
}

impl RigidState {
    /// Place of the body.
    pub(super) fn pose(&self) -> Pose {
        Pose {
            displacement: self.displacement,
            rotation: self.rotation,
        }
    }
}

/// Work on a rigid body over a step, J.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct RigidWork {
    /// Of contacts, where its motion is prescribed.
    pub(super) on_driven: f64,
    /// Of contacts, where it is free.
    pub(super) on_free: f64,
    /// Of its own acceleration.
    pub(super) of_acceleration: f64,
}

impl RigidMotion {
    /// Displacement since time zero of a body with a prescribed motion, m; zero of a free one.
    pub(crate) fn displacement(&self, time: f64) -> Vector {
        match self {
            Self::Prescribed {
                velocity,
                amplitude,
            } => {
                let so_far = amplitude.integral(time);
                velocity.map(|it| so_far * it)
            }
            Self::Free { .. } => Vector::default(),
        }
    }

    /// Velocity at a time (s) of a body with a prescribed motion, m/s; of a free one that at time zero.
    pub(crate) fn velocity(&self, time: f64) -> Vector {
        match self {
            Self::Prescribed {
                velocity,
                amplitude,
            } => {
                let factor = amplitude.value(time);
                velocity.map(|it| factor * it)
            }
            Self::Free { velocity, .. } => *velocity,
        }
    }

    /// Moves a body to a time (s) after a step (s).
    pub(super) fn advance(&self, time: f64, step: f64, state: &mut RigidState) {
        match self {
            Self::Prescribed { .. } => {
                state.velocity = self.velocity(time);
                state.displacement = self.displacement(time);
            }
            Self::Free {
                mass,
                inertia,
                acceleration,
                ..
            } => {
                let half = 0.5 * step * step;
                add(&mut state.displacement, step, state.velocity);
                add(&mut state.displacement, half / mass, state.force);
                add(&mut state.displacement, half, *acceleration);
                add(&mut state.rotation, step, state.angular_velocity);
                add(&mut state.rotation, half / inertia, state.moment);
            }
        }
    }

    /// Finds the velocities at the end of a step (s) of a body that was loaded there, from its state before.
    pub(super) fn accelerate(
        &self,
        step: f64,
        before: &RigidState,
        state: &mut RigidState,
    ) -> RigidWork {
        let mean = |one: Vector, other: Vector| {
            let mut mean = one.map(|it| 0.5 * it);
            add(&mut mean, 0.5, other);
            mean
        };
        let force = mean(state.force, before.force);
        let way = minus(state.displacement, before.displacement);
        let mut work = RigidWork::default();
        match self {
            Self::Prescribed { .. } => work.on_driven = dot(force, way),
            Self::Free {
                mass,
                inertia,
                acceleration,
                ..
            } => {
                add(&mut state.velocity, step / mass, force);
                add(&mut state.velocity, step, *acceleration);
                work.on_free = dot(force, way);
                work.of_acceleration = mass * dot(*acceleration, way);
                if inertia.is_finite() {
                    let moment = mean(state.moment, before.moment);
                    add(&mut state.angular_velocity, step / inertia, moment);
                    work.on_free += dot(moment, minus(state.rotation, before.rotation));
                }
            }
        }
        work
    }

    /// Kinetic energy 1/2 m v . v' of a free body, with the velocities half a step (s) before and after, and that of its rotation, J.
    pub(super) fn kinetic_energy(&self, step: f64, state: &RigidState) -> f64 {
        let Self::Free {
            mass,
            inertia,
            acceleration,
            ..
        } = self
        else {
            return 0.0;
        };
        let mut change = state.force.map(|it| 0.5 * step * it / mass);
        add(&mut change, 0.5 * step, *acceleration);
        let moving = 0.5 * mass * (dot(state.velocity, state.velocity) - dot(change, change));
        if inertia.is_infinite() {
            return moving;
        }
        let change = state.moment.map(|it| 0.5 * step * it / inertia);
        let spin = state.angular_velocity;
        moving + 0.5 * inertia * (dot(spin, spin) - dot(change, change))
    }
}

/// Adds a vector times a factor.
pub(crate) fn add(sum: &mut Vector, factor: f64, vector: Vector) {
    for (sum, value) in sum.iter_mut().zip(vector) {
        *sum += factor * value;
    }
}

serial!(RigidState {
    displacement,
    velocity,
    force,
    rotation,
    angular_velocity,
    moment
});
