//! Going on with a run that was stopped or killed, in the folder of its results.

use std::path::Path;
use std::sync::Arc;

use anyhow::{Context, bail, ensure};
use ligament::run::{on_threads, restore};
use ligament_analysis::distributed_matrix::MatrixCommunicator;
use ligament_analysis::driver::{Problem, Restored};
use ligament_analysis::serial::Serial;
use ligament_case::case::CaseFile;
use ligament_output::checkpoint::Checkpoint;
use ligament_output::folder::{RESOLVED_CASE, ResultFolder};
use ligament_output::read_text;
use ligament_output::results::OutputState;
use ligament_output::results::outputs::{clear, require_results};
use serde_json::Value;

use crate::checkpoints::{IsStopped, VERSION};
use crate::destination::make_results;
use crate::inputs::{Contents, Inputs, MAY_CHANGE, unread};
use crate::loading::{Kept, LoadedBody, SUMMARY};
use crate::model::build_model_on;
use crate::processes::{any_stopped, broadcast_path, broadcast_solution, loading};
use crate::progress::{Progress, ProgressMode};
use crate::provenance::Build;
use crate::run::Report;
use crate::stages::Stages;

/// A run that is to go on.
pub struct Request<'a> {
    /// The folder of its results.
    pub folder: &'a Path,
    /// Settings that are to be others from now on, `key=value` each.
    pub settings: &'a [String],
    /// Threads, where they are to be others.
    pub threads: Option<u32>,
    /// The program that goes on with it.
    pub build: Build,
    /// Tells whether the user wants it to stop again.
    pub is_stopped: IsStopped<'a>,
    /// The processes that go on with it together; rank 0 writes all but the pieces of grids that each writes.
    pub communicator: Arc<dyn MatrixCommunicator>,
}

impl Request<'_> {
    /// Goes on with the run from its last good checkpoint, to the same results as if it had never stopped; one that has no
    /// checkpoint yet starts anew.
    ///
    /// # Errors
    ///
    /// If the folder holds no run or one that has ended, if a setting would change what was computed, or if no checkpoint can be
    /// used.
    pub fn resume(&self, mode: ProgressMode) -> anyhow::Result<Report> {
        self.settings.iter().try_for_each(|it| check_setting(it))?;
        let is_root = self.communicator.is_root();
        let folder = is_root.then(|| self.open()).transpose()?;
        let path = folder.as_ref().map(ResultFolder::path);
        let path = broadcast_path(&*self.communicator, path)?;
        let mut case = CaseFile::load(&path.join(RESOLVED_CASE), self.settings)?;
        let threads = &mut case.case.solver.threads;
        *threads = self.threads.or(*threads);
        on_threads(case.threads(), || self.resume_here(&case, folder, mode))?
    }

    /// The folder, locked, with the results of a run.
    fn open(&self) -> anyhow::Result<ResultFolder> {
        let folder = ResultFolder::resumed(self.folder);
        // That there are no results says more than that a folder cannot be locked.
        let folder = folder.map_err(|error| require_results(self.folder).err().unwrap_or(error))?;
        require_results(folder.path())?;
        Ok(folder)
    }

    /// Goes on with the run of a case on the threads of the caller; rank 0 alone has the folder.
    fn resume_here(
        &self,
        case: &CaseFile,
        folder: Option<ResultFolder>,
        mode: ProgressMode,
    ) -> anyhow::Result<Report> {
        let progress = Progress::on(&*self.communicator, mode);
        let found = match &folder {
            Some(folder) => find_checkpoint(folder, case, &progress)?,
            None => None,
        };
        if let (Some(folder), None) = (&folder, &found) {
            ensure_unfinished(folder)?;
            progress.stage("the run has no checkpoint yet: it starts anew");
        }
        self.go_on(case, folder, found, progress)
    }

    /// Goes on with the model of a case from what was found.
    fn go_on(
        &self,
        case: &CaseFile,
        folder: Option<ResultFolder>,
        found: Option<(Checkpoint, OutputState)>,
        mut progress: Progress,
    ) -> anyhow::Result<Report> {
        let mut stages = Stages::default();
        let model = build_model_on(case, self.communicator.clone(), &mut stages, &progress)?;
        let loading = loading(case, &model)?;
        let problem = loading.problem(&model);
        let communicator = &*self.communicator;
        let mut found = found;
        let solution =
            (found.as_mut()).map(|(checkpoint, _)| std::mem::take(&mut checkpoint.solution));
        let solution = broadcast_solution(communicator, solution)?;
        let restored = solution.map(|it| restore(&problem, &model.setup.analysis, &it));
        let restored = restored.transpose()?;
        let is_stopped = || any_stopped(communicator, self.is_stopped);
        let body = LoadedBody {
            case,
            model: &model,
            loading: &loading,
            build: self.build,
            is_stopped: &is_stopped,
        };
        let Some(folder) = folder else {
            body.follow_beside(restored)?;
            return Ok(Report::OfRankZero);
        };
        let kept = found
            .zip(restored)
            .map(|((checkpoint, results), restored)| {
                let kept = kept(checkpoint, results, restored, &problem)?;
                progress.stage(&format!(
                    "going on at load factor {:.4}, {} broken",
                    kept.restored.load_factor(),
                    kept.restored.broken_bonds()
                ));
                anyhow::Ok(kept)
            });
        let kept = kept.transpose()?;
        // From here on the results of the run change.
        folder.remove(SUMMARY)?;
        folder.remove_made_later()?;
        if kept.is_none() {
            clear(&folder)?;
        }
        let summary = make_results(
            case,
            || Ok(folder),
            |folder| {
                let summary = body.follow(folder, kept, &mut stages, &mut progress)?;
                progress.finish(&summary.termination_message);
                let is_complete = !summary.is_stopped();
                Ok((summary, is_complete))
            },
        )?;
        Ok(Report::Loading(Box::new(summary)))
    }
}

/// Refuses a setting that would change what was computed.
fn check_setting(setting: &str) -> anyhow::Result<()> {
    let key = setting.split_once('=').map_or(setting, |it| it.0).trim();
    ensure!(
        MAY_CHANGE.contains(&key),
        "--set {setting}: a run that goes on keeps all that decides about its results so far; it may only take other values of {}. \
         For anything else run the case anew, with `ligament run`",
        MAY_CHANGE.join(", ")
    );
    Ok(())
}

/// The newest checkpoint that is whole, of this version and this case, and whose files are there; none where there is no
/// checkpoint at all.
fn find_checkpoint(
    folder: &ResultFolder,
    case: &CaseFile,
    progress: &Progress,
) -> anyhow::Result<Option<(Checkpoint, OutputState)>> {
    let mut reasons = Vec::new();
    for read in Checkpoint::list(folder.path()) {
        let usable = read.map_err(anyhow::Error::from).and_then(|checkpoint| {
            check_inputs(&checkpoint, case)?;
            let results = OutputState::read(&mut checkpoint.results.as_slice())?;
            match results.obstacle(folder) {
                None => Ok((checkpoint, results)),
                Some(obstacle) => bail!("{obstacle}"),
            }
        });
        match usable {
            Ok(found) => {
                for reason in reasons {
                    progress.stage(&format!("{reason:#}; going on from the checkpoint before"));
                }
                return Ok(Some(found));
            }
            Err(reason) => reasons.push(reason),
        }
    }
    match reasons.into_iter().next() {
        None => Ok(None),
        Some(first) => Err(first.context(format!(
            "the run in {} cannot go on; its results so far are as they were",
            folder.path().display()
        ))),
    }
}

/// Refuses a checkpoint of another version of the program or of another case.
fn check_inputs(checkpoint: &Checkpoint, case: &CaseFile) -> anyhow::Result<()> {
    let version = &checkpoint.version;
    ensure!(
        version == VERSION,
        "its checkpoint was written by version {version} of the program and this is version {VERSION}: go on with that one, or run \
         the case anew"
    );
    let inputs = Inputs::of_course(case, &mut Contents::default()).map_err(unread)?;
    ensure!(
        inputs.text() == checkpoint.inputs,
        "its checkpoint is of other inputs ({}): go on with the case and the mesh that it was begun with, or run the case anew",
        inputs.difference(&checkpoint.inputs)
    );
    Ok(())
}

/// The run of a checkpoint, ready to go on.
fn kept(
    checkpoint: Checkpoint,
    results: OutputState,
    restored: Restored,
    problem: &Problem,
) -> anyhow::Result<Kept> {
    ensure!(
        results.fits(problem),
        "the checkpoint is of another model: points or bonds differ"
    );
    Ok(Kept {
        restored,
        results,
        notices: checkpoint.notices,
    })
}

/// Refuses a run that has come to its end.
fn ensure_unfinished(folder: &ResultFolder) -> anyhow::Result<()> {
    let path = folder.file(SUMMARY);
    if !path.is_file() {
        return Ok(());
    }
    let summary: Value = serde_json::from_str(&read_text(&path)?)
        .with_context(|| format!("cannot use {}", path.display()))?;
    let end = summary["termination_message"].as_str();
    bail!(
        "the run in {} has come to its end ({}): there is nothing to go on with",
        folder.path().display(),
        end.unwrap_or("an analysis without load steps")
    );
}
