//! Names of fields of results stand in the table of fields alone.

use std::fs;
use std::path::{Path, PathBuf};

use ligament_output::results::fields::{FIELDS, ResultField};
use verification::repository;

use crate::architecture::sources;

/// The table, below `crates`.
const TABLE: &str = "ligament-analysis/src/result_fields.rs";

/// Files below `crates` that have a name of the table for something else.
const OTHERWISE: [(&str, &str, &str); 1] = [(
    "ligament-output/src/results/stored.rs",
    "horizon",
    "the horizon of a bond",
)];

/// Ends of what stands before a name where a field is written or read.
const CALLS: [&str; 10] = [
    "Field::scalar(",
    "Field::single(",
    "Field::vector(",
    "Field::integer(",
    "Field::numbers(",
    "_numbers(",
    "numbers(FieldLocation",
    "integers(",
    "components(",
    "vectors(",
];

/// Whether a name stands as a string in a text: one of several words anywhere, one of a single word where a field is written or read.
fn stands_in(text: &str, name: &str) -> bool {
    let quoted = format!("\"{name}\"");
    text.match_indices(&quoted).any(|(at, _)| {
        let statement = text[..at].rsplit([';', '{', '}']).next().unwrap_or("");
        name.contains('_') || CALLS.iter().any(|call| statement.contains(call))
    })
}

#[test]
fn names_of_fields_stand_in_their_table() {
    let crates = repository().join("crates");
    let mut found: Vec<(PathBuf, &str)> = Vec::new();
    for entry in fs::read_dir(&crates).unwrap() {
        for path in sources(&entry.unwrap().path().join("src")) {
            let text = fs::read_to_string(&path).unwrap();
            let text = text.split("#[cfg(test)]").next().unwrap_or("");
            let below = path.strip_prefix(&crates).unwrap().to_owned();
            if below.ends_with("tests.rs") || below == Path::new(TABLE) {
                continue;
            }
            let names = FIELDS.iter().map(|ResultField { name, .. }| *name);
            let named = names.filter(|name| stands_in(text, name));
            found.extend(named.map(|name| (below.clone(), name)));
        }
    }
    let is_listed = |(path, name): &&(PathBuf, &str)| {
        OTHERWISE
            .iter()
            .any(|it| path.ends_with(it.0) && *name == it.1)
    };
    let new: Vec<_> = found.iter().filter(|it| !is_listed(it)).collect();
    assert!(
        new.is_empty(),
        "take the name from the table of fields: {new:?}"
    );
    for (path, name, reason) in OTHERWISE {
        let is_there = found.contains(&(path.into(), name));
        assert!(is_there, "take it off the list: {path} {name} ({reason})");
    }
}
