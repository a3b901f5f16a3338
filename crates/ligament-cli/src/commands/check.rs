//! `ligament check`.

use std::path::PathBuf;

use clap::Args;

use super::case_args::CaseArgs;
use crate::check::{Extent, check};
use crate::terminal;

pub(super) const EXAMPLES: &str = "\
Examples:
  ligament check cases/disk/case.toml
  ligament check case.toml --set model.horizon_factor=4
  ligament check case.toml --model-only    points and bonds alone, no matrix: for large meshes
  ligament check case.toml --out check     writes check/points.vtu to look at in ParaView";

/// `ligament check`.
#[derive(Debug, Args)]
pub struct CheckArgs {
    /// The case file and changes to it.
    #[command(flatten)]
    pub case: CaseArgs,
    /// Prepare points, bonds and their correction only, and leave the matrix out
    #[arg(long)]
    pub model_only: bool,
    /// Solve for Young's modulus and Poisson's ratio of the body also where it has more than 20000 points
    #[arg(long, conflicts_with = "model_only")]
    pub patch_test: bool,
    /// Write horizons, volumes and energy ratios of the points to points.vtu in this folder
    #[arg(long, value_name = "DIR")]
    pub out: Option<PathBuf>,
}

impl CheckArgs {
    /// Does it.
    pub(super) fn execute(self) -> anyhow::Result<()> {
        let case = self.case.load()?;
        let extent = match (self.model_only, self.patch_test) {
            (true, _) => Extent::Model,
            (false, false) => Extent::Matrix,
            (false, true) => Extent::PatchTest,
        };
        check(&case, extent, self.out.as_deref(), &mut terminal::stdout())
    }
}
