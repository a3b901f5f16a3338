//! `ligament check`: everything up to the first solution with the stiffness of the body, or the model alone, with time and memory.

mod bending_test;
mod body;
mod crack_work;
mod criteria;
mod equations;
mod first_failure;
mod loading;
mod modal;
mod model;
mod motion;
mod patch_test;
mod report;

use std::io::{self, Write};
use std::path::{Path, PathBuf};

use ligament_analysis::connectivity::Fragments;
use ligament_analysis::distributed_matrix::SingleProcess;
use ligament_output::results::fields::ModelPoints;
use ligament_output::results::point_grid;

use ligament::Model;
use ligament::plausibility::notes;
use ligament::run::{on_pool, on_threads};
use ligament::setup::Analysis;
use ligament_case::case::CaseFile;
use ligament_output::summary::Stage;
use ligament_run::disk;
use ligament_run::messages::merged_messages;
use ligament_run::model::build_model;
use ligament_run::progress::{Progress, ProgressMode};
use ligament_run::stages::Stages;

use first_failure::PredictedRun;
pub use report::{CheckExtent, Lines};
use report::{Report, megabytes};

/// Name of the file with the fields of the points.
pub const FIELDS: &str = "points.vtu";

/// Builds the model of a case and reports it; with a folder, writes `points.vtu` with all fixed fields into it. Returns the reason why a run
/// would end before its first load, if it would.
pub fn check(
    case: &CaseFile,
    extent: CheckExtent,
    fields: Option<&Path>,
    lines: Lines,
    out: &mut (dyn Write + Send),
) -> anyhow::Result<Option<String>> {
    on_threads(case.threads(), || {
        let mut stages = Stages::default();
        let progress = Progress::new(ProgressMode::Quiet);
        let model = build_model(case, &mut stages, &progress)?;
        on_pool(&SingleProcess, || {
            let mut report = Report::new(out, lines);
            let refused = write_report(case, extent, (&model, stages), &mut report)?;
            if let Some(folder) = fields {
                let path = write_fields(&model, folder)?;
                report.line(format!("fields written to {}", path.display()))?;
            }
            Ok(refused)
        })
    })?
}

/// Reports a model.
fn write_report(
    case: &CaseFile,
    extent: CheckExtent,
    (model, mut stages): (&Model, Stages),
    report: &mut Report<'_>,
) -> anyhow::Result<Option<String>> {
    let PredictedRun { messages, refused } = match model.setup.analysis {
        Analysis::Modal(settings) => {
            modal::check(case, settings, extent, model, &mut stages, report)?;
            PredictedRun::default()
        }
        Analysis::Motion(ref settings) => {
            motion::check(case, settings, extent, model, &mut stages, report)?;
            PredictedRun::default()
        }
        Analysis::Elastic { .. } | Analysis::Stepped(_) | Analysis::Event(_) => {
            loading::check(case, extent, model, &mut stages, report)?
        }
    };
    patch_test::write(report, extent, model, &mut stages)?;
    let too_stiff = bending_test::write(report, extent, model, &mut stages)?;
    let too_wide = bending_test::write_ligament(report, extent, model, &mut stages)?;
    write_stages(report, stages.done())?;
    let intact = vec![true; model.system.ends.len()];
    let loose = Fragments::find(&*model.system, &intact).points.len();
    if loose > 1 {
        report.line(format!(
            "warning: the body consists of {loose} parts with no bond between them"
        ))?;
    }
    for warning in merged_messages(model.warnings.iter().cloned().chain(messages)) {
        report.line(format!("warning: {warning}"))?;
    }
    for warning in too_stiff.into_iter().chain(too_wide) {
        report.line(format!("warning: {warning}"))?;
    }
    for note in notes(&model.setup) {
        report.line(format!("note: {note}"))?;
    }
    Ok(refused)
}

/// Writes the fixed fields of the points into a folder; returns the path of the file.
fn write_fields(model: &Model, folder: &Path) -> anyhow::Result<PathBuf> {
    std::fs::create_dir_all(folder)?;
    let path = folder.join(FIELDS);
    let points = ModelPoints {
        fixed: &model.fixed,
        volumes: &model.system.volumes,
        spacing: &model.system.spacing,
    };
    point_grid(&path, &model.body().grid(), points)?;
    Ok(path)
}

/// Writes time and memory of the check and the available disk space, the part of the report that varies.
fn write_stages(report: &mut Report<'_>, stages: &[Stage]) -> io::Result<()> {
    report.head("time, memory and disk");
    for stage in stages {
        let name = format!("time, {}", stage.name);
        report.detail(&name, format!("{:.3} s", stage.seconds))?;
    }
    let total: f64 = stages.iter().map(|stage| stage.seconds).sum();
    report.entry("time, all", format!("{total:.3} s"))?;
    if let Some(bytes) = stages.last().and_then(|stage| stage.peak_bytes) {
        report.entry("peak memory", megabytes(bytes as f64))?;
    }
    match disk::free(Path::new(".")) {
        Some(bytes) => report.detail("free on the disk", megabytes(bytes)),
        None => Ok(()),
    }
}
