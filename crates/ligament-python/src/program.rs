//! The command line, called from Python.

use std::ffi::OsString;
use std::process::ExitCode;

use ligament_cli::program;
use pyo3::prelude::*;

/// Executes the program with its arguments, its name first, and returns the exit code; `itself` is the command that calls it.
#[pyfunction]
pub(crate) fn execute(py: Python<'_>, arguments: Vec<OsString>, itself: Vec<OsString>) -> u8 {
    let ended = py.detach(|| program::execute(&arguments, &itself));
    let mut codes = 0..=u8::MAX;
    codes
        .find(|&code| ExitCode::from(code) == ended)
        .unwrap_or(1)
}
