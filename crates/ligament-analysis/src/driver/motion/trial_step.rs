//! An implicit step on trial: its equilibria, and the bonds that break in it.

use crate::balanced::{Attempt, Balanced};
use crate::breakage::Breakage;
use crate::breaking::{BreakingRule, next_to_break};
use crate::driver::breaks::{self, Breaking};
use crate::driver::start::NoObserver;
use crate::equilibrium::Equilibrium;
use crate::error::SetupError;
use crate::history::BreakRecord;
use crate::problem::Problem;
use crate::state::State;
use crate::unbalanced::Unbalanced;

/// A step on trial, which is accepted or dropped.
pub(super) struct TrialStep {
    pub(super) state: State,
    pub(super) balanced: Balanced,
    /// Bonds that broke, in order, with their records.
    pub(super) broken: Vec<u32>,
    pub(super) records: Vec<BreakRecord>,
}

/// Reason why a step cannot be taken: it is too long, or it failed.
pub(super) enum Rejected {
    /// Bonds broke round after round.
    Rounds,
    /// Without inertia it set energy free.
    Free,
    /// There was no equilibrium.
    Unbalanced(Unbalanced),
    /// The equations could not be set up.
    Failed(SetupError),
}

impl<E: Into<SetupError>> From<E> for Rejected {
    fn from(error: E) -> Self {
        Self::Failed(error.into())
    }
}

/// Settings of a step.
pub(super) struct StepSettings {
    /// Row of the history to which the step leads.
    pub(super) row: usize,
    /// Number of bonds that broke before it.
    pub(super) broken: usize,
    pub(super) rule: BreakingRule,
    /// Largest number of rounds of breaking; None: any number.
    pub(super) rounds: Option<usize>,
}

/// A step to the time of a state, from an equilibrium before it; the reason why it is too long, if it is.
pub(super) fn attempt(
    problem: &Problem,
    equilibrium: &mut Equilibrium,
    (state, balanced): (State, Balanced),
    settings: &StepSettings,
) -> Result<TrialStep, Rejected> {
    let mut taken = TrialStep {
        state,
        balanced,
        broken: Vec::new(),
        records: Vec::new(),
    };
    // Friction and contact follow from the start of the step.
    let contact = (taken.state.friction.clone(), taken.state.surfaces.clone());
    let mut breakage = Breakage::default();
    let mut rounds = 0;
    loop {
        (taken.state.friction, taken.state.surfaces) = contact.clone();
        let attempt = equilibrium.balance(&mut taken.state, &breakage, &mut NoObserver)?;
        taken.balanced = match attempt {
            Attempt::Balanced(balanced) => balanced,
            Attempt::Unbalanced(reason) => {
                return Err(Rejected::Unbalanced(reason));
            }
        };
        breakage = Breakage::default();
        if problem.begin_softening(&mut taken.state, &taken.balanced) {
            continue;
        }
        let next = next(problem, &settings.rule, equilibrium, &taken);
        if next.is_empty() {
            breaks::soften(problem, &mut taken.state);
            return Ok(taken);
        }
        rounds += 1;
        if settings.rounds.is_some_and(|most| rounds > most) {
            return Err(Rejected::Rounds);
        }
        let moment = BreakRecord {
            order: settings.broken + taken.broken.len(),
            step: settings.row,
            round: rounds,
            ..BreakRecord::default()
        };
        breakage = taken.break_bonds(problem, &next, moment, equilibrium);
    }
}

/// Bonds that break next in an equilibrium of a step.
fn next(
    problem: &Problem,
    rule: &BreakingRule,
    equilibrium: &Equilibrium,
    taken: &TrialStep,
) -> Vec<u32> {
    let criteria = problem.criteria_in(&taken.state, &taken.balanced);
    if problem.criteria.list.is_empty() {
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

impl TrialStep {
    /// Breaks bonds of an equilibrium of the step.
    fn break_bonds(
        &mut self,
        problem: &Problem,
        bonds: &[u32],
        moment: BreakRecord,
        equilibrium: &mut Equilibrium,
    ) -> Breakage {
        let Self {
            state, balanced, ..
        } = self;
        let criteria = problem.criteria_in(state, balanced);
        let deformation = |_, bond: usize| balanced.deformations[bond];
        let breaking = Breaking {
            problem,
            numbers: equilibrium.numbers(),
            criteria: &criteria,
            deformation: &deformation,
            moment,
        };
        let records = breaking.apply(state, &balanced.internal, bonds);
        self.records.extend(records);
        self.broken.extend(bonds);
        equilibrium.break_bonds(&mut self.state, bonds)
    }
}
