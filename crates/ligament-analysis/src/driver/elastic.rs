//! Linear elastic driver: one solve at load factor one, or one at the end of each part of a programme.

use super::outcome::{Outcome, Rows};
use super::record::StepCounters;
use super::run::Run;
use super::run::StopRules;
use super::way::Stop;
use crate::breakage::Breakage;
use crate::error::SetupError;
use crate::history::{Observer, Termination};
use crate::problem::Problem;

/// Solves the problem at load factor one, or at the end of each part of its programme, without breakage. The history has the
/// unloaded body as step 0.
pub fn run(
    problem: &Problem,
    energy_tolerance: f64,
    observer: &mut dyn Observer,
) -> Result<Outcome, SetupError> {
    let (mut run, at_one) = Run::begin(problem, energy_tolerance, StopRules::NONE, observer)?;
    if let Some(end) = run.end_if_unstable()? {
        return Ok(run.into_outcome(end, Rows::LoadSteps));
    }
    let nothing = Breakage::default();
    let mut termination = Termination::StepsDone;
    let ends = ends(problem);
    // An iterative solver starts from the known solution; a direct one recomputes it bit for bit.
    let iterates = run.equilibrium.choice().iterates();
    let found = at_one.filter(|_| iterates && problem.loads.course().is_none());
    for (step, &(part, load_factor)) in ends.iter().enumerate() {
        run.begin_part(part);
        run.state.load_factor = load_factor;
        if let Some(found) = found.as_ref().filter(|it| it.load_factor == load_factor) {
            run.state.displacement.clone_from(&found.displacement);
        }
        let balanced = match run.next_equilibrium([step, 0], &nothing) {
            Ok(balanced) => balanced,
            Err(Stop::End(end)) => {
                termination = end;
                break;
            }
            Err(Stop::Failed(error)) => return Err(error),
        };
        let counters = StepCounters {
            step,
            at_rest: true,
            ..Default::default()
        };
        run.record(&balanced, counters, step + 1 == ends.len())?;
    }
    Ok(run.into_outcome(termination, Rows::LoadSteps))
}

/// Part of a programme and load factor of each solution, the unloaded body first.
fn ends(problem: &Problem) -> Vec<(usize, f64)> {
    let ends: Vec<(usize, f64)> = match problem.loads.course() {
        None => vec![(0, 1.0)],
        Some(loads) => {
            let parts = loads.programme.parts.iter().enumerate();
            parts.map(|(part, it)| (part, it.span.1)).collect()
        }
    };
    std::iter::once((0, 0.0)).chain(ends).collect()
}
