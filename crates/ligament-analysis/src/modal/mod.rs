//! Natural modes: K phi = omega^2 M phi with lumped masses.
//!
//! [`ModalAnalysis`] finds the lowest modes of a body on its [`Supports`], including the rigid motions of a free body. M is
//! diagonal: M_i along x and y, J_i = M_i r_i for the rotation of a point (MPPD eq. 66).
//!
//! Bonds with a negative shear stiffness (Poisson's ratio above 1/3 in plane stress, 1/4 in plane strain) make the energy a maximum
//! in the rotations, and rotational inertia would give each of them a negative omega^2. With such bonds the rotations follow the
//! displacements without inertia: their equations are equations of equilibrium, as in static condensation.

mod analysis;
mod masses;
mod mode;
mod participation;
mod rigid;
mod shape;

use std::sync::Arc;

use ligament_linalg::FactorError;
#[cfg(feature = "case")]
use ligament_model::word::{WordOrAuto, open};
use ligament_model::{Bonds, LumpedMass, case_type};
use thiserror::Error;

use crate::balanced::Stability;
use crate::costs::Costs;
use crate::error::SetupError;
use crate::solver::{DirectChoice, SolverSettings};
use crate::supports::Supports;
use crate::user_message::Message;

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

/// Largest number of modes: each needs three vectors of the search in memory.
pub const MOST_MODES: u32 = 1000;

case_type! {
    /// Natural modes that are wanted.
    #[derive(Debug, Clone, Copy, PartialEq)]
    #[case(serde(default))]
    pub struct ModalSettings {
        /// Number of modes, rigid ones included, lowest first.
        #[range("minimum" = 1, "maximum" = MOST_MODES)]
        pub modes: usize,
        /// Inertia of the rotations of the points.
        #[case(serde(with = "open"), schemars(with = "WordOrAuto<Rotations>"))]
        pub rotations: Option<Rotations>,
        /// Residual of the search, relative to 1/omega^2.
        #[range("exclusiveMinimum" = 0)]
        pub tolerance: f64,
    }
}

impl Default for ModalSettings {
    fn default() -> Self {
        Self {
            modes: 10,
            rotations: None,
            tolerance: 1e-10,
        }
    }
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
    /// Messages to the user.
    pub messages: Vec<Message>,
    /// Costs of the equations.
    pub costs: Costs,
    /// Solver that was chosen for the equations.
    pub solver: DirectChoice,
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
