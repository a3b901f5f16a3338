//! `ligament repeat`.

use std::path::PathBuf;
use std::process::ExitCode;

use clap::Args;
use ligament_analysis::solver::MOST_THREADS;
use ligament_run::progress::ProgressMode;
use ligament_run::repeat::Request;

use super::argument_parsers::output_folder;
use crate::build::BUILD;
use crate::stop_signal::StopSignal;
use crate::terminal;

pub(super) const EXAMPLES: &str = "\
Examples:
  ligament repeat results/disk
  ligament repeat results/disk --threads 1 --out results/disk-again
  ligament repeat results/disk --mesh ~/meshes/disk.msh

The folder names the case and the mesh. If these have changed since, nothing is run and the message names the change. The exit
code is 0 if all tables, fields and the summary are the same to the last bit, and 5 if not.";

/// Exit code of a repetition whose results differ.
const DIFFERENT: u8 = 5;

/// `ligament repeat`.
#[derive(Debug, Args)]
pub struct RepeatArgs {
    /// The folder of the results of the run
    #[arg(value_name = "DIR")]
    pub folder: PathBuf,
    /// Keep the results of the repetition in this folder [default: DIR.repeat, which stays only if they differ]
    #[arg(short, long, alias = "output", value_parser = output_folder(), value_name = "DIR")]
    pub out: Option<PathBuf>,
    /// The mesh, if it has moved since the run
    #[arg(long, value_name = "FILE")]
    pub mesh: Option<PathBuf>,
    /// Threads to compute with [default: as the run did]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=i64::from(MOST_THREADS)))]
    pub threads: Option<u32>,
    /// Show no progress, only the final result and errors
    #[arg(long, short)]
    pub quiet: bool,
}

impl RepeatArgs {
    /// Executes the command.
    pub(super) fn execute(self) -> anyhow::Result<ExitCode> {
        let stop = StopSignal::install()?;
        let request = Request {
            folder: &self.folder,
            out: self.out.as_deref(),
            mesh: self.mesh.as_deref(),
            threads: self.threads,
            build: BUILD,
            is_stopped: &|| stop.is_received(),
        };
        let repetition = request.repeat(ProgressMode::detect(self.quiet))?;
        repetition.write(&mut terminal::stdout())?;
        Ok(if repetition.is_same() {
            ExitCode::SUCCESS
        } else {
            ExitCode::from(DIFFERENT)
        })
    }
}
