//! What equations cost.

use std::time::Duration;

use crate::serial;

/// What the equations have cost so far.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Costs {
    /// Factorisations; where the solver iterates, of its coarse space.
    pub factorisations: usize,
    /// Changes of a factor in place.
    pub changes: usize,
    /// Solves, those after a change of a factor included.
    pub solves: usize,
    /// Iterations of the solves, where the solver iterates.
    pub iterations: usize,
    /// Time in numbering, pattern and symbolic analysis.
    pub analysis: Duration,
    /// Time in assembly.
    pub assembly: Duration,
    /// Time in factorisation.
    pub factorisation: Duration,
    /// Time in changes in place, with the forward substitution that goes along.
    pub change: Duration,
    /// Time in the backward substitutions that follow them.
    pub backward: Duration,
    /// Time in other solves.
    pub solve: Duration,
    /// Time in deformations, forces, energies and the choice of bonds.
    pub bonds: Duration,
    /// Time in the search for loose parts.
    pub connectivity: Duration,
}

serial!(Costs {
    factorisations,
    changes,
    solves,
    iterations,
    analysis,
    assembly,
    factorisation,
    change,
    backward,
    solve,
    bonds,
    connectivity,
});
