//! `ligament sweep`.

use std::ffi::OsString;
use std::path::PathBuf;

use clap::Args;
use ligament_run::progress::ProgressMode;
use ligament_study::run_table::folder::Shard;
use ligament_study::sweep::{Request, Settings, Task, sweep};

use super::argument_parsers::{output_folder, positive_number};
use crate::terminal;

pub(super) const EXAMPLES: &str = "\
Examples:
  ligament sweep cases/horizon-study/study.toml           all runs, then table and plots
  ligament sweep study.toml --list                        the runs, their memory, what is done
  ligament sweep study.toml --shard 3/16                  runs 3, 19, ... on this machine
  ligament sweep study.toml --collect                     table and plots of what is done
  ligament sweep study.toml --collect --from a --from b   of several machines' folders

A study file names a case, axes and plots:
  case = \"../disk/case.toml\"
  [[axis]]
  key = \"model.horizon_factor\"
  range = { from = 2.0, to = 4.0, step = 0.5 }
  [[plot]]
  x = \"model.horizon_factor\"
  y = \"first_peak.reaction\"

The same command again continues a stopped study, and repeats failed runs.
The exit code is 1 if a run failed.";

/// `ligament sweep`.
#[derive(Debug, Args)]
pub struct SweepArgs {
    /// The study file (TOML)
    #[arg(value_name = "STUDY.toml")]
    pub study: PathBuf,
    /// Folder of the study [default: results/NAME with the name of the study's folder if the file is called study.toml, else
    /// with that of the file]
    #[arg(short, long, alias = "output", value_parser = output_folder(), value_name = "DIR")]
    pub out: Option<PathBuf>,
    /// Execution of the runs.
    #[command(flatten)]
    pub runs: StudyRunsArgs,
}

/// Options of the runs of a study.
#[derive(Debug, Args)]
pub struct StudyRunsArgs {
    /// Runs at once [default: one per processor]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..))]
    pub jobs: Option<u32>,
    /// Memory for the runs in GB [default: what is available]
    #[arg(long, value_name = "GB", value_parser = gigabytes)]
    pub memory: Option<f64>,
    /// Do only every N-th run, from the K-th on: a part of the study for one of several machines
    #[arg(long, value_name = "K/N", value_parser = shard)]
    pub shard: Option<Shard>,
    /// Repeat completed runs as well
    #[arg(long)]
    pub force: bool,
    /// List the runs with the memory they take, and run none
    #[arg(long, conflicts_with_all = ["collect", "shard", "force"], visible_alias = "dry-run")]
    pub list: bool,
    /// Evaluate the completed runs, and run none
    #[arg(long, conflicts_with_all = ["shard", "force"])]
    pub collect: bool,
    /// With --collect: a folder of the study, such as another machine's (may be repeated) [default: --out]
    #[arg(long, value_name = "DIR", requires = "collect")]
    pub from: Vec<PathBuf>,
    /// The gmsh program, for meshes of a geometry, if it is not on the PATH
    #[arg(
        long,
        value_name = "PATH",
        default_value = "gmsh",
        hide_default_value = true
    )]
    pub gmsh: PathBuf,
    /// Show no progress, only the final result and errors
    #[arg(long, short)]
    pub quiet: bool,
}

impl SweepArgs {
    /// Executes the command.
    pub(super) fn execute(self, program: &[OsString]) -> anyhow::Result<()> {
        let request = Request {
            study: self.study,
            out: self.out,
            task: self.runs.task(program),
        };
        sweep(&request, &mut terminal::stdout())
    }
}

impl StudyRunsArgs {
    /// Task for the runs; `program` is the command that calls this program.
    pub(super) fn task(self, program: &[OsString]) -> Task {
        if self.list {
            Task::List
        } else if self.collect {
            Task::Collect(self.from)
        } else {
            Task::Run(Settings {
                shard: self.shard,
                jobs: self.jobs.map(|jobs| jobs as usize),
                memory: self.memory,
                force: self.force,
                gmsh: self.gmsh,
                progress: ProgressMode::detect(self.quiet),
                program: program.to_vec(),
            })
        }
    }
}

fn gigabytes(text: &str) -> Result<f64, String> {
    positive_number(text).ok_or_else(|| "expected GB greater than 0, such as 16".to_owned())
}

pub(super) fn shard(text: &str) -> Result<Shard, String> {
    let numbers = text.split_once('/');
    let numbers = numbers.and_then(|(k, n)| Some((k.parse().ok()?, n.parse().ok()?)));
    match numbers {
        Some((number, count)) if (1..=count).contains(&number) => Ok(Shard { number, count }),
        Some((_, count)) => Err(format!(
            "the shards of {count} are 1/{count} to {count}/{count}"
        )),
        None => Err("expected K/N, such as 3/16".to_owned()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn shards_count_from_one() {
        let (number, count) = (3, 16);
        assert_eq!(shard("3/16"), Ok(Shard { number, count }));
        for wrong in ["0/4", "5/4", "1/0", "3", "a/b", "1/2/3"] {
            assert!(shard(wrong).is_err(), "{wrong}");
        }
        assert!(shard("5/4").is_err_and(|error| error.contains("1/4 to 4/4")));
    }

    #[test]
    fn memory_is_a_positive_number() {
        assert_eq!(gigabytes("1.5"), Ok(1.5));
        for wrong in ["0", "-1", "inf", "nan", "2GB"] {
            assert!(gigabytes(wrong).is_err(), "{wrong}");
        }
    }
}
