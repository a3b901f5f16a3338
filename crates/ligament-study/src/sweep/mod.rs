//! `ligament sweep`: a base case over all combinations of some of its settings.
//!
//! A study file ([`study`]) names the case and axes (`axis`); [`plan`] lists the runs and checks the case of each. Runs are separate
//! processes (`launch`), in a [folder](crate::run_table::folder) with a record of the inputs of each run (`record`), so that the same command
//! continues an interrupted sweep. The final results are a `table` of all runs, with `derived` columns (`evaluation`), some of which need the
//! `cracks` of a run; `curves` of the runs of a `grouping` with fitted lines (`crate::line_fit`); and `pictures` of the runs themselves.

mod axis;
mod cracks;
mod curves;
mod derived;
mod error;
mod estimate;
mod evaluation;
mod grouping;
mod launch;
pub(crate) mod meshes;
mod pictures;
pub mod plan;
mod progress;
mod record;
mod report;
pub mod study;
mod study_plot;
mod table;
pub mod toml_text;

use std::ffi::OsString;
use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::slice;
use std::time::Duration;

use ligament::Message;
use ligament::warning::few_bonds;
use ligament_output::folder::refuse_link;
use ligament_output::terminal::plain;
use ligament_run::memory;
use ligament_run::progress::ProgressMode;
use serde_json::json;

pub use error::StudyError;
pub use launch::bind_to_parent;

use crate::quantities::Quantities;
use crate::run_table::folder::{Shard, StudyFolder};
use cracks::CrackResults;
use estimate::Estimates;
use evaluation::{needs_crack_lines, needs_cracks};
use launch::Resources;
use plan::{MESHES, Run};
use progress::{StudyProgress, seconds};
use record::{RecordedRun, Status};
use study::Study;
use table::Row;

/// File that marks the folder of a sweep.
const MARKER: &str = "sweep.json";

/// Request to a study.
#[derive(Debug, Clone)]
pub struct Request {
    /// The study file.
    pub study: PathBuf,
    /// Folder of the study's results; `results/NAME` without it.
    pub out: Option<PathBuf>,
    /// Task of the request.
    pub task: Task,
}

/// Task for the runs of a study.
#[derive(Debug, Clone)]
pub enum Task {
    /// Execute the runs without results.
    Run(Settings),
    /// List the runs.
    List,
    /// Write the tables and plots of the completed runs in the study's folder, or in the folders named here.
    Collect(Vec<PathBuf>),
}

/// Settings for executing runs.
#[derive(Debug, Clone)]
pub struct Settings {
    /// Part of the runs to execute.
    pub shard: Option<Shard>,
    /// Largest number of simultaneous runs; by default the number of processors.
    pub jobs: Option<usize>,
    /// Memory for the runs, GB; by default the available memory.
    pub memory: Option<f64>,
    /// Whether completed runs are repeated.
    pub force: bool,
    /// The program gmsh.
    pub gmsh: PathBuf,
    /// Display of progress.
    pub progress: ProgressMode,
    /// Command that calls this program, for starting each run; without one the runs are executed in this process.
    pub program: Vec<OsString>,
}

/// Executes the request, with its output on `out`.
///
/// # Errors
///
/// If the study or its case is wrong, its folder is not of a study or in use, or runs failed.
pub fn sweep(request: &Request, out: &mut dyn Write) -> anyhow::Result<()> {
    let study = Study::load(&request.study)?;
    let path = match &request.out {
        Some(path) => path.clone(),
        None => Path::new("results").join(study.name()),
    };
    match &request.task {
        Task::Run(settings) => run(&study, &path, settings, out),
        Task::List => list(&study, &path, out),
        Task::Collect(from) => {
            let folders = StudyFolder::folders_to_collect(MARKER, &path, from)?;
            let runs = plan::runs(&study, &path)?;
            make_report(&study, &runs, &folders, &open_folder(&path, &study)?, out)?;
            Ok(writeln!(out, "  tables and plots in {}", path.display())?)
        }
    }
}

/// Creates the folder of a sweep, or opens the folder of an earlier one.
///
/// # Errors
///
/// If the path is something else, or cannot be written.
pub fn open_folder(path: &Path, study: &Study) -> anyhow::Result<StudyFolder> {
    create_folder(path, &study.source.path, &study.title)
}

/// Creates or opens the folder of a sweep whose study file may not exist yet.
pub(crate) fn create_folder(path: &Path, study: &Path, title: &str) -> anyhow::Result<StudyFolder> {
    refuse_link(&path.join(MESHES))?;
    let marker = json!({
        "study": study.to_string_lossy(),
        "title": title,
        "version": env!("CARGO_PKG_VERSION"),
    });
    let folder = StudyFolder::with_marker(MARKER, path);
    folder.create_or_open(
        &format!("{marker:#}\n"),
        &["runs", "records", "logs", MESHES],
    )
}

/// The completed runs in the folder of a sweep, with their labels; `None` for any other folder.
///
/// # Errors
///
/// If the folder has no table of its runs, or no run is done.
pub fn completed_runs(folder: &Path) -> anyhow::Result<Option<Vec<(String, PathBuf)>>> {
    let is_sweep = StudyFolder::with_marker(MARKER, folder).is_marked();
    is_sweep.then(|| table::completed_runs(folder)).transpose()
}

/// Executes the runs without results.
pub(crate) fn run(
    study: &Study,
    path: &Path,
    settings: &Settings,
    out: &mut dyn Write,
) -> anyhow::Result<()> {
    let runs = plan::runs(study, path)?;
    warn_of_few_bonds(&runs)?;
    // Nothing is written before the cases of all runs are checked.
    let folder = open_folder(path, study)?;
    let claim = folder.claim(settings.shard)?;
    let mine = runs.iter().enumerate();
    let mine = mine.filter(|(index, _)| Shard::contains(settings.shard, *index));
    let mine: Vec<&Run> = mine.map(|(_, run)| run).collect();
    let total = mine.len();
    let (todo, notes) = pending_runs(study, &folder, &mine, settings.force)?;
    let before = total - todo.len();
    let mut progress = StudyProgress::new(study, settings.progress, todo.len());
    if let Some(Shard { number, count }) = settings.shard {
        let all = runs.len();
        progress.print(&format!("shard {number} of {count}: {total} of {all} runs"));
    }
    if before > 0 {
        progress.print(&format!("{before} of {total} runs were done already"));
    }
    notes.iter().for_each(|note| progress.print(note));
    let todo = make_meshes(todo, &folder, &settings.gmsh, &mut progress)?;
    let room = Resources::new(settings.jobs, settings.memory);
    let start = (&*claim.runs, &*settings.program);
    let sum = launch::all(&todo, &folder, start, room, &mut progress)?;
    let (wall, failed) = progress.finish();
    let (problems, tables) = match settings.shard {
        None => {
            let problems = make_report(study, &runs, slice::from_ref(&folder), &folder, out)?;
            (problems, "")
        }
        Some(_) => {
            writeln!(out, "{}: {total} runs", study.title)?;
            (
                Vec::new(),
                "; its tables and plots: ligament sweep --collect",
            )
        }
    };
    let (wall, sum) = (seconds(wall), seconds(sum));
    writeln!(
        out,
        "  time {wall}, {sum} of all runs together; {before} were done already"
    )?;
    writeln!(out, "  results in {}{tables}", path.display())?;
    if failed > 0 {
        return Err(StudyError::Failed { failed, total }.into());
    }
    anyhow::ensure!(
        problems.is_empty(),
        "some tables or plots of the study could not be made; the runs are kept, so correct the study and run it again"
    );
    Ok(())
}

/// Warns once for the study, on stderr, where runs have few bonds a family under a criterion of stress.
fn warn_of_few_bonds(runs: &[Run]) -> io::Result<()> {
    let message = |run: &Run| {
        let case = &run.case.case;
        let criteria = case.fracture.as_ref()?.criteria.as_ref()?;
        few_bonds(criteria, case.model.horizon_factor?)
    };
    let all: Vec<Message> = runs.iter().filter_map(message).collect();
    if let Some(first) = all.first() {
        let [few, of] = [all.len(), runs.len()];
        let text = format!("warning: {few} of {of} runs: {first}");
        writeln!(io::stderr(), "{}", plain(&text))?;
    }
    Ok(())
}

/// The runs to be executed or repeated, and remarks about them.
fn pending_runs<'a>(
    study: &Study,
    folder: &StudyFolder,
    mine: &[&'a Run],
    force: bool,
) -> anyhow::Result<(Vec<&'a Run>, Vec<String>)> {
    let mut todo = Vec::new();
    let mut notes = Vec::new();
    for run in mine {
        let recorded = RecordedRun::in_folder(run, folder);
        recorded.complete_replacement()?;
        if force {
            recorded.record(None)?;
        }
        match recorded.status() {
            Status::Done(_) if recorded.should_repeat() => {}
            Status::Done(_) => continue,
            Status::Changed(how) => {
                notes.push(format!(
                    "{}: repeated, because its inputs changed ({how})",
                    run.words(study)
                ));
            }
            Status::Failed(_) | Status::Missing => {}
        }
        todo.push(*run);
    }
    Ok((todo, notes))
}

/// Makes the missing meshes of runs; returns the runs with a mesh. Those without one have failed.
fn make_meshes<'a>(
    todo: Vec<&'a Run>,
    folder: &StudyFolder,
    gmsh: &Path,
    progress: &mut StudyProgress<'_>,
) -> anyhow::Result<Vec<&'a Run>> {
    let plans = todo.iter().filter_map(|run| run.mesh.as_ref());
    let failed = meshes::make(plans, gmsh, &mut |line| progress.print(line))?;
    let mut meshed = Vec::new();
    for run in todo {
        let mesh = run.mesh.as_ref().map(|plan| plan.request.out.as_path());
        match mesh.and_then(|mesh| failed.get(mesh)) {
            None => meshed.push(run),
            Some(reason) => progress.fails(run, folder, reason, Duration::ZERO)?,
        }
    }
    Ok(meshed)
}

/// Writes the tables and plots of runs in one or several folders, and the problems with them and remarks on stderr; returns the problems.
fn make_report(
    study: &Study,
    runs: &[Run],
    folders: &[StudyFolder],
    to: &StudyFolder,
    out: &mut dyn Write,
) -> anyhow::Result<Vec<String>> {
    let mut unread = Vec::new();
    let mut row = |run| {
        let (status, folder) = best_status(run, folders);
        let cracks = match &status {
            Status::Done(_) if needs_cracks(study) => cracks(study, run, &folder, &mut unread),
            _ => None,
        };
        Row {
            run,
            status,
            folder: folder.to_string_lossy().into_owned(),
            cracks,
        }
    };
    let rows: Vec<Row<'_>> = runs.iter().map(&mut row).collect();
    let mut findings = report::write(study, &rows, to, out)?;
    let further = unread.len().saturating_sub(1);
    findings.problems.extend(unread.into_iter().take(1));
    if further > 0 {
        let all = format!("the same of {further} further runs");
        findings.problems.push(all);
    }
    let mut stderr = io::stderr().lock();
    for text in findings.problems.iter().chain(&findings.remarks) {
        writeln!(stderr, "warning: {}", plain(text))?;
    }
    Ok(findings.problems)
}

/// The best status of a run in some folders, with the folder of its results.
fn best_status(run: &Run, folders: &[StudyFolder]) -> (Status, PathBuf) {
    let found = folders.iter().map(|folder| {
        let recorded = RecordedRun::in_folder(run, folder);
        (recorded.status(), recorded.folder().to_owned())
    });
    let better = |best: (Status, PathBuf), it: (Status, PathBuf)| {
        if it.0.rank() > best.0.rank() {
            it
        } else {
            best
        }
    };
    found.reduce(better).unwrap_or_default()
}

/// Results of a run, and their folder.
pub(crate) struct DoneRun {
    /// Results of the run.
    pub(crate) results: Quantities,
    /// Folder of the results.
    pub(crate) folder: String,
}

/// The runs of a study with their results in its folder, or in the folders `from`.
///
/// # Errors
///
/// If a run has no results.
pub(crate) fn done_runs(
    study: &Study,
    path: &Path,
    from: &[PathBuf],
) -> anyhow::Result<Vec<DoneRun>> {
    let folders = StudyFolder::folders_to_collect(MARKER, path, from)?;
    let runs = plan::runs(study, path)?;
    let done = runs
        .into_iter()
        .map(|run| match best_status(&run, &folders) {
            (Status::Done(results), folder) => Ok(DoneRun {
                results,
                folder: folder.to_string_lossy().into_owned(),
            }),
            (Status::Failed(reason), _) => anyhow::bail!("the run {} failed: {reason}", run.name),
            (Status::Missing | Status::Changed(_), _) => {
                anyhow::bail!("the run {} has no results yet", run.name)
            }
        });
    done.collect()
}

/// The cracks of a run; appends the reason why a result of them is missing to `unread`.
fn cracks(
    study: &Study,
    run: &Run,
    folder: &Path,
    unread: &mut Vec<String>,
) -> Option<CrackResults> {
    let name = &run.name;
    match CrackResults::read(folder) {
        Ok(cracks) => {
            if cracks.is_of_solid() && needs_crack_lines(study) {
                unread.push(format!(
                    "the run {name} is one of a solid, whose crack is a surface without length and height: take crack.area"
                ));
            }
            Some(cracks)
        }
        Err(error) => {
            unread.push(format!(
                "the cracks of the run {name} cannot be read: {error}"
            ));
            None
        }
    }
}

/// Lists the runs with their status and estimated memory.
fn list(study: &Study, path: &Path, out: &mut dyn Write) -> anyhow::Result<()> {
    let folder = StudyFolder::with_marker(MARKER, path);
    let runs = plan::runs(study, path)?;
    warn_of_few_bonds(&runs)?;
    let width = runs.len().to_string().len();
    let mut estimates = Estimates::default();
    let mut todo = 0;
    for (index, run) in runs.iter().enumerate() {
        let recorded = RecordedRun::in_folder(run, &folder);
        let word = match recorded.status() {
            Status::Changed(_) => "changed",
            status => status.word(),
        };
        todo += usize::from(word != "done" || recorded.should_repeat());
        let memory = match estimate::has_mesh(&run.case) {
            true => estimates.bytes(&run.case).map_or_else(
                || "no model".to_owned(),
                |bytes| format!("{:.0} MB", bytes as f64 / 1e6),
            ),
            false => "no mesh yet".to_owned(),
        };
        let words = run.words(study);
        writeln!(
            out,
            "{:>width$}  {word:<7}  {memory:>11}  {words}",
            index + 1
        )?;
    }
    if let Some(bytes) = memory::available_memory() {
        writeln!(out, "memory available: {:.1} GB", bytes as f64 / 1e9)?;
    }
    Ok(writeln!(
        out,
        "{} runs, {todo} to do, in {}",
        runs.len(),
        path.display()
    )?)
}
