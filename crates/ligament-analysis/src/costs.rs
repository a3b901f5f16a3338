//! Costs of the equations.

use std::time::Duration;

use serde::{Deserialize, Serialize};

/// Accumulated costs of the equations.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize)]
pub struct Costs {
    /// Number of factorisations; with an iterative solver, of its coarse space.
    pub factorisations: usize,
    /// Number of updates of a factor in place.
    pub changes: usize,
    /// Number of solves, including those after an update of a factor.
    pub solves: usize,
    /// Number of iterations of an iterative solver.
    pub iterations: usize,
    /// Time of numbering, pattern and symbolic analysis.
    pub analysis: Duration,
    /// Time of assembly.
    pub assembly: Duration,
    /// Time of factorisation.
    pub factorisation: Duration,
    /// Time of updates in place, including their forward substitutions.
    pub change: Duration,
    /// Time of backward substitutions after updates.
    pub backward: Duration,
    /// Time of other solves.
    pub solve: Duration,
    /// Time of deformations, forces, energies and the selection of bonds.
    pub bonds: Duration,
    /// Time of the search for detached parts.
    pub connectivity: Duration,
}

impl Costs {
    /// Sum of the costs of two successive equations.
    pub fn plus(&self, other: &Self) -> Self {
        Self {
            factorisations: self.factorisations + other.factorisations,
            changes: self.changes + other.changes,
            solves: self.solves + other.solves,
            iterations: self.iterations + other.iterations,
            analysis: self.analysis + other.analysis,
            assembly: self.assembly + other.assembly,
            factorisation: self.factorisation + other.factorisation,
            change: self.change + other.change,
            backward: self.backward + other.backward,
            solve: self.solve + other.solve,
            bonds: self.bonds + other.bonds,
            connectivity: self.connectivity + other.connectivity,
        }
    }
}
