//! Faults around a run: kills, full disks, folders of others, malicious input. Nothing is lost, nothing hangs,
//! and the program gives the reason.
#![cfg(unix)]
#![allow(clippy::unwrap_used, reason = "a failed unwrap fails the test")]
#![allow(clippy::print_stderr, reason = "a test that is not run says so")]

use std::ffi::OsStr;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

use crate::support::{SMALL_BAR, assert_success};

mod disks;
mod folders;
mod inputs;
mod outputs;
mod paths;

/// Settings with which the bar takes some seconds.
const LONG: [&str; 4] = [
    "--set",
    "lattice.cells=[120,60]",
    "--set",
    "fracture.steps=3000",
];

/// A folder with the case `case.toml`.
struct Place {
    folder: tempfile::TempDir,
}

impl Place {
    fn new() -> Self {
        let folder = tempfile::tempdir().unwrap();
        fs::write(folder.path().join("case.toml"), SMALL_BAR).unwrap();
        Self { folder }
    }

    fn path(&self, name: impl AsRef<Path>) -> PathBuf {
        self.folder.path().join(name)
    }

    fn command<S: AsRef<OsStr>>(&self, arguments: impl IntoIterator<Item = S>) -> Command {
        let mut command = Command::new(env!("CARGO_BIN_EXE_ligament"));
        command.args(arguments).current_dir(self.folder.path());
        command
    }

    fn ligament<S: AsRef<OsStr>>(&self, arguments: impl IntoIterator<Item = S>) -> Output {
        self.command(arguments).output().unwrap()
    }

    /// The program under limits of the shell such as `ulimit -v 1000000`.
    fn limited(&self, limits: &str, arguments: &str) -> Output {
        let program = env!("CARGO_BIN_EXE_ligament");
        let script = format!("{limits}; exec {program} {arguments}");
        let mut command = Command::new("sh");
        command
            .args(["-c", &script])
            .current_dir(self.folder.path());
        command.output().unwrap()
    }

    /// Runs the case into `out`.
    fn run(&self) {
        assert_success(&self.ligament(["run", "case.toml", "--out", "out"]));
    }

    /// Names and contents of all files in a folder.
    fn contents(&self, name: &str) -> Vec<(String, Vec<u8>)> {
        let mut files: Vec<(String, Vec<u8>)> = fs::read_dir(self.path(name))
            .unwrap()
            .map(|entry| entry.unwrap().path())
            .filter(|path| path.is_file())
            .map(|path| {
                (
                    path.file_name().unwrap().to_str().unwrap().to_owned(),
                    fs::read(path).unwrap(),
                )
            })
            .filter(|(name, _)| name != ".lock")
            .collect();
        files.sort();
        files
    }
}

fn stderr(output: &Output) -> String {
    String::from_utf8_lossy(&output.stderr).into_owned()
}

fn stdout(output: &Output) -> String {
    String::from_utf8_lossy(&output.stdout).into_owned()
}

/// The program refused with exit status 1 and says so in these words.
fn assert_refused(output: &Output, words: &[&str]) {
    let said = stderr(output);
    assert_eq!(output.status.code(), Some(1), "{:?} {said}", output.status);
    for word in words {
        assert!(said.contains(word), "{word}: {said}");
    }
}
