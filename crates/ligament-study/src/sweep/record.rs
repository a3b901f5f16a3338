//! Record of a run beside its results, and the status of the run by both.

use std::fs;
use std::path::{Path, PathBuf};

use ligament_output::folder::{Kind, ResultFolder, put_in_place, recover, refuse_link};
use ligament_output::{rename, replace_file};
use serde::{Deserialize, Serialize};

use super::folder::StudyFolder;
use super::plan::Run;
use crate::quantities::Quantities;

/// File that a run writes last.
const SUMMARY: &str = "summary.json";

/// A record of a run, written before it starts and again if it fails.
///
/// Invariant: the record beside an existing summary has the inputs of that summary. New results of a run with a summary are written to a
/// separate folder, with a separate record; both replace the earlier ones while the run has no results. A killed run has no summary.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(super) struct Record {
    /// Version of the program.
    pub(super) version: String,
    /// Settings of the run on the base case.
    pub(super) settings: Vec<String>,
    /// Inputs of the run.
    pub(super) inputs: String,
    /// The reason why the run failed, if it did.
    pub(super) failed: Option<String>,
}

/// Status of a run.
#[derive(Debug, Clone, PartialEq, Default)]
pub(super) enum Status {
    /// The run is done, with these results.
    Done(Quantities),
    /// The last attempt of the run failed, for this reason.
    Failed(String),
    /// The run has no results.
    #[default]
    Missing,
    /// The run has results of other inputs, with a description of the difference.
    Changed(String),
}

impl Status {
    /// The status of a run in a folder.
    pub(super) fn in_folder(run: &Run, folder: &StudyFolder) -> Self {
        let record = Record::read(&folder.record(run));
        let is_current = |it: &Record| it.inputs == run.inputs.text();
        if let (Ok(results), Some(record)) = (Quantities::read(&folder.run(run)), &record) {
            if is_current(record) {
                return match results.without_equilibrium() {
                    Some(reason) => Self::Failed(reason),
                    None => Self::Done(results),
                };
            }
            return match Record::of_new(run, folder).and_then(|it| it.failed) {
                Some(reason) => Self::Failed(reason),
                None => Self::Changed(run.inputs.difference(&record.inputs)),
            };
        }
        match record.filter(is_current).and_then(|it| it.failed) {
            Some(reason) => Self::Failed(reason),
            None => Self::Missing,
        }
    }

    /// Rank of the status: completed runs above failed ones, failed ones above missing ones.
    pub(super) fn rank(&self) -> u8 {
        match self {
            Self::Done(_) => 2,
            Self::Failed(_) => 1,
            Self::Missing | Self::Changed(_) => 0,
        }
    }

    /// Word for the status in tables.
    pub(super) fn word(&self) -> &'static str {
        match self {
            Self::Done(_) => "done",
            Self::Failed(_) => "failed",
            Self::Missing | Self::Changed(_) => "missing",
        }
    }
}

impl Record {
    fn for_run(run: &Run) -> Self {
        Self {
            version: env!("CARGO_PKG_VERSION").to_owned(),
            settings: run.overrides.clone(),
            inputs: run.inputs.text().to_owned(),
            failed: None,
        }
    }

    /// The record of new results that are to replace earlier ones, if it has the present inputs.
    fn of_new(run: &Run, folder: &StudyFolder) -> Option<Self> {
        let record = Self::read(&folder.new_record(run));
        record.filter(|it| it.inputs == run.inputs.text())
    }

    fn read(path: &Path) -> Option<Self> {
        serde_json::from_str(&fs::read_to_string(path).ok()?).ok()
    }

    fn write(&self, path: &Path) -> anyhow::Result<()> {
        let text = serde_json::to_string_pretty(self)? + "\n";
        Ok(replace_file(path, text.as_bytes())?)
    }
}

fn has_summary(run: &Run, folder: &StudyFolder) -> bool {
    folder.run(run).join(SUMMARY).is_file()
}

/// File of the record of the next computation, separate from the record of existing results.
fn record_of_now(run: &Run, folder: &StudyFolder) -> PathBuf {
    match has_summary(run, folder) {
        true => folder.new_record(run),
        false => folder.record(run),
    }
}

/// Records that a run with results should be repeated, also by a later sweep.
pub(super) fn demand(run: &Run, folder: &StudyFolder) -> anyhow::Result<()> {
    Record::for_run(run).write(&record_of_now(run, folder))
}

/// Whether a run with results should be repeated.
pub(super) fn should_repeat(run: &Run, folder: &StudyFolder) -> bool {
    has_summary(run, folder) && Record::of_new(run, folder).is_some()
}

/// Folder for the results of a run: its own, or a separate one while its own has earlier results. Writes the record of the inputs.
pub(super) fn begin(run: &Run, folder: &StudyFolder) -> anyhow::Result<PathBuf> {
    // A link or a foreign file at the path must not be removed.
    refuse_link(&folder.run(run))?;
    let place = match has_summary(run, folder) {
        true => folder.new_run(run),
        false => folder.run(run),
    };
    refuse_link(&place)?;
    ResultFolder::check(&place, true)?;
    demand(run, folder)?;
    Ok(place)
}

/// Completes a replacement of results that was interrupted by a kill, according to the records.
pub(super) fn complete_replacement(run: &Run, folder: &StudyFolder) -> anyhow::Result<()> {
    let (own, new) = (folder.run(run), folder.new_run(run));
    let is_of_new = !folder.new_record(run).exists() && new.join(SUMMARY).is_file();
    if !own.exists() && is_of_new {
        rename(&new, &own)?;
    }
    Ok(recover(&own, Kind::RUN)?)
}

/// Replaces earlier results of a run and their record by completed new ones.
pub(super) fn complete(run: &Run, folder: &StudyFolder, place: &Path) -> anyhow::Result<()> {
    let own = folder.run(run);
    if place == own {
        return Ok(());
    }
    let (new, old) = (folder.new_record(run), folder.record(run));
    Ok(put_in_place(place, &own, Kind::RUN, || rename(&new, &old))?)
}

/// Records the reason why a run failed.
pub(super) fn fail(run: &Run, folder: &StudyFolder, reason: &str) -> anyhow::Result<()> {
    let record = Record {
        failed: Some(reason.to_owned()),
        ..Record::for_run(run)
    };
    record.write(&record_of_now(run, folder))
}
