//! Common parts of the tests of the commands: the program, its messages, and a small case.
#![allow(clippy::unwrap_used, reason = "a failed unwrap fails the test")]

use std::ffi::OsStr;
use std::path::Path;
use std::process::{Command, Output};

/// A bar of 72 cells that is pulled apart in 10 steps; a run takes some 20 ms.
pub(crate) const SMALL_BAR: &str = include_str!("small-bar.toml");

/// Runs the program.
pub(crate) fn ligament<S: AsRef<OsStr>>(arguments: impl IntoIterator<Item = S>) -> Output {
    let program = env!("CARGO_BIN_EXE_ligament");
    Command::new(program).args(arguments).output().unwrap()
}

/// Runs the program in a folder.
pub(crate) fn ligament_in(folder: &Path, arguments: &[&str]) -> Output {
    let mut program = Command::new(env!("CARGO_BIN_EXE_ligament"));
    program
        .current_dir(folder)
        .args(arguments)
        .output()
        .unwrap()
}

/// What was written to standard output or to standard error.
pub(crate) fn text(bytes: &[u8]) -> String {
    String::from_utf8(bytes.to_vec()).unwrap()
}

/// Standard output of the program.
pub(crate) fn stdout(output: &Output) -> String {
    text(&output.stdout)
}

/// Standard error of the program.
pub(crate) fn stderr(output: &Output) -> String {
    text(&output.stderr)
}

/// Fails with the messages of the program unless it succeeded.
pub(crate) fn assert_success(output: &Output) {
    assert_eq!(output.status.code(), Some(0), "{}", stderr(output));
}
