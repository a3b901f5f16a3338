//! Natural modes: K phi = omega^2 M phi with lumped masses.
//!
//! [`ModalAnalysis`] finds the lowest modes of a body on its [`Supports`], the rigid motions of a free body among them. M is
//! diagonal: M_i along x and y, J_i = M_i r_i for the rotation of a point (MPPD eq. 66).
//!
//! Bonds with a negative shear stiffness (Poisson's ratio above 1/3 in plane stress, 1/4 in plane strain) make the energy a
//! maximum in the rotations, and rotational inertia would give each of them a negative omega^2. There the rotations follow
//! the displacements without inertia: their equations are those of equilibrium, as if they were condensed.

mod analysis;
mod participation;
mod rigid;
mod shape;

use ligament_linalg::FactorError;
use ligament_model::{Bonds, LumpedMass};
use thiserror::Error;

use crate::equilibrium::{SetupError, Stability};
use crate::stiffness::{Costs, SolverChoice, SolverSettings};
use crate::supports::Supports;

pub use analysis::ModalAnalysis;
pub use participation::Moving;

/// A body whose modes are wanted.
#[derive(Clone, Copy)]
pub struct ModalProblem<'a> {
    /// The bond system.
    pub system: &'a dyn Bonds,
    /// Masses of its points.
    pub mass: &'a LumpedMass,
    /// What holds it.
    pub supports: &'a Supports,
    /// How the equations are solved.
    pub solver: SolverSettings,
}

/// Which modes, and how.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ModalSettings {
    /// Number of modes, rigid ones included, lowest first.
    pub modes: usize,
    /// Inertia of the rotations; open: with it where no bond has a negative shear stiffness.
    pub rotations: Option<Rotations>,
    /// Residual of the iteration, relative to 1/omega^2, below which a mode is found.
    pub tolerance: f64,
}

/// What becomes of the rotations of the points.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Rotations {
    /// They have the inertia J_i.
    Inertia,
    /// They have none and follow the displacements.
    Massless,
}

/// A natural mode.
#[derive(Debug, Clone, PartialEq)]
pub struct Mode {
    /// Whether it is a rigid motion.
    pub kind: ModeKind,
    /// omega^2, 1/s^2.
    pub eigenvalue: f64,
    /// Largest |K phi - omega^2 M phi| over the forces that meet at a point.
    pub residual: f64,
    /// phi^T M r for the rigid motions r of size one along x, along y and about the centre of mass, kg^(1/2), kg^(1/2) and
    /// kg^(1/2) m: their squares are the effective masses and inertia.
    pub participation: Vec<f64>,
    /// Displacements and rotations, shape (3 n_points): phi^T M phi = 1 kg, and the first of the largest displacements is
    /// positive.
    pub shape: Vec<f64>,
    /// Strain energy density of this motion, shape (n_points), J/m^3.
    pub strain_energy_density: Vec<f64>,
}

/// Kinds of modes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ModeKind {
    /// A motion that costs no energy.
    Rigid,
    /// Any other.
    Elastic,
}

impl ModeKind {
    /// Name in results.
    pub fn name(self) -> &'static str {
        match self {
            Self::Rigid => "rigid",
            Self::Elastic => "elastic",
        }
    }
}

impl Mode {
    /// omega, rad/s: 0 for a rigid motion, NaN where omega^2 is negative.
    pub fn angular_frequency(&self) -> f64 {
        match self.kind {
            ModeKind::Rigid => 0.0,
            ModeKind::Elastic => self.eigenvalue.sqrt(),
        }
    }

    /// omega/(2 pi), Hz.
    pub fn frequency(&self) -> f64 {
        self.angular_frequency() / std::f64::consts::TAU
    }
}

/// The modes of a body.
#[derive(Debug, Clone, PartialEq)]
pub struct ModalOutcome {
    /// The modes, lowest first.
    pub modes: Vec<Mode>,
    /// What became of the rotations.
    pub rotations: Rotations,
    /// Rigid motions that supports and connectivity leave.
    pub rigid_motions: usize,
    /// Mass of the body, kg, and what of it moves.
    pub moving: Moving,
    /// Whether a count of the eigenvalues confirmed that no mode is missing; none where it could not be made.
    pub complete: Option<bool>,
    /// Inertia of the stiffness, where it may be indefinite.
    pub stability: Option<Stability>,
    /// What a user should know.
    pub notices: Vec<ModalNotice>,
    /// What the equations cost.
    pub costs: Costs,
    /// How they were solved.
    pub solver: SolverChoice,
}

/// Something that a user should know of the modes.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum ModalNotice {
    /// The rotations have no inertia because bonds have a negative shear stiffness.
    #[error(
        "bonds have a negative shear stiffness (large Poisson's ratio): the rotations of the points have no inertia, they \
         follow the displacements"
    )]
    MasslessRotations,
    /// The model has more negative eigenvalues than its rotations explain.
    #[error(
        "the intact model is not stable: {negative} negative eigenvalues, {expected} expected from the rotations; motions \
         with a negative omega^2 are left out"
    )]
    Unstable {
        /// Negative eigenvalues of the stiffness.
        negative: usize,
        /// Those of its rotation block.
        expected: usize,
    },
    /// There are more or fewer modes without energy than rigid motions.
    #[error(
        "{found} modes cost no energy, {expected} rigid motions were expected: {}",
        if found > expected { "the body has mechanisms" } else { "some rigid motions cost energy in this model" }
    )]
    RigidCount {
        /// Modes without energy.
        found: usize,
        /// Rigid motions that supports and connectivity leave.
        expected: usize,
    },
    /// All modes asked for cost no energy.
    #[error(
        "all {modes} modes cost no energy, and the body has {expected} rigid motions: {}",
        if modes > expected { "it has mechanisms" } else { "ask for more modes" }
    )]
    OnlyRigid {
        /// Modes asked for.
        modes: usize,
        /// Rigid motions that supports and connectivity leave.
        expected: usize,
    },
    /// There are not so many modes.
    #[error("the body has {found} modes with mass, {wanted} were asked for")]
    FewerModes {
        /// Modes there are.
        found: usize,
        /// Modes asked for.
        wanted: usize,
    },
    /// The iteration ended before all modes were found.
    #[error("the iteration ended after {products} solutions before all modes were exact")]
    NotConverged {
        /// Solutions with the factor.
        products: usize,
    },
    /// A mode does not fulfil its equations well enough.
    #[error("mode {mode} has a residual of {residual:.1e}, more than {RESIDUAL_TOLERANCE:.0e}")]
    Residual {
        /// Number of the mode, from 1.
        mode: usize,
        /// Its residual.
        residual: f64,
    },
    /// The count of the eigenvalues tells of modes that were not found.
    #[error("{missing} modes below the highest were not found")]
    Missing {
        /// Their number.
        missing: usize,
    },
}

/// Residual of a mode above which the user is told.
pub const RESIDUAL_TOLERANCE: f64 = 1e-8;

/// Why there are no modes.
#[derive(Debug, Error)]
pub enum ModalError {
    /// Nothing that has a mass can move.
    #[error("supports hold every degree of freedom that has a mass: there are no modes")]
    NothingMoves,
    /// The equations could not be set up.
    #[error(transparent)]
    Setup(#[from] SetupError),
    /// The stiffness could not be factorised.
    #[error(
        "the stiffness has no factor: {reason}{}",
        if matches!(reason, FactorError::NotPositiveDefinite { .. }) {
            ", as L L^T needs; let the factorisation be \"auto\" or \"ldlt\""
        } else {
            ""
        }
    )]
    NoFactor {
        /// What went wrong.
        reason: FactorError,
    },
}
