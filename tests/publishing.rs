//! What is published: metadata of the crates, one version in all files, and no file from outside of a package.
#![allow(clippy::unwrap_used, reason = "a failed unwrap fails the test")]

use std::fs;
use std::path::{Component, Path};

use serde_json::Value;
use verification::repository;

use crate::architecture::sources;
use crate::metadata::metadata;

/// Packages that are published.
fn published() -> Vec<Value> {
    let mut metadata = metadata(&["--no-deps"]);
    let Value::Array(packages) = metadata["packages"].take() else {
        panic!("packages are a list");
    };
    let is_published = |it: &Value| it["publish"] != serde_json::json!([]);
    packages.into_iter().filter(is_published).collect()
}

#[test]
fn published_crates_say_what_they_are() {
    let packages = published();
    assert_eq!(packages.len(), 14);
    for package in packages {
        for field in ["description", "license", "repository"] {
            assert!(package[field].is_string(), "{field} of {}", package["name"]);
        }
        for field in ["keywords", "categories", "authors"] {
            let entries = package[field].as_array().unwrap();
            assert!(!entries.is_empty(), "{field} of {}", package["name"]);
        }
        for dependency in package["dependencies"].as_array().unwrap() {
            if dependency["path"].is_null() || dependency["kind"] == "dev" {
                continue;
            }
            // An internal interface changes with any version.
            let pinned = format!("={}", env!("CARGO_PKG_VERSION"));
            assert_eq!(dependency["req"], pinned, "{}", package["name"]);
        }
    }
}

#[test]
fn the_version_is_the_same_everywhere() {
    let version = env!("CARGO_PKG_VERSION");
    let citation = fs::read_to_string(repository().join("CITATION.cff")).unwrap();
    let (_, rest) = citation.split_once("\ndate-released: ").unwrap();
    let date = rest.lines().next().unwrap();
    for (file, line) in [
        ("CITATION.cff", format!("\nversion: {version}\n")),
        ("codemeta.json", format!("\"version\": \"{version}\"")),
        (
            "tools/packaging/conda/recipe.yaml",
            format!("  version: {version}\n"),
        ),
        ("CHANGELOG.md", format!("\n## {version} - {date}\n")),
    ] {
        let text = fs::read_to_string(repository().join(file)).unwrap();
        assert!(text.contains(&line), "{file} is of another version");
    }
}

/// Users read the notes of a version on one screen; details are in a page of their own.
#[test]
fn notes_of_a_version_are_short() {
    let text = fs::read_to_string(repository().join("CHANGELOG.md")).unwrap();
    let versions: Vec<_> = text.split("\n## ").skip(1).collect();
    assert_eq!(versions[0].lines().next(), Some("Unreleased"));
    for notes in &versions[1..] {
        assert!(notes.lines().count() <= 40, "{}", &notes[..20]);
    }
}

/// A container is built where there is a daemon; here its recipe names files that exist and the oldest compiler that is supported.
#[test]
fn the_container_copies_what_there_is() {
    let recipe = repository().join("tools/packaging/Dockerfile");
    let text = fs::read_to_string(recipe).unwrap();
    let compiler = env!("CARGO_PKG_RUST_VERSION");
    assert!(text.contains(&format!("FROM rust:{compiler}-")));
    let copied: Vec<_> = (text.lines())
        .filter_map(|line| line.strip_prefix("COPY --from=build "))
        .flat_map(|line| line.split_whitespace().rev().skip(1))
        .map(|path| path.strip_prefix("/sources/").unwrap())
        .collect();
    assert!(copied.contains(&"target/release/ligament"));
    for path in copied.iter().filter(|path| !path.starts_with("target/")) {
        assert!(repository().join(path).exists(), "{path}");
    }
}

/// Files that published crates compile in are below their folder, so that they are packed.
#[test]
fn no_file_comes_from_outside_of_a_package() {
    let mut found = 0;
    for package in published() {
        let manifest = package["manifest_path"].as_str().unwrap();
        let folder = Path::new(manifest).parent().unwrap();
        let parts = ["src", "examples"].map(|it| folder.join(it));
        let files = parts
            .iter()
            .filter(|it| it.exists())
            .flat_map(|it| sources(it));
        for file in files {
            let text = fs::read_to_string(&file).unwrap();
            for call in ["include_str!(\"", "include_bytes!(\""] {
                for rest in text.split(call).skip(1) {
                    let given = rest.split('"').next().unwrap();
                    found += 1;
                    let depth = file.parent().unwrap().strip_prefix(folder).unwrap();
                    let up = Path::new(given).components();
                    let up = up.filter(|it| *it == Component::ParentDir).count();
                    assert!(
                        up <= depth.components().count(),
                        "{given} in {}",
                        file.display()
                    );
                }
            }
        }
    }
    assert!(found > 10, "the calls were found");
}
