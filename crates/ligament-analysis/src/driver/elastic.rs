//! Linear elastic driver: one solve at load factor one, or one at the end of each part of a programme.

use super::record::StepCounters;
use super::run::Run;
use super::way::{Outcome, Rows, Stop, StopRules, Way};
use crate::breakage::Breakage;
use crate::error::SetupError;
use crate::history::{Observer, StepRecord, Termination};
use crate::problem::Problem;
use crate::state::State;

/// Begins with the unloaded body.
///
/// # Errors
///
/// If the equations cannot be set up, or the observer fails.
pub fn begin<'a>(
    problem: &Problem,
    energy_tolerance: f64,
    observer: &'a mut dyn Observer,
) -> Result<ElasticSolutions<'a>, SetupError> {
    let (mut run, at_one) = Run::begin(problem, energy_tolerance, StopRules::NONE, observer)?;
    let ended = run.end_if_unstable()?;
    // An iterative solver starts from the known solution; a direct one recomputes it bit for bit.
    let iterates = run.equations.choice().iterates();
    let found = at_one.filter(|_| iterates && problem.loads.course().is_none());
    Ok(ElasticSolutions {
        ends: ends(problem),
        next: 0,
        run,
        found,
        ended,
    })
}

/// Solves the problem at load factor one, or at the end of each part of its programme, without breakage. The history has the
/// unloaded body as step 0.
///
/// # Errors
///
/// As in [`begin`], or if the run fails.
pub fn run(
    problem: &Problem,
    energy_tolerance: f64,
    observer: &mut dyn Observer,
) -> Result<Outcome, SetupError> {
    Box::new(begin(problem, energy_tolerance, observer)?).follow()
}

/// Elastic solutions of a problem.
pub struct ElasticSolutions<'a> {
    run: Run<'a>,
    /// Part of a programme and load factor of each solution, the unloaded body first.
    ends: Vec<(usize, f64)>,
    /// Number of the next solution.
    next: usize,
    /// Solution from which an iterative solver starts.
    found: Option<State>,
    /// Reason why the run ended before its first solution.
    ended: Option<Termination>,
}

impl Way for ElasticSolutions<'_> {
    fn advance(&mut self) -> Result<(), Stop> {
        if let Some(end) = self.ended.take() {
            return Err(Stop::End(end));
        }
        let (run, step) = (&mut self.run, self.next);
        let Some(&(part, load_factor)) = self.ends.get(step) else {
            return Err(Stop::End(Termination::StepsDone));
        };
        run.begin_part(part);
        run.state.load_factor = load_factor;
        let found = self.found.as_ref();
        if let Some(found) = found.filter(|it| it.load_factor == load_factor) {
            run.state.displacement.clone_from(&found.displacement);
        }
        let balanced = run.next_equilibrium([step, 0], &Breakage::default())?;
        let counters = StepCounters {
            step,
            at_rest: true,
            ..Default::default()
        };
        self.next += 1;
        run.record(&balanced, counters, self.next == self.ends.len())?;
        Ok(())
    }

    fn now(&self) -> (&State, &[StepRecord]) {
        self.run.now()
    }

    fn outcome(self: Box<Self>, end: Termination) -> Result<Outcome, SetupError> {
        Ok(self.run.into_outcome(end, Rows::LoadSteps))
    }
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
