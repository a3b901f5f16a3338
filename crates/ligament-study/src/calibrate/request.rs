//! What is to be calibrated, and why that may fail.

use std::io;
use std::path::PathBuf;

use ligament_output::summary::Build;
use serde::Serialize;

use crate::quantities::QuantityError;

/// What is to be calibrated; a record keeps what decides about the result.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Request {
    /// The case file.
    pub case: PathBuf,
    /// Changes to it that all runs have, `key=value` each.
    pub overrides: Vec<String>,
    /// Threads to compute with, before those of the case.
    #[serde(skip)]
    pub threads: Option<u32>,
    /// The key whose value is sought.
    pub key: String,
    /// The result that is to meet the target, by its name in the summary.
    pub of: String,
    /// The target, in the unit of the result.
    pub target: f64,
    /// Largest difference from the target, relative to it.
    pub within: f64,
    /// Smallest value of the key.
    pub from: Option<f64>,
    /// Largest value of the key.
    pub to: Option<f64>,
    /// Largest number of runs.
    pub most_runs: usize,
    /// Folder for the record and the runs.
    #[serde(skip)]
    pub out: PathBuf,
    /// Whether an earlier calibration in the folder is replaced; it is continued otherwise.
    #[serde(skip)]
    pub force: bool,
    /// The program, for the record of the runs.
    #[serde(skip)]
    pub build: Build,
}

/// Why a calibration cannot begin or go on.
#[derive(Debug, thiserror::Error)]
pub enum CalibrationError {
    /// The target is zero, which has no relative neighbourhood.
    #[error("--target {0}: a target is a finite number other than 0")]
    NoTarget(f64),
    /// The limits of the key exclude each other.
    #[error("--from {0} is not below --to {1}")]
    EmptyRange(f64, f64),
    /// The case has no number at the key to begin with, or 0, which tells no size.
    #[error(
        "the case has no number other than 0 at `{key}` to begin with: give it one by --set {key}=..., or say between which values to \
         look by --from and --to"
    )]
    NoStart {
        /// The key.
        key: String,
    },
    /// The result is not there.
    #[error("run {run} ({setting}), results in {}", folder.display())]
    NoResult {
        /// Number of the run.
        run: usize,
        /// The value of the key that it ran with.
        setting: String,
        /// Folder of the run.
        folder: PathBuf,
        /// Why.
        source: QuantityError,
    },
    /// No state of a run under load is in equilibrium.
    #[error(
        "run {run} ({setting}), results in {}: {reason}; a range by --from and --to may keep clear of such values", folder.display()
    )]
    NoEquilibrium {
        /// Number of the run.
        run: usize,
        /// The value of the key that it ran with.
        setting: String,
        /// Folder of the run.
        folder: PathBuf,
        /// Why.
        reason: String,
    },
    /// A file of the case cannot be read.
    #[error("cannot read {}", path.display())]
    Unreadable {
        /// The file.
        path: PathBuf,
        /// The system's reason.
        source: io::Error,
    },
    /// The folder has a calibration of something else.
    #[error(
        "the calibration in {} {difference}; --force replaces it, --out takes another folder",
        folder.display()
    )]
    Other {
        /// The folder.
        folder: PathBuf,
        /// In what it differs.
        difference: String,
    },
    /// The search ended without an answer.
    #[error("{0}")]
    NotMet(String),
}

/// What `--set` takes.
pub(super) fn setting(key: &str, value: f64) -> String {
    format!("{key}={value:?}")
}
