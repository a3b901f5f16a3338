//! Linear elastic answer: one solve at load factor one.

use super::Problem;
use super::outcome::{Outcome, Rows};
use super::recorder::{Energies, StepCounters, step_record};
use super::start::begin;
use crate::breakage::Breakage;
use crate::equilibrium::{Balanced, Equilibrium, SetupError, Unbalanced};
use crate::history::{Observer, Termination, View};

/// Solves the problem at load factor one; no bond breaks. The history has the unloaded body as step 0.
pub fn run(
    problem: &Problem<'_>,
    energy_tolerance: f64,
    observer: &mut dyn Observer,
) -> Result<Outcome, SetupError> {
    let mut equilibrium = Equilibrium::of(problem, energy_tolerance)?;
    let start = begin(problem, &mut equilibrium, observer)?;
    let mut state = start.unloaded;
    let mut history = Vec::new();
    let mut energies = Energies::unloaded(problem.boundary);
    let mut termination = Termination::StepsDone;
    for (step, load_factor) in [0.0, 1.0].into_iter().enumerate() {
        state.load_factor = load_factor;
        let solves_before = equilibrium.costs().solves;
        observer.round(step, 0, load_factor, 0)?;
        let balanced = match equilibrium.balance(&mut state, &Breakage::default(), observer)? {
            Ok(Balanced {
                negative_energy: Some(energy),
                ..
            }) => {
                let reason = Unbalanced::NegativeEnergy { energy };
                termination = Termination::NoEquilibrium { step, reason };
                break;
            }
            Ok(balanced) => balanced,
            Err(reason) => {
                termination = Termination::NoEquilibrium { step, reason };
                break;
            }
        };
        energies.add_work(problem, &state, &balanced);
        let counters = StepCounters {
            step,
            solves: equilibrium.costs().solves - solves_before,
            at_rest: true,
            negative_eigenvalues: equilibrium.negative_eigenvalues(),
            ..Default::default()
        };
        history.push(step_record(
            problem,
            &state,
            &balanced,
            &energies,
            equilibrium.fragments(),
            counters,
        ));
        let view = View {
            system: problem.system,
            state: &state,
            balanced: &balanced,
            boundary: problem.boundary,
            criteria: problem.criteria,
            fragments: equilibrium.fragments(),
            costs: equilibrium.costs(),
            is_last: load_factor == 1.0,
        };
        observer.step(&history[step], &view)?;
    }
    Ok(Outcome {
        history,
        rows: Rows::LoadSteps,
        state,
        termination,
        elastic_stiffness: start.elastic.stiffness,
        first_break: None,
        stability: start.elastic.stability,
        costs: *equilibrium.costs(),
        solver: *equilibrium.choice(),
    })
}
