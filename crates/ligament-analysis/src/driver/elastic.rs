//! Linear elastic answer: one solve at load factor one.

use super::outcome::{Outcome, Rows};
use super::path::{Path, StopRules};
use super::recorder::StepCounters;
use crate::balanced::Attempt;
use crate::breakage::Breakage;
use crate::error::SetupError;
use crate::history::{Observer, Termination};
use crate::problem::Problem;

/// Solves the problem at load factor one; no bond breaks. The history has the unloaded body as step 0.
pub fn run(
    problem: &Problem,
    energy_tolerance: f64,
    observer: &mut dyn Observer,
) -> Result<Outcome, SetupError> {
    let (mut path, _) = Path::begin(problem, energy_tolerance, StopRules::NONE, observer)?;
    let nothing = Breakage::default();
    let mut termination = Termination::StepsDone;
    for (step, load_factor) in [0.0, 1.0].into_iter().enumerate() {
        path.state.load_factor = load_factor;
        path.enter(step, 0)?;
        let balanced = match path.balance(step, &nothing)? {
            Attempt::Balanced(balanced) => balanced,
            Attempt::Unbalanced(reason) => {
                termination = Termination::NoEquilibrium { step, reason };
                break;
            }
        };
        path.account(step, &nothing, &balanced)?;
        let counters = StepCounters {
            step,
            at_rest: true,
            ..Default::default()
        };
        path.record(&balanced, counters, load_factor == 1.0)?;
    }
    Ok(path.into_outcome(termination, Rows::LoadSteps))
}
