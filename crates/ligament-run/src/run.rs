//! A run of a case: from the file to the folder with its results.

use std::io::{self, Write};
use std::path::Path;

use anyhow::Context;
use ligament::Loading;
use ligament::run::{follow, on_threads};
use ligament::setup::Analysis;
use ligament_output::folder::ResultFolder;
use ligament_output::results::{ResultWriter, Time, WriteRule};

use crate::destination::{self, make_results};
use crate::memory;
use crate::model::{Model, build_model};
use crate::modes::find_modes;
use crate::progress::{Progress, ProgressMode};
use crate::stages::Stages;
use crate::summary::{ModalSummary, Summary};
use crate::watch::Watch;
use ligament_case::case::{CaseFile, StressField};

/// What a run found.
#[derive(Debug, Clone, PartialEq)]
pub enum Report {
    /// The answer to loads.
    Loading(Box<Summary>),
    /// Natural modes.
    Modes(Box<ModalSummary>),
}

impl Report {
    /// The lines that a user sees at the end of a run.
    pub fn write(&self, out: &mut dyn Write) -> io::Result<()> {
        match self {
            Self::Loading(summary) => summary.write(out),
            Self::Modes(summary) => summary.write(out),
        }
    }
}

/// Runs a case and writes its results into a new folder.
pub fn run(case: &CaseFile, out: &Path, force: bool, mode: ProgressMode) -> anyhow::Result<Report> {
    on_threads(case.threads(), || run_here(case, out, force, mode))?
}

/// Runs a case on the threads of the caller.
fn run_here(
    case: &CaseFile,
    out: &Path,
    force: bool,
    mode: ProgressMode,
) -> anyhow::Result<Report> {
    ResultFolder::check(out, force)?;
    let mut stages = Stages::default();
    let mut progress = Progress::new(mode);
    let model = build_model(case, &mut stages, &progress)?;
    if let Analysis::Modal(settings) = model.setup.analysis {
        let summary = find_modes(case, settings, &model, out, force, stages)?;
        progress.finish(&format!("{} modes found", summary.modes.len()));
        Ok(Report::Modes(Box::new(summary)))
    } else {
        let summary = follow_loads(case, &model, out, force, stages, progress)?;
        Ok(Report::Loading(Box::new(summary)))
    }
}

/// Loads a model, breaks its bonds if the case says so, and writes what happens into a new folder.
fn follow_loads(
    case: &CaseFile,
    model: &Model,
    out: &Path,
    force: bool,
    mut stages: Stages,
    mut progress: Progress,
) -> anyhow::Result<Summary> {
    let loading = Loading::new(&model.setup, &model.system).map_err(|it| case.located(it))?;
    let problem = loading.problem(&model.system, &model.criteria);
    memory::foresee_equations(case, &model.system, &problem)?;

    // Nothing is written, and nothing replaced, before all input was found good.
    make_results(case, out, force, |folder| {
        if let Some(words) = destination::words(folder) {
            progress.stage(&words);
        }
        let summary = write_loading(case, model, &loading, folder, &mut stages, &mut progress)?;
        progress.finish(&summary.termination_message);
        Ok(summary)
    })
}

/// Follows loads, and writes all results into a folder.
fn write_loading(
    case: &CaseFile,
    model: &Model,
    loading: &Loading,
    folder: &ResultFolder,
    stages: &mut Stages,
    progress: &mut Progress,
) -> anyhow::Result<Summary> {
    let problem = loading.problem(&model.system, &model.criteria);
    let grid = model.body().grid();
    let output = &case.case.output;
    let rule = WriteRule {
        fields_every: output.fields_every.unwrap_or_default() as usize,
        bonds: output.bonds,
        model: output.model,
        virial: output.stress.contains(&StressField::Virial),
        traction: output.stress.contains(&StressField::Traction),
        time: match model.setup.analysis {
            Analysis::Event(_) => Time::Step,
            _ => Time::Load,
        },
    };
    let writer = ResultWriter::new(folder, &grid, &model.fixed, rule, &problem)?;
    let mut watch = Watch::new(writer, progress, &model.setup);
    let outcome = stages.time("solution", || {
        follow(&problem, &model.setup.analysis, &mut watch)
    })?;

    let notices = watch.into_notices();
    let summary = Summary::new(
        case,
        model,
        &loading.boundary,
        &outcome,
        notices,
        stages.done(),
    );
    let text =
        serde_json::to_string_pretty(&summary).context("the summary cannot be written as JSON")?;
    folder.write_text("summary.json", &(text + "\n"))?;
    Ok(summary)
}
