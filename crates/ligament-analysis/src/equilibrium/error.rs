//! Why there is no equilibrium, and what stops an analysis.

use ligament_linalg::{FactorError, PatternError};
use thiserror::Error;

use crate::history::ObserverError;

/// Why no equilibrium was found: an outcome of the run, not an error.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum Unbalanced {
    /// Newton-Raphson did not get there.
    #[error(
        "Newton-Raphson did not converge: residual {residual:.1e} after {iterations} iterations"
    )]
    NotConverged {
        /// Relative residual of the last iterate.
        residual: f64,
        /// Iterations done.
        iterations: usize,
    },
    /// A pivot of the indefinite matrix vanished.
    #[error(
        "the stiffness lost stability: vanishing pivot at point {point}, component {component}"
    )]
    VanishingPivot {
        /// Point index.
        point: u32,
        /// Component name.
        component: &'static str,
    },
    /// L L^T was asked for where bonds have negative stiffness, and met a pivot that is not positive.
    #[error(
        "the stiffness is not positive definite, as L L^T needs (pivot at point {point}, component {component}): bonds \
         have a negative shear stiffness (large Poisson's ratio); let the factorisation be \"auto\" or \"ldlt\""
    )]
    NotPositiveDefinite {
        /// Point index.
        point: u32,
        /// Component name.
        component: &'static str,
    },
    /// The energy of the motions is negative: the stored one, unless the temperature changes.
    #[error("the stiffness lost stability: negative strain energy {energy:.3e} J")]
    NegativeEnergy {
        /// That energy, J.
        energy: f64,
    },
    /// The matrix could not be factorised.
    #[error("the stiffness has no factor: {0}")]
    NoFactor(FactorError),
}

/// What stops an analysis with an error.
#[derive(Debug, Error)]
pub enum SetupError {
    /// The system of equations could not be set up.
    #[error("the pattern of the stiffness matrix is broken: {0}")]
    Pattern(#[from] PatternError),
    /// The symbolic analysis failed.
    #[error(transparent)]
    Analysis(#[from] FactorError),
    /// The exact path was asked for with bonds that soften.
    #[error(
        "the exact path goes in straight lines from breakage to breakage, and softening bonds bend them: take load steps"
    )]
    Softening,
    /// An observer could not do its part.
    #[error(transparent)]
    Observer(#[from] ObserverError),
}
