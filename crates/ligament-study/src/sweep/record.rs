//! What is kept of a run beside its results, and what follows from both: whether it is done.

use std::fs;
use std::io;

use ligament_output::folder::ResultFolder;
use ligament_output::replace_file;
use serde::{Deserialize, Serialize};

use super::error::StudyError;
use super::folder::{StudyFolder, file_error};
use super::plan::Run;
use crate::quantities::Quantities;

/// The file that a run writes last.
const SUMMARY: &str = "summary.json";

/// A record of a run, written before it starts and again if it fails.
///
/// At any time: where a summary is there, the record beside it holds the inputs that it was computed from. So an earlier
/// summary is removed before a new record is written, and a run that was killed has no summary.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(super) struct Record {
    /// Version of the program.
    pub(super) version: String,
    /// The settings of the run on top of the base case.
    pub(super) settings: Vec<String>,
    /// Inputs of the run.
    pub(super) inputs: String,
    /// The reason why the run failed, if it did.
    pub(super) failed: Option<String>,
}

/// How far a run is.
#[derive(Debug, Clone, PartialEq, Default)]
pub(super) enum Status {
    /// The run is done, with these results.
    Done(Quantities),
    /// The run failed when it was last tried.
    Failed(String),
    /// The run has no results.
    #[default]
    Missing,
    /// The run has results of other inputs, which differ as the text says.
    Changed(String),
}

impl Status {
    /// The status of a run in a folder.
    pub(super) fn in_folder(run: &Run, folder: &StudyFolder) -> Self {
        let text = fs::read_to_string(folder.record(run)).unwrap_or_default();
        let Ok(record) = serde_json::from_str::<Record>(&text) else {
            return Self::Missing;
        };
        let results = Quantities::read(&folder.run(run));
        if record.inputs != run.inputs.text() {
            return match results {
                Ok(_) => Self::Changed(run.inputs.difference(&record.inputs)),
                Err(_) => Self::Missing,
            };
        }
        match (results, record.failed) {
            (Ok(results), _) => Self::Done(results),
            (Err(_), Some(reason)) => Self::Failed(reason),
            (Err(_), None) => Self::Missing,
        }
    }

    /// A number that is larger the more there is of a run.
    pub(super) fn rank(&self) -> u8 {
        match self {
            Self::Done(_) => 2,
            Self::Failed(_) => 1,
            Self::Missing | Self::Changed(_) => 0,
        }
    }

    /// The word for it in tables.
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

    fn write(&self, run: &Run, folder: &StudyFolder) -> anyhow::Result<()> {
        let text = serde_json::to_string_pretty(self)? + "\n";
        Ok(replace_file(&folder.record(run), text.as_bytes())?)
    }
}

/// Makes room for a run: removes what an earlier one left, its summary first, and notes what is about to be computed.
pub(super) fn begin(run: &Run, folder: &StudyFolder) -> anyhow::Result<()> {
    forget(run, folder)?;
    // A link or a file in its place is not ours to remove; the run itself would refuse as well.
    ResultFolder::check(&folder.run(run), false)?;
    Record::for_run(run).write(run, folder)
}

/// Removes the results of a run, its summary first.
pub(super) fn forget(run: &Run, folder: &StudyFolder) -> Result<(), StudyError> {
    let results = folder.run(run);
    for (path, is_folder) in [(results.join(SUMMARY), false), (results, true)] {
        let removed = if is_folder {
            fs::remove_dir_all(&path)
        } else {
            fs::remove_file(&path)
        };
        match removed {
            Err(error) if error.kind() != io::ErrorKind::NotFound => {
                return Err(file_error("remove", &path, error));
            }
            _ => {}
        }
    }
    Ok(())
}

/// Notes why a run failed.
pub(super) fn fail(run: &Run, folder: &StudyFolder, reason: &str) -> anyhow::Result<()> {
    let record = Record {
        failed: Some(reason.to_owned()),
        ..Record::for_run(run)
    };
    record.write(run, folder)
}
