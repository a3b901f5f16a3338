//! Resuming a stopped or killed run in its result folder.

use std::io::Read;
use std::path::Path;
use std::sync::Arc;

use anyhow::{Context, bail, ensure};
use ligament::run::{Posed, Restored, on_pool, on_threads, restore};
use ligament::setup::Refine;
use ligament::{Loading, Model};
use ligament_analysis::distributed_matrix::MatrixCommunicator;
use ligament_analysis::driver::Problem;
use ligament_analysis::serial::Serial;
use ligament_case::case::CaseFile;
use ligament_output::checkpoint::{Checkpoint, StoredSolution};
use ligament_output::folder::{RESOLVED_CASE, ResultFolder};
use ligament_output::quantity::quantity;
use ligament_output::results::OutputState;
use ligament_output::results::outputs::{clear, require_results};
use ligament_output::results::passes::read_passes;
use ligament_output::summary::{self, Build, Identity, SUMMARY_FILE, Summary};

use crate::checkpoints::{IsStopped, StopRequests, VERSION};
use crate::destination::make_results;
use crate::end::End;
use crate::inputs::{
    CHANGEABLE_KEYS, FileIdentities, Inputs, find_moved_files, set_mesh, unreadable_file,
};
use crate::loading::{LoadedBody, RestoredRun};
use crate::model::build_model_on;
use crate::origin;
use crate::processes::{any_stopped, broadcast_path, broadcast_solution, loading};
use crate::progress::{Progress, ProgressMode};
use crate::refinement::pass;
use crate::run::{self, Report};
use crate::stages::Stages;

/// Request to resume a run.
pub struct Request<'a> {
    /// Result folder of the run.
    pub folder: &'a Path,
    /// Path of the mesh, where it has moved since the run.
    pub mesh: Option<&'a Path>,
    /// Changed settings, `key=value` each.
    pub settings: &'a [String],
    /// Number of threads, if other than in the case.
    pub threads: Option<u32>,
    /// Build of the resuming program.
    pub build: Build,
    /// Whether the user wants to stop the run again.
    pub is_stopped: IsStopped<'a>,
    /// Processes of the resumed run; rank 0 writes all results except the pieces of grids, which each process writes.
    pub communicator: Arc<dyn MatrixCommunicator>,
}

impl Request<'_> {
    /// Resumes the run from its last valid checkpoint, with the same results as an uninterrupted run; a run without a checkpoint starts
    /// anew.
    ///
    /// # Errors
    ///
    /// If the folder has no run or one that has ended, if a setting would change earlier results, or if no checkpoint can be used.
    pub fn resume(&self, mode: ProgressMode) -> anyhow::Result<Report> {
        self.settings.iter().try_for_each(|it| check_setting(it))?;
        let is_root = self.communicator.is_root();
        let folder = is_root.then(|| self.open()).transpose()?;
        let path = folder.as_ref().map(ResultFolder::path);
        let path = broadcast_path(&*self.communicator, path)?;
        let mut case = CaseFile::load(&path.join(RESOLVED_CASE), self.settings)?;
        let threads = &mut case.case.solver.threads;
        *threads = self.threads.or(*threads);
        set_mesh(&mut case, self.mesh)?;
        find_moved_files(&mut case, &path, &|it| was_read(&path, it));
        on_threads(case.threads(), || {
            self.resume_here((&case, &path), folder, mode)
        })?
    }

    /// Opens and locks the folder with the results of a run.
    fn open(&self) -> anyhow::Result<ResultFolder> {
        let folder = ResultFolder::open_resumed(self.folder);
        // The error of missing results takes precedence over the error of the lock.
        let folder = folder.map_err(|error| require_results(self.folder).err().unwrap_or(error))?;
        require_results(folder.path())?;
        Ok(folder)
    }

    /// Resumes the run of a case in a folder of results on the caller's threads; only rank 0 has locked the folder.
    fn resume_here(
        &self,
        (case, path): (&CaseFile, &Path),
        folder: Option<ResultFolder>,
        mode: ProgressMode,
    ) -> anyhow::Result<Report> {
        let progress = Progress::on(&*self.communicator, mode);
        if let Some(words) = origin::change(case, path) {
            progress.stage(&words);
        }
        let found = match &folder {
            Some(folder) => find_checkpoint(folder, case, &progress)?,
            None => None,
        };
        if let (Some(folder), None) = (&folder, &found) {
            ensure_unfinished(folder)?;
            progress.stage("the run has no checkpoint yet, so it starts from the beginning");
        }
        let go_on = || self.continue_run((case, path), folder, found, progress);
        let solved = on_pool(&*self.communicator, go_on);
        let request = run::Request {
            is_stopped: self.is_stopped,
            communicator: self.communicator.clone(),
            earlier: read_passes(path, pass(case))?,
            ..run::Request::new(case, self.folder, self.build.clone())
        };
        request.go_on(solved, mode)
    }

    /// Builds the model of a case and continues from the checkpoint that was found, if any.
    fn continue_run(
        &self,
        (case, path): (&CaseFile, &Path),
        folder: Option<ResultFolder>,
        found: Option<(Checkpoint, OutputState, StoredSolution)>,
        mut progress: Progress,
    ) -> anyhow::Result<(Report, Option<Refine>)> {
        let mut stages = Stages::default();
        let model = build_model_on(case, self.communicator.clone(), &mut stages, &progress)?;
        let loading = loading(case, &model)?;
        let problem = loading.problem(&model);
        let communicator = &*self.communicator;
        let (found, stored) = found
            .map(|(checkpoint, results, stored)| ((checkpoint, results), stored))
            .unzip();
        let stored = broadcast_solution(communicator, stored)?;
        let restored = stored.map(|it| restore_run((&model, &loading), &problem, it.open(path)?));
        let restored = restored.transpose()?;
        let is_stopped = || any_stopped(communicator, self.is_stopped);
        let body = LoadedBody {
            case,
            model: &model,
            loading: &loading,
            build: self.build.clone(),
            requests: StopRequests::at_next_state(&is_stopped),
            earlier: &read_passes(path, pass(case))?,
        };
        let Some(folder) = folder else {
            body.follow_beside(restored)?;
            return Ok((Report::OfRankZero, None));
        };
        let restored_run = found
            .zip(restored)
            .map(|((checkpoint, results), restored)| {
                let restored_run = restored_run(checkpoint, results, restored, &problem)?;
                progress.stage(&resumption_line(&restored_run.restored, &model));
                anyhow::Ok(restored_run)
            });
        let restored_run = restored_run.transpose()?;
        // The results of the run change from here on.
        folder.remove(SUMMARY_FILE)?;
        folder.remove_derived_files()?;
        if restored_run.is_none() {
            clear(&folder)?;
        }
        let (summary, next) = make_results(
            (case, false),
            || Ok(folder),
            |folder, _| {
                let (summary, next) =
                    body.follow(folder, restored_run, &mut stages, &mut progress)?;
                progress.finish(&summary.termination_message);
                let is_complete = summary.end() != End::Stopped;
                Ok(((summary, next), is_complete))
            },
        )?;
        Ok((Report::Loading(Box::new(summary)), next))
    }
}

/// The line about the state from which a run continues.
fn resumption_line(restored: &Restored, model: &Model) -> String {
    let (reached, broken) = (restored.load_factor(), restored.broken_bonds());
    let reached = match model.setup.analysis.is_motion() {
        true => quantity(reached, "s"),
        false => format!("load factor {reached:.4}"),
    };
    format!("resuming at {reached} with {broken} broken")
}

/// The run of a checkpoint's solution.
fn restore_run(
    (model, loading): (&Model, &Loading),
    problem: &Problem,
    mut solution: impl Read,
) -> anyhow::Result<Restored> {
    let motion = loading.motion(problem);
    let posed = Posed::new(problem, motion.as_ref());
    Ok(restore(posed, &model.setup.analysis, &mut solution)?)
}

/// Refuses a setting that would change earlier results.
fn check_setting(setting: &str) -> anyhow::Result<()> {
    let key = setting.split_once('=').map_or(setting, |it| it.0).trim();
    ensure!(
        CHANGEABLE_KEYS.contains(&key),
        "--set {setting}: a resumed run can only change {}; any other key would change its earlier results. For that, run the case again \
         with `ligament run`",
        CHANGEABLE_KEYS.join(", ")
    );
    Ok(())
}

/// The newest intact checkpoint of this version and case whose result files exist; `None` where there is no checkpoint.
fn find_checkpoint(
    folder: &ResultFolder,
    case: &CaseFile,
    progress: &Progress,
) -> anyhow::Result<Option<(Checkpoint, OutputState, StoredSolution)>> {
    let mut reasons = Vec::new();
    for read in Checkpoint::list(folder.path()) {
        let usable = read
            .map_err(anyhow::Error::from)
            .and_then(|(checkpoint, stored)| {
                check_inputs(&checkpoint, case)?;
                let results = OutputState::read(&mut checkpoint.results.as_slice())?;
                match results.mismatch(folder) {
                    None => Ok((checkpoint, results, stored)),
                    Some(obstacle) => bail!("{obstacle}"),
                }
            });
        match usable {
            Ok(found) => {
                for reason in reasons {
                    progress.stage(&format!(
                        "{reason:#}; resuming from the checkpoint before it"
                    ));
                }
                return Ok(Some(found));
            }
            Err(reason) => reasons.push(reason),
        }
    }
    match reasons.into_iter().next() {
        None => Ok(None),
        Some(first) => Err(first.context(format!(
            "cannot resume the run in {}; its results are unchanged",
            folder.path().display()
        ))),
    }
}

/// Whether a checkpoint of a run was written with an input of this content.
fn was_read(folder: &Path, content: &Identity) -> bool {
    let mut checkpoints = Checkpoint::list(folder).into_iter().flatten();
    let content = content.to_string();
    checkpoints.any(|it| it.0.inputs.contains(&content))
}

/// Refuses a checkpoint of another version of the program or of another case.
fn check_inputs(checkpoint: &Checkpoint, case: &CaseFile) -> anyhow::Result<()> {
    let version = &checkpoint.version;
    ensure!(
        version == VERSION,
        "version {version} of the program wrote its checkpoint, and this is version {VERSION}: resume with that version, or run the case \
         again"
    );
    let inputs = Inputs::determining_inputs(case, &mut FileIdentities::default());
    let inputs = inputs.map_err(unreadable_file).context(
        "an input of the run cannot be read; if the mesh has moved, give its new place with --mesh",
    )?;
    ensure!(
        inputs.text() == checkpoint.inputs,
        "its checkpoint belongs to other inputs ({}): resume with the case and the mesh of the first run, or run the case again",
        inputs.difference(&checkpoint.inputs)
    );
    Ok(())
}

/// The state of a checkpoint from which the run continues.
fn restored_run(
    checkpoint: Checkpoint,
    results: OutputState,
    restored: Restored,
    problem: &Problem,
) -> anyhow::Result<RestoredRun> {
    ensure!(
        results.fits(problem),
        "the checkpoint belongs to another model: points or bonds differ"
    );
    Ok(RestoredRun {
        restored,
        results,
        messages: checkpoint.messages,
    })
}

/// Refuses a run that has ended.
fn ensure_unfinished(folder: &ResultFolder) -> anyhow::Result<()> {
    let Some(summary) = summary::read::<Summary>(folder.path())? else {
        return Ok(());
    };
    let end = Some(&*summary.termination_message).filter(|it| !it.is_empty());
    bail!(
        "the run in {} is complete ({}), so there is nothing to resume",
        folder.path().display(),
        end.unwrap_or("an analysis without load steps")
    );
}
