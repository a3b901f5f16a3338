//! The `ligament` program.

use std::env;
use std::ffi::OsString;
use std::process::ExitCode;

use ligament_cli::program;

fn main() -> ExitCode {
    let arguments: Vec<OsString> = env::args_os().collect();
    // If its own path is unknown, the program starts itself by the name of its call.
    let itself = env::current_exe().map_or_else(
        |_| arguments.iter().take(1).cloned().collect(),
        |it| vec![it.into()],
    );
    program::execute(&arguments, &itself)
}
