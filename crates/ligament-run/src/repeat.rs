//! Repetition of a run from the record in its result folder, with a bitwise comparison.

use std::ffi::OsString;
use std::fs;
use std::io::{self, Write};
use std::path::{Path, PathBuf};

use anyhow::{Context, ensure};
use ligament_analysis::Termination;
use ligament_case::case::CaseFile;
use ligament_output::folder::{RESOLVED_CASE, ResultFolder};
use ligament_output::results::outputs::require_results;
use ligament_output::results::passes::read_passes;
use ligament_output::summary::{self, Build, Input, Provenance, SUMMARY_FILE, Summary};

use crate::checkpoints::{IsStopped, VERSION};
use crate::comparison::{Comparison, FirstRunEnd};
use crate::inputs::{FileIdentities, are_kept, files, find_moved_files, set_mesh, unreadable_file};
use crate::progress::ProgressMode;
use crate::provenance::provenance;
use crate::refinement::pass;
use crate::run;

/// Suffix of the result folder's name for the folder of a repetition.
const SUFFIX: &str = ".repeat";

/// Request to repeat a run.
pub struct Request<'a> {
    /// Result folder of the run.
    pub folder: &'a Path,
    /// Folder in which the results of the repetition are kept; without one they are written beside the results of the run, and removed if
    /// equal.
    pub out: Option<&'a Path>,
    /// Path of the mesh, where it has moved since the run.
    pub mesh: Option<&'a Path>,
    /// Number of threads, if other than in the case.
    pub threads: Option<u32>,
    /// Build of the repeating program.
    pub build: Build,
    /// Whether the user wants to stop the repetition.
    pub is_stopped: IsStopped<'a>,
}

/// Result of a repetition.
#[derive(Debug)]
pub struct Repetition {
    folder: PathBuf,
    /// Folder of the repetition's results, if kept.
    kept_folder: Option<PathBuf>,
    comparison: Comparison,
    /// Notes on the run for the user.
    notes: Vec<String>,
    /// Differing circumstances of the run: name, earlier value, present value.
    circumstances: Vec<[String; 3]>,
    /// Whether a note may explain differences.
    is_explained: bool,
}

impl Request<'_> {
    /// Repeats the run with its case and mesh and compares all tables, fields and the summary.
    ///
    /// A stopped run is repeated up to the state where it was stopped.
    ///
    /// # Errors
    ///
    /// If the folder has no results of a run that has ended, another process writes to it, an input file has changed, or the run fails.
    pub fn repeat(&self, mode: ProgressMode) -> anyhow::Result<Repetition> {
        let folder = ResultFolder::path_for_reading(self.folder).map_err(folder_in_use_error)?;
        require_results(&folder)?;
        let summary = summary_of(&folder)?;
        let mut case = self.case(&folder)?;
        let mut contents = FileIdentities::default();
        if let Some(record) = &summary.provenance {
            find_moved_files(&mut case, &folder, &|it| {
                record.inputs.iter().any(|input| input.content == *it)
            });
            check_inputs(&folder, record, &case, &mut contents)?;
        }
        let out = self.place(&folder)?;
        let now = provenance(self.build.clone(), &case, &folder, &mut contents)
            .map_err(unreadable_file)?;
        if let Err(error) = self.run_again(&case, &folder, &out, &summary, mode) {
            if self.out.is_none() {
                // The folder did not exist before; a rest that cannot be removed is harmless.
                let _ = fs::remove_dir_all(&out);
            }
            return Err(error);
        }
        let ending = match summary.termination == WALL_TIME {
            true => FirstRunEnd::ByTime,
            false => FirstRunEnd::ByCourse,
        };
        let comparison = Comparison::new(&folder, &out, ending)?;
        let kept_folder = (self.out.is_some() || !comparison.is_same()).then(|| out.clone());
        if kept_folder.is_none() {
            fs::remove_dir_all(&out).with_context(|| format!("cannot remove {}", out.display()))?;
        }
        Ok(Repetition {
            notes: notes(&summary),
            circumstances: circumstances(&summary, &now),
            is_explained: summary.provenance.as_ref().is_none_or(|it| it.resumed),
            folder: self.folder.to_path_buf(),
            kept_folder,
            comparison,
        })
    }

    /// The case of the run, with the requested number of threads.
    fn case(&self, folder: &Path) -> anyhow::Result<CaseFile> {
        let mut case = CaseFile::load(&folder.join(RESOLVED_CASE), &[])?;
        let threads = &mut case.case.solver.threads;
        *threads = self.threads.or(*threads);
        set_mesh(&mut case, self.mesh)?;
        // A repetition has no limit of wall time: it is stopped where the run was.
        if let Some(fracture) = &mut case.case.fracture {
            fracture.stop.wall_time = None;
        }
        if let Some(motion) = &mut case.case.motion {
            motion.stop.wall_time = None;
        }
        Ok(case)
    }

    /// The folder for the results of the repetition, which must not exist yet.
    fn place(&self, folder: &Path) -> anyhow::Result<PathBuf> {
        let place = match self.out {
            Some(out) => out.to_path_buf(),
            None => {
                let name = folder.file_name();
                let mut name: OsString = name.context("the folder has no name: give --out")?.into();
                name.push(SUFFIX);
                folder.with_file_name(name)
            }
        };
        ensure!(
            fs::symlink_metadata(&place).is_err(),
            "{} exists already, perhaps from an earlier repetition: remove it, or choose another folder with --out",
            place.display()
        );
        Ok(place)
    }

    /// Runs the case again, up to the state where the run was stopped, if it was.
    fn run_again(
        &self,
        case: &CaseFile,
        folder: &Path,
        out: &Path,
        summary: &Summary,
        mode: ProgressMode,
    ) -> anyhow::Result<()> {
        let was_cut_short = [Termination::Stopped.name(), WALL_TIME]
            .iter()
            .any(|name| summary.termination == *name);
        let rows = fs::read(folder.join(HISTORY)).unwrap_or_default();
        let written_bytes =
            |folder: &Path| -> u64 { TOLD.iter().map(|name| length_of(&folder.join(name))).sum() };
        let end = written_bytes(folder) + without_last_row(&rows);
        let reached = || written_bytes(out) + length_of(&out.join(HISTORY));
        let is_at_its_end = || was_cut_short && reached() >= end;
        let request = run::Request {
            is_stopped: &|| (self.is_stopped)() || is_at_its_end(),
            keeps_inputs: are_kept(case, folder),
            earlier: read_passes(folder, pass(case))?,
            is_one_pass: true,
            ..run::Request::new(case, out, self.build.clone())
        };
        let report = request
            .run(mode)
            .with_context(|| format!("the run in {} cannot be repeated", folder.display()))?;
        ensure!(
            !report.is_stopped() || is_at_its_end(),
            "stopped: nothing was compared"
        );
        Ok(())
    }
}

/// Name in summaries of the end by a limit of wall time.
const WALL_TIME: &str = "wall-time";

/// Tables that grow with each equilibrium, after which a run can be stopped.
const TOLD: [&str; 2] = ["iterations.csv", "breaks.csv"];

/// Table whose last row describes the state in which a run was stopped, and is written after the stop.
const HISTORY: &str = "history.csv";

/// Length of a table before its last row, bytes.
fn without_last_row(table: &[u8]) -> u64 {
    let rows = table.strip_suffix(b"\n").unwrap_or(table);
    let end = rows.iter().rposition(|it| *it == b'\n');
    end.map_or(0, |it| it as u64 + 1)
}

/// Converts the error of a folder that another process writes to.
fn folder_in_use_error(error: ligament_output::Error) -> anyhow::Error {
    match error {
        ligament_output::Error::Busy { path, .. } => anyhow::anyhow!(
            "{} is in use: a run writes its results there; repeat it when that run has ended",
            path.display()
        ),
        other => other.into(),
    }
}

fn length_of(path: &Path) -> u64 {
    fs::metadata(path).map_or(0, |file| file.len())
}

/// Reads the summary of a run that has ended or was stopped.
fn summary_of(folder: &Path) -> anyhow::Result<Summary> {
    let summary = summary::read(folder)?;
    summary.with_context(|| {
        format!(
            "the run in {0} is incomplete, because it has no {SUMMARY_FILE}; complete it by `ligament resume {0}`",
            folder.display()
        )
    })
}

/// Refuses to repeat a run whose case or files have changed, with their names.
fn check_inputs(
    folder: &Path,
    record: &Provenance,
    case: &CaseFile,
    contents: &mut FileIdentities,
) -> anyhow::Result<()> {
    let now = files(case);
    let mut changed = Vec::new();
    for Input { key, file, content } in &record.inputs {
        let named = |key: &String| now.iter().find(|(other, _)| other == key);
        let (what, path) = match key {
            None => ("the case of the run".to_owned(), folder.join(file)),
            Some(key) => (
                format!("`{key}`"),
                named(key).map_or_else(|| file.clone(), |(_, path)| path.clone()),
            ),
        };
        let found = contents.identity(&path).map_err(|error| {
            let hint = match key.as_deref() {
                Some("mesh.file") => "; if the mesh has moved, give its new place with --mesh",
                _ => "",
            };
            unreadable_file((path.clone(), error)).context(format!("{what} cannot be read{hint}"))
        })?;
        if found != *content {
            let path = path.display();
            changed.push(format!("{what}, {path}: {content} then, {found} now"));
        }
    }
    ensure!(
        changed.is_empty(),
        "the run in {} cannot be repeated, because its inputs have changed: {}",
        folder.display(),
        changed.join("; ")
    );
    Ok(())
}

/// Notes for the user on a run that is compared.
fn notes(summary: &Summary) -> Vec<String> {
    let is_cut_short =
        summary.termination == Termination::Stopped.name() || summary.termination == WALL_TIME;
    let record = summary.provenance.as_ref();
    let all = [
        (
            record.is_none(),
            "the results have no record of commit and inputs, because an earlier version wrote them; the files of the case were taken as \
             they are now",
        ),
        (
            record.is_some_and(|it| it.resumed),
            "the run was resumed: its first part may come from other output settings or another build",
        ),
        (
            summary.without_equilibrium,
            "the run has no equilibrium under load: only the steps up to there were compared",
        ),
        (
            is_cut_short,
            "the run was cut short: only its steps were compared",
        ),
    ];
    let applicable = all.into_iter().filter(|(applies, _)| *applies);
    applicable.map(|(_, note)| note.to_owned()).collect()
}

/// Differing circumstances of the run that may explain a difference: name, earlier value, present value.
fn circumstances(summary: &Summary, now: &Provenance) -> Vec<[String; 3]> {
    let word = |it: Option<&str>| it.unwrap_or("not known").to_owned();
    let then = summary.provenance.as_ref();
    let commit = |of: &Build| match of.uncommitted_changes {
        Some(true) => format!("{} with uncommitted changes", word(of.commit.as_deref())),
        _ => word(of.commit.as_deref()),
    };
    let named = |it: &Provenance| {
        let build = &it.build;
        [
            ("commit", commit(build)),
            ("profile", word(build.profile.as_deref())),
            ("target", word(build.target.as_deref())),
            ("compiler", word(build.compiler.as_deref())),
            ("processor", word(it.processor.as_deref())),
            ("vectors", word(it.vector_instructions.as_deref())),
        ]
    };
    let version = [summary.model.version.to_string(), VERSION.to_owned()];
    let recorded = then
        .into_iter()
        .flat_map(|then| named(then).into_iter().zip(named(now)));
    let recorded = recorded.map(|((what, then), (_, now))| (what, [then, now]));
    let all = [("version", version)].into_iter().chain(recorded);
    all.filter(|(_, [then, now])| then != now)
        .map(|(what, [then, now])| [what.to_owned(), then, now])
        .collect()
}

impl Repetition {
    /// Whether all results are bitwise equal.
    pub fn is_same(&self) -> bool {
        self.comparison.is_same()
    }

    /// Writes the report for the user.
    pub fn write(&self, out: &mut dyn Write) -> io::Result<()> {
        let (folder, compared) = (self.folder.display(), self.comparison.compared);
        let differing = self.comparison.differing.as_slice();
        match differing {
            [] => writeln!(
                out,
                "{folder}: repeated, the same to the last bit in all {compared} files"
            )?,
            [first, rest @ ..] => {
                let count = differing.len();
                writeln!(
                    out,
                    "{folder}: repeated, NOT THE SAME in {count} of {compared} files"
                )?;
                writeln!(out, "  first difference   {first}")?;
                for other in rest.iter().take(SHOWN) {
                    writeln!(out, "  also               {other}")?;
                }
                if rest.len() > SHOWN {
                    writeln!(
                        out,
                        "  also               {} more files",
                        rest.len() - SHOWN
                    )?;
                }
            }
        }
        writeln!(
            out,
            "  not compared       times, memory, threads, checkpoints"
        )?;
        for [what, then, now] in &self.circumstances {
            writeln!(out, "  {what:<18} {then} then, {now} now")?;
        }
        if !self.is_same() && !self.is_explained && self.circumstances.is_empty() {
            let alike = "program and processor are the same: were the results edited? If not, please report this";
            writeln!(out, "  {:<18} {alike}", "explanation")?;
        }
        for note in &self.notes {
            writeln!(out, "  note: {note}")?;
        }
        if let Some(kept_folder) = &self.kept_folder {
            writeln!(out, "  repetition in      {}", kept_folder.display())?;
        }
        Ok(())
    }
}

/// Number of files after the first whose difference is shown.
const SHOWN: usize = 5;
