//! `ligament calibrate`.

use std::io;
use std::path::{Path, PathBuf};

use clap::Args;

use super::CaseArgs;
use crate::calibrate::{Request, calibrate};

pub(super) const EXAMPLES: &str = "\
Examples:
  ligament calibrate cases/brazilian-disk/case.toml --key material.tensile_strength --target 598.47e3
  ligament calibrate case.toml --key material.tensile_strength --target 598.47e3 \\
      --set model.horizon_factor=2.5 --set mesh.file=fine.msh
  ligament calibrate plate.toml --key material.young --of modes.3.frequency --target 1200 --within 0.001
  ligament calibrate case.toml --key material.tensile_strength --of peak.reaction --target 2e5 --from 1e6 --to 9e6

The search begins at the value in the case. Names of results are those of summary.json, parts joined by dots.
If the target cannot be met, as where the result jumps over it, the exit code is 1 and the record kept.";

/// `ligament calibrate`.
#[derive(Debug, Args)]
pub struct CalibrateArgs {
    /// The case file and changes to it.
    #[command(flatten)]
    pub case: CaseArgs,
    /// The key whose value is sought, e.g. material.tensile_strength
    #[arg(long, value_name = "KEY")]
    pub key: String,
    /// What the result is to be, in its unit
    #[arg(long, value_name = "VALUE", allow_negative_numbers = true)]
    pub target: f64,
    /// The result, by its name in summary.json
    #[arg(long, value_name = "RESULT", default_value = "first_peak.reaction")]
    pub of: String,
    /// Largest difference from the target, relative to it
    #[arg(long, value_name = "SHARE", default_value_t = 0.01)]
    pub within: f64,
    /// Smallest value of the key [default: none]
    #[arg(long, value_name = "VALUE", allow_negative_numbers = true)]
    pub from: Option<f64>,
    /// Largest value of the key [default: none]
    #[arg(long, value_name = "VALUE", allow_negative_numbers = true)]
    pub to: Option<f64>,
    /// Largest number of runs
    #[arg(long, value_name = "N", default_value_t = 15, value_parser = clap::value_parser!(u32).range(1..))]
    pub max_runs: u32,
    /// Folder for the record and the runs [default: results/NAME-calibration with the name of the case's folder]
    #[arg(long, value_name = "DIR")]
    pub out: Option<PathBuf>,
    /// Replace an earlier calibration in the folder
    #[arg(long)]
    pub force: bool,
}

impl CalibrateArgs {
    /// Does it.
    pub(super) fn execute(self) -> anyhow::Result<()> {
        let name = self.case.load()?.name();
        let default_out = || Path::new("results").join(format!("{name}-calibration"));
        let request = Request {
            case: self.case.file,
            overrides: self.case.overrides,
            threads: self.case.threads,
            key: self.key,
            of: self.of,
            target: self.target,
            within: self.within,
            limits: [self.from, self.to],
            most_runs: self.max_runs as usize,
            out: self.out.unwrap_or_else(default_out),
            force: self.force,
        };
        calibrate(&request, &mut io::stderr(), &mut io::stdout().lock())
    }
}
