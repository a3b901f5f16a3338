//! Errors that stop an analysis.

use ligament_linalg::{FactorError, PatternError};
use thiserror::Error;

use crate::bond_numbers::WithoutBonds;
use crate::checkpoint::CheckpointError;
use crate::history::ObserverError;
use crate::motion::MotionError;
use crate::solver::Unfit;

/// Error that stops an analysis.
#[derive(Debug, Error)]
pub enum SetupError {
    /// The sparsity pattern of the stiffness matrix is invalid.
    #[error("the pattern of the stiffness matrix is broken: {0}")]
    Pattern(#[from] PatternError),
    /// The symbolic analysis failed.
    #[error(transparent)]
    Analysis(#[from] FactorError),
    /// Conjugate gradients were required where they cannot solve the equations.
    #[error(
        "conjugate gradients cannot solve these equations: {0}; let solver.method be direct, or leave it open"
    )]
    NotIterative(#[from] Unfit),
    /// Several processes cannot solve the equations.
    #[error("several processes cannot solve these equations: {0}; use one process")]
    NotDistributed(Unfit),
    /// A process has no bonds of a divided body.
    #[error(transparent)]
    RankWithoutBonds(#[from] WithoutBonds),
    /// The exact path was required with bonds that soften.
    #[error(
        "the exact path goes in straight lines from breakage to breakage, and softening bonds bend them: take load steps"
    )]
    Softening,
    /// The exact path through stages or with contact was required with a criterion whose measure has no closed form along a line.
    #[error(
        "the exact path through stages or with contact needs to know where a bond reaches its limit along a line, which the criterion \"{criterion}\" \
         does not tell: take load steps"
    )]
    UnknownAlongLines {
        /// Name of the criterion.
        criterion: &'static str,
    },
    /// The loads cause no deformation of a body that is to break.
    #[error(
        "nothing resists the loads: they move the body as a whole and do not deform it, so that no bond would ever break; hold a \
         part of it by a support"
    )]
    NothingResists,
    /// The exact path through stages was required with crack faces that close, or with contact.
    #[error(
        "faces of cracks and surfaces open and close on the way from breakage to breakage where one load stays and another grows, which the \
         exact path through stages does not follow: take load steps, or leave the faces open"
    )]
    ClosingFaces,
    /// The exact path was required with friction, or with contact between surfaces in present positions.
    #[error(
        "friction, and contact between surfaces in their present positions, depend on the way to a state, which the exact path from breakage \
         to breakage does not follow: take load steps"
    )]
    ContactOnExactPath,
    /// A motion in time cannot be computed.
    #[error(transparent)]
    Motion(#[from] MotionError),
    /// A run cannot continue from its checkpoint.
    #[error("cannot resume from the checkpoint: {0}")]
    Checkpoint(#[from] CheckpointError),
    /// An observer failed.
    #[error(transparent)]
    Observer(#[from] ObserverError),
}
