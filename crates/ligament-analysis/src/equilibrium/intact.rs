//! Equations of an intact body from which several runs begin.

use std::sync::Arc;

use super::equations::Equations;
use super::{Equilibrium, Iteration};
use crate::bond_numbers::BondNumbers;
use crate::connectivity::decremental::Connectivity;
use crate::tangent::direct::DirectSolver;

/// Equations of an intact body with its factor, which do not change: each run begins with a copy.
pub(crate) struct IntactEquilibrium {
    equations: Equations<DirectSolver>,
    connectivity: Connectivity,
    numbers: Arc<BondNumbers>,
    iteration: Iteration,
}

impl Equilibrium {
    /// The present equations for runs that begin from here; None where the solver is not direct with a symmetric factor.
    pub(crate) fn intact(&self) -> Option<IntactEquilibrium> {
        let solver = self.equations.solver.copied()?;
        Some(IntactEquilibrium {
            equations: self.equations.with_solver(Box::new(solver)),
            connectivity: self.connectivity.clone(),
            numbers: self.numbers.clone(),
            iteration: self.iteration,
        })
    }
}

impl IntactEquilibrium {
    /// A copy for a run.
    pub(crate) fn begun(&self) -> Equilibrium {
        let solver = self.equations.solver.copy();
        Equilibrium {
            equations: self.equations.with_solver(Box::new(solver)),
            connectivity: self.connectivity.clone(),
            numbers: self.numbers.clone(),
            iteration: self.iteration,
            held: None,
        }
    }
}

impl<S: ?Sized> Equations<S> {
    /// The equations with another solver of the same stiffness.
    fn with_solver<T: ?Sized>(&self, solver: Box<T>) -> Equations<T> {
        Equations {
            solver,
            problem: self.problem.clone(),
            unknowns: self.unknowns.clone(),
            halo: self.halo.clone(),
            stiffness: self.stiffness.clone(),
            choice: self.choice,
            energy_tolerance: self.energy_tolerance,
            accuracy: self.accuracy.clone(),
            meeting: self.meeting.clone(),
            earlier: self.earlier.clone(),
            costs: self.costs,
        }
    }
}
