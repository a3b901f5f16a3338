//! The program as a whole: from its arguments to its exit code.

use std::ffi::OsString;
use std::io::{self, Write};
use std::process::ExitCode;

use clap::Parser;
use ligament_run::end::StoppedBeforeSolution;

use crate::stop_signal::report_large_files;
use crate::{Cli, processes, terminal};

/// Does what the arguments ask for, the name of the program first, and gives the exit code; `program` is the command that calls
/// this program, for runs that it starts as processes of their own.
pub fn execute(arguments: &[OsString], program: &[OsString]) -> ExitCode {
    parse_and_execute(arguments, |cli: Cli| cli.execute(program))
}

/// Reads the arguments of a program, its name first, does what they ask for, prints the error where that fails, and gives the exit code.
pub fn parse_and_execute<A: Parser>(
    arguments: &[OsString],
    execute: impl FnOnce(A) -> anyhow::Result<ExitCode>,
) -> ExitCode {
    // Where the system refuses, a file that is too large ends the program as it would without this.
    let _ = report_large_files();
    let code = match A::try_parse_from(arguments) {
        Ok(read) => conclude(execute(read)),
        Err(told) => {
            // Help and versions are told as errors, too.
            let _ = told.print();
            u8::try_from(told.exit_code()).map_or(ExitCode::FAILURE, ExitCode::from)
        }
    };
    // Where the program is a part of another one nobody else writes what is left of a line.
    let _ = io::stdout().flush();
    code
}

/// The exit code of what was done, or failed: that is printed.
fn conclude(done: anyhow::Result<ExitCode>) -> ExitCode {
    let (code, error) = match done {
        Ok(code) => (code, None),
        Err(error) if is_closed_pipe(&error) => (ExitCode::SUCCESS, None),
        Err(error) => (code_of(&error), Some(error)),
    };
    // What all processes meet the first one tells of.
    if let Some(error) = error.as_ref().filter(|_| !processes::is_not_root()) {
        print_error(error);
    }
    let all_came = processes::part(error.is_some());
    if let Some(error) = error
        .as_ref()
        .filter(|_| processes::is_not_root() && !all_came)
    {
        print_error(error);
    }
    if !all_came {
        processes::abort();
    }
    code
}

/// The exit code of an error: a run that a signal stopped ends alike whether or not it had begun.
fn code_of(error: &anyhow::Error) -> ExitCode {
    let stopped = error.downcast_ref::<StoppedBeforeSolution>();
    stopped.map_or(ExitCode::FAILURE, |it| it.exit_code().into())
}

/// The error and its causes; a reader that has gone away does not want to hear of them.
fn print_error(error: &anyhow::Error) {
    let mut stderr = terminal::stderr();
    let _ = writeln!(stderr, "error: {error}");
    for cause in error.chain().skip(1) {
        let _ = writeln!(stderr, "  because: {cause}");
    }
}

/// Whether standard output, or a pipe in the place of a file, was closed by its reader, as by `ligament inspect ... | head`.
fn is_closed_pipe(error: &anyhow::Error) -> bool {
    let mut causes = error.chain().filter_map(|it| it.downcast_ref());
    causes.any(|it: &io::Error| it.kind() == io::ErrorKind::BrokenPipe)
}
