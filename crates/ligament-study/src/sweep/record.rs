//! Results of a run with the record of their inputs, and the status of the run by both.

use std::path::{Path, PathBuf};

use ligament_output::folder::{Kind, ResultFolder, put_in_place, recover, refuse_link};
use ligament_output::summary::SUMMARY;
use ligament_output::{read_json, rename, replace_file};
use serde::{Deserialize, Serialize};

use super::plan::Run;
use crate::quantities::Quantities;
use crate::run_table::folder::StudyFolder;

/// Folder of results of a run, and file of the record of their inputs.
pub(super) struct Results {
    pub(super) folder: PathBuf,
    record: PathBuf,
}

impl Results {
    fn named(name: &str, study: &StudyFolder) -> Self {
        let path = study.path();
        Self {
            folder: path.join("runs").join(name),
            record: path.join("records").join(format!("{name}.json")),
        }
    }

    /// The present results of a run.
    pub(super) fn of(run: &Run, study: &StudyFolder) -> Self {
        Self::named(&run.name, study)
    }

    /// The new results of a run that has earlier ones.
    fn new_of(run: &Run, study: &StudyFolder) -> Self {
        Self::named(&format!("{}~new", run.name), study)
    }

    /// The results of the next computation of a run: apart from results that it has.
    fn next_of(run: &Run, study: &StudyFolder) -> Self {
        let present = Self::of(run, study);
        match present.are_complete() {
            true => Self::new_of(run, study),
            false => present,
        }
    }

    fn are_complete(&self) -> bool {
        self.folder.join(SUMMARY).is_file()
    }

    fn record(&self) -> Option<Record> {
        read_json(&self.record).ok()
    }

    /// The record, if it has the present inputs of a run.
    fn record_of_inputs(&self, run: &Run) -> Option<Record> {
        self.record().filter(|it| it.inputs == run.inputs.text())
    }

    /// Writes the record of the present inputs of a run, and the reason why it failed, if it did.
    fn write_record(&self, run: &Run, failed: Option<&str>) -> anyhow::Result<()> {
        let record = Record {
            version: env!("CARGO_PKG_VERSION").to_owned(),
            settings: run.overrides.clone(),
            inputs: run.inputs.text().to_owned(),
            failed: failed.map(str::to_owned),
        };
        let text = serde_json::to_string_pretty(&record)? + "\n";
        Ok(replace_file(&self.record, text.as_bytes())?)
    }
}

/// A record of a run, written before it starts and again if it fails.
///
/// Invariant: the record beside an existing summary has the inputs of that summary. New results of a run with a summary are written to a
/// separate folder, with a separate record; both replace the earlier ones while the run has no results. A killed run has no summary.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
struct Record {
    /// Version of the program.
    version: String,
    /// Settings of the run on the base case.
    settings: Vec<String>,
    /// Inputs of the run.
    inputs: String,
    /// The reason why the run failed, if it did.
    failed: Option<String>,
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
    /// The status of a run in the folder of its study.
    pub(super) fn in_folder(run: &Run, study: &StudyFolder) -> Self {
        let present = Results::of(run, study);
        let attempt = match (Quantities::read(&present.folder), present.record()) {
            (Ok(results), Some(record)) if record.inputs == run.inputs.text() => {
                return match results.without_equilibrium() {
                    Some(reason) => Self::Failed(reason),
                    None => Self::Done(results),
                };
            }
            (Ok(_), Some(record)) => {
                let new = Results::new_of(run, study).record_of_inputs(run);
                let how = run.inputs.difference(&record.inputs);
                return new
                    .and_then(|it| it.failed)
                    .map_or(Self::Changed(how), Self::Failed);
            }
            _ => present.record_of_inputs(run),
        };
        attempt
            .and_then(|it| it.failed)
            .map_or(Self::Missing, Self::Failed)
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
        ["missing", "failed", "done"][usize::from(self.rank())]
    }
}

/// Records that a run with results should be repeated, also by a later sweep.
pub(super) fn demand(run: &Run, study: &StudyFolder) -> anyhow::Result<()> {
    Results::next_of(run, study).write_record(run, None)
}

/// Records the reason why a run failed.
pub(super) fn fail(run: &Run, study: &StudyFolder, reason: &str) -> anyhow::Result<()> {
    Results::next_of(run, study).write_record(run, Some(reason))
}

/// Whether a run with results should be repeated.
pub(super) fn should_repeat(run: &Run, study: &StudyFolder) -> bool {
    let new = Results::new_of(run, study);
    Results::of(run, study).are_complete() && new.record_of_inputs(run).is_some()
}

/// Folder for the results of a run: its own, or a separate one while its own has earlier results. Writes the record of the inputs.
pub(super) fn begin(run: &Run, study: &StudyFolder) -> anyhow::Result<PathBuf> {
    // A link or a foreign file at the path must not be removed.
    refuse_link(&Results::of(run, study).folder)?;
    let next = Results::next_of(run, study);
    refuse_link(&next.folder)?;
    ResultFolder::check(&next.folder, true)?;
    next.write_record(run, None)?;
    Ok(next.folder)
}

/// Completes a replacement of results that was interrupted by a kill, according to the records.
pub(super) fn complete_replacement(run: &Run, study: &StudyFolder) -> anyhow::Result<()> {
    let (present, new) = (Results::of(run, study), Results::new_of(run, study));
    if !present.folder.exists() && !new.record.exists() && new.are_complete() {
        rename(&new.folder, &present.folder)?;
    }
    Ok(recover(&present.folder, Kind::RUN)?)
}

/// Replaces earlier results of a run and their record by completed new ones, if they were written apart.
pub(super) fn complete(run: &Run, study: &StudyFolder, written: &Path) -> anyhow::Result<()> {
    let (present, new) = (Results::of(run, study), Results::new_of(run, study));
    if written == present.folder {
        return Ok(());
    }
    let records = || rename(&new.record, &present.record);
    Ok(put_in_place(written, &present.folder, Kind::RUN, records)?)
}
