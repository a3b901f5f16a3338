//! The program `ligament-verify`.

use std::env;
use std::ffi::OsString;
use std::process::ExitCode;

use ligament_cli::{program, terminal};
use ligament_verify::{Request, verify};

fn main() -> ExitCode {
    let arguments: Vec<OsString> = env::args_os().collect();
    program::parse_and_execute(&arguments, |request: Request| {
        verify(&request, &mut terminal::stdout())?;
        Ok(ExitCode::SUCCESS)
    })
}
