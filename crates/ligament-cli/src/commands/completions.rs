//! `ligament completions`.

use std::io::{self, Write};
use std::path::PathBuf;

use clap::{Args, Command};
use clap_complete::Shell;
use ligament_output::write_file;

use super::argument_parsers::output_file;

pub(super) const EXAMPLES: &str = "\
Examples:
  ligament completions bash > ~/.local/share/bash-completion/completions/ligament
  ligament completions zsh > ~/.zfunc/_ligament
  ligament completions fish > ~/.config/fish/completions/ligament.fish";

/// `ligament completions`.
#[derive(Debug, Args)]
pub struct CompletionsArgs {
    /// The shell
    #[arg(value_name = "SHELL")]
    pub shell: Shell,
    /// The file to write [default: standard output]
    #[arg(short, long, alias = "output", value_parser = output_file(), value_name = "FILE")]
    pub out: Option<PathBuf>,
    /// Replace the file if there is one
    #[arg(long)]
    pub force: bool,
}

impl CompletionsArgs {
    /// Writes the script for a command and all below it.
    pub(super) fn execute(self, mut program: Command) -> anyhow::Result<()> {
        // Generated into memory: clap_complete panics where the pipe is closed early.
        let mut script = Vec::new();
        clap_complete::generate(self.shell, &mut program, "ligament", &mut script);
        match self.out {
            None => Ok(io::stdout().lock().write_all(&script)?),
            Some(path) => Ok(write_file(&path, &script, self.force)?),
        }
    }
}
