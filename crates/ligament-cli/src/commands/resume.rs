//! `ligament resume`.

use std::path::PathBuf;
use std::process::ExitCode;

use clap::Args;
use ligament_analysis::solver::MOST_THREADS;
use ligament_run::progress::ProgressMode;
use ligament_run::resume::Request;

use super::run::print_report;
use crate::build::BUILD;
use crate::processes;
use crate::stop_signal::StopSignal;

pub(super) const EXAMPLES: &str = "\
Examples:
  ligament resume results/disk
  ligament resume results/disk --set fracture.stop.bonds=400
  ligament resume results/disk --set fracture.steps=[0.1,0.2,0.3,0.4]
  ligament resume results/disk --mesh ~/meshes/disk.msh

--set can only change keys that leave earlier results unchanged: fracture.stop.load_fraction, .displacement, .bonds and .wall_time,
fracture.steps (completed ones must stay, new ones can follow), fracture.max_iterations, output.fields_every,
output.during_breakage, output.checkpoint_every and output.picture.";

/// `ligament resume`.
#[derive(Debug, Args)]
pub struct ResumeArgs {
    /// The folder of the results of the run
    #[arg(value_name = "DIR")]
    pub folder: PathBuf,
    /// The mesh, if it has moved since the run began
    #[arg(long, value_name = "FILE")]
    pub mesh: Option<PathBuf>,
    /// Change when the run stops, or what it writes from now on, e.g. fracture.stop.bonds=400 (may be repeated)
    #[arg(long = "set", value_name = "KEY=VALUE")]
    pub settings: Vec<String>,
    /// Threads to compute with [default: as when the run began]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=i64::from(MOST_THREADS)))]
    pub threads: Option<u32>,
    /// Show no progress, only the final result and errors
    #[arg(long, short)]
    pub quiet: bool,
}

impl ResumeArgs {
    /// Executes the command.
    pub(super) fn execute(self) -> anyhow::Result<ExitCode> {
        let stop = StopSignal::install()?;
        let request = Request {
            folder: &self.folder,
            mesh: self.mesh.as_deref(),
            settings: &self.settings,
            threads: self.threads,
            build: BUILD,
            is_stopped: &|| stop.is_received(),
            communicator: processes::join()?,
        };
        let report = request.resume(ProgressMode::detect(self.quiet))?;
        print_report(&report, &self.folder, false)
    }
}
