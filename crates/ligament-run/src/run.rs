//! A run of a case: from the file to the folder with its results.

use std::io::{self, Write};
use std::path::Path;
use std::sync::Arc;
use std::sync::mpsc::Sender;

use ligament::Vibration;
use ligament::run::{on_pool, on_threads};
use ligament::setup::{Analysis, Refine};
use ligament_analysis::distributed_matrix::{MatrixCommunicator, SingleProcess};
use ligament_analysis::modal::{ModalAnalysis, ModalSettings};
use ligament_analysis::refinement_pass::PassRecord;
use ligament_case::case::CaseFile;
use ligament_output::folder::ResultFolder;
use ligament_output::results::passes::PLACES_FILE;
use ligament_output::results::write_modes;
use ligament_output::summary::{self, Build, ModalSummary, Provenance, Summary};

use crate::checkpoints::StopRequests;
use crate::destination::{self, make_results};
use crate::end::{End, StoppedBeforeSolution};
use crate::inputs::{FileIdentities, unreadable_file};
use crate::loading::LoadedBody;
use crate::memory;
use crate::messages::merged_messages;
use crate::model::{Model, build_model_on};
use crate::processes::{any_stopped, loading};
use crate::progress::{Progress, ProgressMode, StepLine};
use crate::provenance::provenance;
use crate::refinement::Anew;
use crate::stages::Stages;
use crate::summary::{modal_summary, write, write_modal};

pub use crate::checkpoints::IsStopped;

/// Report of a run.
#[derive(Debug, Clone, PartialEq)]
pub enum Report {
    /// Summary of a run under loads.
    Loading(Box<Summary>),
    /// Summary of an analysis of natural modes.
    Modes(Box<ModalSummary>),
    /// Ranks other than 0 have no report.
    OfRankZero,
}

impl Report {
    /// Writes the report of a run for the user.
    pub fn write(&self, out: &mut dyn Write) -> io::Result<()> {
        match self {
            Self::Loading(summary) => write(summary, out),
            Self::Modes(summary) => write_modal(summary, out),
            Self::OfRankZero => Ok(()),
        }
    }

    /// Reason why no state under load is in equilibrium, if none is.
    pub fn without_equilibrium(&self) -> Option<&str> {
        match self {
            Self::Loading(summary) if summary.without_equilibrium => {
                Some(&summary.termination_message)
            }
            Self::Loading(_) | Self::Modes(_) | Self::OfRankZero => None,
        }
    }

    /// End of the run.
    pub fn end(&self) -> End {
        match self {
            Self::Loading(summary) => summary.end(),
            Self::Modes(summary) if summary.unstable => End::Invalid,
            Self::Modes(_) | Self::OfRankZero => End::Done,
        }
    }

    /// Whether the run was stopped by its user, and can be resumed.
    pub fn is_stopped(&self) -> bool {
        self.end() == End::Stopped
    }
}

/// Request to run a case.
pub struct Request<'a> {
    /// Case of the run.
    pub case: &'a CaseFile,
    /// Folder for the results.
    pub out: &'a Path,
    /// Whether results of an earlier run may be replaced.
    pub force: bool,
    /// Build of the running program.
    pub build: Build,
    /// Whether the user wants to stop the run.
    pub is_stopped: IsStopped<'a>,
    /// Whether the user wants the run to end at once, with an error and without its last state.
    pub is_aborted: IsStopped<'a>,
    /// Whether the folder gets copies of the files that the case reads, so that it can be moved and repeated elsewhere.
    pub keeps_inputs: bool,
    /// Receiver of the state at the end of each load step.
    pub steps: Option<Sender<StepLine>>,
    /// Processes of the run; rank 0 writes all results except the pieces of grids, which each process writes.
    pub communicator: Arc<dyn MatrixCommunicator>,
    /// Records of the passes of a refinement before the first one.
    pub earlier: Vec<PassRecord>,
    /// Whether the run ends with the first pass of a refinement.
    pub is_one_pass: bool,
}

/// Runs a case and writes its results into a new folder, without a record of the build.
pub fn run(case: &CaseFile, out: &Path, force: bool, mode: ProgressMode) -> anyhow::Result<Report> {
    let request = Request {
        force,
        ..Request::new(case, out, Build::default())
    };
    request.run(mode)
}

impl<'a> Request<'a> {
    /// A request to run a case on one process into a folder without results, up to its end.
    pub fn new(case: &'a CaseFile, out: &'a Path, build: Build) -> Self {
        Self {
            case,
            out,
            force: false,
            build,
            is_stopped: &|| false,
            is_aborted: &|| false,
            keeps_inputs: false,
            steps: None,
            communicator: Arc::new(SingleProcess),
            earlier: Vec::new(),
            is_one_pass: false,
        }
    }

    /// Runs the case and writes its results into a new folder, up to its end or until it is stopped.
    ///
    /// # Errors
    ///
    /// If the folder cannot be used, the case is wrong, or results cannot be written.
    pub fn run(&self, mode: ProgressMode) -> anyhow::Result<Report> {
        on_threads(self.case.threads(), || self.run_here(mode))?
    }

    /// Runs the case on the caller's threads.
    pub(crate) fn run_here(&self, mode: ProgressMode) -> anyhow::Result<Report> {
        let communicator = &self.communicator;
        if communicator.is_root() {
            ResultFolder::check(self.out, self.force)?;
        }
        let mut stages = Stages::default();
        let progress = Progress::on(&**communicator, mode).with_receiver(self.steps.clone());
        let model = build_model_on(self.case, communicator.clone(), &mut stages, &progress)?;
        let solve = || self.solve(&model, stages, progress);
        let solved = on_pool(&**communicator, solve);
        drop(model);
        self.go_on(solved, mode)
    }

    /// The report of a run that was solved, or of the last one of those that begin anew after it, on the caller's threads. The files of the run before
    /// are replaced.
    pub(crate) fn go_on(
        &self,
        solved: anyhow::Result<(Report, Option<Refine>)>,
        mode: ProgressMode,
    ) -> anyhow::Result<Report> {
        let anew = match solved {
            Ok((report, next)) => match (next.filter(|_| !self.is_one_pass), &report) {
                (Some(refine), Report::Loading(summary)) => {
                    let passes = summary.refinement.as_ref().map(|it| it.passes.clone());
                    Anew::Pass {
                        refine,
                        places: std::path::absolute(self.out)?.join(PLACES_FILE),
                        earlier: passes.unwrap_or_default(),
                    }
                }
                _ => return Ok(report),
            },
            Err(error) => Anew::Growth(error.downcast()?),
        };
        Progress::on(&*self.communicator, mode).stage(&anew.words());
        let case = anew.case(self.case);
        let earlier = match anew {
            Anew::Growth(_) => self.earlier.clone(),
            Anew::Pass { earlier, .. } => earlier,
        };
        let request = Request {
            case: &case,
            force: true,
            build: self.build.clone(),
            steps: self.steps.clone(),
            communicator: self.communicator.clone(),
            earlier,
            ..*self
        };
        request.run_here(mode)
    }

    /// Runs the analysis of a model under loads, or of its modes.
    fn solve(
        &self,
        model: &Model,
        stages: Stages,
        mut progress: Progress,
    ) -> anyhow::Result<(Report, Option<Refine>)> {
        for warning in merged_messages(model.warnings.iter().cloned()) {
            progress.stage(&format!("warning: {warning}"));
        }
        if let Analysis::Modal(settings) = model.setup.analysis {
            // The modal analysis runs on one process with the whole body.
            if !self.communicator.is_root() {
                return Ok((Report::OfRankZero, None));
            }
            let create = || ResultFolder::create(self.out, self.force);
            let (build, mut contents) = (self.build.clone(), FileIdentities::default());
            let provenance = provenance(build, self.case, self.out, &mut contents);
            let body = (model, provenance.map_err(unreadable_file)?);
            let summary = find_modes(
                (self.case, self.keeps_inputs),
                settings,
                body,
                create,
                stages,
            )?;
            progress.finish(&format!("{} modes found", summary.modes.len()));
            Ok((Report::Modes(Box::new(summary)), None))
        } else {
            follow_loads(self, model, stages, progress)
        }
    }
}

/// Runs the analysis of a model under loads, and writes the results into a new folder.
fn follow_loads(
    request: &Request<'_>,
    model: &Model,
    mut stages: Stages,
    mut progress: Progress,
) -> anyhow::Result<(Report, Option<Refine>)> {
    let (case, communicator) = (request.case, &*request.communicator);
    let loading = loading(case, model)?;
    if !communicator.has_matrices() && !model.setup.analysis.is_motion() {
        let problem = loading.problem(model);
        memory::check_equation_memory(case, &*model.system, &problem)?;
    }
    let is_stopped = || any_stopped(communicator, request.is_stopped);
    anyhow::ensure!(!is_stopped(), StoppedBeforeSolution);
    let body = LoadedBody {
        case,
        model,
        loading: &loading,
        build: request.build.clone(),
        requests: StopRequests {
            is_stopped: &is_stopped,
            is_aborted: request.is_aborted,
        },
        earlier: &request.earlier,
    };
    if !communicator.is_root() {
        body.follow_beside(None)?;
        return Ok((Report::OfRankZero, None));
    }
    // Nothing is written or replaced before all input is checked.
    let create = || ResultFolder::create(request.out, request.force);
    let (summary, next) = make_results((case, request.keeps_inputs), create, |folder, case| {
        if let Some(words) = destination::replacement_message(folder) {
            progress.stage(&words);
        }
        let body = LoadedBody { case, ..body };
        let (summary, next) = body.follow(folder, None, &mut stages, &mut progress)?;
        progress.finish(&summary.termination_message);
        let is_complete = summary.end() != End::Stopped;
        Ok(((summary, next), is_complete))
    })?;
    Ok((Report::Loading(Box::new(summary)), next))
}

/// Finds the modes of a model and writes them into a new folder; `inputs` are the case, and whether the folder gets copies of its files.
fn find_modes(
    inputs: (&CaseFile, bool),
    settings: ModalSettings,
    (model, provenance): (&Model, Provenance),
    create: impl FnOnce() -> Result<ResultFolder, ligament_output::Error>,
    mut stages: Stages,
) -> anyhow::Result<ModalSummary> {
    let case = inputs.0;
    let vibration = Vibration::new(model);
    let vibration = vibration.map_err(|error| case.error_at_key(error))?;
    let problem = vibration.problem(model);
    let analysis = stages.time("analysis", || ModalAnalysis::new(&problem, settings))?;
    memory::check_memory(case, &*model.system, Some(analysis.stiffness()))?;

    let outcome = stages.time("modes", || analysis.find())?;

    // Nothing is written or replaced before the modes are found.
    make_results(inputs, create, |folder, case| {
        stages.time("output", || {
            let grid = model.body().grid();
            write_modes(folder, &grid, &*model.system, &model.fixed, &outcome)
        })?;
        let summary = modal_summary(case, model, &outcome, provenance, stages.done());
        summary::write(folder, &summary)?;
        Ok((summary, true))
    })
}
