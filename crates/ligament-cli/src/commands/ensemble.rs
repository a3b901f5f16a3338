//! `ligament ensemble`.

use std::path::{Path, PathBuf};
use std::process::ExitCode;

use clap::Args;
use ligament_run::progress::ProgressMode;
use ligament_study::ensemble::{Request, Settings, Task, ensemble};
use ligament_study::run_table::folder::Shard;

use super::argument_parsers::{output_folder, positive_number};
use super::case_args::CaseArgs;
use super::sweep::shard;
use crate::stop_signal::StopSignal;
use crate::terminal;

pub(super) const EXAMPLES: &str = "\
Examples:
  ligament ensemble cases/random-strength/case.toml --samples 200 --seed 7
  ligament ensemble case.toml --set fracture.scatter.modulus=8 --out results/weaker
  ligament ensemble case.toml --shard 3/16                samples 2, 18, 34, ... on this machine
  ligament ensemble case.toml --collect                   tables and plots of what is done
  ligament ensemble case.toml --collect --from a --from b  of several machines' folders

The case has a [fracture.scatter]; its seed does not matter. Sample k depends on --seed and on k alone, and is the run
  ligament run case.toml --set fracture.scatter.seed=SEED
with the SEED in its row of samples.csv, to the same bits. With two tables [[fracture.scatter]] it is the seed of the
first, fracture.scatter.0.seed.

The same command again computes the samples that are missing; with more --samples it goes on.";

/// Largest number of samples: their numbers and rows are held in memory, some 100 bytes each.
const MOST_SAMPLES: u64 = 10_000_000;

/// `ligament ensemble`.
#[derive(Debug, Args)]
pub struct EnsembleArgs {
    /// The case file and changes to it.
    #[command(flatten)]
    pub case: CaseArgs,
    /// Number of samples
    #[arg(long, value_name = "N", default_value_t = 1000, value_parser = clap::value_parser!(u64).range(1..=MOST_SAMPLES))]
    pub samples: u64,
    /// Seed of the ensemble
    #[arg(long, value_name = "S", default_value_t = 0)]
    pub seed: u64,
    /// Number of displacements at which the curves of the samples are compared
    #[arg(long, value_name = "N", default_value_t = 101, value_parser = clap::value_parser!(u32).range(2..=100_000))]
    pub points: u32,
    /// Largest of these displacements, in the unit of the load [default: 1.25 times the largest of the body without random
    /// factors]
    #[arg(long, value_name = "U", value_parser = displacement)]
    pub to: Option<f64>,
    /// Folder of the ensemble [default: results/NAME-ensemble, with the name of the case file, or of its folder where the file
    /// is case.toml]
    #[arg(short, long, alias = "output", value_parser = output_folder(), value_name = "DIR")]
    pub out: Option<PathBuf>,
    /// Samples at once [default: one for each thread]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..))]
    pub jobs: Option<u32>,
    /// Compute only every N-th sample, from the K-th on: a part of the ensemble for one of several machines
    #[arg(long, value_name = "K/N", value_parser = shard)]
    pub shard: Option<Shard>,
    /// Remove the samples in the folder first
    #[arg(long, conflicts_with = "shard")]
    pub force: bool,
    /// Make the tables and the plots of the stored samples, and compute none
    #[arg(long, conflicts_with_all = ["shard", "force"])]
    pub collect: bool,
    /// With --collect: a folder of the ensemble, such as another machine's (may be repeated) [default: --out]
    #[arg(long, value_name = "DIR", requires = "collect")]
    pub from: Vec<PathBuf>,
    /// Show no progress, only the final result and errors
    #[arg(long, short)]
    pub quiet: bool,
}

impl EnsembleArgs {
    /// Executes the command.
    pub(super) fn execute(self) -> anyhow::Result<ExitCode> {
        let case = self.case.load()?;
        let stop = StopSignal::install()?;
        let usual = || Path::new("results").join(format!("{}-ensemble", case.name()));
        let out = self.out.unwrap_or_else(usual);
        let task = match self.collect {
            true => Task::Collect(self.from),
            false => Task::Run(Settings {
                shard: self.shard,
                jobs: self.jobs.map(|jobs| jobs as usize),
                force: self.force,
                progress: ProgressMode::detect(self.quiet),
            }),
        };
        let request = Request {
            case: &case,
            samples: self.samples,
            seed: self.seed,
            points: self.points as usize,
            displacement: self.to,
            out: &out,
            is_stopped: &|| stop.is_received(),
            task,
        };
        let end = ensemble(&request, &mut terminal::stdout())?;
        Ok(ExitCode::from(end.exit_code()))
    }
}

fn displacement(text: &str) -> Result<f64, String> {
    positive_number(text)
        .ok_or_else(|| "expected a displacement greater than 0, such as 1e-5".to_owned())
}
