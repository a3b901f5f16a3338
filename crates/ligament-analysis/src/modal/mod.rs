//! Natural modes: K phi = omega^2 M phi with lumped masses.
//!
//! [`ModalAnalysis`] finds the lowest modes of a body on its [`Supports`], including the rigid motions of a free body. M is
//! diagonal: M_i along x and y, J_i = M_i r_i for the rotation of a point (MPPD eq. 66).
//!
//! Bonds with a negative shear stiffness (Poisson's ratio above 1/3 in plane stress, 1/4 in plane strain) make the energy a maximum
//! in the rotations, and rotational inertia would give each of them a negative omega^2. With such bonds the rotations follow the
//! displacements without inertia: their equations are those of equilibrium, as in static condensation.

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

/// Body whose modes are computed. A copy shares its data.
#[derive(Clone)]
pub struct ModalProblem {
    /// Bonds between the points of the body.
    pub system: Arc<dyn Bonds>,
    /// Masses of the points.
    pub mass: Arc<LumpedMass>,
    /// Supports of the body.
    pub supports: Arc<Supports>,
    /// Settings of the solver of the equations.
    pub solver: SolverSettings,
}

/// Settings of the search for modes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ModalSettings {
    /// Number of modes, including rigid ones, lowest first.
    pub modes: usize,
    /// Inertia of the rotations; open: with inertia where no bond has a negative shear stiffness.
    pub rotations: Option<Rotations>,
    /// Largest residual of the iteration, relative to 1/omega^2, of a converged mode.
    pub tolerance: f64,
}

/// Modes of a body.
#[derive(Debug, Clone, PartialEq)]
pub struct ModalOutcome {
    /// Modes, lowest first.
    pub modes: Vec<Mode>,
    /// Inertia of the rotations that was chosen.
    pub rotations: Rotations,
    /// Number of rigid motions permitted by supports and connectivity.
    pub rigid_motions: usize,
    /// Mass of the body and its movable mass, kg.
    pub moving: Moving,
    /// Whether a count of the eigenvalues confirmed that no mode is missing; none where the count was impossible.
    pub complete: Option<bool>,
    /// Inertia of the stiffness, where it may be indefinite.
    pub stability: Option<Stability>,
    /// Notices to the user.
    pub notices: Vec<ModalNotice>,
    /// Costs of the equations.
    pub costs: Costs,
    /// Solver that was chosen for the equations.
    pub solver: DirectChoice,
}

/// Notice to the user about the modes.
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
        /// Number of negative eigenvalues of the stiffness.
        negative: usize,
        /// Number of negative eigenvalues of the rotation block.
        expected: usize,
    },
    /// The numbers of energy-free modes and of rigid motions differ.
    #[error(
        "{found} modes cost no energy, {expected} rigid motions were expected: {}",
        if found > expected { "the body has mechanisms" } else { "some rigid motions cost energy in this model" }
    )]
    RigidCount {
        /// Number of energy-free modes.
        found: usize,
        /// Number of rigid motions permitted by supports and connectivity.
        expected: usize,
    },
    /// All requested modes are energy-free.
    #[error(
        "all {modes} modes cost no energy, and the body has {expected} rigid motions: {}",
        if modes > expected { "it has mechanisms" } else { "ask for more modes" }
    )]
    OnlyRigid {
        /// Number of requested modes.
        modes: usize,
        /// Number of rigid motions permitted by supports and connectivity.
        expected: usize,
    },
    /// The body has fewer modes than requested.
    #[error("the body has {found} modes with mass, {wanted} were asked for")]
    FewerModes {
        /// Number of modes with mass.
        found: usize,
        /// Number of requested modes.
        wanted: usize,
    },
    /// The iteration ended before all modes converged.
    #[error("the iteration ended after {products} solutions before all modes were exact")]
    NotConverged {
        /// Number of solutions with the factor.
        products: usize,
    },
    /// A mode has too large a residual.
    #[error("mode {mode} has a residual of {residual:.1e}, more than {RESIDUAL_TOLERANCE:.0e}")]
    Residual {
        /// Number of the mode, from 1.
        mode: usize,
        /// Residual of the mode.
        residual: f64,
    },
    /// The count of the eigenvalues shows missing modes.
    #[error("{missing} modes below the highest were not found")]
    Missing {
        /// Number of missing modes.
        missing: usize,
    },
}

/// Reason why modes cannot be computed.
#[derive(Debug, Error)]
pub enum ModalError {
    /// No degree of freedom with mass is free.
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
        /// Error of the factorisation.
        reason: FactorError,
    },
}
