//! `ligament verify`.

use std::path::PathBuf;

use clap::Args;

use super::output;
use crate::terminal;
use ligament_verify::report::console;
use ligament_verify::table::Extent;
use ligament_verify::{EXPERIMENTS, Request, verify};

pub(super) const EXAMPLES: &str = "\
Examples:
  ligament verify                    everything: results/verification/README.md
  ligament verify disk --fast        one experiment, and of it what the tests run
  ligament verify --list             the experiments

The exit code is 1 if a value that should agree does not.";

/// `ligament verify`.
#[derive(Debug, Args)]
pub struct VerifyArgs {
    /// Experiments to run [default: all]
    #[arg(value_name = "NAME")]
    pub names: Vec<String>,
    /// List the experiments with their sources, and run none
    #[arg(long)]
    pub list: bool,
    /// Run the subset that the tests run
    #[arg(long)]
    pub fast: bool,
    /// Folder for the report
    #[arg(
        long,
        alias = "output", value_parser = output::folder(),
        value_name = "DIR",
        default_value = "results/verification"
    )]
    pub out: PathBuf,
    /// Replace an earlier report in the folder
    #[arg(long)]
    pub force: bool,
}

impl VerifyArgs {
    /// Does it.
    pub(super) fn execute(self) -> anyhow::Result<()> {
        let mut stdout = terminal::stdout();
        if self.list {
            return Ok(console::list(&mut stdout, &EXPERIMENTS)?);
        }
        let extent = match self.fast {
            true => Extent::Fast,
            false => Extent::Full,
        };
        let request = Request {
            names: self.names,
            extent,
            out: self.out,
            force: self.force,
        };
        verify(&request, &mut stdout)
    }
}
