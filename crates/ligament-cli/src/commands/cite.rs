//! `ligament cite`.

use std::io::Write;
use std::path::PathBuf;

use clap::Args;
use ligament_case::case::CaseFile;

use crate::cite::{cited_references, program};
use crate::terminal;

pub(super) const EXAMPLES: &str = "\
Examples:
  ligament cite                             this program, as BibTeX
  ligament cite case.toml >> thesis.bib     and the papers of the law, the criteria and the corrections
  ligament cite results/disk/case.resolved.toml";

/// `ligament cite`.
#[derive(Debug, Args)]
pub struct CiteArgs {
    /// The case file (TOML), whose papers are to be cited too
    #[arg(value_name = "CASE.toml")]
    pub case: Option<PathBuf>,
}

impl CiteArgs {
    /// Executes the command.
    pub(super) fn execute(self) -> anyhow::Result<()> {
        let mut out = terminal::stdout();
        write!(out, "{}", program())?;
        let Some(path) = self.case else {
            return Ok(());
        };
        let file = CaseFile::load(&path, &[])?;
        for reference in cited_references(&file.case.sources()) {
            write!(out, "\n{}", reference.bibtex())?;
        }
        Ok(())
    }
}
