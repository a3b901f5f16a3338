//! Choices and costs of the solver of a run, for the summary.

use ligament_analysis::costs::Costs;
use ligament_analysis::critical_step::CriticalStep;
use ligament_analysis::solver::{DirectChoice, ExplicitChoice, FactorKind, SolverChoice};
use ligament_case::case::word_of;
use ligament_output::summary::{FactorSummary, IterationSummary, SolverSummary};

/// Summary of the choices for a matrix factor.
fn factor(choice: &DirectChoice) -> FactorSummary {
    FactorSummary {
        factorisation: match choice.factorisation {
            _ if choice.unsymmetric => "lu".into(),
            FactorKind::Llt => "llt".into(),
            FactorKind::Ldlt => "ldlt".into(),
        },
        ordering: word_of(&choice.ordering).into(),
        update: word_of(&choice.update).into(),
    }
}

/// Motions of the points that limit the critical step of an explicit scheme.
pub(super) fn limited_by(critical: &CriticalStep) -> &'static str {
    if critical.of_rotations > 0.5 {
        "rotations"
    } else {
        "displacements"
    }
}

/// Description of the limit of the time step of an explicit motion.
fn limit(ExplicitChoice { critical, .. }: &ExplicitChoice) -> String {
    let (step, by) = (critical.step, limited_by(critical));
    format!("the critical step is {step:.4e} s, limited by {by}")
}

/// Summary of the solver's choices and costs.
pub(super) fn solver_summary(costs: &Costs, choice: &SolverChoice) -> SolverSummary {
    let iterations = costs.iterations;
    let iteration = |tolerance, aggregate| IterationSummary {
        tolerance,
        aggregate,
        iterations,
    };
    let (method, reason, factor, iteration) = match choice {
        SolverChoice::Direct(it) => ("direct", it.reason.to_string(), Some(factor(it)), None),
        &SolverChoice::Iterative(it) => {
            let iteration = iteration(it.tolerance, Some(it.aggregate));
            ("iterative", it.reason.to_string(), None, Some(iteration))
        }
        SolverChoice::Distributed(it) => {
            let iteration = it.tolerance.map(|it| iteration(it, None));
            ("distributed", it.reason.to_string(), None, iteration)
        }
        SolverChoice::Explicit(it) => ("explicit", limit(it), None, None),
    };
    let ranks = match choice {
        SolverChoice::Distributed(it) => Some(it.n_ranks),
        SolverChoice::Direct(_) | SolverChoice::Iterative(_) | SolverChoice::Explicit(_) => None,
    };
    SolverSummary {
        method: method.into(),
        reason: reason.into(),
        factor,
        iteration,
        ranks,
        threads: rayon::current_num_threads(),
        factorisations: costs.factorisations,
        changes: costs.changes,
        solves: costs.solves,
        analysis_seconds: costs.analysis.as_secs_f64(),
        assembly_seconds: costs.assembly.as_secs_f64(),
        factorisation_seconds: costs.factorisation.as_secs_f64(),
        change_seconds: costs.change.as_secs_f64(),
        backward_seconds: costs.backward.as_secs_f64(),
        solve_seconds: costs.solve.as_secs_f64(),
        bonds_seconds: costs.bonds.as_secs_f64(),
        connectivity_seconds: costs.connectivity.as_secs_f64(),
    }
}
