//! Errors that stop an analysis.

use ligament_linalg::{FactorError, PatternError};
use thiserror::Error;

use crate::bond_numbers::WithoutBonds;
use crate::checkpoint::CheckpointError;
use crate::history::ObserverError;
use crate::solver::Unfit;

/// What stops an analysis with an error.
#[derive(Debug, Error)]
pub enum SetupError {
    /// The system of equations could not be set up.
    #[error("the pattern of the stiffness matrix is broken: {0}")]
    Pattern(#[from] PatternError),
    /// The symbolic analysis failed.
    #[error(transparent)]
    Analysis(#[from] FactorError),
    /// Conjugate gradients were asked for where they cannot solve the equations.
    #[error(
        "conjugate gradients cannot solve these equations: {0}; let solver.method be direct, or leave it open"
    )]
    NotIterative(#[from] Unfit),
    /// Several processes cannot solve the equations.
    #[error("several processes cannot solve these equations: {0}; run it with one process")]
    NotDistributed(Unfit),
    /// A body has no bonds for one of the processes that share it out.
    #[error(transparent)]
    RankWithoutBonds(#[from] WithoutBonds),
    /// The exact path was asked for with bonds that soften.
    #[error(
        "the exact path goes in straight lines from breakage to breakage, and softening bonds bend them: take load steps"
    )]
    Softening,
    /// The exact path through stages was asked for with a criterion whose measure has no closed form along a line.
    #[error(
        "the exact path through stages needs to know where a bond reaches its limit along a line, which the criterion \"{criterion}\" \
         does not tell: take load steps"
    )]
    UnknownAlongLines {
        /// Name of the criterion.
        criterion: &'static str,
    },
    /// The loads of a body that is to break deform nothing.
    #[error(
        "nothing resists the loads: they move the body as a whole and do not deform it, so that no bond would ever break; hold a \
         part of it by a support"
    )]
    NothingResists,
    /// The exact path through stages was asked for with faces of cracks that close.
    #[error(
        "faces of cracks open and close on the way from breakage to breakage where one load stays and another grows, which the exact path \
         through stages does not follow: take load steps, or leave the faces open"
    )]
    ClosingFaces,
    /// A run cannot go on from its checkpoint.
    #[error("the run cannot go on from its checkpoint: {0}")]
    Checkpoint(#[from] CheckpointError),
    /// An observer could not do its part.
    #[error(transparent)]
    Observer(#[from] ObserverError),
}
