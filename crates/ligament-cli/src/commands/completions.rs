//! `ligament completions`.

use std::io::{self, Write};

use clap::{Args, CommandFactory};
use clap_complete::Shell;

use super::Cli;

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
}

impl CompletionsArgs {
    /// Does it.
    pub(super) fn execute(self) -> anyhow::Result<()> {
        // Generated into memory: clap_complete panics where the pipe is closed early.
        let mut script = Vec::new();
        clap_complete::generate(self.shell, &mut Cli::command(), "ligament", &mut script);
        Ok(io::stdout().lock().write_all(&script)?)
    }
}
