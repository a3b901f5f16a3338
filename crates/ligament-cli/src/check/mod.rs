//! `ligament check`: everything up to the first solution with the stiffness of the body, or the model alone, with time and memory.

mod bending_test;
mod body;
mod characteristic_length;
mod crack_work;
mod criteria;
mod entry;
mod equations;
mod extent;
mod foresight;
mod loading;
mod modal;
mod model;
mod motion;
mod patch_test;
mod restraints;

use std::io::{self, Write};
use std::path::Path;

use ligament_analysis::connectivity::Fragments;
use ligament_analysis::distributed_matrix::Solo;
use ligament_output::results::fields::ModelPoints;
use ligament_output::results::point_grid;

use ligament::Model;
use ligament::plausibility::notes;
use ligament::run::{on_pool, on_threads};
use ligament::setup::Analysis;
use ligament_case::case::CaseFile;
use ligament_output::summary::Stage;
use ligament_run::disk;
use ligament_run::messages::counted;
use ligament_run::model::build_model;
use ligament_run::progress::{Progress, ProgressMode};
use ligament_run::stages::Stages;

use entry::{entry, megabytes};
pub use extent::Extent;
use foresight::Foreseen;

/// Name of the file with the fields of the points.
pub const FIELDS: &str = "points.vtu";

/// Builds the model of a case and reports it; with a folder, writes `points.vtu` with all fixed fields into it. Returns the reason why a run
/// would end before its first load, if it would.
pub fn check(
    case: &CaseFile,
    extent: Extent,
    fields: Option<&Path>,
    out: &mut (dyn Write + Send),
) -> anyhow::Result<Option<String>> {
    on_threads(case.threads(), || check_here(case, extent, fields, out))?
}

/// Checks a case on the caller's threads.
fn check_here(
    case: &CaseFile,
    extent: Extent,
    fields: Option<&Path>,
    out: &mut (dyn Write + Send),
) -> anyhow::Result<Option<String>> {
    let mut stages = Stages::default();
    let progress = Progress::new(ProgressMode::Quiet);
    let model = build_model(case, &mut stages, &progress)?;
    on_pool(&Solo, || {
        write_report(case, extent, fields, (&model, stages), out)
    })
}

/// Reports a model.
fn write_report(
    case: &CaseFile,
    extent: Extent,
    fields: Option<&Path>,
    (model, mut stages): (&Model, Stages),
    out: &mut dyn Write,
) -> anyhow::Result<Option<String>> {
    let Foreseen { messages, refused } = match model.setup.analysis {
        Analysis::Modal(settings) => {
            modal::check(case, settings, extent, model, &mut stages, out)?;
            Foreseen::default()
        }
        Analysis::Motion(ref settings) => {
            motion::check(case, settings, extent, model, &mut stages, out)?;
            Foreseen::default()
        }
        Analysis::Elastic { .. } | Analysis::Stepped(_) | Analysis::Event(_) => {
            loading::check(case, extent, model, &mut stages, out)?
        }
    };
    patch_test::write(out, extent, model, &mut stages)?;
    let too_stiff = bending_test::write(out, extent, model, &mut stages)?;
    write_stages(out, stages.done())?;
    let intact = vec![true; model.system.ends.len()];
    let loose = Fragments::find(&*model.system, &intact).points.len();
    if loose > 1 {
        writeln!(
            out,
            "warning: the body consists of {loose} parts with no bond between them"
        )?;
    }
    for warning in counted(model.warnings.iter().cloned().chain(messages)) {
        writeln!(out, "warning: {warning}")?;
    }
    if let Some(warning) = too_stiff {
        writeln!(out, "warning: {warning}")?;
    }
    for note in notes(&model.setup) {
        writeln!(out, "note: {note}")?;
    }
    if let Some(folder) = fields {
        std::fs::create_dir_all(folder)?;
        let path = folder.join(FIELDS);
        let (grid, system) = (model.body().grid(), &model.system);
        let points = ModelPoints {
            fixed: &model.fixed,
            volumes: &system.volumes,
            spacing: &system.spacing,
        };
        point_grid(&path, &grid, points)?;
        writeln!(out, "fields written to {}", path.display())?;
    }
    Ok(refused)
}

/// Writes time and memory of the check and the available disk space, the part of the report that varies.
fn write_stages(out: &mut dyn Write, stages: &[Stage]) -> io::Result<()> {
    writeln!(out, "time, memory and disk")?;
    for stage in stages {
        let name = format!("time, {}", stage.name);
        entry(out, &name, format!("{:.3} s", stage.seconds))?;
    }
    let total: f64 = stages.iter().map(|stage| stage.seconds).sum();
    entry(out, "time, all", format!("{total:.3} s"))?;
    if let Some(bytes) = stages.last().and_then(|stage| stage.peak_bytes) {
        entry(out, "peak memory", megabytes(bytes as f64))?;
    }
    match disk::free(Path::new(".")) {
        Some(bytes) => entry(out, "free on the disk", megabytes(bytes)),
        None => Ok(()),
    }
}
