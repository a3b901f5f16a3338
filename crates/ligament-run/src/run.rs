//! A run of a case: from the file to the folder with its results.

use std::io::{self, Write};
use std::path::Path;
use std::sync::Arc;

use ligament::run::on_threads;
use ligament::setup::Analysis;
use ligament_analysis::distributed_matrix::{MatrixCommunicator, Solo};
use ligament_output::folder::ResultFolder;
use ligament_output::summary::{Build, ModalSummary, Summary};

use crate::destination::{self, make_results};
use crate::end::{End, StoppedBeforeSolution};
use crate::inputs::{Contents, unread};
use crate::loading::LoadedBody;
use crate::memory;
use crate::model::{Model, build_model_on};
use crate::modes::find_modes;
use crate::processes::{any_stopped, loading};
use crate::progress::{Progress, ProgressMode};
use crate::provenance::provenance;
use crate::stages::Stages;
use crate::summary::{write, write_modal};
use ligament_case::case::CaseFile;

pub use crate::checkpoints::IsStopped;

/// What a run found.
#[derive(Debug, Clone, PartialEq)]
pub enum Report {
    /// The answer to loads.
    Loading(Box<Summary>),
    /// Natural modes.
    Modes(Box<ModalSummary>),
    /// This process is not rank 0, which alone has the report.
    OfRankZero,
}

impl Report {
    /// The lines that a user sees at the end of a run.
    pub fn write(&self, out: &mut dyn Write) -> io::Result<()> {
        match self {
            Self::Loading(summary) => write(summary, out),
            Self::Modes(summary) => write_modal(summary, out),
            Self::OfRankZero => Ok(()),
        }
    }

    /// Why no state under load is in equilibrium, where none is.
    pub fn without_equilibrium(&self) -> Option<&str> {
        match self {
            Self::Loading(summary) if summary.without_equilibrium => {
                Some(&summary.termination_message)
            }
            Self::Loading(_) | Self::Modes(_) | Self::OfRankZero => None,
        }
    }

    /// How the run ended.
    pub fn end(&self) -> End {
        match self {
            Self::Loading(summary) => End::of(summary),
            Self::Modes(_) | Self::OfRankZero => End::Done,
        }
    }

    /// Whether the run was stopped by its user, and can go on.
    pub fn is_stopped(&self) -> bool {
        self.end() == End::Stopped
    }
}

/// A run that is asked for.
pub struct Request<'a> {
    /// The case.
    pub case: &'a CaseFile,
    /// The folder of its results.
    pub out: &'a Path,
    /// Whether results of an earlier run may be replaced.
    pub force: bool,
    /// The program that runs it.
    pub build: Build,
    /// Tells whether the user wants it to stop.
    pub is_stopped: IsStopped<'a>,
    /// The processes that run it together; rank 0 writes all but the pieces of grids that each writes.
    pub communicator: Arc<dyn MatrixCommunicator>,
}

/// Runs a case and writes its results into a new folder; the record of these says nothing of the build.
pub fn run(case: &CaseFile, out: &Path, force: bool, mode: ProgressMode) -> anyhow::Result<Report> {
    let request = Request {
        case,
        out,
        force,
        build: Build::default(),
        is_stopped: &|| false,
        communicator: Arc::new(Solo),
    };
    request.run(mode)
}

impl Request<'_> {
    /// Runs the case and writes its results into a new folder, until it is stopped.
    ///
    /// # Errors
    ///
    /// If the folder cannot be used, something is wrong with the case, or results cannot be written.
    pub fn run(&self, mode: ProgressMode) -> anyhow::Result<Report> {
        on_threads(self.case.threads(), || self.run_here(mode))?
    }

    /// Runs the case on the threads of the caller.
    fn run_here(&self, mode: ProgressMode) -> anyhow::Result<Report> {
        let communicator = &self.communicator;
        if communicator.is_root() {
            ResultFolder::check(self.out, self.force)?;
        }
        let mut stages = Stages::default();
        let progress = Progress::on(&**communicator, mode);
        let model = build_model_on(self.case, communicator.clone(), &mut stages, &progress)?;
        self.solve(&model, stages, progress)
    }

    /// Loads a model or finds its modes.
    fn solve(
        &self,
        model: &Model,
        stages: Stages,
        mut progress: Progress,
    ) -> anyhow::Result<Report> {
        for warning in &model.warnings {
            progress.stage(&format!("warning: {warning}"));
        }
        if let Analysis::Modal(settings) = model.setup.analysis {
            // Modes need the whole body on one process.
            if !self.communicator.is_root() {
                return Ok(Report::OfRankZero);
            }
            let create = || ResultFolder::create(self.out, self.force);
            let provenance = provenance(self.build.clone(), self.case, &mut Contents::default());
            let provenance = provenance.map_err(unread)?;
            let body = (model, provenance);
            let summary = find_modes(self.case, settings, body, create, stages)?;
            progress.finish(&format!("{} modes found", summary.modes.len()));
            Ok(Report::Modes(Box::new(summary)))
        } else {
            follow_loads(self, model, stages, progress)
        }
    }
}

/// Loads a model, breaks its bonds if the case says so, and writes what happens into a new folder.
fn follow_loads(
    request: &Request<'_>,
    model: &Model,
    mut stages: Stages,
    mut progress: Progress,
) -> anyhow::Result<Report> {
    let (case, communicator) = (request.case, &*request.communicator);
    let loading = loading(case, model)?;
    if !communicator.has_matrices() {
        let problem = loading.problem(model);
        memory::foresee_equations(case, &*model.system, &problem)?;
    }
    let is_stopped = || any_stopped(communicator, request.is_stopped);
    anyhow::ensure!(!is_stopped(), StoppedBeforeSolution);
    let body = LoadedBody {
        case,
        model,
        loading: &loading,
        build: request.build.clone(),
        is_stopped: &is_stopped,
    };
    if !communicator.is_root() {
        body.follow_beside(None)?;
        return Ok(Report::OfRankZero);
    }
    // Nothing is written, and nothing replaced, before all input was found good.
    let create = || ResultFolder::create(request.out, request.force);
    let summary = make_results(case, create, |folder| {
        if let Some(words) = destination::words(folder) {
            progress.stage(&words);
        }
        let summary = body.follow(folder, None, &mut stages, &mut progress)?;
        progress.finish(&summary.termination_message);
        let is_complete = End::of(&summary) != End::Stopped;
        Ok((summary, is_complete))
    })?;
    Ok(Report::Loading(Box::new(summary)))
}
