//! Finds the origin of the program, for the record of its runs: the commit, the compiler, the profile and the target.
//!
//! Without Git, or outside a checkout, the commit is not known and the program says so.
#![allow(
    clippy::print_stdout,
    reason = "a build script speaks to Cargo through its output"
)]

use std::env;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

fn main() {
    let repository = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    let sources = sources(&repository);
    for path in sources.iter().map(|it| repository.join(it)) {
        watch(&path);
    }
    let of_cargo = |name| env::var(name).unwrap_or_default();
    let commit = git(&repository, &["rev-parse", "HEAD"]);
    let changes = commit.as_ref().and_then(|_| {
        // Where HEAD points to another commit, by a commit or a branch.
        let head = git(&repository, &["symbolic-ref", "--quiet", "HEAD"]);
        let places = ["HEAD", "logs/HEAD", "packed-refs"].map(str::to_owned);
        for place in places.into_iter().chain(head) {
            let path = git(&repository, &["rev-parse", "--git-path", &place]);
            path.map(|path| repository.join(path))
                .filter(|path| path.is_file())
                .inspect(|path| watch(path));
        }
        let mut status = vec!["status", "--porcelain", "--"];
        status.extend(sources.iter().filter_map(|path| path.to_str()));
        git(&repository, &status)
    });
    let (uncommitted, words) = match changes.as_deref() {
        None => ("", ""),
        Some("") => ("false", ""),
        Some(_) => ("true", " with uncommitted changes"),
    };
    let version = of_cargo("CARGO_PKG_VERSION");
    match &commit {
        None => set("VERSION", &version),
        Some(commit) => set("VERSION", &format!("{version}, commit {commit}{words}")),
    }
    set("COMMIT", &commit.unwrap_or_default());
    set("UNCOMMITTED", uncommitted);
    set("PROFILE", &of_cargo("PROFILE"));
    set("TARGET", &of_cargo("TARGET"));
    let compiler = said(Command::new(of_cargo("RUSTC")).arg("--version"));
    set("COMPILER", &compiler.unwrap_or_default());
}

/// All sources of the program, as seen from the repository, without its tests and pages.
fn sources(repository: &Path) -> Vec<PathBuf> {
    let mut found = vec!["Cargo.toml".into(), "Cargo.lock".into()];
    let crates = fs::read_dir(repository.join("crates"));
    let mut names: Vec<_> = crates.into_iter().flatten().flatten().collect();
    names.sort_by_key(fs::DirEntry::file_name);
    for folder in names {
        let folder = Path::new("crates").join(folder.file_name());
        found.extend(["Cargo.toml", "build.rs", "src"].map(|name| folder.join(name)));
    }
    found.retain(|path| repository.join(path).exists());
    found
}

/// Output of Git for the repository, if it is a checkout and not a folder inside another one.
fn git(repository: &Path, arguments: &[&str]) -> Option<String> {
    if !repository.join(".git").exists() {
        return None;
    }
    let mut command = Command::new("git");
    // Variables that a hook of Git sets would point elsewhere.
    for variable in ["GIT_DIR", "GIT_WORK_TREE", "GIT_INDEX_FILE"] {
        command.env_remove(variable);
    }
    let command = command.arg("--no-optional-locks").arg("-C");
    said(command.arg(repository).args(arguments))
}

/// Output of a program; nothing if it failed or does not exist.
fn said(command: &mut Command) -> Option<String> {
    let output = command.output().ok().filter(|it| it.status.success())?;
    let text = String::from_utf8(output.stdout).ok()?;
    Some(text.trim_end().to_owned())
}

fn watch(path: &Path) {
    println!("cargo::rerun-if-changed={}", path.display());
}

fn set(name: &str, value: &str) {
    println!("cargo::rustc-env=LIGAMENT_{name}={value}");
}
