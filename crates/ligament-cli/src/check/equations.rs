//! Report of `ligament check` on the equations: size, and choice of the solver with its reason.

use std::io;
use std::time::Instant;

use ligament_analysis::Equilibrium;
use ligament_analysis::solver::{
    DirectChoice, FactorKind, IterativeChoice, Ordering, POINTS_FOR_DISSECTION, SolverChoice, TIED,
    Update,
};
use ligament_analysis::stiffness::Stiffness;

use super::report::{Report, megabytes};
use ligament_case::case::CaseFile;
use ligament_run::memory;
use ligament_run::model::Model;

/// Writes the size of the equations and the choice of the solver.
pub(super) fn write(
    report: &mut Report<'_>,
    case: &CaseFile,
    model: &Model,
    equilibrium: &Equilibrium,
) -> anyhow::Result<()> {
    match (equilibrium.stiffness(), equilibrium.choice()) {
        (Some(stiffness), _) => write_with_matrix(report, case, model, stiffness),
        (None, SolverChoice::Iterative(choice)) => {
            write_iteration(report, case, model, (equilibrium.unknowns().len(), choice))
        }
        (
            None,
            SolverChoice::Direct(_) | SolverChoice::Distributed(_) | SolverChoice::Explicit(_),
        ) => Ok(()),
    }
}

/// Writes the size of equations with a matrix and the choices for its factor.
pub(super) fn write_with_matrix(
    report: &mut Report<'_>,
    case: &CaseFile,
    model: &Model,
    stiffness: &Stiffness,
) -> anyhow::Result<()> {
    let symbolic = stiffness.symbolic();
    let matrix = symbolic.pattern().n_entries();
    let factor = symbolic.n_factor_values();
    report.head("equations");
    report.entry("unknowns", stiffness.unknowns().len())?;
    let entries = format!("{matrix} in the matrix, {factor} in the factor");
    report.detail("entries", entries)?;
    write_memory(report, case, model, Some(stiffness))?;
    let choice = stiffness.choice();
    report.detail("method", format!("direct: {}", choice.reason))?;
    write_choice(report, model, choice)?;
    report.detail("ordering", ordering_reason(model))?;
    for ordering in [Ordering::NestedDissection, Ordering::MinimumDegree] {
        write_ordering(report, stiffness, ordering)?;
    }
    Ok(())
}

/// Writes the number of unknowns without a matrix and the choices for the iteration.
fn write_iteration(
    report: &mut Report<'_>,
    case: &CaseFile,
    model: &Model,
    (unknowns, choice): (usize, &IterativeChoice),
) -> anyhow::Result<()> {
    let IterativeChoice {
        reason,
        tolerance,
        aggregate,
        cluster,
    } = choice;
    report.head("equations");
    report.entry("unknowns", unknowns)?;
    write_memory(report, case, model, None)?;
    let method = format!("iterative, by conjugate gradients without a matrix: {reason}");
    report.entry("method", method)?;
    let aggregates = match cluster {
        None => format!("rigid motions of at most {aggregate} points each"),
        Some(cluster) => {
            format!("rigid motions of at most {aggregate} points each, then of {cluster}")
        }
    };
    report.detail("coarse space", aggregates)?;
    let tied = TIED * tolerance;
    let left = format!(
        "{tolerance:e} of the forces after a breakage; bonds within {tied:e} break together"
    );
    report.detail("tolerance", left)?;
    Ok(report.detail("threads", rayon::current_num_threads())?)
}

fn write_memory(
    report: &mut Report<'_>,
    case: &CaseFile,
    model: &Model,
    stiffness: Option<&Stiffness>,
) -> io::Result<()> {
    let bytes = memory::equation_bytes(&*model.system, stiffness);
    report.entry("estimated memory", megabytes(bytes as f64))?;
    if let Some(there) = memory::allowed_memory(case) {
        report.detail("available memory", megabytes(there as f64))?;
    }
    match memory::check_memory(case, &*model.system, stiffness) {
        Ok(()) => Ok(()),
        Err(too_large) => report.line(format!("warning: {too_large}")),
    }
}

fn write_choice(report: &mut Report<'_>, model: &Model, choice: &DirectChoice) -> io::Result<()> {
    let setup = &model.setup;
    if choice.unsymmetric {
        return report.detail("factorisation",
            "L U, because the printed forces derive from no energy; entries and ordering are those of the energy form",
        );
    }
    let is_named = setup.solver.factorisation.is_some();
    let why = match (is_named, choice.factorisation) {
        (true, _) => "set in the case",
        (false, FactorKind::Llt) if model.system.has_volumetric_cells => {
            "bonds and cells have positive stiffnesses, so the stiffness of the body is positive definite"
        }
        (false, FactorKind::Llt) => {
            "every bond has a positive axial and shear stiffness, so the stiffness of the body is positive definite"
        }
        (false, FactorKind::Ldlt) => {
            "not every bond has a positive shear stiffness: the stiffness may be indefinite"
        }
    };
    let name = match choice.factorisation {
        FactorKind::Llt => "L L^T",
        FactorKind::Ldlt => "L D L^T",
    };
    report.detail("factorisation", format!("{name}: {why}"))?;
    let when_broken = match (setup.analysis.is_fracture(), choice.update) {
        (false, _) => "no bond breaks".to_owned(),
        (true, Update::Refactor) => "the factor is recomputed".to_owned(),
        (true, Update::Incremental) => format!(
            "the factor is updated in place for up to {} bonds at once (for more, a new one is faster); recomputed every {} bonds",
            choice.most_bonds_in_place, choice.rebuild_every
        ),
    };
    report.detail("when bonds break", when_broken)?;
    report.detail("threads", rayon::current_num_threads())
}

fn ordering_reason(model: &Model) -> String {
    if model.setup.solver.ordering.is_some() {
        return "set in the case".to_owned();
    }
    let side = if model.system.n_points() < POINTS_FOR_DISSECTION {
        "minimum degree, because there are fewer"
    } else {
        "nested dissection, because there are not fewer"
    };
    format!("{side} than {POINTS_FOR_DISSECTION} points")
}

fn write_ordering(
    report: &mut Report<'_>,
    stiffness: &Stiffness,
    ordering: Ordering,
) -> anyhow::Result<()> {
    let start = Instant::now();
    let symbolic = stiffness.analysed_with(ordering)?;
    let seconds = start.elapsed().as_secs_f64();
    let name = match ordering {
        Ordering::NestedDissection => "  nested dissection",
        Ordering::MinimumDegree => "  minimum degree",
    };
    let (values, multiplications) = (symbolic.n_factor_values(), symbolic.n_multiplications());
    let is_chosen = ordering == stiffness.choice().ordering;
    let taken = if is_chosen { " (chosen)" } else { "" };
    let costs = format!(
        "{values} values in the factor, {multiplications:.2e} multiplications, analysed in {seconds:.3} s{taken}"
    );
    Ok(report.detail(name, costs)?)
}
