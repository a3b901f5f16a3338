//! Results of a run with the record of their inputs, and the status of the run by both.

use std::path::{Path, PathBuf};

use ligament_output::folder::{Kind, ResultFolder, recover, refuse_link, replace_folder};
use ligament_output::summary::SUMMARY_FILE;
use ligament_output::{read_json, rename, replace_file};
use serde::{Deserialize, Serialize};

use super::plan::Run;
use crate::quantities::Quantities;
use crate::run_table::folder::StudyFolder;

/// Folder of results of a run, and file of the record of their inputs.
struct Results {
    folder: PathBuf,
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

    fn are_complete(&self) -> bool {
        self.folder.join(SUMMARY_FILE).is_file()
    }

    fn record(&self) -> Option<Record> {
        read_json(&self.record).ok()
    }

    /// The record, if it has the present inputs of a run.
    fn record_of_inputs(&self, run: &Run) -> Option<Record> {
        self.record().filter(|it| it.inputs == run.inputs.text())
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

/// A run in the folder of its study: its results and, while these are to be replaced, its new results, with their records.
pub(super) struct RecordedRun<'a> {
    run: &'a Run,
    present: Results,
    new: Results,
}

impl<'a> RecordedRun<'a> {
    pub(super) fn in_folder(run: &'a Run, study: &StudyFolder) -> Self {
        Self {
            run,
            present: Results::named(&run.name, study),
            new: Results::named(&format!("{}~new", run.name), study),
        }
    }

    /// Folder of the results.
    pub(super) fn folder(&self) -> &Path {
        &self.present.folder
    }

    /// Folder and record for the next computation, separate ones if the run has results.
    fn next(&self) -> &Results {
        match self.present.are_complete() {
            true => &self.new,
            false => &self.present,
        }
    }

    /// Status of the run.
    pub(super) fn status(&self) -> Status {
        let Self { run, present, new } = self;
        let attempt = match (Quantities::read(&present.folder), present.record()) {
            (Ok(results), Some(record)) if record.inputs == run.inputs.text() => {
                return match results.without_equilibrium() {
                    Some(reason) => Status::Failed(reason),
                    None => Status::Done(results),
                };
            }
            (Ok(_), Some(record)) => {
                let how = run.inputs.difference(&record.inputs);
                let failed = new.record_of_inputs(run).and_then(|it| it.failed);
                return failed.map_or(Status::Changed(how), Status::Failed);
            }
            _ => present.record_of_inputs(run),
        };
        let failed = attempt.and_then(|it| it.failed);
        failed.map_or(Status::Missing, Status::Failed)
    }

    /// Whether the run has results and should be repeated.
    pub(super) fn should_repeat(&self) -> bool {
        self.present.are_complete() && self.new.record_of_inputs(self.run).is_some()
    }

    /// Writes the record of the inputs, with the reason why the run failed, if it did. A run with results is to be repeated then, also by a
    /// later sweep.
    pub(super) fn record(&self, failed: Option<&str>) -> anyhow::Result<()> {
        let record = Record {
            version: env!("CARGO_PKG_VERSION").to_owned(),
            settings: self.run.overrides.clone(),
            inputs: self.run.inputs.text().to_owned(),
            failed: failed.map(str::to_owned),
        };
        let text = serde_json::to_string_pretty(&record)? + "\n";
        Ok(replace_file(&self.next().record, text.as_bytes())?)
    }

    /// Writes the record of the inputs; returns the folder for the results: the run's own, or a separate one while this has earlier
    /// results.
    pub(super) fn begin(&self) -> anyhow::Result<PathBuf> {
        // A link or a foreign file at the path must not be removed.
        refuse_link(self.folder())?;
        let folder = &self.next().folder;
        refuse_link(folder)?;
        ResultFolder::check(folder, true)?;
        self.record(None)?;
        Ok(folder.clone())
    }

    /// Completes a replacement of results that was interrupted by a kill, according to the records.
    pub(super) fn complete_replacement(&self) -> anyhow::Result<()> {
        let Self { present, new, .. } = self;
        if !present.folder.exists() && !new.record.exists() && new.are_complete() {
            rename(&new.folder, &present.folder)?;
        }
        Ok(recover(&present.folder, Kind::RUN)?)
    }

    /// Replaces earlier results and their record by completed new ones, if these were written to a separate folder.
    pub(super) fn complete(&self, written: &Path) -> anyhow::Result<()> {
        let Self { present, new, .. } = self;
        if written == present.folder {
            return Ok(());
        }
        let records = || rename(&new.record, &present.record);
        Ok(replace_folder(
            written,
            &present.folder,
            Kind::RUN,
            records,
        )?)
    }
}
