//! What several commands take: a case with changes to it, and a position.

use std::path::PathBuf;

use clap::Args;
use ligament_case::case::{CaseError, CaseFile, MOST_THREADS};

/// A case and changes to it.
#[derive(Debug, Args)]
pub struct CaseArgs {
    /// The case file (TOML)
    #[arg(value_name = "CASE.toml")]
    pub file: PathBuf,
    /// Change a setting of the case file, e.g. model.horizon_factor=4 (may be repeated)
    #[arg(long = "set", value_name = "KEY=VALUE")]
    pub overrides: Vec<String>,
    /// Threads to compute with [default: solver.threads of the case, or one per processor]
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=i64::from(MOST_THREADS)))]
    pub threads: Option<u32>,
}

impl CaseArgs {
    /// Reads the case, with the threads of the command line before its own.
    pub(super) fn load(&self) -> Result<CaseFile, CaseError> {
        let mut case = CaseFile::load(&self.file, &self.overrides)?;
        let threads = &mut case.case.solver.threads;
        *threads = self.threads.or(*threads);
        Ok(case)
    }
}

/// A position on the command line, m.
pub(super) fn position(text: &str) -> Result<[f64; 2], String> {
    let number = |text: &str| text.trim().parse::<f64>().ok().filter(|it| it.is_finite());
    let numbers = text
        .split_once(',')
        .and_then(|(x, y)| Some([number(x)?, number(y)?]));
    numbers.ok_or_else(|| "expected X,Y in m, such as 0.01,-0.02".to_owned())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn positions_are_two_numbers() {
        assert_eq!(position("-0.01, 2e-3"), Ok([-0.01, 2e-3]));
        assert_eq!(position("1e-2, -0.5"), Ok([0.01, -0.5]));
        for wrong in ["0.1", "0.01,", "1,2,3", "0.1,nan"] {
            assert!(
                position(wrong).is_err_and(|error| error.contains("X,Y")),
                "{wrong}"
            );
        }
    }
}
