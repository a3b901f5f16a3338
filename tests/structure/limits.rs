//! The page of limits has the table of features that do not go together, as the program refuses them.
#![allow(clippy::unwrap_used)]

use std::collections::BTreeSet;
use std::env;
use std::fs;

use ligament::setup::{Exclusion, NOT_TOGETHER};
use verification::repository;

/// The page, and the heading of its table.
const PAGE: &str = "docs/guide/limits.md";
const HEADING: &str = "| refused | beside | reason |\n|---|---|---|\n";

fn row(pair: &Exclusion) -> String {
    let reason = pair.reason_beside("...");
    let (refused, beside, page) = (pair.refused.name, pair.beside.name, pair.page);
    format!("| {refused} | {beside} | {reason} ([more](../{page})) |\n")
}

/// A page with its table made anew.
fn with_table(text: &str) -> String {
    let (before, rest) = text.split_once(HEADING).unwrap();
    let earlier = rest
        .split_inclusive('\n')
        .take_while(|it| it.starts_with('|'));
    let earlier: usize = earlier.map(str::len).sum();
    let rows: String = NOT_TOGETHER.iter().map(row).collect();
    format!("{before}{HEADING}{rows}{}", &rest[earlier..])
}

/// With `LIGAMENT_WRITE_LIMITS` in the environment the table is written first.
#[test]
fn the_page_of_limits_has_what_does_not_go_together() {
    let path = repository().join(PAGE);
    let mut text = fs::read_to_string(&path).unwrap();
    if env::var_os("LIGAMENT_WRITE_LIMITS").is_some() {
        text = with_table(&text);
        fs::write(&path, &text).unwrap();
    }
    let again =
        "make it anew: LIGAMENT_WRITE_LIMITS=1 cargo test --release -p verification --test guards";
    assert!(
        with_table(&text) == text,
        "{PAGE} is not what the program refuses; {again}"
    );
}

/// Each pair stands once, and its page exists.
#[test]
fn pairs_stand_once_and_have_pages() {
    let mut seen = BTreeSet::new();
    for pair in NOT_TOGETHER {
        let names = (pair.refused.name, pair.beside.name);
        assert!(seen.insert(names), "{names:?}");
        assert!(
            repository().join("docs").join(pair.page).is_file(),
            "{}",
            pair.page
        );
    }
}
