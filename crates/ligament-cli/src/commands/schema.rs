//! `ligament schema`.

use std::io::{self, Write};
use std::path::PathBuf;

use clap::Args;
use ligament_case::case::schema;
use ligament_output::write_file;

use super::argument_parsers::output_file;

pub(super) const EXAMPLES: &str = "\
Examples:
  ligament schema --out case.schema.json

With the schema an editor completes the keys of a case file, shows what they mean, and marks wrong ones. In
VS Code (extension Even Better TOML), Helix and Zed (language server taplo) a case takes it by its first line:
  #:schema ./case.schema.json";

/// `ligament schema`.
#[derive(Debug, Args)]
pub struct SchemaArgs {
    /// The file to write [default: standard output]
    #[arg(short, long, alias = "output", value_parser = output_file(), value_name = "FILE.json")]
    pub out: Option<PathBuf>,
    /// Replace the file if there is one
    #[arg(long)]
    pub force: bool,
}

impl SchemaArgs {
    /// Executes the command.
    pub(super) fn execute(self) -> anyhow::Result<()> {
        let text = serde_json::to_string_pretty(&schema())? + "\n";
        match self.out {
            None => Ok(io::stdout().lock().write_all(text.as_bytes())?),
            Some(path) => Ok(write_file(&path, text.as_bytes(), self.force)?),
        }
    }
}
