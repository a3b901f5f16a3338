//! An implicit step on trial: its equilibria, and the bonds that break in it.

use crate::balanced::Balanced;
use crate::breakage::Breakage;
use crate::breaking::{BreakingRule, next_to_break};
use crate::driver::breaks::{Breaking, CriteriaAtDeformations};
use crate::driver::dissipation;
use crate::equilibrium::Equilibrium;
use crate::history::BreakRecord;
use crate::problem::Problem;
use crate::state::State;

/// A step that was taken.
pub(super) struct Taken {
    pub(super) state: State,
    pub(super) balanced: Balanced,
    /// Bonds that broke, in order, with their records.
    pub(super) broken: Vec<u32>,
    pub(super) records: Vec<BreakRecord>,
}

/// Bonds that break next in an equilibrium of a step.
pub(super) fn next(
    problem: &Problem,
    rule: &BreakingRule,
    equilibrium: &Equilibrium,
    taken: &Taken,
) -> Vec<u32> {
    let criteria = problem.criteria_in(&taken.state, &taken.balanced);
    if criteria.list.is_empty() {
        return Vec::new();
    }
    let (system, deformations) = (&problem.system, &taken.balanced.deformations);
    let in_file = |bond| system.ends_in_file(bond);
    let rule = BreakingRule {
        tie_tolerance: equilibrium.choice().tie_tolerance(rule.tie_tolerance),
        ..*rule
    };
    let intact = &taken.state.intact;
    next_to_break(
        equilibrium.numbers(),
        &rule,
        deformations,
        &criteria,
        intact,
        in_file,
    )
}

impl Taken {
    /// Breaks bonds of an equilibrium of the step.
    pub(super) fn break_bonds(
        &mut self,
        problem: &Problem,
        bonds: &[u32],
        moment: BreakRecord,
        equilibrium: &mut Equilibrium,
    ) -> Breakage {
        let Self {
            state, balanced, ..
        } = self;
        let time = state.load_factor;
        let criteria = problem.criteria_in(state, balanced).into_owned();
        let deformation = |_, bond: usize| balanced.deformations[bond];
        let breaking = Breaking {
            ends: problem.system.ends(),
            judged: CriteriaAtDeformations {
                criteria: &criteria,
                deformation: &deformation,
            },
            moment: BreakRecord {
                load_factor: time,
                displacement: problem
                    .loads
                    .control_displacement(time, &state.displacement),
                reaction: problem.loads.control_force(time, &balanced.internal),
                ..moment
            },
        };
        let records = breaking.records(equilibrium.numbers(), bonds);
        for record in &records {
            dissipation::break_bond(problem, state, record.bond as usize, record);
        }
        self.records.extend(records);
        self.broken.extend(bonds);
        equilibrium.break_bonds(&mut self.state, bonds)
    }
}
