//! Stepped loading with ordered bond breaking (NHPD section 2.4, Fig. 5).
//!
//! In a load step: equilibrium; the bonds beyond their critical stretch in order; the first of them break; equilibrium
//! again; until none is left to break.

use std::time::Instant;

use ligament_model::element::beam::BondDeformation;

use super::recorder::{Energies, Outcome, StepCounters, step_record};
use super::start::{Start, begin, report_loose, report_mechanisms};
use super::{LoadPoint, Problem};
use crate::boundary::ControlKind;
use crate::breaking::{BreakingRule, next_to_break};
use crate::connectivity::Hold;
use crate::equilibrium::{Balanced, Equilibrium, SetupError, Unbalanced};
use crate::history::{BreakRecord, Notice, Observer, StepRecord, Termination, View};
use crate::state::State;

/// How to step and when to stop.
#[derive(Debug, Clone, PartialEq)]
pub struct SteppedSettings {
    /// Load factor at the end of each step, ascending.
    pub load_factors: Vec<f64>,
    /// Divide what is left of the first breakage's step, after a step that ends exactly there, into so many; 0: off.
    pub refine_first_break: usize,
    /// Which bonds break in a round.
    pub rule: BreakingRule,
    /// Relative change of the energy that ends Newton-Raphson (NHPD eq. 21).
    pub energy_tolerance: f64,
    /// Rounds of breaking allowed in a step.
    pub round_limit: usize,
    /// When to stop before the last step.
    pub stop: StopRules,
}

/// Rules that end the run before its last step.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct StopRules {
    /// The load at rest fell to this fraction of the largest so far, after bonds broke.
    pub load_fraction: Option<f64>,
    /// The displacement of the control load reached this, m.
    pub displacement: Option<f64>,
    /// So many bonds broke.
    pub bonds: Option<usize>,
    /// So many seconds passed.
    pub wall_time: Option<f64>,
    /// The stored energy became negative: the body has lost its stability.
    pub negative_energy: bool,
}

impl StopRules {
    /// All load steps, as long as the body is stable.
    pub const NONE: Self = Self {
        load_fraction: None,
        displacement: None,
        bonds: None,
        wall_time: None,
        negative_energy: true,
    };
}

/// Below this fraction of the peak a body carries no load any more: what is left is rounding.
const NO_LOAD: f64 = 1e-9;

/// Follows the loading; `critical_stretch` (n_bonds) is infinite where a bond never breaks.
pub fn run(
    problem: &Problem<'_>,
    critical_stretch: &[f64],
    settings: &SteppedSettings,
    observer: &mut dyn Observer,
) -> Result<Outcome, SetupError> {
    let mut equilibrium = Equilibrium::of(problem, settings.energy_tolerance)?;
    let Start {
        unloaded,
        elastic_stiffness,
        first_break,
        stability,
    } = begin(problem, &mut equilibrium, critical_stretch, observer)?;
    let load_factors = refined(settings, first_break);
    let mut path = Path {
        problem,
        critical_stretch,
        settings,
        observer,
        equilibrium,
        state: unloaded,
        energies: Energies::default(),
        history: Vec::new(),
        broken: 0,
        collapsed: false,
        energy_was_negative: false,
        last_step: load_factors.len(),
        started: Instant::now(),
    };
    let mut termination = Termination::StepsDone;
    for (step, &load_factor) in std::iter::once(&0.0).chain(&load_factors).enumerate() {
        if let Some(end) = path.load_step(step, load_factor)? {
            termination = end;
            break;
        }
    }
    let costs = *path.equilibrium.costs();
    let Path { history, state, .. } = path;
    Ok(Outcome {
        history,
        state,
        termination,
        elastic_stiffness,
        first_break,
        stability,
        costs,
    })
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
struct Path<'a> {
    problem: &'a Problem<'a>,
    critical_stretch: &'a [f64],
    settings: &'a SteppedSettings,
    observer: &'a mut dyn Observer,
    equilibrium: Equilibrium<'a>,
    state: State,
    energies: Energies,
    history: Vec<StepRecord>,
    broken: usize,
    collapsed: bool,
    energy_was_negative: bool,
    last_step: usize,
    started: Instant,
}

impl Path<'_> {
    /// One load step; tells why the run ends, if it does.
    ///
    /// Where breakages leave no equilibrium, the step shows the last one before them.
    fn load_step(
        &mut self,
        step: usize,
        load_factor: f64,
    ) -> Result<Option<Termination>, SetupError> {
        self.state.load_factor = load_factor;
        let solves_before = self.equilibrium.costs().solves;
        let mut counters = StepCounters {
            step,
            ..Default::default()
        };
        let mut just_broken = Vec::new();
        let mut last: Option<Balanced> = None;
        loop {
            let round = counters.rounds;
            self.observer.round(step, round, load_factor, self.broken)?;
            let displacement = self.state.displacement.clone();
            let balanced = match self.balance(step)? {
                Ok(balanced) => balanced,
                Err(reason) => {
                    let end = Termination::NoEquilibrium { step, reason };
                    self.state.displacement = displacement;
                    return match last {
                        Some(balanced) => self.record(&balanced, counters, Some(end)),
                        None => Ok(Some(end)),
                    };
                }
            };
            self.account(step, &just_broken, &balanced)?;
            let next = self.next_to_break(&balanced);
            counters.at_rest = next.is_empty();
            counters.solves = self.equilibrium.costs().solves - solves_before;
            counters.negative_eigenvalues = self.equilibrium.negative_eigenvalues();
            let interrupted = self.interruption(&counters);
            if counters.at_rest || interrupted.is_some() {
                return self.record(&balanced, counters, interrupted);
            }
            counters.rounds += 1;
            counters.broken_in_step += next.len();
            just_broken = self.break_bonds(&next, &balanced, &counters)?;
            if self.collapsed {
                return self.record(&balanced, counters, Some(Termination::Collapsed));
            }
            last = Some(balanced);
        }
    }

    /// Equilibrium of the state; a negative energy is none unless the case says to go on.
    fn balance(&mut self, step: usize) -> Result<Result<Balanced, Unbalanced>, SetupError> {
        let balanced = self.equilibrium.balance(&mut self.state, self.observer)?;
        let Some(energy) = balanced
            .as_ref()
            .ok()
            .filter(|balanced| balanced.energy_is_negative)
            .map(|balanced| balanced.stored_energy)
        else {
            return Ok(balanced);
        };
        if self.settings.stop.negative_energy {
            return Ok(Err(Unbalanced::NegativeEnergy { energy }));
        }
        if !std::mem::replace(&mut self.energy_was_negative, true) {
            self.observer.notice(&Notice::NegativeEnergy { step })?;
        }
        Ok(balanced)
    }

    fn next_to_break(&mut self, balanced: &Balanced) -> Vec<u32> {
        let start = Instant::now();
        let next = next_to_break(
            &self.settings.rule,
            &balanced.deformations,
            self.critical_stretch,
            &self.state.intact,
        );
        self.equilibrium.count_bond_work(start);
        next
    }

    /// Adds up work and released energy, and reports mechanisms.
    fn account(
        &mut self,
        step: usize,
        just_broken: &[(u32, BondDeformation)],
        balanced: &Balanced,
    ) -> Result<(), SetupError> {
        self.energies.add_work(self.problem, &self.state, balanced);
        self.energies
            .add_released(self.problem, just_broken, balanced);
        report_mechanisms(step, balanced, self.observer)?;
        Ok(())
    }

    /// Breaks bonds and holds what came loose; returns the bonds with their last deformations.
    fn break_bonds(
        &mut self,
        bonds: &[u32],
        balanced: &Balanced,
        counters: &StepCounters,
    ) -> Result<Vec<(u32, BondDeformation)>, SetupError> {
        let mut records = Vec::with_capacity(bonds.len());
        for &bond in bonds {
            self.broken += 1;
            let ratio =
                balanced.deformations[bond as usize].stretch / self.critical_stretch[bond as usize];
            let (order, load_factor) = (self.broken, self.state.load_factor);
            records.push(BreakRecord {
                order,
                step: counters.step,
                round: counters.rounds,
                load_factor,
                bond,
                ratio,
            });
        }
        self.observer.broke(&records)?;
        let holds = self.equilibrium.break_bonds(&mut self.state, bonds);
        self.collapsed |= self.load_came_loose(&holds);
        let fragments = self.equilibrium.fragments();
        report_loose(counters.step, fragments, &holds, self.observer)?;
        Ok(bonds
            .iter()
            .map(|&bond| (bond, balanced.deformations[bond as usize]))
            .collect())
    }

    /// Whether a given force acts on a part that nothing holds any more.
    fn load_came_loose(&self, holds: &[Hold]) -> bool {
        let control = &self.problem.boundary.control;
        let of_point = &self.equilibrium.fragments().of_point;
        control.kind == ControlKind::Force
            && control.points.iter().any(|&point| {
                holds
                    .iter()
                    .any(|hold| hold.fragment == of_point[point as usize])
            })
    }

    /// What ends the run in the middle of a load step.
    fn interruption(&self, counters: &StepCounters) -> Option<Termination> {
        let stop = &self.settings.stop;
        let seconds = self.started.elapsed().as_secs_f64();
        if let Some(bonds) = stop.bonds.filter(|&bonds| self.broken >= bonds) {
            return Some(Termination::BondsBroken { bonds });
        }
        if let Some(seconds) = stop.wall_time.filter(|&allowed| seconds >= allowed) {
            return Some(Termination::WallTime { seconds });
        }
        let exhausted = !counters.at_rest && counters.rounds >= self.settings.round_limit;
        exhausted.then_some(Termination::NotAtRest {
            step: counters.step,
            rounds: counters.rounds,
        })
    }

    /// What ends the run after a load step at rest.
    fn end_of_step(&self) -> Option<Termination> {
        let last = self.history.last()?;
        let peak = self
            .history
            .iter()
            .map(|step| step.reaction)
            .fold(0.0, f64::max);
        let stop = &self.settings.stop;
        if let Some(displacement) = stop
            .displacement
            .filter(|&wanted| last.displacement >= wanted)
        {
            return Some(Termination::DisplacementReached { displacement });
        }
        if last.broken_bonds == 0 {
            return None;
        }
        if last.reaction <= NO_LOAD * peak {
            return Some(Termination::FellApart);
        }
        let fraction = stop
            .load_fraction
            .filter(|&fraction| last.reaction <= fraction * peak)?;
        Some(Termination::LoadFraction { fraction })
    }

    /// Ends the load step: records it and tells whether it was the last.
    fn record(
        &mut self,
        balanced: &Balanced,
        counters: StepCounters,
        interrupted: Option<Termination>,
    ) -> Result<Option<Termination>, SetupError> {
        self.history.push(step_record(
            self.problem,
            &self.state,
            balanced,
            &self.energies,
            self.equilibrium.fragments(),
            self.critical_stretch,
            counters,
        ));
        let end = interrupted.or_else(|| self.end_of_step());
        let view = View {
            system: self.problem.system,
            state: &self.state,
            balanced,
            boundary: self.problem.boundary,
            critical_stretch: self.critical_stretch,
            fragments: self.equilibrium.fragments(),
            costs: self.equilibrium.costs(),
            is_last: end.is_some() || counters.step == self.last_step,
        };
        if let Some(record) = self.history.last() {
            self.observer.step(record, &view)?;
        }
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
