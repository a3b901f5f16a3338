//! The `ligament` program.

use std::io::{self, Write};
use std::process::ExitCode;

use clap::Parser;
use ligament_cli::{Cli, terminal};

fn main() -> ExitCode {
    match Cli::parse().execute() {
        Ok(code) => code,
        Err(error) if is_closed_pipe(&error) => ExitCode::SUCCESS,
        Err(error) => {
            print_error(&error);
            ExitCode::FAILURE
        }
    }
}

/// The error and its causes; a reader that has gone away does not want to hear of them.
fn print_error(error: &anyhow::Error) {
    let mut stderr = terminal::stderr();
    let _ = writeln!(stderr, "error: {error}");
    for cause in error.chain().skip(1) {
        let _ = writeln!(stderr, "  because: {cause}");
    }
}

/// Whether standard output was closed by its reader, as by `ligament inspect ... | head`.
fn is_closed_pipe(error: &anyhow::Error) -> bool {
    error
        .downcast_ref::<io::Error>()
        .is_some_and(|error| error.kind() == io::ErrorKind::BrokenPipe)
}
