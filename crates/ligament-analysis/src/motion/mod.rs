//! Motion in time: the equations M a + C v + f(u) = F(t) of a body whose bonds break.
//!
//! The loads of the [`Problem`] are functions of time: the load factor of a [`State`](crate::State) is the time, s. [`run`] integrates the
//! equations by the scheme of the settings.

pub mod contact;

use std::sync::Arc;

use ligament_model::LumpedMass;

use crate::driver::Problem;

/// Motion in time: a problem whose loads are functions of time, with masses, first velocities and dashpots. A copy shares its data.
#[derive(Clone)]
pub struct MotionProblem {
    /// Bonds, criteria, loads in time, solver and probes.
    pub problem: Problem,
    /// Masses and rotational inertias of the points.
    pub mass: Arc<LumpedMass>,
    /// Velocities at time zero, shape (n_degrees_of_freedom), m/s and rad/s.
    pub initial_velocity: Arc<[f64]>,
    /// Dashpots between points and the ground.
    pub dashpots: Arc<[Dashpot]>,
}

/// Dashpot between a point and the ground: the force -C v for the velocity v of the point.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Dashpot {
    /// The point.
    pub point: u32,
    /// Damping C, symmetric and positive semidefinite, N s/m; in the plane without a third row.
    pub damping: [[f64; 3]; 3],
}

/// Settings of a motion.
#[derive(Debug, Clone, PartialEq)]
pub struct MotionSettings {
    /// Duration, s.
    pub duration: f64,
    /// Number of equal intervals after each of which the history has a row.
    pub rows: usize,
    /// Scheme of the integration.
    pub scheme: Scheme,
    /// Damping in proportion to mass and stiffness.
    pub damping: Damping,
    /// Factor on the rotational inertias of the points.
    pub rotary_inertia: f64,
    /// Rules for a stop before the end.
    pub stop: MotionStop,
}

/// Scheme of the integration in time.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Scheme {
    /// Velocity Verlet, which is stable below a critical step.
    Explicit(ExplicitSettings),
}

/// Settings of explicit steps.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ExplicitSettings {
    /// Time step, s; open: `safety` times the critical step.
    pub step: Option<f64>,
    /// Fraction of the critical step, below 1.
    pub safety: f64,
}

/// Damping C = alpha M + beta K.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Damping {
    /// alpha, 1/s.
    pub mass: f64,
    /// beta, s.
    pub stiffness: f64,
}

/// Rules that end a motion early.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct MotionStop {
    /// Largest number of broken bonds.
    pub bonds: Option<usize>,
    /// Largest wall time, s.
    pub wall_time: Option<f64>,
}
