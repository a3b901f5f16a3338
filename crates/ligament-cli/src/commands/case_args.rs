//! Arguments of several commands: a case with changes to it.

use std::path::PathBuf;

use clap::Args;
use ligament_analysis::solver::MOST_THREADS;
use ligament_case::case::{CaseError, CaseFile, unset};

/// A case and changes to it.
#[derive(Debug, Args)]
pub struct CaseArgs {
    /// The case file (TOML)
    #[arg(value_name = "CASE.toml")]
    pub file: PathBuf,
    /// Change a setting of the case file, e.g. model.horizon_factor=4 (may be repeated)
    #[arg(long = "set", value_name = "KEY=VALUE")]
    pub overrides: Vec<String>,
    /// Take a key out of the case file, e.g. fracture.steps (may be repeated; before any --set)
    #[arg(long = "unset", value_name = "KEY")]
    pub unset: Vec<String>,
    /// Threads to compute with [default: solver.threads of the case, or one per processor]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=i64::from(MOST_THREADS)))]
    pub threads: Option<u32>,
}

impl CaseArgs {
    /// Reads the case; the threads of the command line take precedence over its own.
    pub(super) fn load(&self) -> Result<CaseFile, CaseError> {
        let taken_away = self.unset.iter().map(|key| unset(key));
        let overrides: Vec<String> = taken_away.chain(self.overrides.iter().cloned()).collect();
        let mut case = CaseFile::load(&self.file, &overrides)?;
        let threads = &mut case.case.solver.threads;
        *threads = self.threads.or(*threads);
        Ok(case)
    }
}
