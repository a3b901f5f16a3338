//! Request for a calibration, and its errors.

use std::path::PathBuf;

use ligament_output::summary::Build;
use serde::Serialize;

use crate::quantities::QuantityError;

/// Request for a calibration; fields that determine the result are kept in the record.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Request {
    /// The case file.
    pub case: PathBuf,
    /// Overrides of the case in all runs, `key=value` each.
    pub overrides: Vec<String>,
    /// Number of threads, if other than in the case.
    #[serde(skip)]
    pub threads: Option<u32>,
    /// The key whose value is sought.
    pub key: String,
    /// Name in the summary of the result that should meet the target.
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
    /// Whether an earlier calibration in the folder is replaced, not continued.
    #[serde(skip)]
    pub force: bool,
    /// Build of the program, for the record of the runs.
    #[serde(skip)]
    pub build: Build,
}

/// Error of a calibration.
#[derive(Debug, thiserror::Error)]
pub enum CalibrationError {
    /// The target is zero or not finite, so that relative differences are undefined.
    #[error("--target {0}: a target is a finite number other than 0")]
    NoTarget(f64),
    /// The limits of the key exclude each other.
    #[error("--from {0} is not below --to {1}")]
    EmptyRange(f64, f64),
    /// The case has no start value at the key, or 0, which gives no size.
    #[error(
        "the case has no number other than 0 at `{key}` to start from: give one by --set {key}=..., or a range by --from and --to"
    )]
    NoStart {
        /// Key to be calibrated.
        key: String,
    },
    /// No run of the case has this result.
    #[error("--of {0}: {1}")]
    UnknownResult(String, QuantityError),
    /// No state of a run under load is in equilibrium.
    #[error(
        "run {run} ({setting}), results in {}: {reason}; a range by --from and --to can exclude such values", folder.display()
    )]
    NoEquilibrium {
        /// Number of the run.
        run: usize,
        /// Setting of the key in the run.
        setting: String,
        /// Folder of the run.
        folder: PathBuf,
        /// Reason of the error.
        reason: String,
    },
    /// The folder has another calibration.
    #[error(
        "the calibration in {} {difference}; --force replaces it, --out takes another folder",
        folder.display()
    )]
    Other {
        /// Folder of the other calibration.
        folder: PathBuf,
        /// Description of the difference.
        difference: String,
    },
    /// The search ended without meeting the target.
    #[error("{0}")]
    NotMet(String),
}

/// Argument of `--set` for a key and a value.
pub(super) fn setting(key: &str, value: f64) -> String {
    format!("{key}={value:?}")
}
