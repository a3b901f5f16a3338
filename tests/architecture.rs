//! How the crates are arranged: which may know which, who may touch files, and what lies where.
#![allow(clippy::unwrap_used)]

use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};
use std::process::Command;

use serde_json::Value;
use verification::repository;

/// Each crate and the crates of this workspace that it depends on.
const ARROWS: [(&str, &[&str]); 6] = [
    ("ligament-mesh", &[]),
    ("ligament-linalg", &[]),
    ("ligament-model", &["ligament-mesh"]),
    ("ligament-analysis", &["ligament-linalg", "ligament-model"]),
    ("ligament-output", &["ligament-analysis"]),
    (
        "ligament",
        &[
            "ligament-analysis",
            "ligament-mesh",
            "ligament-model",
            "ligament-output",
        ],
    ),
];

/// Crates that only the program may use: command line, case files and errors for people.
const OF_THE_PROGRAM: [&str; 12] = [
    "anyhow",
    "clap",
    "clap_complete",
    "indicatif",
    "schemars",
    "serde",
    "serde_derive",
    "serde_json",
    "strsim",
    "toml",
    "toml_edit",
    "ctrlc",
];

/// The one crate whose benchmarks take a whole problem from this package.
const WITH_FIXTURES: &str = "ligament-analysis";

/// What lies at the top of the repository, hidden files and results aside.
const TOP: [&str; 13] = [
    "ARCHITECTURE.md",
    "CHANGELOG.md",
    "CONTRIBUTING.md",
    "Cargo.lock",
    "Cargo.toml",
    "LICENSE-APACHE",
    "LICENSE-MIT",
    "README.md",
    "cases",
    "crates",
    "docs",
    "meshes",
    "tests",
];

/// Lines of a source file that one can still take in.
const LONGEST_FILE: usize = 500;

/// Dependencies of the crates under `crates/`, those for tests apart.
struct Dependencies {
    normal: BTreeMap<String, BTreeSet<String>>,
    of_tests: BTreeMap<String, BTreeSet<String>>,
}

fn dependencies() -> Dependencies {
    let output = Command::new(env!("CARGO"))
        .args([
            "metadata",
            "--format-version",
            "1",
            "--no-deps",
            "--offline",
        ])
        .current_dir(repository())
        .output()
        .unwrap();
    assert!(
        output.status.success(),
        "{}",
        String::from_utf8_lossy(&output.stderr)
    );
    let metadata: Value = serde_json::from_slice(&output.stdout).unwrap();
    let mut found = Dependencies {
        normal: BTreeMap::new(),
        of_tests: BTreeMap::new(),
    };
    for package in metadata["packages"].as_array().unwrap() {
        let name = package["name"].as_str().unwrap();
        if name == env!("CARGO_PKG_NAME") {
            continue;
        }
        for (of, is_wanted) in [
            (
                &mut found.normal,
                (|kind| kind != "dev") as fn(&str) -> bool,
            ),
            (&mut found.of_tests, |kind| kind == "dev"),
        ] {
            let listed = package["dependencies"].as_array().unwrap();
            let names = (listed.iter())
                .filter(|dependency| is_wanted(dependency["kind"].as_str().unwrap_or("normal")))
                .map(|dependency| dependency["name"].as_str().unwrap().to_owned());
            of.insert(name.to_owned(), names.collect());
        }
    }
    found
}

/// Source files under a folder.
fn sources(folder: &Path) -> Vec<PathBuf> {
    let mut found = Vec::new();
    for entry in std::fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.is_dir() {
            found.extend(sources(&path));
        } else if path.extension().is_some_and(|extension| extension == "rs") {
            found.push(path);
        }
    }
    found
}

/// Source files of a crate, with their lines of code (comments left out) and their numbers.
fn code(name: &str) -> Vec<(PathBuf, Vec<(usize, String)>)> {
    let files = sources(&repository().join("crates").join(name).join("src"));
    assert!(!files.is_empty(), "{name} has no sources");
    let lines = |path: &PathBuf| {
        let text = std::fs::read_to_string(path).unwrap();
        let is_code = |(_, line): &(usize, &str)| !line.trim_start().starts_with("//");
        let numbered = text.lines().enumerate().filter(is_code);
        numbered.map(|(k, line)| (k + 1, line.to_owned())).collect()
    };
    files
        .iter()
        .map(|path| (path.clone(), lines(path)))
        .collect()
}

/// The crates are those of the list and depend on each other exactly as it says.
#[test]
fn crates_depend_downwards_only() {
    let Dependencies { normal, of_tests } = dependencies();
    let crates: BTreeSet<&str> = normal.keys().map(String::as_str).collect();
    assert_eq!(crates, ARROWS.iter().map(|(name, _)| *name).collect());
    for (name, allowed) in ARROWS {
        let allowed: BTreeSet<&str> = allowed.iter().copied().collect();
        let used: BTreeSet<&str> = (normal[name].iter().map(String::as_str))
            .filter(|dependency| crates.contains(dependency))
            .collect();
        assert_eq!(used, allowed, "{name}");
        let in_tests = of_tests[name]
            .iter()
            .find(|dependency| crates.contains(dependency.as_str()));
        assert_eq!(
            in_tests, None,
            "{name} knows more of the workspace in its tests"
        );
        let with_fixtures = of_tests[name].contains(env!("CARGO_PKG_NAME"));
        assert_eq!(with_fixtures, name == WITH_FIXTURES, "{name}");
    }
}

/// Case files, the command line and messages to people are the program's business.
#[test]
fn only_the_program_reads_cases_and_talks() {
    let Dependencies { normal, of_tests } = dependencies();
    for (name, used) in &normal {
        let foreign: Vec<&str> = (OF_THE_PROGRAM.iter().copied())
            .filter(|dependency| used.contains(*dependency) || of_tests[name].contains(*dependency))
            .collect();
        if name == "ligament" {
            assert!(foreign.contains(&"clap") && foreign.contains(&"serde"));
        } else {
            assert!(foreign.is_empty(), "{name} depends on {foreign:?}");
        }
    }
}

/// The libraries print nothing; only the writer of results and the program touch files.
#[test]
fn libraries_neither_print_nor_touch_files() {
    let printing = [
        "println!",
        "eprintln!",
        "print!(",
        "eprint!(",
        "dbg!",
        "std::io::stdout",
        "std::io::stderr",
    ];
    let files = ["std::fs", "fs::File", "File::open", "File::create"];
    let mut writers = 0;
    for (name, _) in ARROWS {
        for (path, lines) in code(name) {
            for (number, line) in lines {
                let place = format!("{}:{number}: {}", path.display(), line.trim());
                let touches_files = files.iter().any(|word| line.contains(word));
                writers += usize::from(touches_files);
                let may_write = ["ligament", "ligament-output"].contains(&name);
                assert!(!touches_files || may_write, "{place}");
                assert!(
                    name == "ligament" || !printing.iter().any(|word| line.contains(word)),
                    "{place}"
                );
            }
        }
    }
    assert!(writers > 0, "somebody writes the results");
}

/// No source file is longer than 500 lines; there are no exceptions.
#[test]
fn source_files_are_short() {
    let files = sources(&repository().join("crates"));
    let is_source = |path: &&PathBuf| path.components().any(|part| part.as_os_str() == "src");
    let long: Vec<String> = (files.iter().filter(is_source))
        .map(|path| (path, std::fs::read_to_string(path).unwrap().lines().count()))
        .filter(|(_, lines)| *lines > LONGEST_FILE)
        .map(|(path, lines)| format!("{} has {lines} lines", path.display()))
        .collect();
    assert!(files.len() > 50, "the sources were found");
    assert!(long.is_empty(), "{long:#?}");
}

/// The top of the repository holds what a reader expects and nothing else.
#[test]
fn the_top_of_the_repository_is_tidy() {
    let entries = std::fs::read_dir(repository()).unwrap();
    let found: BTreeSet<String> = entries
        .map(|entry| entry.unwrap().file_name().into_string().unwrap())
        .filter(|name| !name.starts_with('.') && name != "target" && name != "results")
        .collect();
    let expected = TOP.iter().chain(&["tools"]).map(|name| (*name).to_owned());
    assert_eq!(found, expected.collect());
}
