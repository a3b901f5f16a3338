//! Equations of a run, and the bonds that break next in a state that they balance.

use crate::balanced::Balanced;
use crate::bond_numbers::BondNumbers;
use crate::breaking::{self, BreakingRule};
use crate::connectivity::Fragments;
use crate::costs::Costs;
use crate::equilibrium::Equilibrium;
use crate::problem::Problem;
use crate::serial::Sink;
use crate::solver::SolverChoice;
use crate::state::State;

/// What a run solves or steps: the equations of equilibrium, or the bonds of explicit steps, which have no equations.
pub trait Equations {
    /// Global numbers of the local bonds.
    fn numbers(&self) -> &BondNumbers;

    /// Connected parts of the body.
    fn fragments(&self) -> &Fragments;

    /// Accumulated costs.
    fn costs(&self) -> &Costs;

    /// Solver that was chosen.
    fn choice(&self) -> SolverChoice;

    /// Appends the bytes from which they are restored.
    fn write(&self, out: &mut dyn Sink);
}

impl Equations for Equilibrium {
    fn numbers(&self) -> &BondNumbers {
        self.numbers()
    }

    fn fragments(&self) -> &Fragments {
        self.fragments()
    }

    fn costs(&self) -> &Costs {
        self.costs()
    }

    fn choice(&self) -> SolverChoice {
        *self.choice()
    }

    fn write(&self, out: &mut dyn Sink) {
        self.write(out);
    }
}

/// Bonds that break next in a balanced state of a body by a rule, in order. Collective.
pub(super) fn next_to_break(
    problem: &Problem,
    equations: &impl Equations,
    rule: &BreakingRule,
    (state, balanced): (&State, &Balanced),
) -> Vec<u32> {
    let criteria = problem.criteria_in(state, balanced);
    if problem.criteria.list.is_empty() {
        return Vec::new();
    }
    let rule = BreakingRule {
        tie_tolerance: equations.choice().tie_tolerance(rule.tie_tolerance),
        ..*rule
    };
    let in_file = |bond| problem.system.ends_in_file(bond);
    let (numbers, deformations) = (equations.numbers(), &balanced.deformations);
    breaking::next_to_break(
        numbers,
        &rule,
        deformations,
        &criteria,
        &state.intact,
        in_file,
    )
}
