//! The method, second page: from the discrete model to a broken specimen, or to its modes. The first is [`crate::model`].

use std::io::{self, Write};
use std::path::Path;

use anyhow::Context;
use ligament_analysis::driver::{self, Outcome, Problem};
use ligament_analysis::{Observer, SetupError};
use ligament_output::folder::{RESOLVED_CASE, ResultFolder};
use ligament_output::results::{ResultWriter, Time, WriteRule};

use crate::case::{CaseFile, Control, Fracture, StressField};
use crate::model::{Model, build_model};
use crate::modes::find_modes;
use crate::progress::{Progress, ProgressMode};
use crate::resolve::{self, Loading};
use crate::stages::Stages;
use crate::summary::{ModalSummary, Summary};
use crate::watch::Watch;

/// Energy rule of an elastic solution, which has no fracture section to say it (NHPD's value).
pub const ELASTIC_ENERGY_TOLERANCE: f64 = 1e-4;

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
    resolve::on_threads(case, || run_here(case, out, force, mode))?
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
    let progress = Progress::new(mode);
    let model = build_model(case, &mut stages, &progress)?;
    match &case.case.modal {
        Some(modal) => {
            let summary = find_modes(case, modal, &model, out, force, stages, progress)?;
            Ok(Report::Modes(Box::new(summary)))
        }
        None => {
            let summary = follow_loads(case, &model, out, force, stages, progress)?;
            Ok(Report::Loading(Box::new(summary)))
        }
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
    let loading = Loading::of(case, &*model.body, &model.system)?;
    let problem = loading.problem(&model.system, &model.criteria);

    // Nothing is written, and nothing replaced, before all input was found good.
    let folder = ResultFolder::create(out, force)?;
    folder.write_text(RESOLVED_CASE, &case.resolved_toml()?)?;
    let grid = model.body.grid();
    let rule = WriteRule {
        fields_every: case.case.output.fields_every as usize,
        bonds: case.case.output.bonds,
        model: case.case.output.model,
        virial: case.case.output.stress.contains(&StressField::Virial),
        traction: case.case.output.stress.contains(&StressField::Traction),
        time: match case.case.fracture.as_ref().map(|it| &it.control) {
            Some(Control::Event) => Time::Step,
            Some(Control::Stepped(_)) | None => Time::Load,
        },
    };
    let writer = ResultWriter::new(&folder, &grid, &model.fixed, rule, &problem)?;
    let mut watch = Watch::new(writer, &mut progress, &*model.body, &case.case);
    let outcome = stages.time("solution", || follow(case, &problem, &mut watch))?;

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
    progress.finish(&outcome.termination.to_string());
    Ok(summary)
}

/// Solves the case, or follows its loading up to failure.
pub fn follow(
    case: &CaseFile,
    problem: &Problem,
    observer: &mut dyn Observer,
) -> Result<Outcome, SetupError> {
    match &case.case.fracture {
        None => driver::elastic::run(problem, ELASTIC_ENERGY_TOLERANCE, observer),
        Some(fracture) => break_bonds(problem, fracture, observer),
    }
}

/// Follows the loading with the driver that the case chooses.
pub fn break_bonds(
    problem: &Problem,
    fracture: &Fracture,
    observer: &mut dyn Observer,
) -> Result<Outcome, SetupError> {
    match &fracture.control {
        Control::Stepped(stepping) => {
            let settings = resolve::stepped(fracture, stepping);
            driver::stepped::run(problem, &settings, observer)
        }
        Control::Event => {
            let settings = resolve::event(fracture);
            driver::event::run(problem, &settings, observer)
        }
    }
}
