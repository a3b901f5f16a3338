//! Request for an ensemble.

use std::num::NonZero;
use std::path::{Path, PathBuf};
use std::thread;

use ligament_case::case::CaseFile;
use ligament_run::progress::ProgressMode;
use ligament_run::run::IsStopped;

use crate::run_table::folder::Shard;

/// Request for an ensemble.
pub struct Request<'a> {
    /// The case, with a `fracture.scatter`.
    pub case: &'a CaseFile,
    /// Number of samples.
    pub samples: u64,
    /// Seed of the ensemble.
    pub seed: u64,
    /// Number of displacements at which curves are compared.
    pub points: usize,
    /// Largest of these displacements; by default 1.25 times the largest one of the body without random factors.
    pub displacement: Option<f64>,
    /// Folder of the ensemble.
    pub out: &'a Path,
    /// Whether the user wants to stop; samples that have ended are stored.
    pub is_stopped: IsStopped<'a>,
    /// Task of the request.
    pub task: Task,
}

/// Task of a request.
#[derive(Debug, Clone)]
pub enum Task {
    /// Compute the samples that are missing.
    Run(Settings),
    /// Write the tables and plots of the samples in the folder of the ensemble, or in the folders named here.
    Collect(Vec<PathBuf>),
}

/// Settings for computing samples.
#[derive(Debug, Clone)]
pub struct Settings {
    /// Shard of the samples to compute; None for all.
    pub shard: Option<Shard>,
    /// Largest number of simultaneous samples; by default the number of threads.
    pub jobs: Option<usize>,
    /// Whether stored samples are removed first.
    pub force: bool,
    /// Display of progress.
    pub progress: ProgressMode,
}

impl Request<'_> {
    /// Number of threads of all samples together: as in the case, or as many as there are processors.
    pub(super) fn threads(&self) -> usize {
        let all = thread::available_parallelism().map_or(1, NonZero::get);
        self.case.threads().unwrap_or(all)
    }
}
