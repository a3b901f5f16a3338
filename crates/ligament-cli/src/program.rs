//! The program, from its arguments to its exit code.

use std::ffi::OsString;
use std::io::{self, Write};
use std::process::ExitCode;

use clap::Parser;
use ligament_output::remedy::{Terms, causes};
use ligament_run::end::StoppedBeforeSolution;

use crate::stop_signal::report_large_files;
use crate::{Cli, processes, terminal};

/// Executes the program with its arguments, its name first, and returns the exit code; `program` is the command that calls this program,
/// for runs as separate processes.
pub fn execute(arguments: &[OsString], program: &[OsString]) -> ExitCode {
    parse_and_execute(arguments, |cli: Cli| cli.execute(program))
}

/// Parses the arguments of a program, its name first, calls `execute`, prints its error, if any, and returns the exit code.
pub fn parse_and_execute<A: Parser>(
    arguments: &[OsString],
    execute: impl FnOnce(A) -> anyhow::Result<ExitCode>,
) -> ExitCode {
    // If this fails, a file beyond the size limit ends the program by a signal, as by default.
    let _ = report_large_files();
    let code = match A::try_parse_from(arguments) {
        Ok(read) => conclude(execute(read)),
        Err(usage_error) => {
            // Help and versions are returned as errors, too.
            let _ = usage_error.print();
            u8::try_from(usage_error.exit_code()).map_or(ExitCode::FAILURE, ExitCode::from)
        }
    };
    // An unfinished line would not be flushed otherwise if this is part of another program.
    let _ = io::stdout().flush();
    code
}

/// The exit code of a command; prints its error, if any.
fn conclude(done: anyhow::Result<ExitCode>) -> ExitCode {
    let (code, error) = match done {
        Ok(code) => (code, None),
        Err(error) if is_closed_pipe(&error) => (ExitCode::SUCCESS, None),
        Err(error) => (code_of(&error), Some(error)),
    };
    // Errors of all processes are printed by rank 0.
    if let Some(error) = error.as_ref().filter(|_| !processes::is_not_root()) {
        print_error(error);
    }
    let all_finished = processes::finish(error.is_some());
    if let Some(error) = error
        .as_ref()
        .filter(|_| processes::is_not_root() && !all_finished)
    {
        print_error(error);
    }
    if !all_finished {
        processes::abort();
    }
    code
}

/// The exit code of an error; a run that a signal stopped has the same code before and after its start.
fn code_of(error: &anyhow::Error) -> ExitCode {
    let stopped = error.downcast_ref::<StoppedBeforeSolution>();
    stopped.map_or(ExitCode::FAILURE, |it| it.exit_code().into())
}

/// Options that remedies name.
const TERMS: Terms = Terms {
    elsewhere: " with --out",
    replace: " with --force",
    setting: |key, value| format!("--set {key}={value}"),
    option: |name, value| format!("--{name} {value}").trim_end().to_owned(),
};

/// Prints the error and its causes; failures of the output are ignored.
fn print_error(error: &anyhow::Error) {
    let mut stderr = terminal::stderr();
    let mut before = "error";
    for cause in causes(error.chain(), &TERMS) {
        let _ = writeln!(stderr, "{before}: {cause}");
        before = "  because";
    }
}

/// Whether the error comes from standard output or another pipe that its reader closed, as in `ligament inspect ... | head`.
fn is_closed_pipe(error: &anyhow::Error) -> bool {
    let mut causes = error.chain().filter_map(|it| it.downcast_ref());
    causes.any(|it: &io::Error| it.kind() == io::ErrorKind::BrokenPipe)
}
