//! Natural modes: K phi = omega^2 M phi with lumped masses.
//!
//! [`ModalAnalysis`] finds the lowest modes of a body on its [`Supports`], the rigid motions of a free body among them. M is
//! diagonal: M_i along x and y, J_i = M_i r_i for the rotation of a point (MPPD eq. 66).
//!
//! Bonds with a negative shear stiffness (Poisson's ratio above 1/3 in plane stress, 1/4 in plane strain) make the energy a
//! maximum in the rotations, and rotational inertia would give each of them a negative omega^2. There the rotations follow
//! the displacements without inertia: their equations are those of equilibrium, as if they were condensed.

mod analysis;
mod masses;
mod mode;
mod participation;
mod rigid;
mod shape;

use std::sync::Arc;

use ligament_linalg::FactorError;
use ligament_model::{Bonds, LumpedMass};
use thiserror::Error;

use crate::balanced::Stability;
use crate::costs::Costs;
use crate::error::SetupError;
use crate::solver::{DirectChoice, SolverSettings};
use crate::supports::Supports;

pub use analysis::ModalAnalysis;
pub use mode::{Mode, ModeKind, RESIDUAL_TOLERANCE, Rotations};
pub use participation::Moving;

/// A body whose modes are wanted. A copy shares the parts.
#[derive(Clone)]
pub struct ModalProblem {
    /// The bond system.
    pub system: Arc<dyn Bonds>,
    /// Masses of the points.
    pub mass: Arc<LumpedMass>,
    /// Supports of the body.
    pub supports: Arc<Supports>,
    /// How the equations are solved.
    pub solver: SolverSettings,
}

/// Settings of a search for modes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ModalSettings {
    /// Number of modes, rigid ones included, lowest first.
    pub modes: usize,
    /// Inertia of the rotations; open: with it where no bond has a negative shear stiffness.
    pub rotations: Option<Rotations>,
    /// Residual of the iteration, relative to 1/omega^2, below which a mode is found.
    pub tolerance: f64,
}

/// The modes of a body.
#[derive(Debug, Clone, PartialEq)]
pub struct ModalOutcome {
    /// The modes, lowest first.
    pub modes: Vec<Mode>,
    /// Inertia of the rotations that was chosen.
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
    /// Solver that was chosen for the equations.
    pub solver: DirectChoice,
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
        /// Negative eigenvalues of the rotation block.
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
        /// Residual of the mode.
        residual: f64,
    },
    /// The count of the eigenvalues tells of modes that were not found.
    #[error("{missing} modes below the highest were not found")]
    Missing {
        /// Number of the missing modes.
        missing: usize,
    },
}

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
