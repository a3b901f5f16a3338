//! `ligament check`.

use std::io::Write;
use std::path::PathBuf;
use std::process::ExitCode;

use clap::Args;
use ligament_output::check_file;
use ligament_run::end::End;

use super::argument_parsers::output_folder;
use super::case_args::CaseArgs;
use crate::check::{CheckExtent, FIELDS, Lines, check};
use crate::terminal;

pub(super) const EXAMPLES: &str = "\
Examples:
  ligament check cases/disk/case.toml
  ligament check case.toml --set model.horizon_factor=4
  ligament check case.toml --all           what the points, the correction and the solver are like in detail
  ligament check case.toml --model-only    points and bonds alone, no matrix: for large meshes
  ligament check case.toml --out check     writes check/points.vtu to look at in ParaView";

/// `ligament check`.
#[derive(Debug, Args)]
pub struct CheckArgs {
    /// The case file and changes to it.
    #[command(flatten)]
    pub case: CaseArgs,
    /// Prepare only the points, the bonds and their correction, without the matrix
    #[arg(long)]
    pub model_only: bool,
    /// Predict the first breakage and Young's modulus and Poisson's ratio of the body even where that takes long: above 20000 points,
    /// in a solid above 2000
    #[arg(long, conflicts_with = "model_only")]
    pub patch_test: bool,
    /// Show all lines: groups, correction, energies, solver, patch test and times in detail
    #[arg(long)]
    pub all: bool,
    /// Write horizons, volumes and energy ratios of the points to points.vtu in this folder
    #[arg(short, long, alias = "output", value_parser = output_folder(), value_name = "DIR")]
    pub out: Option<PathBuf>,
    /// Replace points.vtu in the folder of --out if there is one
    #[arg(long)]
    pub force: bool,
}

impl CheckArgs {
    /// Executes the command.
    pub(super) fn execute(self) -> anyhow::Result<ExitCode> {
        if let Some(folder) = &self.out {
            check_file(&folder.join(FIELDS), self.force)?;
        }
        let case = self.case.load()?;
        let extent = match (self.model_only, self.patch_test) {
            (true, _) => CheckExtent::Model,
            (false, false) => CheckExtent::Matrix,
            (false, true) => CheckExtent::PatchTest,
        };
        let lines = match self.all {
            true => Lines::All,
            false => Lines::Main,
        };
        let out = &mut terminal::stdout();
        let Some(reason) = check(&case, extent, self.out.as_deref(), lines, out)? else {
            return Ok(ExitCode::SUCCESS);
        };
        out.flush()?;
        writeln!(terminal::stderr(), "error: no result under load: {reason}")?;
        // A run would end with the same code.
        Ok(ExitCode::from(End::NoResult.exit_code()))
    }
}
