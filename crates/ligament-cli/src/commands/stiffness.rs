//! `ligament stiffness`.

use std::path::{Path, PathBuf};

use clap::Args;
use ligament_study::bond_stiffness::{Request, bond_stiffness};

use super::argument_parsers::output_folder;
use super::case_args::CaseArgs;
use crate::terminal;

pub(super) const EXAMPLES: &str = "\
Examples:
  ligament stiffness case.toml                                  results/NAME-stiffness
  ligament stiffness case.toml --set material.angle=0.7854      with the axes turned
  ligament stiffness case.toml --set model.poisson=bonds        where k_t may be negative";

/// `ligament stiffness`.
#[derive(Debug, Args)]
pub struct StiffnessArgs {
    /// The case.
    #[command(flatten)]
    pub case: CaseArgs,
    /// Length of the bonds over their horizon, on which k_theta depends (and k_t of laws in the form of a beam)
    #[arg(long, value_name = "SHARE", default_value_t = 0.5)]
    pub length: f64,
    /// Folder for the results [default: results/NAME-stiffness with the name of the case's folder]
    #[arg(short, long, alias = "output", value_parser = output_folder(), value_name = "DIR")]
    pub out: Option<PathBuf>,
    /// Replace earlier results in the folder
    #[arg(long)]
    pub force: bool,
}

impl StiffnessArgs {
    /// Executes the command.
    pub(super) fn execute(self) -> anyhow::Result<()> {
        let case = Box::new(self.case.load()?);
        let default_out = || Path::new("results").join(format!("{}-stiffness", case.name()));
        let out = self.out.unwrap_or_else(default_out);
        let request = Request {
            case,
            length: self.length,
            out,
            force: self.force,
        };
        bond_stiffness(&request, &mut terminal::stdout())
    }
}
