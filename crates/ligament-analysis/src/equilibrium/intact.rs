//! Equations with another solver of the same stiffness.

use super::equations::Equations;

impl<S: ?Sized> Equations<S> {
    /// A copy of the equations with another solver of the same stiffness.
    pub(super) fn with_solver<T: ?Sized>(&self, solver: Box<T>) -> Equations<T> {
        Equations {
            solver,
            problem: self.problem.clone(),
            unknowns: self.unknowns.clone(),
            halo: self.halo.clone(),
            stiffness: self.stiffness.clone(),
            choice: self.choice,
            energy_tolerance: self.energy_tolerance,
            accuracy: self.accuracy.clone(),
            contact: self.contact.clone(),
            earlier: self.earlier.clone(),
            costs: self.costs,
        }
    }
}
