//! `ligament completions`.

use std::io::{self, Write};

use clap::{Args, Command};
use clap_complete::Shell;

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
    /// Writes the script for a command and all below it.
    pub(super) fn execute(self, mut program: Command) -> anyhow::Result<()> {
        // Generated into memory: clap_complete panics where the pipe is closed early.
        let mut script = Vec::new();
        clap_complete::generate(self.shell, &mut program, "ligament", &mut script);
        Ok(io::stdout().lock().write_all(&script)?)
    }
}
