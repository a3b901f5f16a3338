//! Choice of the solver for the equations of a body.

use std::sync::Arc;

use ligament_model::Bonds;

use super::TangentSolver;
use super::direct::DirectSolver;
use super::distributed::DistributedSolver;
use super::iterative::IterativeSolver;
use super::unsymmetric::UnsymmetricSolver;
use crate::bond_numbers::BondNumbers;
use crate::error::SetupError;
use crate::solver::{IterativeChoice, Method, Reason, SolverChoice, SolverSettings, Unfit};
use crate::stiffness::{self, Stiffness};
use crate::unknowns::Unknowns;

/// A solver and the choice that led to it.
pub(crate) struct Solving {
    /// Sparsity pattern and symbolic factor; none where the solver has no matrix.
    pub(crate) stiffness: Option<Arc<Stiffness>>,
    pub(crate) choice: SolverChoice,
    pub(crate) solver: Box<dyn TangentSolver>,
}

impl Solving {
    /// Chooses a solver for unknowns, with the global numbers of the local bonds and whether faces may be pressed against each other, without
    /// factorising.
    ///
    /// # Errors
    ///
    /// If the named method cannot solve the equations, or the factor is too large.
    pub(crate) fn new(
        system: &Arc<dyn Bonds>,
        unknowns: &Arc<Unknowns>,
        settings: &SolverSettings,
        (numbers, presses): (&Arc<BondNumbers>, bool),
    ) -> Result<Self, SetupError> {
        let communicator = &settings.communicator;
        if communicator.has_matrices() {
            let choice = settings.distributed_choice(&**system, communicator.size());
            let choice = choice.map_err(SetupError::NotDistributed)?;
            if presses {
                return Err(SetupError::NotDistributed(Unfit::ClosingFaces));
            }
            let solver = DistributedSolver::new(
                system.clone(),
                unknowns.clone(),
                communicator.0.clone(),
                numbers.clone(),
                choice.tolerance,
            );
            return Ok(Self {
                stiffness: None,
                choice: SolverChoice::Distributed(choice),
                solver: Box::new(solver),
            });
        }
        let (method, reason) = settings.chosen_method(&**system)?;
        let iterating = |reason| {
            let choice = settings.iterative_choice(&**system, reason);
            Self::iterating(system, unknowns, choice, presses)
        };
        let Some(available) = settings.bound_of_factor(&**system) else {
            return match method {
                Method::Iterative => Ok(iterating(reason)),
                Method::Direct => {
                    let stiffness = Stiffness::new(system, unknowns.clone(), settings, reason)?;
                    Ok(Self::factorising(stiffness, presses))
                }
            };
        };
        let too_large = |needed| {
            let reason = Reason::Memory { needed, available };
            iterating(reason)
        };
        // The analysis of a factor that is far too large needs much memory itself.
        let least = stiffness::least_bytes(&**system);
        if least > available {
            return Ok(too_large(least));
        }
        let mut stiffness = Stiffness::new(system, unknowns.clone(), settings, reason)?;
        let needed = stiffness.bytes();
        if needed > available {
            return Ok(too_large(needed));
        }
        if method == Method::Iterative {
            stiffness.chosen_for(Reason::Memory { needed, available });
        }
        Ok(Self::factorising(stiffness, presses))
    }

    /// Conjugate gradients.
    fn iterating(
        system: &Arc<dyn Bonds>,
        unknowns: &Arc<Unknowns>,
        choice: IterativeChoice,
        presses: bool,
    ) -> Self {
        Self {
            stiffness: None,
            choice: SolverChoice::Iterative(choice),
            solver: Box::new(IterativeSolver::new(
                system.clone(),
                unknowns.clone(),
                choice,
                presses,
            )),
        }
    }

    /// Direct solver with a symmetric or unsymmetric factor.
    fn factorising(stiffness: Stiffness, presses: bool) -> Self {
        let stiffness = Arc::new(stiffness);
        let choice = *stiffness.choice();
        Self {
            solver: if choice.unsymmetric {
                Box::new(UnsymmetricSolver::new(stiffness.clone()))
            } else {
                Box::new(DirectSolver::new(stiffness.clone(), presses))
            },
            stiffness: Some(stiffness),
            choice: SolverChoice::Direct(choice),
        }
    }
}
