//! Stepped loading with ordered bond breaking (NHPD section 2.4, Fig. 5).
//!
//! A load step solves for equilibrium, orders the bonds beyond their critical stretch, breaks the first of them and solves again,
//! until no bond is left to break.

use std::io::Read;
use std::time::Instant;

use super::checkpoint::{Restored, RestoredRun, WayKind};
use super::delayed_updates::{DelayedUpdates, PartsOfBody, WHOLE_EVERY};
use super::equations::next_to_break;
use super::prediction::{self, Prediction};
use super::prepared::Prepared;
use super::record::{ElasticAnswer, StepCounters};
use super::run::Run;
use super::way::{LoadPoint, Outcome, Rows, Stop, StopRules, Way};
use crate::balanced::Balanced;
use crate::breakage::Breakage;
use crate::breaking::{BreakingRule, Leading};
use crate::checkpoint::CheckpointError;
use crate::error::SetupError;
use crate::history::{Observer, StepRecord, Termination};
use crate::load_program::Part;
use crate::problem::Problem;
use crate::state::State;

/// Settings of load steps, with their stop rules.
#[derive(Debug, Clone, PartialEq)]
pub struct SteppedSettings {
    /// Load factor at the end of each step; where it falls, the body is unloaded. None with a programme of stages, which has its
    /// own steps.
    pub load_factors: Vec<f64>,
    /// Number of steps into which the rest of the first breakage's step is divided, after a step that ends exactly there; 0: off.
    pub refine_first_break: usize,
    /// Rule that selects the bonds that break in a round.
    pub rule: BreakingRule,
    /// Relative change of the energy that ends Newton-Raphson (NHPD eq. 21).
    pub energy_tolerance: f64,
    /// Largest number of rounds of breaking in a step.
    pub round_limit: usize,
    /// Rules for a stop before the last step.
    pub stop: StopRules,
}

/// Begins with the unloaded body.
///
/// # Errors
///
/// If the equations cannot be set up, nothing resists the loads, or the observer fails.
pub fn begin<'a>(
    problem: &Problem,
    settings: &SteppedSettings,
    observer: &'a mut dyn Observer,
) -> Result<LoadSteps<'a>, SetupError> {
    let begun = Run::begin(problem, settings.energy_tolerance, settings.stop, observer)?;
    LoadSteps::begun(begun, settings)
}

/// Follows the load program from its beginning to the end of the run.
///
/// # Errors
///
/// As in [`begin`], or if the run fails.
pub fn run(
    problem: &Problem,
    settings: &SteppedSettings,
    observer: &mut dyn Observer,
) -> Result<Outcome, SetupError> {
    Box::new(begin(problem, settings, observer)?).follow()
}

/// Follows the load program of a problem that differs from the prepared one in its criteria, to the bits of [`run`].
///
/// # Errors
///
/// If nothing resists the loads, or the observer fails.
pub fn run_from(
    prepared: &Prepared,
    problem: &Problem,
    settings: &SteppedSettings,
    observer: &mut dyn Observer,
) -> Result<Outcome, SetupError> {
    let begun = prepared.begun(problem, settings.stop, observer)?;
    Box::new(LoadSteps::begun(begun, settings)?).follow()
}

/// Predicts the first failure in the load steps.
///
/// # Errors
///
/// If the equations cannot be set up, or nothing resists the loads.
pub fn predict(
    problem: &Problem,
    settings: &SteppedSettings,
    observer: &mut dyn Observer,
) -> Result<Prediction, SetupError> {
    let begun = Run::begin(problem, settings.energy_tolerance, settings.stop, observer)?;
    if let Some(refused) = Prediction::refused(&begun.0) {
        return Ok(refused);
    }
    let (run, at_one, plan) = planned(begun, settings)?;
    let factors: Vec<f64> = plan.iter().skip(1).map(|it| it.load_factor).collect();
    prediction::predict(run, at_one, Some(&factors))
}

/// Run before its first load step, its equilibrium at load factor one, if there is one, and all load steps.
fn planned<'a>(
    (mut run, at_one): (Run<'a>, Option<State>),
    settings: &SteppedSettings,
) -> Result<(Run<'a>, Option<State>, Vec<LoadStep>), SetupError> {
    run.require_resistance(at_one.as_ref())?;
    let plan = plan(&run.problem, settings, &run.progress.elastic);
    if let (Some(at_one), Some(first)) = (&at_one, plan.get(1)) {
        run.report_first_step(at_one, first.load_factor)?;
    }
    Ok((run, at_one, plan))
}

/// Restores a run from a checkpoint, to continue as if it had never stopped; the stop rules may differ from those before, and load steps may be
/// added.
///
/// # Errors
///
/// If the checkpoint is damaged, belongs to another problem or driver, or has other load steps so far.
pub fn restore(
    problem: &Problem,
    settings: &SteppedSettings,
    checkpoint: &mut dyn Read,
) -> Result<Restored, SetupError> {
    let energy_tolerance = settings.energy_tolerance;
    let step = |(counters, load_factors): &InLoadStep| {
        (load_factors.len() == counters.step + 1).then_some(counters.step)
    };
    let with = (problem, energy_tolerance);
    let restored = RestoredRun::of_equilibria(WayKind::LoadSteps, with, checkpoint, step)?;
    let (_, done) = &restored.position;
    let plan = plan(problem, settings, &restored.progress.elastic);
    let planned = |step: usize| plan.get(step).map(|it| it.load_factor.to_bits());
    let is_same = |step: &usize| planned(*step) == Some(done[*step].to_bits());
    if let Some(step) = (0..done.len()).find(|step| !is_same(step)) {
        let was = done[step];
        return Err(CheckpointError::OtherLoading { step, was }.into());
    }
    let settings = settings.clone();
    Ok(Restored::new(restored, move |restored, observer| {
        let (mut run, balanced, (counters, _)) = Run::go_on(settings.stop, restored, observer);
        run.aim(plan[counters.step].load_factor);
        Box::new(LoadSteps {
            run,
            settings,
            plan,
            next: counters.step,
            begun: Some((counters, balanced)),
            parts: PartsOfBody::default(),
            ended: None,
        })
    }))
}

/// Position within a load step: load factors of the steps up to the present one, that of the unloaded body first.
type InLoadStep = (StepCounters, Vec<f64>);

/// A load step.
#[derive(Debug, Clone, Copy, PartialEq)]
struct LoadStep {
    /// Index of the part of the programme of stages; 0 without one.
    part: usize,
    /// Load factor at the end of the step, or the share of the controlling motion or energy of its part.
    load_factor: f64,
}

/// All load steps, the unloaded body first.
fn plan(problem: &Problem, settings: &SteppedSettings, elastic: &ElasticAnswer) -> Vec<LoadStep> {
    let step = |part: usize| move |load_factor: f64| LoadStep { part, load_factor };
    let steps: Vec<LoadStep> = match problem.loads.course() {
        None => refined(settings, elastic.first_break)
            .into_iter()
            .map(step(0))
            .collect(),
        Some(loads) => {
            let parts = loads.programme.parts.iter().enumerate();
            let of_part =
                |(part, it): (usize, &Part)| it.load_factors().into_iter().map(step(part));
            parts.flat_map(of_part).collect()
        }
    };
    std::iter::once(step(0)(0.0)).chain(steps).collect()
}

/// Load factors with the step of the first breakage divided.
fn refined(settings: &SteppedSettings, first_break: Option<LoadPoint>) -> Vec<f64> {
    let factors = &settings.load_factors;
    let (
        parts,
        Some(LoadPoint {
            load_factor: first, ..
        }),
    ) = (settings.refine_first_break, first_break)
    else {
        return factors.clone();
    };
    let Some(divided) = factors
        .iter()
        .position(|&factor| factor > first)
        .filter(|_| parts > 0)
    else {
        return factors.clone();
    };
    let end = factors[divided];
    let inner = (0..=parts).map(|part| first + (end - first) * part as f64 / parts as f64);
    let before = factors[..divided]
        .iter()
        .copied()
        .filter(|&factor| factor < first);
    before
        .chain(inner)
        .chain(factors[divided + 1..].iter().copied())
        .collect()
}

/// Run through load steps.
pub struct LoadSteps<'a> {
    run: Run<'a>,
    settings: SteppedSettings,
    /// All load steps, the unloaded body first.
    plan: Vec<LoadStep>,
    /// Number of the next load step.
    next: usize,
    /// Equilibrium within the next load step from which a restored run goes on.
    begun: Option<(StepCounters, Balanced)>,
    parts: PartsOfBody,
    /// Reason why the run ended before its first load step.
    ended: Option<Termination>,
}

impl Way for LoadSteps<'_> {
    fn advance(&mut self) -> Result<(), Stop> {
        if let Some(end) = self.ended.take() {
            return Err(Stop::End(end));
        }
        let step = self.next;
        let (counters, balanced) = match self.begun.take() {
            Some(begun) => begun,
            None => {
                let Some(&LoadStep { part, load_factor }) = self.plan.get(step) else {
                    return Err(Stop::End(Termination::StepsDone));
                };
                self.run.begin_part(part);
                self.run.aim(load_factor);
                if !self.run.is_controlled() {
                    self.run.state.load_factor = load_factor;
                }
                let counters = StepCounters {
                    step,
                    ..Default::default()
                };
                let nothing = Breakage::default();
                (counters, self.run.next_equilibrium([step, 0], &nothing)?)
            }
        };
        self.break_until_admissible(counters, balanced)?;
        self.next += 1;
        Ok(())
    }

    fn now(&self) -> (&State, &[StepRecord]) {
        self.run.now()
    }

    fn set_next_load_factor(&mut self, load_factor: f64) -> bool {
        let next = self.plan.get_mut(self.next);
        next.map(|it| it.load_factor = load_factor).is_some()
    }

    fn outcome(mut self: Box<Self>, end: Termination) -> Result<Outcome, SetupError> {
        self.run.report_past_peak(&end)?;
        Ok(self.run.into_outcome(end, Rows::LoadSteps))
    }
}

impl<'a> LoadSteps<'a> {
    /// Load steps from the unloaded body; with its equilibrium at load factor one, if there is one.
    fn begun(
        (mut run, at_one): (Run<'a>, Option<State>),
        settings: &SteppedSettings,
    ) -> Result<Self, SetupError> {
        let mut plan = Vec::new();
        let ended = run.end_if_unstable()?;
        if ended.is_none() {
            (run, _, plan) = planned((run, at_one), settings)?;
            run.soften();
        }
        Ok(Self {
            run,
            settings: settings.clone(),
            plan,
            next: 0,
            begun: None,
            parts: PartsOfBody::default(),
            ended,
        })
    }

    /// Breaks bonds in a load step, from an equilibrium on, until none is left to break.
    ///
    /// Where a breakage leaves no equilibrium, the step records the last one before it.
    fn break_until_admissible(
        &mut self,
        mut counters: StepCounters,
        mut balanced: Balanced,
    ) -> Result<(), Stop> {
        loop {
            let Run { problem, state, .. } = &mut self.run;
            let mut breakage = Some(Breakage::default());
            if !problem.begin_softening(state, &balanced) {
                let next = self.next_to_break(&balanced);
                counters.at_rest = next.is_empty();
                let end = self.end(&balanced, &counters);
                let end = self.offer(&balanced, counters, end)?;
                if counters.at_rest || end.is_some() {
                    return self.record(&balanced, counters, end);
                }
                self.show_between_breakages(&balanced, counters)?;
                breakage = self.break_next(&mut counters, next, &mut balanced)?;
                if self.run.collapsed {
                    return self.record(&balanced, counters, Some(Termination::Collapsed));
                }
            }
            let at = [counters.step, counters.rounds];
            let is_behind = breakage.is_none();
            let breakage = breakage.unwrap_or_default();
            balanced = match self.run.next_equilibrium(at, &breakage) {
                Err(Stop::End(end)) => {
                    if is_behind {
                        balanced = self.run.equations.measured(&mut self.run.state);
                    }
                    return self.record(&balanced, counters, Some(end));
                }
                next => next?,
            };
        }
    }

    /// Breaks the next bonds of an equilibrium, and in a large body also the bonds of further rounds, while updates of its parts are delayed.
    /// Returns the breakage after which an equilibrium of the whole body is due, with the equilibrium before it; None where all breakages are
    /// solved, and `balanced` is behind the state.
    fn break_next(
        &mut self,
        counters: &mut StepCounters,
        next: Vec<u32>,
        balanced: &mut Balanced,
    ) -> Result<Option<Breakage>, SetupError> {
        // Most load steps of a whole body have no round after the first.
        let parts = (counters.rounds > 0).then(|| self.parts.body(&self.run));
        let Some(body) = parts.flatten() else {
            let at = counters.next_round(next.len());
            return self.run.break_bonds(&next, balanced, at).map(Some);
        };
        let (problem, rule) = (self.run.problem.clone(), &self.settings.rule);
        let leading = Leading::Next(*rule);
        let run = &mut self.run;
        let (mut delayed, _) = DelayedUpdates::begin(run, (&problem, &body), leading, balanced);
        let mut bonds = delayed.deformed(&next);
        loop {
            let at = counters.next_round(bonds.len());
            let known = delayed.known();
            let breakage = delayed.break_bonds(&bonds, &known, at)?;
            let Some(leaders) = delayed.follow(&breakage, at)? else {
                *balanced = delayed.before(&breakage);
                return Ok(Some(breakage));
            };
            let start = Instant::now();
            bonds = delayed.next_to_break(rule, &leaders);
            delayed.run.equations.count_bond_work(start);
            if bonds.is_empty()
                || counters.rounds.is_multiple_of(WHOLE_EVERY)
                || counters.rounds >= self.settings.round_limit
                || delayed.run.interruption().is_some()
                || (delayed.run)
                    .is_seen_between_breakages(counters.step, counters.broken_in_step)?
            {
                delayed.catch_up();
                return Ok(None);
            }
        }
    }

    fn next_to_break(&mut self, balanced: &Balanced) -> Vec<u32> {
        let start = Instant::now();
        let Run {
            problem,
            equations,
            state,
            ..
        } = &self.run;
        let next = next_to_break(problem, equations, &self.settings.rule, (state, balanced));
        self.run.equations.count_bond_work(start);
        next
    }

    /// Reason why the run ends in an equilibrium of a load step.
    fn end(&self, balanced: &Balanced, counters: &StepCounters) -> Option<Termination> {
        let exhausted = !counters.at_rest && counters.rounds >= self.settings.round_limit;
        let not_at_rest = exhausted.then_some(Termination::NotAtRest {
            step: counters.step,
            rounds: counters.rounds,
        });
        let interruption = self.run.interruption().or(not_at_rest);
        interruption.or_else(|| {
            self.end_at_rest(balanced, counters.step)
                .filter(|_| counters.at_rest)
        })
    }

    /// Reason why the run ends in an equilibrium at rest. Unloading is no failure, and the load fraction counts only where the load
    /// is as large as it was before.
    fn end_at_rest(&self, balanced: &Balanced, step: usize) -> Option<Termination> {
        if self.run.is_controlled() {
            let end = self.run.end_at_rest(balanced);
            return end.or_else(|| self.run.end_by_load_fraction(balanced));
        }
        let loads = &self.run.problem.loads;
        let size = loads.control_factor(self.run.state.load_factor).abs();
        let before = self.run.progress.history[..step].iter();
        let mut before = before.map(|it| self.run.control_factor(it).abs());
        let is_unloading = before.next_back().is_some_and(|last| size < last);
        if is_unloading || (step > 0 && size == 0.0) {
            return None;
        }
        let end = self.run.end_at_rest(balanced);
        let was_larger = before.any(|earlier| earlier > size);
        let fallen = (!was_larger).then(|| self.run.end_by_load_fraction(balanced));
        end.or(fallen.flatten())
    }

    /// Offers an equilibrium of a load step to the observer.
    fn offer(
        &mut self,
        balanced: &Balanced,
        counters: StepCounters,
        end: Option<Termination>,
    ) -> Result<Option<Termination>, SetupError> {
        let is_last = counters.at_rest && counters.step + 1 == self.plan.len();
        let done = end.is_none() && is_last;
        let steps = self.plan[..=counters.step].iter();
        let load_factors: Vec<f64> = steps.map(|it| it.load_factor).collect();
        let end = end.or(done.then_some(Termination::StepsDone));
        let position = (WayKind::LoadSteps, &(counters, load_factors));
        Ok(self.run.offer(position, balanced, end)?)
    }

    /// Shows an equilibrium between two breakages of the load step to an observer that reads it.
    fn show_between_breakages(
        &mut self,
        balanced: &Balanced,
        mut counters: StepCounters,
    ) -> Result<(), SetupError> {
        let StepCounters {
            step,
            broken_in_step,
            ..
        } = counters;
        if broken_in_step > 0 && self.run.is_seen_between_breakages(step, broken_in_step)? {
            let Run { problem, state, .. } = &self.run;
            counters.largest_ratio = problem.largest_ratio(state, balanced);
            self.run.show_between_breakages(balanced, counters)?;
        }
        Ok(())
    }

    /// Records the end of the load step, and stops where the run ends.
    fn record(
        &mut self,
        balanced: &Balanced,
        mut counters: StepCounters,
        end: Option<Termination>,
    ) -> Result<(), Stop> {
        let Run { problem, state, .. } = &self.run;
        counters.largest_ratio = problem.largest_ratio(state, balanced);
        self.run.record(balanced, counters, end.is_some())?;
        end.map_or(Ok(()), |end| Err(Stop::End(end)))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::breaking::BreakingOrder;

    fn settings(load_factors: &[f64], refine_first_break: usize) -> SteppedSettings {
        SteppedSettings {
            load_factors: load_factors.to_vec(),
            refine_first_break,
            rule: BreakingRule {
                order: BreakingOrder::Excess,
                bonds_per_iteration: 5,
                tie_tolerance: 1e-8,
            },
            energy_tolerance: 1e-4,
            round_limit: 100,
            stop: StopRules::NONE,
        }
    }

    #[test]
    fn only_the_step_of_the_first_breakage_is_divided() {
        let first = Some(LoadPoint {
            displacement: 0.0,
            reaction: 0.0,
            load_factor: 0.3,
        });
        assert_eq!(
            refined(&settings(&[0.25, 0.5, 1.0], 2), first),
            [0.25, 0.3, 0.4, 0.5, 1.0]
        );
        assert_eq!(
            refined(&settings(&[0.25, 0.5, 1.0], 0), first),
            [0.25, 0.5, 1.0]
        );
        assert_eq!(refined(&settings(&[0.1, 0.2], 3), first), [0.1, 0.2]);
        assert_eq!(refined(&settings(&[0.3, 0.5], 1), first), [0.3, 0.5]);
    }
}
