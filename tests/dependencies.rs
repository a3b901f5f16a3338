//! The packages that the program is built from: where they come from, and under which licences.
#![allow(clippy::unwrap_used, reason = "a failed unwrap fails the test")]

use std::process::Command;

use serde_json::Value;
use verification::repository;

/// The registry of crates.io, the one source of packages.
const SOURCE: &str = "registry+https://github.com/rust-lang/crates.io-index";

/// Licences that ask for no more than to be named; of a choice between several one suffices.
const LICENCES: [&str; 10] = [
    "0BSD",
    "Apache-2.0",
    "BSD-2-Clause",
    "BSD-3-Clause",
    "BSL-1.0",
    "MIT",
    "MIT-0",
    "Unicode-3.0",
    "Unlicense",
    "Zlib",
];

/// Whether a licence expression of SPDX can be met by the licences alone: all parts of AND, one of OR. The older `MIT/Apache-2.0`
/// is an OR; exceptions, behind WITH, allow more and ask nothing.
fn is_met(expression: &str) -> bool {
    let words = expression
        .replace('(', " ( ")
        .replace(')', " ) ")
        .replace('/', " OR ");
    let words: Vec<&str> = words.split_whitespace().collect();
    let (met, rest) = any_of(&words);
    assert!(rest.is_empty(), "{expression} is no licence expression");
    met
}

fn any_of<'a>(words: &'a [&'a str]) -> (bool, &'a [&'a str]) {
    let (mut met, mut rest) = all_of(words);
    while let [word, more @ ..] = rest
        && *word == "OR"
    {
        let (other, after) = all_of(more);
        (met, rest) = (met | other, after);
    }
    (met, rest)
}

fn all_of<'a>(words: &'a [&'a str]) -> (bool, &'a [&'a str]) {
    let (mut met, mut rest) = one(words);
    while let [word, more @ ..] = rest
        && *word == "AND"
    {
        let (other, after) = one(more);
        (met, rest) = (met & other, after);
    }
    (met, rest)
}

fn one<'a>(words: &'a [&'a str]) -> (bool, &'a [&'a str]) {
    match words {
        ["(", inner @ ..] => {
            let (met, rest) = any_of(inner);
            assert_eq!(rest.first(), Some(&")"));
            (met, &rest[1..])
        }
        [licence, "WITH", _, rest @ ..] | [licence, rest @ ..] => {
            (LICENCES.contains(licence), rest)
        }
        [] => panic!("a licence is missing"),
    }
}

#[test]
fn expressions_of_licences_are_understood() {
    for met in [
        "MIT",
        "MIT/Apache-2.0",
        "GPL-3.0 OR MIT",
        "(MIT OR GPL-2.0) AND Unicode-3.0",
        "Apache-2.0 WITH LLVM-exception",
    ] {
        assert!(is_met(met), "{met}");
    }
    for unmet in [
        "GPL-3.0",
        "MIT AND GPL-3.0",
        "(GPL-2.0 OR LGPL-2.1) AND MIT",
        "SSPL-1.0",
    ] {
        assert!(!is_met(unmet), "{unmet}");
    }
}

/// Every package comes from crates.io with its digest in the lock file, or lies in this repository; every licence is one of the list.
/// Nothing is asked of a network.
#[test]
fn packages_are_those_of_crates_io_under_free_licences() {
    let output = Command::new(env!("CARGO"))
        .args(["metadata", "--format-version", "1", "--offline", "--locked"])
        .current_dir(repository())
        .output()
        .unwrap();
    assert!(
        output.status.success(),
        "{}",
        String::from_utf8_lossy(&output.stderr)
    );
    let metadata: Value = serde_json::from_slice(&output.stdout).unwrap();
    let packages = metadata["packages"].as_array().unwrap();
    assert!(packages.len() > 50, "the packages were found");
    let lock = std::fs::read_to_string(repository().join("Cargo.lock")).unwrap();
    let mut complaints = Vec::new();
    for package in packages {
        let word = |key: &str| package[key].as_str().unwrap_or_default();
        let (name, version, licence) = (word("name"), word("version"), word("license"));
        match package["source"].as_str() {
            None if word("manifest_path").starts_with(repository().to_str().unwrap()) => {}
            Some(SOURCE) => {
                let entry = format!(
                    "name = \"{name}\"\nversion = \"{version}\"\nsource = \"{SOURCE}\"\nchecksum = "
                );
                if !lock.contains(&entry) {
                    complaints.push(format!("{name} {version} has no digest in Cargo.lock"));
                }
            }
            source => complaints.push(format!("{name} {version} comes from {source:?}")),
        }
        if !is_met(licence) {
            complaints.push(format!("{name} {version} is under {licence:?}"));
        }
    }
    assert!(complaints.is_empty(), "{complaints:#?}");
}
