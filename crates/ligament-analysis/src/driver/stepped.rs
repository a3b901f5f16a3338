//! Stepped loading with ordered bond breaking (NHPD section 2.4, Fig. 5).
//!
//! In a load step: equilibrium; the bonds beyond their critical stretch in order; the first of them break; equilibrium
//! again; until none is left to break.

use std::time::Instant;

use super::outcome::{LoadPoint, Outcome, Rows};
use super::path::{Path, StopRules};
use super::recorder::{StepCounters, largest_ratio};
use crate::balanced::{Attempt, Balanced};
use crate::breakage::Breakage;
use crate::breaking::{BreakingRule, next_to_break};
use crate::error::SetupError;
use crate::history::{Observer, Termination};
use crate::problem::Problem;

/// How to step and when to stop.
#[derive(Debug, Clone, PartialEq)]
pub struct SteppedSettings {
    /// Load factor at the end of each step; where it falls, the body is unloaded.
    pub load_factors: Vec<f64>,
    /// Divide what is left of the first breakage's step, after a step that ends exactly there, into so many; 0: off.
    pub refine_first_break: usize,
    /// Rule by which the bonds that break in a round are picked.
    pub rule: BreakingRule,
    /// Relative change of the energy that ends Newton-Raphson (NHPD eq. 21).
    pub energy_tolerance: f64,
    /// Rounds of breaking allowed in a step.
    pub round_limit: usize,
    /// When to stop before the last step.
    pub stop: StopRules,
}

/// Follows the loading.
pub fn run(
    problem: &Problem,
    settings: &SteppedSettings,
    observer: &mut dyn Observer,
) -> Result<Outcome, SetupError> {
    let (mut path, _) = Path::begin(problem, settings.energy_tolerance, settings.stop, observer)?;
    path.soften();
    let load_factors = refined(settings, path.elastic.first_break);
    let mut stepping = Stepping {
        path,
        settings,
        last_step: load_factors.len(),
        load_factor_before: 0.0,
    };
    let mut termination = Termination::StepsDone;
    for (step, &load_factor) in std::iter::once(&0.0).chain(&load_factors).enumerate() {
        if let Some(end) = stepping.load_step(step, load_factor)? {
            termination = end;
            break;
        }
    }
    Ok(stepping.path.into_outcome(termination, Rows::LoadSteps))
}

/// The load factors with the step of the first breakage divided.
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

/// The run on its way.
struct Stepping<'a> {
    path: Path<'a>,
    settings: &'a SteppedSettings,
    last_step: usize,
    /// Load factor of the step before.
    load_factor_before: f64,
}

impl Stepping<'_> {
    /// Does one load step, and gives the reason why the run ends, if it does.
    ///
    /// Where breakages leave no equilibrium, the step shows the last one before them.
    fn load_step(
        &mut self,
        step: usize,
        load_factor: f64,
    ) -> Result<Option<Termination>, SetupError> {
        self.path.state.load_factor = load_factor;
        let mut counters = StepCounters {
            step,
            ..Default::default()
        };
        let mut breakage = Breakage::default();
        let mut last: Option<Balanced> = None;
        loop {
            self.path.enter(step, counters.rounds)?;
            let balanced = match self.path.balance(step, &breakage)? {
                Attempt::Balanced(balanced) => balanced,
                Attempt::Unbalanced(reason) => {
                    let end = Some(self.path.without_equilibrium(step, reason));
                    return match last {
                        Some(balanced) => self.record(&balanced, counters, end),
                        None => Ok(end),
                    };
                }
            };
            self.path.account(step, &breakage, &balanced)?;
            let next = self.next_to_break(&balanced);
            counters.at_rest = next.is_empty();
            let interrupted = self.interruption(&counters);
            if counters.at_rest || interrupted.is_some() {
                return self.record(&balanced, counters, interrupted);
            }
            counters.rounds += 1;
            counters.broken_in_step += next.len();
            breakage = self
                .path
                .break_bonds(&next, &balanced, step, counters.rounds)?;
            if self.path.collapsed {
                return self.record(&balanced, counters, Some(Termination::Collapsed));
            }
            last = Some(balanced);
        }
    }

    fn next_to_break(&mut self, balanced: &Balanced) -> Vec<u32> {
        let start = Instant::now();
        let next = next_to_break(
            &self.settings.rule,
            &balanced.deformations,
            &self.path.problem.criteria,
            &self.path.state.intact,
        );
        self.path.equilibrium.count_bond_work(start);
        next
    }

    /// What ends the run in the middle of a load step.
    fn interruption(&self, counters: &StepCounters) -> Option<Termination> {
        let exhausted = !counters.at_rest && counters.rounds >= self.settings.round_limit;
        let not_at_rest = exhausted.then_some(Termination::NotAtRest {
            step: counters.step,
            rounds: counters.rounds,
        });
        self.path.interruption().or(not_at_rest)
    }

    /// Ends the load step: records it and tells whether it was the last.
    fn record(
        &mut self,
        balanced: &Balanced,
        mut counters: StepCounters,
        interrupted: Option<Termination>,
    ) -> Result<Option<Termination>, SetupError> {
        counters.largest_ratio =
            largest_ratio(&self.path.state, balanced, &self.path.problem.criteria);
        // A load that is taken back is no failure.
        let load_factor = self.path.state.load_factor.abs();
        let is_unloading = load_factor < self.load_factor_before.abs();
        let at_rest = || self.path.end_at_rest(balanced).filter(|_| !is_unloading);
        let end = interrupted.or_else(at_rest);
        self.load_factor_before = self.path.state.load_factor;
        let is_last = end.is_some() || counters.step == self.last_step;
        self.path.record(balanced, counters, is_last)?;
        Ok(end)
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
