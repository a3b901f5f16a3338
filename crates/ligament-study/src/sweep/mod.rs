//! `ligament sweep`: a base case over all combinations of some of its settings.
//!
//! A study file ([`study`]) names the case and axes (`axis`); [`plan`] lists the runs and checks the case of each. Runs are separate
//! processes (`launch`), in a folder ([`folder`]) with a record of the inputs of each run (`record`), so that the same command continues an
//! interrupted sweep. The final results are a `table` of all runs, with `curves` and fitted lines (`crate::line_fit`).

mod axis;
mod curves;
mod error;
mod estimate;
pub mod folder;
mod launch;
mod meshes;
pub mod plan;
mod progress;
mod record;
pub(crate) mod report;
pub mod study;
mod table;
pub mod written;

use std::collections::BTreeMap;
use std::ffi::OsString;
use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::time::Duration;

use ligament_output::terminal::plain;
use ligament_run::memory;
use ligament_run::progress::ProgressMode;

pub use error::StudyError;
pub use launch::bind_to_parent;

use estimate::Estimates;
use folder::{MARKER, Shard, StudyFolder};
use launch::Room;
use plan::Run;
use progress::{StudyProgress, seconds};
use record::Status;
use study::Study;
use table::Row;

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
    /// Command that calls this program, for starting each run.
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
        Task::Collect(from) => collect(&study, &path, from, out),
    }
}

/// Executes the runs without results.
fn run(study: &Study, path: &Path, settings: &Settings, out: &mut dyn Write) -> anyhow::Result<()> {
    let runs = plan::runs(study, &StudyFolder::at(path).meshes())?;
    // Nothing is written before the cases of all runs are checked.
    let folder = StudyFolder::open(path, study)?;
    let claim = folder.claim(settings.shard)?;
    let mine: Vec<&Run> = (runs.iter().enumerate())
        .filter(|(index, _)| settings.shard.is_none_or(|shard| shard.contains(*index)))
        .map(|(_, run)| run)
        .collect();
    let (mut todo, notes) = not_done(study, &folder, &mine, settings.force)?;
    let before = mine.len() - todo.len();
    let mut progress = StudyProgress::new(study, settings.progress, todo.len());
    if let Some(Shard { number, count }) = settings.shard {
        progress.print(&format!(
            "shard {number} of {count}: {} of {} runs",
            mine.len(),
            runs.len()
        ));
    }
    if before > 0 {
        let all = mine.len();
        progress.print(&format!("{before} of {all} runs were done already"));
    }
    notes.iter().for_each(|note| progress.print(note));
    let unmeshed = made_meshes(&todo, &folder, &settings.gmsh, &mut progress)?;
    todo.retain(|run| !unmeshed.contains_key(&run.name));
    let room = Room::new(settings.jobs, settings.memory);
    let start = (&*claim.runs, &*settings.program);
    let sum = launch::all(&todo, &folder, start, room, &mut progress)?;
    let (wall, failed) = progress.finish();

    if settings.shard.is_none() {
        let problems = make_report(study, &runs, &[(&folder, &runs)], &folder, out)?;
        tell_problems(&problems)?;
        write_times(out, wall, sum, before)?;
        writeln!(out, "  results in {}", path.display())?;
        if failed == 0 && !problems.is_empty() {
            anyhow::bail!(
                "some tables or plots of the study could not be made; the runs are kept, so correct the study and run it again"
            );
        }
    } else {
        writeln!(out, "{}: {} runs", study.title, mine.len())?;
        write_times(out, wall, sum, before)?;
        writeln!(
            out,
            "  results in {}; its tables and plots: ligament sweep --collect",
            path.display()
        )?;
    }
    match failed {
        0 => Ok(()),
        failed => Err(StudyError::Failed {
            failed,
            total: mine.len(),
        }
        .into()),
    }
}

/// The runs to be executed or repeated, and remarks about them.
fn not_done<'a>(
    study: &Study,
    folder: &StudyFolder,
    mine: &[&'a Run],
    force: bool,
) -> anyhow::Result<(Vec<&'a Run>, Vec<String>)> {
    let mut todo = Vec::new();
    let mut notes = Vec::new();
    for run in mine {
        record::complete_replacement(run, folder)?;
        if force {
            record::demand(run, folder)?;
        }
        match Status::in_folder(run, folder) {
            Status::Done(_) if record::should_repeat(run, folder) => {}
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

/// Makes the missing meshes of runs; returns the runs without a mesh, which have failed, with the reasons.
fn made_meshes(
    todo: &[&Run],
    folder: &StudyFolder,
    gmsh: &Path,
    progress: &mut StudyProgress,
) -> anyhow::Result<BTreeMap<String, String>> {
    let lacking = todo
        .iter()
        .filter_map(|run| Some((run.name.as_str(), run.mesh.as_ref()?)));
    let unmeshed = meshes::make(lacking, gmsh, &mut |line| progress.print(line))?;
    for (name, reason) in &unmeshed {
        if let Some(run) = todo.iter().find(|run| run.name == *name) {
            record::fail(run, folder, reason)?;
            progress.ends(run, &Status::Failed(reason.clone()), Duration::ZERO);
        }
    }
    Ok(unmeshed)
}

fn write_times(
    out: &mut dyn Write,
    wall: Duration,
    sum: Duration,
    before: usize,
) -> io::Result<()> {
    writeln!(
        out,
        "  time {}, {} of all runs together; {before} were done already",
        seconds(wall),
        seconds(sum)
    )
}

fn tell_problems(problems: &[String]) -> io::Result<()> {
    let mut stderr = io::stderr().lock();
    problems
        .iter()
        .try_for_each(|problem| writeln!(stderr, "warning: {}", plain(problem)))
}

/// Writes the tables and plots of runs in one or several folders, each with its list of runs.
fn make_report(
    study: &Study,
    runs: &[Run],
    folders: &[(&StudyFolder, &[Run])],
    to: &StudyFolder,
    out: &mut dyn Write,
) -> anyhow::Result<Vec<String>> {
    let row = |(index, run)| {
        let found = folders.iter().map(|(folder, there): &(_, &[Run])| {
            let run = &there[index];
            (Status::in_folder(run, folder), folder.run(run))
        });
        let better = |best: (Status, PathBuf), it: (Status, PathBuf)| {
            if it.0.rank() > best.0.rank() {
                it
            } else {
                best
            }
        };
        let (status, folder) = found.reduce(better).unwrap_or_default();
        Row {
            run,
            status,
            folder: folder.to_string_lossy().into_owned(),
        }
    };
    let rows: Vec<Row<'_>> = runs.iter().enumerate().map(row).collect();
    report::write(study, runs, &rows, to, out)
}

/// Writes the tables and plots of the completed runs.
fn collect(
    study: &Study,
    path: &Path,
    from: &[PathBuf],
    out: &mut dyn Write,
) -> anyhow::Result<()> {
    let own = [path.to_owned()];
    let paths = if from.is_empty() { &own[..] } else { from };
    let mut folders = Vec::new();
    for path in paths {
        let folder = StudyFolder::at(path);
        if !folder.is_marked() {
            let (folder, marker) = (path.clone(), MARKER);
            return Err(StudyError::NoStudy { folder, marker }.into());
        }
        let runs = plan::runs(study, &folder.meshes())?;
        folders.push((folder, runs));
    }
    let to = StudyFolder::open(path, study)?;
    let runs = plan::runs(study, &to.meshes())?;
    let there: Vec<(&StudyFolder, &[Run])> = folders
        .iter()
        .map(|(folder, runs)| (folder, runs.as_slice()))
        .collect();
    let problems = make_report(study, &runs, &there, &to, out)?;
    tell_problems(&problems)?;
    writeln!(out, "  tables and plots in {}", path.display())?;
    Ok(())
}

/// Lists the runs with their status and estimated memory.
fn list(study: &Study, path: &Path, out: &mut dyn Write) -> anyhow::Result<()> {
    let folder = StudyFolder::at(path);
    let runs = plan::runs(study, &folder.meshes())?;
    let width = runs.len().to_string().len();
    let mut estimates = Estimates::default();
    let mut todo = 0;
    for (index, run) in runs.iter().enumerate() {
        let word = match Status::in_folder(run, &folder) {
            Status::Changed(_) => "changed",
            status => status.word(),
        };
        todo += usize::from(word != "done" || record::should_repeat(run, &folder));
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
    if let Some(bytes) = memory::available() {
        writeln!(out, "memory available: {:.1} GB", bytes as f64 / 1e9)?;
    }
    Ok(writeln!(
        out,
        "{} runs, {todo} to do, in {}",
        runs.len(),
        path.display()
    )?)
}
