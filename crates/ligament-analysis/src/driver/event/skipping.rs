//! Skipped events, for which the observer does not need the whole body: [updates of its parts are delayed](super::super::delayed_updates).
//!
//! The line through the unloaded state is stored at one load factor, and quantities at critical load factors are proportional.

use super::super::delayed_updates::{DelayedUpdates, WHOLE_EVERY};
use crate::balanced::{Attempt, Balanced};
use crate::breakage::Breakage;
use crate::breaking::{FirstToBreak, Leading};
use crate::driver::record::StepCounters;
use crate::driver::run::Run;
use crate::error::SetupError;
use crate::lagging::Body;

/// Result of skipping events.
pub(super) enum Skipped {
    /// No event was skipped, because the run may end with the next one.
    Nothing,
    /// An equilibrium of the whole body, or the reason why there is none.
    Line(Attempt),
    /// A breakage that cannot be applied to delayed parts, and the equilibrium of the whole body before it.
    Broke(Balanced, Breakage),
}

/// Whether an event may be skipped.
pub(super) fn may_skip(run: &Run<'_>, step: usize) -> bool {
    !step.is_multiple_of(WHOLE_EVERY) && !run.observer.looks(step)
}

/// Skips events from an equilibrium on the line to the first of them, as long as allowed; advances the step number.
pub(super) fn skip(
    run: &mut Run<'_>,
    body: &Body,
    tie_tolerance: f64,
    step: &mut usize,
    line: &Balanced,
) -> Result<Skipped, SetupError> {
    let problem = run.problem.clone();
    let leading = Leading::Tied(tie_tolerance);
    let (mut delayed, leaders) = DelayedUpdates::begin(run, (&problem, body), leading, line);
    let mut first = leaders.first_to_break();
    let first_step = *step;
    while may_skip(delayed.run, *step) {
        let Some(critical) = go_to(&mut delayed, &first) else {
            if *step == first_step {
                delayed.go_back();
                return Ok(Skipped::Nothing);
            }
            break;
        };
        let breakage = break_first(&mut delayed, first, critical, *step)?;
        let Some(next) = delayed.follow(&breakage, [*step, 1])? else {
            let before = delayed.before(&breakage);
            return Ok(Skipped::Broke(before, breakage));
        };
        *step += 1;
        first = next.first_to_break();
    }
    delayed.catch_up();
    let attempt = run.balance(*step, &Breakage::default())?;
    Ok(Skipped::Line(attempt))
}

/// Moves to the load factor at which the first bonds break; None where the run may end before.
fn go_to(delayed: &mut DelayedUpdates<'_, '_>, first: &FirstToBreak) -> Option<Balanced> {
    let load_factor = delayed.load_factor / first.ratio;
    if !(load_factor > 0.0 && load_factor <= 1.0) {
        return None;
    }
    delayed.run.state.load_factor = load_factor;
    delayed.know(&[]);
    let (critical, run) = (delayed.known(), &delayed.run);
    let (displacement, _) = run.problem.control(&run.state, &critical);
    let wanted = run.stop.displacement;
    let ends = wanted.is_some_and(|wanted| displacement >= wanted)
        || run.interruption().is_some()
        || run.end_at_rest(&critical).is_some()
        || run.end_by_load_fraction(&critical).is_some();
    (!ends).then_some(critical)
}

/// Records a critical equilibrium and breaks its bonds.
fn break_first(
    delayed: &mut DelayedUpdates<'_, '_>,
    first: FirstToBreak,
    mut critical: Balanced,
    step: usize,
) -> Result<Breakage, SetupError> {
    let run = &mut *delayed.run;
    run.account(step, &Breakage::default(), &critical)?;
    critical.stored_energy = run.energies.stored_in_proportion();
    run.enter(step, 0)?;
    run.progress.solves[0] = run.equations.costs().solves;
    run.progress.negative_eigenvalues = run.equations.negative_eigenvalues();
    let counters = StepCounters {
        step,
        broken_in_step: first.bonds.len(),
        rounds: 1,
        at_rest: true,
        largest_ratio: 1.0,
        ..Default::default()
    };
    run.record_observed_points(&critical, counters)?;
    let system = delayed.run.problem.system.clone();
    let first = first.sorted(|it| system.ends_in_file(it));
    let bonds = delayed.deformed(&first.bonds);
    delayed.break_bonds(&bonds, &critical, [step, 1])
}
