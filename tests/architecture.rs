//! How the crates are arranged: which may know which, who may touch files, and what lies where.
#![allow(clippy::unwrap_used)]

use std::collections::{BTreeMap, BTreeSet};
use std::path::{Path, PathBuf};

use verification::repository;

use crate::metadata::metadata;

/// Each crate and the crates of this workspace that it depends on.
pub(crate) const ARROWS: [(&str, &[&str]); 16] = [
    ("ligament-mesh", &[]),
    ("ligament-linalg", &[]),
    ("ligament-model", &["ligament-mesh"]),
    ("ligament-post", &["ligament-mesh", "ligament-model"]),
    ("ligament-analysis", &["ligament-linalg", "ligament-model"]),
    ("ligament-petsc", &["ligament-analysis"]),
    (
        "ligament-output",
        &[
            "ligament-analysis",
            "ligament-mesh",
            "ligament-model",
            "ligament-post",
        ],
    ),
    (
        "ligament",
        &["ligament-analysis", "ligament-mesh", "ligament-model"],
    ),
    (
        "ligament-case",
        &[
            "ligament",
            "ligament-analysis",
            "ligament-mesh",
            "ligament-model",
        ],
    ),
    (
        "ligament-run",
        &[
            "ligament",
            "ligament-analysis",
            "ligament-case",
            "ligament-model",
            "ligament-output",
        ],
    ),
    (
        "ligament-plot",
        &[
            "ligament",
            "ligament-mesh",
            "ligament-model",
            "ligament-output",
            "ligament-post",
        ],
    ),
    (
        "ligament-report",
        &["ligament-model", "ligament-output", "ligament-plot"],
    ),
    (
        "ligament-study",
        &[
            "ligament",
            "ligament-analysis",
            "ligament-case",
            "ligament-mesh",
            "ligament-model",
            "ligament-output",
            "ligament-plot",
            "ligament-post",
            "ligament-run",
        ],
    ),
    (
        "ligament-cli",
        &[
            "ligament",
            "ligament-analysis",
            "ligament-case",
            "ligament-mesh",
            "ligament-model",
            "ligament-output",
            "ligament-petsc",
            "ligament-plot",
            "ligament-post",
            "ligament-report",
            "ligament-run",
            "ligament-study",
        ],
    ),
    (
        "ligament-verify",
        &[
            "ligament",
            "ligament-analysis",
            "ligament-case",
            "ligament-cli",
            "ligament-linalg",
            "ligament-mesh",
            "ligament-model",
            "ligament-output",
            "ligament-plot",
            "ligament-post",
            "ligament-run",
            "ligament-study",
        ],
    ),
    (
        "ligament-python",
        &[
            "ligament",
            "ligament-case",
            "ligament-cli",
            "ligament-mesh",
            "ligament-output",
            "ligament-plot",
            "ligament-report",
            "ligament-run",
            "ligament-study",
        ],
    ),
];

/// Packages that few crates may use, in their tests too: texts of cases and records, the command line, errors for people.
const RESERVED: [(&str, &[&str]); 18] = [
    ("clap", &["ligament-cli", "ligament-verify"]),
    ("clap_complete", &["ligament-cli"]),
    ("indicatif", &["ligament-run", "ligament-study"]),
    (
        "anyhow",
        &[
            "ligament-case",
            "ligament-cli",
            "ligament-python",
            "ligament-run",
            "ligament-study",
            "ligament-verify",
        ],
    ),
    ("numpy", &["ligament-python"]),
    ("pyo3", &["ligament-python"]),
    (
        "schemars",
        &[
            "ligament",
            "ligament-analysis",
            "ligament-case",
            "ligament-model",
            "ligament-output",
        ],
    ),
    (
        "serde",
        &[
            "ligament",
            "ligament-analysis",
            "ligament-case",
            "ligament-linalg",
            "ligament-mesh",
            "ligament-model",
            "ligament-output",
            "ligament-plot",
            "ligament-study",
            "ligament-verify",
        ],
    ),
    ("postcard", &["ligament-analysis"]),
    (
        "serde_json",
        &[
            "ligament-case",
            "ligament-cli",
            "ligament-output",
            "ligament-python",
            "ligament-report",
            "ligament-run",
            "ligament-study",
        ],
    ),
    ("serde_path_to_error", &["ligament-case"]),
    (
        "toml",
        &[
            "ligament-case",
            "ligament-cli",
            "ligament-plot",
            "ligament-report",
            "ligament-verify",
        ],
    ),
    ("toml_edit", &["ligament-case", "ligament-study"]),
    ("roxmltree", &["ligament-cli", "ligament-output"]),
    ("csv", &["ligament-output"]),
    ("rustix", &["ligament-run", "ligament-verify"]),
    ("skrifa", &["ligament-plot"]),
    ("tiny-skia", &["ligament-plot"]),
];

/// Crates that know serde and schemars by their feature `case` alone, for types that a case file reads as they are.
const OF_CASES: [&str; 3] = ["ligament", "ligament-analysis", "ligament-model"];

/// Crates that touch files.
const WITH_FILES: [&str; 9] = [
    "ligament-case",
    "ligament-cli",
    "ligament-output",
    "ligament-plot",
    "ligament-python",
    "ligament-report",
    "ligament-run",
    "ligament-study",
    "ligament-verify",
];

/// Crates that write to the terminal.
const TALKING: [&str; 3] = ["ligament-cli", "ligament-run", "ligament-study"];

/// The crate that calls another language.
const CALLS_C: &str = "ligament-petsc";

/// Parts of which no crate holds more than one, so that no room of the house grows over the others.
const PARTS: usize = 4;

/// What lies at the top of the repository, hidden files and results aside.
const TOP: [&str; 16] = [
    "ARCHITECTURE.md",
    "CHANGELOG.md",
    "CITATION.cff",
    "CONTRIBUTING.md",
    "Cargo.lock",
    "Cargo.toml",
    "LICENSE-APACHE",
    "LICENSE-MIT",
    "README.md",
    "cases",
    "codemeta.json",
    "crates",
    "deny.toml",
    "docs",
    "meshes",
    "tests",
];

/// Packages of tests and benchmarks, which may depend on any crate.
const OF_TESTS: [&str; 2] = [env!("CARGO_PKG_NAME"), "benchmarks"];

/// Lines of a source file that one can still take in.
const LONGEST_FILE: usize = 900;

/// Dependencies of the crates under `crates/`, those for tests apart.
struct Dependencies {
    normal: BTreeMap<String, BTreeSet<String>>,
    of_tests: BTreeMap<String, BTreeSet<String>>,
}

fn dependencies() -> Dependencies {
    let metadata = metadata(&["--no-deps"]);
    let mut found = Dependencies {
        normal: BTreeMap::new(),
        of_tests: BTreeMap::new(),
    };
    for package in metadata["packages"].as_array().unwrap() {
        let name = package["name"].as_str().unwrap();
        if OF_TESTS.contains(&name) {
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
pub(crate) fn sources(folder: &Path) -> Vec<PathBuf> {
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
        assert!(
            !of_tests[name].contains(env!("CARGO_PKG_NAME")),
            "{name} looks up to the fixtures of the verification"
        );
    }
}

/// The formats of cases, the command line and words for people stay with those whose business they are.
#[test]
fn packages_are_used_where_they_belong() {
    let Dependencies { normal, of_tests } = dependencies();
    for (package, allowed) in RESERVED {
        let uses = |name: &&String| {
            [&normal, &of_tests]
                .iter()
                .any(|of| of[*name].contains(package))
        };
        let users: Vec<&str> = normal.keys().filter(uses).map(String::as_str).collect();
        assert_eq!(users, allowed, "{package}");
    }
}

/// What computes reads no case files: what describes its types to them is optional, and off where nobody asks for it. `tools/packages` compiles it without.
#[test]
fn what_computes_knows_case_files_by_a_feature_alone() {
    let metadata = metadata(&["--no-deps"]);
    let mut found = BTreeSet::new();
    for package in metadata["packages"].as_array().unwrap() {
        let name = package["name"].as_str().unwrap();
        let Some(&name) = OF_CASES.iter().find(|it| **it == name) else {
            continue;
        };
        assert!(package["features"]["default"].is_null(), "{name}");
        for dependency in package["dependencies"].as_array().unwrap() {
            if dependency["name"] == "schemars" {
                assert_eq!(dependency["optional"], true, "{name}");
                found.insert(name);
            }
        }
    }
    assert_eq!(found, BTreeSet::from(OF_CASES));
}

/// The libraries print nothing; what computes touches no files.
#[test]
fn libraries_neither_print_nor_touch_files() {
    let printing = [
        "println!",
        "eprintln!",
        "print!(",
        "eprint!(",
        "dbg!",
        "io::stdout",
        "io::stderr",
    ];
    let files = ["std::fs", "fs::File", "File::open", "File::create"];
    // A user may name standard output as the file that is to be written: opened a second time it would be overwritten by itself.
    let names_files = Path::new("ligament-output/src/single_file.rs");
    for (name, _) in ARROWS {
        let (mut prints, mut touches) = (Vec::new(), Vec::new());
        for (path, lines) in code(name) {
            for (number, line) in lines {
                let has = |words: &[&str]| words.iter().any(|word| line.contains(word));
                let place = || format!("{}:{number}: {}", path.display(), line.trim());
                prints.extend((has(&printing) && !path.ends_with(names_files)).then(place));
                touches.extend(has(&files).then(place));
            }
        }
        assert_eq!(
            TALKING.contains(&name),
            !prints.is_empty(),
            "{name} {prints:#?}"
        );
        assert_eq!(
            WITH_FILES.contains(&name),
            !touches.is_empty(),
            "{name} {touches:#?}"
        );
    }
}

/// One file calls another language. All crates but its own forbid unsafe code by the lints of the workspace.
#[test]
fn unsafe_code_stands_in_one_file() {
    let mut found = BTreeSet::new();
    for (name, _) in ARROWS {
        for (path, lines) in code(name) {
            let words = |line: &str| line.replace("unsafe_code", "");
            let is_unsafe = |(_, line): &(usize, String)| words(line).contains("unsafe");
            if lines.iter().any(is_unsafe) {
                found.insert(path);
            }
        }
        let manifest = repository().join("crates").join(name).join("Cargo.toml");
        let manifest = std::fs::read_to_string(manifest).unwrap();
        let of_workspace = manifest.contains("[lints]\nworkspace = true");
        assert_eq!(
            of_workspace,
            name != CALLS_C,
            "{name} keeps the lints of the workspace"
        );
    }
    let allowed = repository()
        .join("crates")
        .join(CALLS_C)
        .join("src/native.rs");
    assert_eq!(found, BTreeSet::from([allowed]));
}

/// No crate holds more than a quarter of the source lines.
#[test]
fn no_crate_outgrows_the_others() {
    let lines = |path: &PathBuf| std::fs::read_to_string(path).unwrap().lines().count();
    let of_crate = |name: &str| {
        let files = sources(&repository().join("crates").join(name).join("src"));
        files.iter().map(lines).sum::<usize>()
    };
    let sizes = ARROWS.map(|(name, _)| (name, of_crate(name)));
    let whole: usize = sizes.iter().map(|(_, lines)| lines).sum();
    for (name, lines) in sizes {
        assert!(
            PARTS * lines <= whole,
            "{name} holds {lines} of {whole} lines"
        );
    }
}

/// No source file is longer than 900 lines: a stage can be read in one place, and a longer file has several reasons to change.
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
