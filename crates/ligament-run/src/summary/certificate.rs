//! The certificate of a run in statics, from its outcome and its tables.

use std::collections::BTreeMap;
use std::io::{self, Write};
use std::path::Path;

use ligament::Model;
use ligament::bending_test::smallest_ligament;
use ligament::setup::Analysis;
use ligament_analysis::driver::{Outcome, Rows};
use ligament_analysis::history::StepRecord;
use ligament_output::csv::read::CsvTable;
use ligament_output::quantity::{four_digits, quantity};
use ligament_output::results::cracks::StoredCracks;
use ligament_output::results::solid_cracks::{SolidCracks, has_solid};
use ligament_output::summary::CertificateSummary;

/// Largest number of points of a body whose cracks are traced at the end of a run, which takes a second.
const MOST_POINTS: usize = 100_000;

/// Largest number of sides of an outline whose thinnest section is searched at the end of a run, which takes a tenth of a second.
const MOST_SIDES_AFTER_RUN: usize = 4_000;

/// Certificate of the last state at rest of a run whose tables are complete in a folder; none for a motion, and for a run without a result.
///
/// # Errors
///
/// If a table cannot be read.
pub(crate) fn certificate(
    folder: &Path,
    model: &Model,
    outcome: &Outcome,
) -> Result<Option<CertificateSummary>, ligament_output::Error> {
    let last = outcome.at_rest().next_back();
    let is_result =
        |_: &&StepRecord| outcome.rows != Rows::Times && !outcome.is_without_equilibrium();
    let Some(last) = last.filter(is_result) else {
        return Ok(None);
    };
    let is_cracked = last.broken_bonds > 0 || outcome.softened_bonds > 0;
    let is_traced = model.system.subdomain.is_whole() && model.system.n_points() <= MOST_POINTS;
    let area = match is_cracked && is_traced {
        // A body whose points have no cells has no faces along which a crack could be traced.
        true => crack_area(folder, last.step)
            .ok()
            .filter(|area| *area > 0.0),
        false => None,
    };
    Ok(Some(CertificateSummary {
        step: last.step,
        broken_bonds: last.broken_bonds,
        work: last.external_work,
        stored: last.stored_energy,
        released: last.released_energy,
        dissipated: last.dissipated_energy,
        crack_area: area,
        dissipated_per_area: area.map(|area| last.dissipated_energy / area),
        fracture_energy: model.setup.spent_fracture_energy(),
        horizon_over_ligament: horizon_over_ligament(model),
        largest_residual: largest_residual(&folder.join("iterations.csv"), until(outcome, last))?,
        ties: ties(&folder.join("breaks.csv"), tie_tolerance(model, outcome))?,
    }))
}

/// Horizon over the smallest ligament of a body whose bonds may break; none where the search of its thinnest section takes long.
fn horizon_over_ligament(model: &Model) -> Option<f64> {
    if model.criteria.list.is_empty() || !model.system.subdomain.is_whole() {
        return None;
    }
    let section = smallest_ligament(model, MOST_SIDES_AFTER_RUN).ok()?;
    Some(1.0 / section.horizons())
}

/// Step and round of the last solution that a run found up to its last record at rest.
fn until(outcome: &Outcome, last: &StepRecord) -> (usize, usize) {
    let is_last = outcome.history.last().is_some_and(|it| it.at_rest);
    // A record of the exact path is the state before its bonds break in the first round.
    let rounds = match outcome.rows == Rows::Events && !is_last {
        true => 0,
        false => usize::MAX,
    };
    (last.step, rounds)
}

/// Area of the cracks in the state of a step, m^2.
fn crack_area(folder: &Path, step: usize) -> Result<f64, ligament_output::Error> {
    if has_solid(folder)? {
        return Ok(SolidCracks::open(folder)?.surface(step).area());
    }
    let cracks = StoredCracks::open(folder)?;
    let lines = cracks.lines(step);
    Ok(cracks.thickness * lines.iter().map(|line| line.length()).sum::<f64>())
}

/// Largest residual of the last iteration of each round up to a step and a round; none without iterations.
fn largest_residual(
    path: &Path,
    until: (usize, usize),
) -> Result<Option<f64>, ligament_output::Error> {
    let mut ends = BTreeMap::new();
    for [step, round, residual] in CsvTable::read(path)?.numbers(["step", "round", "residual"])? {
        ends.insert((step as usize, round as usize), residual);
    }
    let found = ends.into_iter().filter(|(place, _)| *place <= until);
    Ok(found.map(|(_, residual)| residual).reduce(f64::max))
}

/// Relative difference of utilisations up to which the run took bonds as tied.
fn tie_tolerance(model: &Model, outcome: &Outcome) -> f64 {
    let analysis_tolerance = match &model.setup.analysis {
        Analysis::Event(settings) => settings.tie_tolerance,
        Analysis::Stepped(settings) => settings.rule.tie_tolerance,
        Analysis::Elastic { .. } | Analysis::Modal(_) | Analysis::Motion(_) => 0.0,
    };
    outcome.solver.tie_tolerance(analysis_tolerance)
}

/// Number of breakages whose utilisation equals the utilisation of the breakage before them in the same round, to a relative tolerance.
fn ties(path: &Path, tolerance: f64) -> Result<usize, ligament_output::Error> {
    let rows = CsvTable::read(path)?.numbers(["step", "round", "utilisation"])?;
    let is_tied = |pair: &&[[f64; 3]]| {
        let [[step, round, one], [next_step, next_round, other]] = [pair[0], pair[1]];
        [step, round] == [next_step, next_round] && (one - other).abs() <= tolerance * one.abs()
    };
    Ok(rows.windows(2).filter(is_tied).count())
}

/// Writes the lines of a certificate.
pub(super) fn write_certificate(
    certificate: &CertificateSummary,
    out: &mut dyn Write,
) -> io::Result<()> {
    let energies = [certificate.work, certificate.stored, certificate.dissipated];
    let [work, stored, spent] = energies.map(|it| quantity(it, "J"));
    writeln!(
        out,
        "  energies           {work} of work, {stored} stored, {spent} spent"
    )?;
    if let Some((area, per_area)) = certificate.crack_area.zip(certificate.dissipated_per_area) {
        let over = certificate.spent_ratio().map_or(String::new(), |ratio| {
            format!(", {} of the fracture_energy", four_digits(ratio))
        });
        writeln!(
            out,
            "  cracks             {}, over which {} were spent{over}",
            quantity(area, "m^2"),
            quantity(per_area, "J/m^2")
        )?;
    }
    if let Some(ratio) = certificate.horizon_over_ligament {
        writeln!(
            out,
            "  horizon            {ratio:.2} of the smallest ligament"
        )?;
    }
    let residual = certificate.largest_residual;
    let residual = residual.map_or("none".to_owned(), |it| format!("{it:.1e}"));
    let ties = certificate.ties;
    writeln!(
        out,
        "  largest residual   {residual} of the forces at a point; {ties} breakages tied"
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    fn file(text: &str) -> (tempfile::TempDir, std::path::PathBuf) {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("table.csv");
        std::fs::write(&path, text).unwrap();
        (folder, path)
    }

    /// The last iteration of a round counts, not the earlier ones.
    #[test]
    fn the_largest_residual_is_that_of_a_state_found() {
        let rows = "step,round,iteration,residual\n1,1,1,0.5\n1,1,2,1e-9\n1,2,1,1e-8\n2,1,1,3e-9\n";
        let (_folder, path) = file(rows);
        let all = (2, usize::MAX);
        assert_eq!(largest_residual(&path, all).unwrap(), Some(1e-8));
        // The second round did not find its state.
        assert_eq!(largest_residual(&path, (1, 1)).unwrap(), Some(1e-9));
        let (_folder, path) = file("step,round,iteration,residual\n");
        assert_eq!(largest_residual(&path, all).unwrap(), None);
    }

    /// Equal utilisations are ties only within a round.
    #[test]
    fn ties_are_counted_in_their_round() {
        let rows = "step,round,utilisation\n1,1,1.5\n1,1,1.5\n1,1,1.2\n1,2,1.2\n2,2,1.2\n2,2,1.200000000001\n";
        let (_folder, path) = file(rows);
        assert_eq!(ties(&path, 1e-8).unwrap(), 2);
        assert_eq!(ties(&path, 0.5).unwrap(), 3);
    }
}
