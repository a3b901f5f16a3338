//! The solver that is chosen for the equations of a body.

use std::sync::Arc;

use ligament_model::Bonds;

use super::TangentSolver;
use super::direct::DirectSolver;
use super::distributed::DistributedSolver;
use super::iterative::IterativeSolver;
use super::unsymmetric::UnsymmetricSolver;
use crate::error::SetupError;
use crate::ranks::Together;
use crate::solver::{IterativeChoice, Method, SolverChoice, SolverSettings};
use crate::stiffness::Stiffness;
use crate::unknowns::Unknowns;

/// A solver with what was chosen for it.
pub(crate) struct Solving {
    /// Pattern and symbolic factor; none where the solver has no matrix.
    pub(crate) stiffness: Option<Arc<Stiffness>>,
    pub(crate) choice: SolverChoice,
    pub(crate) solver: Box<dyn TangentSolver>,
}

impl Solving {
    /// Chooses a solver for some unknowns; nothing is factorised yet.
    ///
    /// # Errors
    ///
    /// If the named method cannot solve the equations, or the factor is too large.
    pub(crate) fn new(
        system: &Arc<dyn Bonds>,
        unknowns: &Arc<Unknowns>,
        settings: SolverSettings,
    ) -> Result<Self, SetupError> {
        if let Some(Together(ranks)) = settings.ranks {
            let choice = settings.distributed_choice(&**system, ranks.n_ranks());
            let choice = choice.map_err(SetupError::NotDistributed)?;
            let (system, unknowns) = (system.clone(), unknowns.clone());
            let solver = DistributedSolver::new(system, unknowns, ranks, choice.tolerance);
            return Ok(Self {
                stiffness: None,
                choice: SolverChoice::Distributed(choice),
                solver: Box::new(solver),
            });
        }
        let (method, reason) = settings.chosen_method(&**system)?;
        if method == Method::Iterative {
            let tolerance = settings.tolerance;
            let solver = IterativeSolver::new(system.clone(), unknowns.clone(), tolerance);
            return Ok(Self {
                stiffness: None,
                choice: SolverChoice::Iterative(IterativeChoice { reason, tolerance }),
                solver: Box::new(solver),
            });
        }
        let stiffness = Arc::new(Stiffness::new(system, unknowns.clone(), settings, reason)?);
        let choice = *stiffness.choice();
        Ok(Self {
            solver: if choice.unsymmetric {
                Box::new(UnsymmetricSolver::new(stiffness.clone()))
            } else {
                Box::new(DirectSolver::new(stiffness.clone()))
            },
            stiffness: Some(stiffness),
            choice: SolverChoice::Direct(choice),
        })
    }
}
