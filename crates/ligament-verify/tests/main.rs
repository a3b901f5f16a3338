//! The program as it is called.
#![allow(clippy::unwrap_used, reason = "a failed unwrap fails the test")]

use std::ffi::OsStr;
use std::fs;
use std::process::Command;

/// Runs the program: exit code, standard output, standard error.
fn verify<S: AsRef<OsStr>>(
    arguments: impl IntoIterator<Item = S>,
) -> (Option<i32>, String, String) {
    let mut program = Command::new(env!("CARGO_BIN_EXE_ligament-verify"));
    let output = program.args(arguments).output().unwrap();
    let [stdout, stderr] = [output.stdout, output.stderr].map(|it| String::from_utf8(it).unwrap());
    (output.status.code(), stdout, stderr)
}

#[test]
fn help_and_wrong_usage() {
    let (code, stdout, _) = verify(["--help"]);
    assert_eq!(code, Some(0));
    assert!(stdout.contains("Examples:"), "{stdout}");
    assert_eq!(verify(["--fest"]).0, Some(2));
    let (code, _, stderr) = verify(["poisson", "--out", "-"]);
    assert_eq!(code, Some(2));
    assert!(stderr.contains("name one"), "{stderr}");
}

#[test]
fn its_experiments_are_listed_and_no_others_known() {
    let (code, stdout, _) = verify(["--list"]);
    assert_eq!(code, Some(0));
    assert!(
        stdout
            .lines()
            .any(|line| line.starts_with("disk ") && line.contains("eq. 22"))
    );
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().join("report");
    let (code, _, stderr) = verify(["disc".as_ref(), "--out".as_ref(), out.as_os_str()]);
    assert_eq!(code, Some(1));
    let message = "error: no experiment `disc`; did you mean `disk`?";
    assert!(stderr.starts_with(message), "{stderr}");
    assert!(!out.exists(), "nothing is written");
}

/// A report is written once; an earlier one is replaced only if that is asked for, and results of a run never.
#[test]
fn a_verification_writes_its_report() {
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().join("report");
    let verify = |more: &[&str]| {
        let words = ["poisson", "--fast", "--out"].map(OsStr::new);
        let more = more.iter().map(OsStr::new);
        verify(words.into_iter().chain([out.as_os_str()]).chain(more))
    };
    let (code, stdout, stderr) = verify(&[]);
    assert_eq!(code, Some(0), "{stderr}");
    assert!(stdout.contains("within tolerance"));
    for file in [
        "README.md",
        "verification.csv",
        "poisson-mesh.csv",
        "poisson-mesh.svg",
    ] {
        assert!(out.join(file).is_file(), "{file}");
    }
    let (code, _, stderr) = verify(&[]);
    assert_eq!(code, Some(1));
    assert!(stderr.contains("--force"), "{stderr}");
    assert_eq!(verify(&["--force"]).0, Some(0));
    fs::rename(out.join("verification.csv"), out.join("case.resolved.toml")).unwrap();
    let (code, _, stderr) = verify(&["--force"]);
    assert_eq!(code, Some(1));
    assert!(stderr.contains("no verification.csv"), "{stderr}");
}
