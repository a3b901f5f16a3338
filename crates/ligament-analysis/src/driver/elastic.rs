//! Linear elastic answer: one solve at load factor one.

use super::Problem;
use super::recorder::{Energies, LoadPoint, Outcome, StepCounters, largest_ratio, step_record};
use crate::connectivity::{Fragments, Hold};
use crate::equilibrium::{Balanced, Equilibrium, SetupError, Stability};
use crate::history::{Notice, Observer, ObserverError, StepRecord, Termination, View};
use crate::state::State;

/// Solves the problem at load factor one; no bond breaks.
pub fn run(
    problem: &Problem<'_>,
    energy_tolerance: f64,
    observer: &mut dyn Observer,
) -> Result<Outcome, SetupError> {
    let mut equilibrium = Equilibrium::new(problem.system, problem.boundary, energy_tolerance)?;
    let start = begin(problem, &mut equilibrium, &[], observer)?;
    let mut history = Vec::new();
    let mut state = start.unloaded;
    let mut energies = Energies::default();
    let mut termination = Termination::StepsDone;
    for (step, load_factor) in [0.0, 1.0].into_iter().enumerate() {
        state.load_factor = load_factor;
        let solves = equilibrium.costs().solves;
        observer.round(step, 0, load_factor, 0)?;
        let balanced = match equilibrium.balance(&mut state, observer)? {
            Ok(balanced) => balanced,
            Err(reason) => {
                termination = Termination::NoEquilibrium { step, reason };
                break;
            }
        };
        energies.add_work(problem, &state, &balanced);
        let counters = StepCounters {
            step,
            solves: equilibrium.costs().solves - solves,
            at_rest: true,
            ..Default::default()
        };
        let record = step_record(
            problem,
            &state,
            &balanced,
            &energies,
            &start.fragments,
            &[],
            counters,
        );
        let view = View {
            system: problem.system,
            state: &state,
            balanced: &balanced,
            boundary: problem.boundary,
            critical_stretch: &[],
            fragments: &start.fragments,
            costs: equilibrium.costs(),
            is_last: load_factor == 1.0,
        };
        observer.step(&record, &view)?;
        history.push(record);
    }
    Ok(Outcome {
        history,
        state,
        termination,
        elastic_stiffness: start.elastic_stiffness,
        first_break: None,
        stability: start.stability,
        costs: *equilibrium.costs(),
    })
}

/// What is known before the first load step.
pub(super) struct Start {
    pub(super) unloaded: State,
    pub(super) fragments: Fragments,
    pub(super) elastic_stiffness: f64,
    pub(super) first_break: Option<LoadPoint>,
    pub(super) stability: Option<Stability>,
}

/// Holds what nothing holds, and solves once at load factor one for the stiffness, the first breakage and the inertia.
pub(super) fn begin(
    problem: &Problem<'_>,
    equilibrium: &mut Equilibrium<'_>,
    critical_stretch: &[f64],
    observer: &mut dyn Observer,
) -> Result<Start, SetupError> {
    let mut unloaded = State::fresh(problem.system);
    let (fragments, holds) = equilibrium.bonds_changed(&mut unloaded);
    if let Some(first) = holds.first() {
        observer.notice(&came_loose(0, &fragments, &holds, first.fragment))?;
    }
    let mut probe = State {
        load_factor: 1.0,
        ..unloaded.clone()
    };
    let balanced = match equilibrium.balance(&mut probe, &mut Unobserved)? {
        Ok(balanced) => balanced,
        Err(_) => {
            let (elastic_stiffness, first_break, stability) = (f64::NAN, None, None);
            return Ok(Start {
                unloaded,
                fragments,
                elastic_stiffness,
                first_break,
                stability,
            });
        }
    };
    if !balanced.mechanisms.is_empty() {
        let degrees_of_freedom = balanced.mechanisms.clone();
        observer.notice(&Notice::Mechanisms {
            step: 0,
            degrees_of_freedom,
        })?;
        unloaded.held.clone_from(&probe.held);
    }
    let indefinite = problem
        .system
        .shear_rigidity
        .iter()
        .any(|&rigidity| rigidity < 0.0);
    let stability = if indefinite {
        equilibrium.stability(&probe)?
    } else {
        None
    };
    if let Some(Stability { negative, expected }) = stability
        && negative != expected
    {
        observer.notice(&Notice::Unstable { negative, expected })?;
    }
    let counters = StepCounters::default();
    let at_one = step_record(
        problem,
        &probe,
        &balanced,
        &Energies::default(),
        &fragments,
        critical_stretch,
        counters,
    );
    let first_break =
        first_break(&probe, &balanced, critical_stretch).map(|load_factor| LoadPoint {
            load_factor,
            displacement: at_one.displacement * load_factor,
            reaction: at_one.reaction * load_factor,
        });
    let elastic_stiffness = at_one.reaction / at_one.displacement;
    Ok(Start {
        unloaded,
        fragments,
        elastic_stiffness,
        first_break,
        stability,
    })
}

/// Load factor of the first breakage: with linear bonds the inverse of the largest s/s_0 at load factor one.
fn first_break(at_one: &State, balanced: &Balanced, critical_stretch: &[f64]) -> Option<f64> {
    let ratio = largest_ratio(at_one, balanced, critical_stretch);
    (ratio > 0.0).then_some(1.0 / ratio)
}

pub(super) fn came_loose(
    step: usize,
    fragments: &Fragments,
    holds: &[Hold],
    first_fragment: u32,
) -> Notice {
    let mut loose: Vec<u32> = holds.iter().map(|hold| hold.fragment).collect();
    loose.dedup();
    Notice::CameLoose {
        step,
        points: loose
            .iter()
            .map(|&fragment| fragments.points[fragment as usize].len())
            .sum(),
        motions: holds.len(),
        first: fragments.points[first_fragment as usize][0],
    }
}

/// Watches nothing.
struct Unobserved;

impl Observer for Unobserved {
    fn step(&mut self, _: &StepRecord, _: &View<'_>) -> Result<(), ObserverError> {
        Ok(())
    }
}
