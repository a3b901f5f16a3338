//! An implicit step on trial: its equilibria, and the bonds that break in it.

use crate::balanced::{Attempt, Balanced};
use crate::breakage::Breakage;
use crate::breaking::BreakingRule;
use crate::driver::breaks::{self, Breaking};
use crate::driver::equations::next_to_break;
use crate::driver::run::Run;
use crate::driver::start::NoObserver;
use crate::error::SetupError;
use crate::history::BreakRecord;
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

/// A step of a run to a time, with at most `most` rounds of breaking, if there is a limit, on a copy of its state; the reason why it is too long, if
/// it is. The equations follow the copy.
pub(super) fn attempt(
    run: &mut Run<'_>,
    time: f64,
    rule: &BreakingRule,
    most: Option<usize>,
) -> Result<TrialStep, Rejected> {
    let (problem, equations, before) = (&run.problem, &mut run.equations, &run.state);
    let mut state = State {
        load_factor: time,
        ..before.clone()
    };
    let (mut broken, mut records) = (Vec::new(), Vec::new());
    let (mut breakage, mut round) = (Breakage::default(), 0);
    loop {
        // Friction and contact follow from the start of the step.
        (state.friction, state.surfaces) = (before.friction.clone(), before.surfaces.clone());
        let balanced = match equations.balance(&mut state, &breakage, &mut NoObserver)? {
            Attempt::Balanced(balanced) => balanced,
            Attempt::Unbalanced(reason) => return Err(Rejected::Unbalanced(reason)),
        };
        breakage = Breakage::default();
        if problem.begin_softening(&mut state, &balanced) {
            continue;
        }
        let next = next_to_break(problem, &*equations, rule, (&state, &balanced));
        if next.is_empty() {
            breaks::soften(problem, &mut state);
            return Ok(TrialStep {
                state,
                balanced,
                broken,
                records,
            });
        }
        round += 1;
        if most.is_some_and(|most| round > most) {
            return Err(Rejected::Rounds);
        }
        let breaking = Breaking {
            problem,
            numbers: equations.numbers(),
            criteria: &problem.criteria_in(&state, &balanced),
            deformation: &|_: usize, bond: usize| balanced.deformations[bond],
            moment: BreakRecord {
                order: run.progress.broken + broken.len(),
                step: run.progress.history.len(),
                round,
                ..BreakRecord::default()
            },
        };
        records.extend(breaking.apply(&mut state, &balanced.internal, &next));
        breakage = equations.break_bonds(&mut state, &next);
        broken.extend(next);
    }
}
