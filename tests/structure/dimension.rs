//! Dimension is a type where coordinates are multiplied, and a value everywhere else.

use std::ffi::OsStr;
use std::fs;
use std::path::{Path, PathBuf};

use verification::repository;

/// Files and folders named by a dimension, below `crates`, each with its reason: geometry that has another form in space. Nothing may be
/// added without one.
const GEOMETRIC: [(&str, &str); 12] = [
    (
        "ligament-cli/src/inspect/solid.rs",
        "words on solid cells and faces of a mesh",
    ),
    ("ligament-mesh/src/gmsh/solid", "element types of Gmsh"),
    ("ligament-mesh/src/solid", "solid cells and their faces"),
    (
        "ligament-model/src/bonds/outline/solid.rs",
        "triangles of an outline",
    ),
    (
        "ligament-model/src/bonds/outline/solid",
        "triangles of an outline",
    ),
    (
        "ligament-model/src/bonds/precrack/solid.rs",
        "surfaces that cut bonds",
    ),
    (
        "ligament-model/src/bonds/precrack/solid",
        "surfaces that cut bonds",
    ),
    (
        "ligament-model/src/element/pair/space.rs",
        "a bond in space bends in two planes and twists",
    ),
    (
        "ligament-model/src/shape/solid.rs",
        "balls, cylinders and boxes",
    ),
    (
        "ligament-output/src/results/solid_body.rs",
        "files of a solid body",
    ),
    (
        "ligament-output/src/results/solid_cracks.rs",
        "files of cracks as surfaces",
    ),
    ("ligament-plot/src/picture/solid", "a painter of solids"),
];

/// Crates that see bodies as values, whatever their dimension.
const BY_VALUE: [&str; 8] = [
    "ligament-analysis",
    "ligament-linalg",
    "ligament-output",
    "ligament-petsc",
    "ligament-plot",
    "ligament-post",
    "ligament-report",
    "ligament-run",
];

fn walk(folder: &Path, found: &mut Vec<PathBuf>) {
    for entry in fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.is_dir() {
            walk(&path, found);
        }
        found.push(path);
    }
}

/// Source files and folders of the crates, below `crates`.
fn sources() -> Vec<PathBuf> {
    let crates = repository().join("crates");
    let mut found = Vec::new();
    for entry in fs::read_dir(&crates).unwrap() {
        walk(&entry.unwrap().path().join("src"), &mut found);
    }
    let below = |path: &PathBuf| path.strip_prefix(&crates).unwrap().to_owned();
    let found: Vec<PathBuf> = found.iter().map(below).collect();
    assert!(found.len() > 500, "the sources were not found");
    found
}

#[test]
fn no_file_is_named_by_its_dimension() {
    let is_named = |path: &&PathBuf| {
        let stem = path.file_stem().and_then(OsStr::to_str).unwrap();
        stem.split('_')
            .any(|word| ["space", "solid"].contains(&word))
    };
    let sources = sources();
    let named: Vec<&str> = (sources.iter().filter(is_named))
        .map(|path| path.to_str().unwrap())
        .collect();
    let is_new = |path: &&&str| !GEOMETRIC.iter().any(|(listed, _)| listed == *path);
    let new: Vec<_> = named.iter().filter(is_new).collect();
    assert!(new.is_empty(), "written for one dimension: {new:?}");
    for (listed, reason) in GEOMETRIC {
        assert!(
            named.contains(&listed),
            "take it off the list: {listed} ({reason})"
        );
    }
}

/// No bound on a type that stands for a dimension alone, and no dimension in a type where bodies are values; tensors of a checkpoint are
/// written in each.
#[test]
fn dimension_is_a_value_above_the_mechanics() {
    let mut found = Vec::new();
    for path in sources() {
        if path.extension() != Some(OsStr::new("rs")) {
            continue;
        }
        let text = fs::read_to_string(repository().join("crates").join(&path)).unwrap();
        let name = path.iter().next().and_then(OsStr::to_str).unwrap();
        let is_bound = text.contains("Dim:") || text.contains("Dimension<D>");
        let is_serial = path.ends_with("ligament-analysis/src/serial.rs");
        let has_type = BY_VALUE.contains(&name) && text.contains("<const D: usize") && !is_serial;
        if is_bound || has_type {
            found.push(path);
        }
    }
    assert!(found.is_empty(), "the dimension is in a type: {found:?}");
}
