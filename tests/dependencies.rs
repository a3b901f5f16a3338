//! The packages that the program is built from: where they come from, and under which licences.
#![allow(clippy::unwrap_used, reason = "a failed unwrap fails the test")]

use std::collections::BTreeSet;
use std::process::Command;

use serde_json::Value;
use verification::repository;

use crate::metadata::metadata;

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

/// Rust's name of this machine.
fn host() -> String {
    let output = Command::new(env!("CARGO")).arg("-vV").output().unwrap();
    let text = String::from_utf8(output.stdout).unwrap();
    let line = text.lines().find_map(|line| line.strip_prefix("host: "));
    line.unwrap().to_owned()
}

/// The value of a key of an entry of the lock file.
fn value<'a>(entry: &'a str, key: &str) -> Option<&'a str> {
    let mut lines = entry.lines();
    lines.find_map(|line| line.strip_prefix(key)?.strip_prefix(" = "))
}

/// Every package of any platform comes from crates.io with its digest, or lies in this repository.
#[test]
fn packages_come_from_crates_io_with_their_digests() {
    let here = metadata(&["--no-deps"]);
    let here: BTreeSet<&str> = (here["packages"].as_array().unwrap().iter())
        .map(|package| package["name"].as_str().unwrap())
        .collect();
    let lock = std::fs::read_to_string(repository().join("Cargo.lock")).unwrap();
    let entries: Vec<&str> = lock.split("[[package]]\n").skip(1).collect();
    assert!(entries.len() > 50, "the packages were found");
    let source = format!("{SOURCE:?}");
    let is_known = |entry: &&str| match value(entry, "source") {
        None => here.contains(value(entry, "name").unwrap().trim_matches('"')),
        Some(from) => from == source && value(entry, "checksum").is_some(),
    };
    let others: Vec<&str> = entries.into_iter().filter(|it| !is_known(it)).collect();
    assert!(others.is_empty(), "{others:#?}");
}

/// Fails with the packages whose licence is none of the list.
fn assert_free(metadata: &Value) {
    let packages = metadata["packages"].as_array().unwrap();
    assert!(packages.len() > 50, "the packages were found");
    let licence = |package: &Value| package["license"].as_str().unwrap_or_default().to_owned();
    let unfree: Vec<String> = (packages.iter())
        .filter(|package| !is_met(&licence(package)))
        .map(|package| format!("{} is under {:?}", package["name"], licence(package)))
        .collect();
    assert!(unfree.is_empty(), "{unfree:#?}");
}

/// Packages that this machine compiles: no other ones need to be there.
#[test]
fn packages_of_this_platform_are_under_free_licences() {
    assert_free(&metadata(&["--filter-platform", &host()]));
}

#[test]
#[ignore = "downloads the packages of other platforms; run by tools/test"]
fn packages_of_all_platforms_are_under_free_licences() {
    assert_free(&metadata(&[]));
}
