//! Motion in time: the equations M a + C v + f(u) = F(t) of a body whose bonds break.
//!
//! The loads of the [`Problem`] are functions of time: the load factor of a [`State`](crate::State) is the time, s.
//! [`driver::motion`](crate::driver::motion) integrates the equations.

mod stable_step;

use std::sync::Arc;

use ligament_model::{LumpedMass, case_type};
use nalgebra::Matrix3;
use thiserror::Error;

use crate::breaking::BreakingRule;
use crate::problem::{ELASTIC_ENERGY_TOLERANCE, Problem};

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

/// Largest dissipation of implicit steps, beyond which they are less accurate than of second order.
pub const MOST_DISSIPATION: f64 = 3.0_f64.recip();

case_type! {
    /// How the body moves in time under loads that depend on time.
    #[derive(Debug, Clone, PartialEq)]
    pub struct MotionSettings {
        /// Time at the end, s.
        #[range("exclusiveMinimum" = 0)]
        pub duration: f64,
        /// Rows of the history, at equal times.
        #[range("minimum" = 1, "maximum" = 1_000_000)]
        #[case(serde(default = "rows"))]
        pub rows: usize,
        /// Scheme of the integration in time.
        #[case(serde(default))]
        pub scheme: Scheme,
        /// Time step, s; explicit steps without it are `safety` times the critical step of the body. It is shortened so that rows are at
        /// multiples of it, and implicit steps are halved where bonds break fast.
        #[range("exclusiveMinimum" = 0)]
        pub step: Option<f64>,
        /// Share of the critical step, beyond which explicit steps are unstable.
        #[range("exclusiveMinimum" = 0, "exclusiveMaximum" = 1;
            "greater than 0 and less than 1: the share of the critical step, beyond which an explicit scheme is unstable")]
        #[case(serde(default = "safety"))]
        pub safety: f64,
        /// Dissipation of fast motions by implicit steps, after Hilber, Hughes and Taylor: 0 takes no energy.
        #[range("minimum" = 0, "maximum" = MOST_DISSIPATION; "0 to 1/3")]
        #[case(serde(default))]
        pub dissipation: f64,
        /// Share of the work so far that a step without inertia may set free beyond what its bonds dissipate, and that a motion may have left when
        /// equilibria follow again; for the scheme `auto`.
        #[range("exclusiveMinimum" = 0, "exclusiveMaximum" = 1)]
        #[case(serde(default = "statics"))]
        pub statics: f64,
        /// Factor on the rotational inertia of the points; a larger one allows longer steps where rotations limit them.
        #[range("exclusiveMinimum" = 0)]
        #[case(serde(default = "rotary_inertia"))]
        pub rotary_inertia: f64,
        /// Damping C = `mass` M + `stiffness` K.
        #[case(serde(default))]
        pub damping: Damping,
        /// When to stop before the end; whichever comes first.
        #[case(serde(default))]
        pub stop: MotionStop,
        /// Breakages in implicit steps; of a case in `[fracture]`.
        #[case(serde(skip))]
        pub breakages: StepBreakages,
    }
}

case_type! {
    /// Scheme of the integration in time.
    #[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
    pub enum Scheme {
        /// Central differences: steps without equations to solve, shorter than a critical step.
        #[default]
        Explicit,
        /// Newmark's scheme: steps of any length, each an equilibrium with inertia; of `[fracture]` the keys of a load step hold for each.
        Implicit,
        /// Equilibria without inertia from row to row until the body loses its balance, then implicit steps until it is at rest, then equilibria
        /// again.
        Auto,
    }
}

case_type! {
    /// Damping in proportion to masses and stiffness.
    #[derive(Debug, Clone, Copy, PartialEq, Default)]
    #[case(serde(default))]
    pub struct Damping {
        /// alpha, 1/s: slow motions are damped most.
        #[range("minimum" = 0; "at least 0: a negative damping would feed energy to the body")]
        pub mass: f64,
        /// beta, s: fast motions are damped most; it shortens the critical step.
        #[range("minimum" = 0; "at least 0: a negative damping would feed energy to the body")]
        pub stiffness: f64,
    }
}

case_type! {
    /// When to stop before the end of a motion; whichever comes first.
    #[derive(Debug, Clone, Copy, PartialEq, Default)]
    #[case(serde(default))]
    pub struct MotionStop {
        /// When so many bonds are broken.
        #[range("minimum" = 1)]
        pub bonds: Option<usize>,
        /// After so much time of the machine, s.
        #[range("exclusiveMinimum" = 0)]
        pub wall_time: Option<f64>,
    }
}

/// Breakages in implicit steps.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct StepBreakages {
    /// Rule that selects the bonds that break in a round.
    pub rule: BreakingRule,
    /// Largest number of rounds of breaking in a step; beyond it the step is halved, ten times at most.
    pub rounds: usize,
    /// Relative change of the energy that ends the iteration of bonds that soften (NHPD eq. 21).
    pub energy_tolerance: f64,
}

impl Default for StepBreakages {
    fn default() -> Self {
        Self {
            rule: BreakingRule::default(),
            rounds: 20,
            energy_tolerance: ELASTIC_ENERGY_TOLERANCE,
        }
    }
}

impl MotionSettings {
    /// Settings for a duration, s: explicit steps of 0.8 of the critical step, 200 rows of the history, no damping.
    pub fn new(duration: f64) -> Self {
        Self {
            duration,
            rows: rows(),
            scheme: Scheme::default(),
            step: None,
            safety: safety(),
            dissipation: 0.0,
            statics: statics(),
            rotary_inertia: rotary_inertia(),
            damping: Damping::default(),
            stop: MotionStop::default(),
            breakages: StepBreakages::default(),
        }
    }

    /// Whether the scheme is explicit.
    pub fn is_explicit(&self) -> bool {
        self.scheme == Scheme::Explicit
    }

    /// Share of the work that steps without inertia may set free, where there are such steps.
    pub fn share_of_statics(&self) -> Option<f64> {
        (self.scheme == Scheme::Auto).then_some(self.statics)
    }
}

fn rows() -> usize {
    200
}

fn safety() -> f64 {
    0.8
}

fn statics() -> f64 {
    1e-3
}

fn rotary_inertia() -> f64 {
    1.0
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
    /// Refuses time steps (s) in which the trapezoidal rule reverses velocities: it multiplies them by (1 - a)/(1 + a) with a = alpha dt/2,
    /// where exp(-2 a) is right.
    pub(crate) fn check(self, step: f64) -> Result<(), MotionError> {
        let alpha = self.mass;
        // A product that is 2 but for rounding would leave no velocity.
        match alpha * step < 2.0 * (1.0 - 1e-9) {
            true => Ok(()),
            false => Err(MotionError::DampingTooFast { step, alpha }),
        }
    }
}

impl MotionProblem {
    /// Mass of each degree of freedom with a factor on the rotational inertias, shape (n_degrees_of_freedom), kg and kg m^2.
    pub fn masses(&self, rotary_inertia: f64) -> Vec<f64> {
        let layout = self.problem.system.layout;
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
        let n = self.problem.system.layout.n_degrees_of_freedom();
        let is_free = |dof: &u32| !self.problem.loads.is_prescribed(*dof as usize);
        (0..n as u32).filter(is_free).collect()
    }

    /// Degrees of freedom whose motion is prescribed, ascending.
    pub fn prescribed(&self) -> Vec<u32> {
        let n = self.problem.system.layout.n_degrees_of_freedom();
        let is_prescribed = |dof: &u32| self.problem.loads.is_prescribed(*dof as usize);
        (0..n as u32).filter(is_prescribed).collect()
    }
}
