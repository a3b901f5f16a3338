//! What Cargo compiles and runs of the tests: every file of them, and the code in comments.
#![allow(clippy::unwrap_used, reason = "a failed unwrap fails the test")]

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

use serde_json::Value;
use verification::repository;

use crate::architecture::{ARROWS, sources};
use crate::metadata::metadata;

/// The root files of the targets that are wanted.
fn roots(is_wanted: fn(&Value) -> bool) -> BTreeSet<PathBuf> {
    let metadata = metadata(&["--no-deps"]);
    let packages = metadata["packages"].as_array().unwrap();
    (packages.iter())
        .flat_map(|package| package["targets"].as_array().unwrap())
        .filter(|target| is_wanted(target))
        .map(|target| PathBuf::from(target["src_path"].as_str().unwrap()))
        .collect()
}

/// A file in a folder of tests is the root of a target, or a module that a file above it declares: what nobody declares is not
/// compiled, and its tests would never run.
#[test]
fn every_file_of_tests_belongs_to_a_target() {
    let roots = roots(|_| true);
    let folders = ARROWS.map(|(name, _)| repository().join("crates").join(name).join("tests"));
    let folders = folders.into_iter().chain([repository().join("tests")]);
    let files: Vec<PathBuf> = (folders.filter(|folder| folder.exists()))
        .flat_map(|folder| sources(&folder))
        .collect();
    assert!(files.len() > 100, "the files were found");
    let is_forgotten = |file: &&PathBuf| !roots.contains(*file) && !is_declared(file, &roots);
    let forgotten: Vec<&PathBuf> = files.iter().filter(is_forgotten).collect();
    assert!(forgotten.is_empty(), "no target has {forgotten:#?}");
}

/// Whether the module in a file is declared by `mod.rs` or a root of a target in the folder that holds the module, or by the file that
/// is called like this folder.
fn is_declared(file: &Path, roots: &BTreeSet<PathBuf>) -> bool {
    let folder = file.parent().unwrap();
    let (module, above) = match file.file_stem().unwrap().to_str().unwrap() {
        "mod" => (
            folder.file_name().unwrap().to_str().unwrap(),
            folder.parent().unwrap(),
        ),
        stem => (stem, folder),
    };
    let declaration = format!("mod {module};");
    let declares = |path: &Path| {
        let text = std::fs::read_to_string(path).unwrap_or_default();
        (text.lines()).any(|line| line.trim_start_matches("pub ") == declaration)
    };
    let mut of_folder = roots.iter().filter(|root| root.parent() == Some(above));
    declares(&above.join("mod.rs"))
        || declares(&above.with_extension("rs"))
        || of_folder.any(|root| declares(root))
}

/// A crate with unit tests has them compiled and run; a crate without is not compiled once more for them.
#[test]
fn unit_tests_are_run() {
    let tried = roots(|target| target["test"] == true);
    for (name, _) in ARROWS {
        let folder = repository().join("crates").join(name).join("src");
        let has_tests = sources(&folder).iter().any(|path| {
            let text = std::fs::read_to_string(path).unwrap();
            text.lines().any(|line| line.trim() == "#[test]")
        });
        assert_eq!(
            has_tests,
            tried.contains(&folder.join("lib.rs")),
            "{name}: test in [lib]"
        );
    }
}

/// Comments of documentation that hold code are compiled and run; a crate without code in them is not read for that.
#[test]
fn code_in_comments_is_run() {
    let tried = roots(|target| target["doctest"] == true);
    for (name, _) in ARROWS {
        let folder = repository().join("crates").join(name).join("src");
        let holds_code = sources(&folder).iter().any(|path| {
            let text = std::fs::read_to_string(path).unwrap();
            let comments = (text.lines().map(str::trim_start))
                .filter_map(|line| line.strip_prefix("///").or(line.strip_prefix("//!")));
            let fences = comments.filter_map(|comment| comment.trim().strip_prefix("```"));
            // Every other fence ends what the one before it began.
            fences.step_by(2).any(|language| language != "text")
        });
        assert_eq!(
            holds_code,
            tried.contains(&folder.join("lib.rs")),
            "{name}: doctest in [lib]"
        );
    }
}
