//! Rigid bodies that move as prescribed, or with a mass by velocity Verlet (central differences):
//!
//! q' = q + dt v + dt^2/2 a, v' = v + dt/2 (a + a') with a = F/m + g, and the same for the angles with the moment M over the inertia I.
//!
//! The kinetic energy m/2 v-.v+ with the velocities v -+ dt/2 a in the middles of the steps before and after is m/2 (v.v - (dt/2 a).(dt/2 a)).

use ligament_model::surface::{Pose, Vector};
use ligament_model::tensor::dot;
use serde::{Deserialize, Serialize};

use crate::load_program::Amplitude;

/// A rigid body.
#[derive(Debug, Clone, PartialEq)]
pub struct RigidBody {
    /// Name in results.
    pub name: String,
    /// Motion of the body.
    pub motion: RigidMotion,
    /// Distance at the start to what it meets, m.
    pub gap: f64,
    /// Surface by which it is drawn.
    pub surface: RigidSurface,
}

/// Surface of a rigid body by which it is drawn: in the plane its area.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct RigidSurface {
    /// Middle, about which the body turns, m.
    pub middle: Vector,
    /// Places at the start, shape (n_places), m; in the plane z = 0.
    pub places: Vec<Vector>,
    /// Triangles by their corners, shape (n_triangles).
    pub triangles: Vec<[u32; 3]>,
}

impl RigidSurface {
    /// Displacements of the places in a state of the body, m. In space only balls turn, whose surface stays the same.
    pub fn displacements(&self, state: &RigidState) -> Vec<Vector> {
        let (sine, cosine) = state.rotation[2].sin_cos();
        let of_place = |place: &Vector| {
            let [x, y] = [0, 1].map(|axis| place[axis] - self.middle[axis]);
            let turned = [cosine * x - sine * y - x, sine * x + cosine * y - y, 0.0];
            std::array::from_fn(|axis| state.displacement[axis] + turned[axis])
        };
        self.places.iter().map(of_place).collect()
    }
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

/// State of a rigid body in a record.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
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

/// Velocities and accelerations of a free rigid body; zero where the motion is prescribed.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
pub struct RigidRates {
    /// Velocity, m/s.
    pub velocity: Vector,
    /// Acceleration, m/s^2.
    pub acceleration: Vector,
    /// Angular velocity, rad/s.
    pub angular_velocity: Vector,
    /// Angular acceleration, rad/s^2.
    pub angular_acceleration: Vector,
}

/// Force on a rigid body and moment about its middle, N and N m.
pub(super) type Resultant = [Vector; 2];

impl RigidMotion {
    /// Displacement since time zero of a body with a prescribed motion, m; zero for a free body.
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

    /// Velocity at a time (s) of a body with a prescribed motion, m/s; for a free body its velocity at time zero.
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

    /// Pose of a body at a time (s); `free` is the pose of a free body.
    pub(crate) fn pose(&self, time: f64, free: Option<&Pose>) -> Pose {
        match self {
            Self::Prescribed { .. } => Pose {
                displacement: self.displacement(time),
                ..Pose::default()
            },
            Self::Free { .. } => free.copied().unwrap_or_default(),
        }
    }

    /// Moves a free body by a step (s) of velocity Verlet.
    pub(super) fn advance(&self, step: f64, rates: &RigidRates, pose: &mut Pose) {
        if let Self::Free { .. } = self {
            let half = 0.5 * step * step;
            add(&mut pose.displacement, step, rates.velocity);
            add(&mut pose.displacement, half, rates.acceleration);
            add(&mut pose.rotation, step, rates.angular_velocity);
            add(&mut pose.rotation, half, rates.angular_acceleration);
        }
    }

    /// Rates of a free body at the end of a step (s) of velocity Verlet, under the load of the contacts there.
    pub(super) fn accelerated(
        &self,
        step: f64,
        before: &RigidRates,
        [force, moment]: Resultant,
    ) -> RigidRates {
        let Self::Free {
            mass,
            inertia,
            acceleration,
            ..
        } = self
        else {
            return *before;
        };
        let mut now = RigidRates {
            acceleration: force.map(|it| it / mass),
            angular_acceleration: moment.map(|it| it / inertia),
            ..*before
        };
        add(&mut now.acceleration, 1.0, *acceleration);
        for of in [*before, now] {
            add(&mut now.velocity, 0.5 * step, of.acceleration);
            add(
                &mut now.angular_velocity,
                0.5 * step,
                of.angular_acceleration,
            );
        }
        now
    }

    /// Kinetic energy of a free body, J: with the velocities half a step (s) before and after, which velocity Verlet conserves, or at the
    /// time with a step of zero.
    pub(super) fn kinetic_energy(&self, step: f64, rates: &RigidRates) -> f64 {
        let Self::Free { mass, inertia, .. } = self else {
            return 0.0;
        };
        let square = |velocity: Vector, acceleration: Vector| {
            let change = acceleration.map(|it| 0.5 * step * it);
            dot(velocity, velocity) - dot(change, change)
        };
        let moving = 0.5 * mass * square(rates.velocity, rates.acceleration);
        if inertia.is_infinite() {
            return moving;
        }
        moving + 0.5 * inertia * square(rates.angular_velocity, rates.angular_acceleration)
    }
}

/// Adds a vector times a factor.
pub(crate) fn add(sum: &mut Vector, factor: f64, vector: Vector) {
    for (sum, value) in sum.iter_mut().zip(vector) {
        *sum += factor * value;
    }
}
