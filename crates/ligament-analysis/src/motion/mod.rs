//! Motion in time: the equations M a + C v + f(u) = F(t) of a body whose bonds break.
//!
//! The loads of the [`Problem`] are functions of time: the load factor of a [`State`](crate::State) is the time, s.
//! [`driver::motion`](crate::driver::motion) integrates the equations.

mod energy_bound;
pub(crate) mod rigid;
mod stable_step;

pub mod contact;

use std::sync::Arc;

use ligament_model::LumpedMass;
use nalgebra::Matrix3;
use thiserror::Error;

use crate::breaking::BreakingRule;
use crate::problem::Problem;

pub use crate::critical_step::CriticalStep;
pub use stable_step::critical_step;

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
    pub damping: Matrix3<f64>,
}

impl Dashpot {
    /// Dashpot of a point with the entries of its damping by row and column, N s/m.
    pub fn new(point: u32, damping: impl FnMut(usize, usize) -> f64) -> Self {
        Self {
            point,
            damping: Matrix3::from_fn(damping),
        }
    }
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

impl MotionSettings {
    /// Whether the scheme is explicit.
    pub fn is_explicit(&self) -> bool {
        matches!(self.scheme, Scheme::Explicit(_))
    }
}

/// Scheme of the integration in time.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Scheme {
    /// Velocity Verlet, which is stable below a critical step.
    Explicit(ExplicitSettings),
    /// Newmark's scheme with the averaging of Hilber, Hughes and Taylor, which is stable for any step.
    Implicit(ImplicitSettings),
}

/// Settings of implicit steps.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ImplicitSettings {
    /// Largest time step, s.
    pub step: f64,
    /// Dissipation alpha of high frequencies after Hilber, Hughes and Taylor, 0 (Newmark's trapezoidal rule) to 1/3.
    pub dissipation: f64,
    /// Rule that selects the bonds that break in a round.
    pub rule: BreakingRule,
    /// Largest number of rounds of breaking in a step; beyond it the step is halved, ten times at most.
    pub rounds: usize,
    /// Relative change of the energy that ends the iteration of bonds that soften (NHPD eq. 21).
    pub energy_tolerance: f64,
    /// Share of the work so far that a step without inertia may set free beyond what its bonds dissipate: equilibria follow each other up to
    /// there, and again once the motion has no more energy than that. None: all steps have inertia.
    pub statics: Option<f64>,
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

/// Reason why a motion cannot be computed.
#[derive(Debug, Clone, Copy, PartialEq, Error)]
pub enum MotionError {
    /// Supports and loads prescribe every degree of freedom.
    #[error("supports and loads prescribe the motion of every point: nothing is left to move")]
    NothingMoves,
    /// No bond and no support resists a motion.
    #[error("nothing in the body resists a motion: it has no critical time step")]
    NothingResists,
    /// A point has no mass.
    #[error("point {point} has no mass, or no inertia of its rotation: explicit motion needs both")]
    Massless {
        /// The point.
        point: u32,
    },
    /// A negative shear stiffness makes rotations with inertia unstable.
    #[error(
        "bonds have a negative shear stiffness (large Poisson's ratio): rotations of points with inertia are unstable, and a motion would grow \
         without bound; take a smaller Poisson's ratio or a law without rotations"
    )]
    UnstableRotations,
    /// Damping in proportion to a stiffness that changes with the displacements.
    #[error(
        "the forces of the bonds are not linear in the displacements: damping in proportion to the stiffness has no meaning; damp by mass"
    )]
    StiffnessDamping,
    /// The given step is larger than the stable one.
    #[error(
        "the time step {step:.4e} s is larger than the critical one, {critical:.4e} s, so that the motion would grow without bound"
    )]
    StepTooLarge {
        /// Given step, s.
        step: f64,
        /// Critical step, s.
        critical: f64,
    },
    /// Time steps were required in a number that has no end.
    #[error(
        "the motion would take {steps:.1e} time steps of {at_most:.3e} s, more than can be computed: shorten the duration, or lengthen the step \
         (coarser points, less stiffness, or for slow loads equilibria until the body moves)"
    )]
    TooManySteps {
        /// Number of steps.
        steps: f64,
        /// Longest step, s.
        at_most: f64,
    },
    /// Damping by mass beyond what a step can follow.
    #[error(
        "damping by mass of {alpha:.4e} 1/s is too fast for a time step of {step:.4e} s: from 2/damping.mass = {:.4e} s on velocities would \
         change their sign from step to step instead of decaying; take a motion.step well below it (a tenth decays right to 0.4 %), or less \
         damping",
        2.0 / alpha
    )]
    DampingTooFast {
        /// Time step, s.
        step: f64,
        /// Damping over mass, 1/s.
        alpha: f64,
    },
    /// A rigid body with a mass was required in implicit steps that turn it, with bonds that soften, or between equilibria.
    #[error(
        "implicit steps move a rigid body with a mass without turning it, beside bonds that do not soften, and not from equilibria: remove \
         the inertia, or take explicit steps"
    )]
    FreeRigidBody,
    /// Several processes cannot compute a motion.
    #[error("several processes cannot compute a motion in time; use one process")]
    SeveralProcesses,
}

impl Damping {
    /// Refuses time steps (s) in which the trapezoidal rule turns velocities round: it keeps (1 - a)/(1 + a) of them with a = alpha dt/2, where
    /// exp(-2 a) is right.
    pub(crate) fn check(self, step: f64) -> Result<(), MotionError> {
        let alpha = self.mass;
        // A product that is 2 but for rounding would leave no velocity to go on from.
        match alpha * step < 2.0 * (1.0 - 1e-9) {
            true => Ok(()),
            false => Err(MotionError::DampingTooFast { step, alpha }),
        }
    }
}

impl MotionProblem {
    /// Mass of each degree of freedom with a factor on the rotational inertias, shape (n_degrees_of_freedom), kg and kg m^2.
    pub fn masses(&self, rotary_inertia: f64) -> Vec<f64> {
        let layout = self.problem.system.layout();
        let of_dof = |dof: usize| {
            let point = layout.point(dof) as usize;
            match layout.component(dof).is_rotation() {
                false => self.mass.mass[point],
                true => rotary_inertia * self.mass.inertia[point],
            }
        };
        (0..layout.n_degrees_of_freedom()).map(of_dof).collect()
    }

    /// Degrees of freedom whose motion is not prescribed, ascending.
    pub fn free(&self) -> Vec<u32> {
        let n = self.problem.system.layout().n_degrees_of_freedom();
        let is_free = |dof: &u32| !self.problem.loads.is_prescribed(*dof as usize);
        (0..n as u32).filter(is_free).collect()
    }

    /// Degrees of freedom whose motion is prescribed, ascending.
    pub fn prescribed(&self) -> Vec<u32> {
        let n = self.problem.system.layout().n_degrees_of_freedom();
        let is_prescribed = |dof: &u32| self.problem.loads.is_prescribed(*dof as usize);
        (0..n as u32).filter(is_prescribed).collect()
    }
}
