//! Readers under damaged input: no panic, no abort, and time and memory that the size of the input bounds.
//!
//! Each target ([`Target`]) has seeds, which are files of this repository and results made on the spot, and a fixed number of inputs
//! made of them with a fixed seed. For as long as one likes, in release builds:
//!
//! ```text
//! LIGAMENT_FUZZ="mesh 1800 7" cargo test --release -p verification --test fuzz -- --ignored
//! ```
//!
//! tries `mesh` (or `all`) for 1800 s from the seed 7. What breaks a target is left in the folder `ligament-fuzz` for temporary
//! files, beside the last input of each target, which tells of aborts; it belongs into `corpus/TARGET` once it is mended.
#![allow(clippy::unwrap_used, reason = "a failed unwrap fails the test")]
#![allow(clippy::print_stderr, reason = "a long run says how far it is")]

mod arrays;
mod factors;
mod folder;
mod mutation;
mod records;
mod resources;
mod results;
mod solutions;
mod stopped;
mod texts;

use std::fs;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::PathBuf;
use std::sync::{Mutex, PoisonError};
use std::time::{Duration, Instant};

use mutation::{Random, mutated};
use resources::Watch;
use verification::repository;

/// What reads input.
trait Target {
    /// Name of the target and of its corpus.
    fn name(&self) -> &'static str;

    /// Inputs to begin with.
    fn seeds(&self) -> Vec<Vec<u8>>;

    /// Words that inputs of this kind are made of.
    fn words(&self) -> &'static [&'static str] {
        &[]
    }

    /// Reads an input to its end; a panic is a failure. Gives whether it was accepted.
    fn read(&mut self, input: &[u8]) -> bool;
}

/// When to stop.
#[derive(Debug, Clone, Copy)]
enum Until {
    Inputs(usize),
    Time(Duration),
}

/// One target at a time, so that memory is that of the target.
static ALONE: Mutex<()> = Mutex::new(());

/// Tries inputs; gives their number and that of those that were accepted.
fn hammer(target: &mut dyn Target, until: Until, seed: u64) -> (usize, usize) {
    let _alone = ALONE.lock().unwrap_or_else(PoisonError::into_inner);
    let folder = std::env::temp_dir().join("ligament-fuzz");
    fs::create_dir_all(&folder).unwrap();
    let last = folder.join(format!("{}-last-{}", target.name(), std::process::id()));
    let mut seeds = target.seeds();
    seeds.extend(corpus(target.name()));
    assert!(!seeds.is_empty(), "{} has no seeds", target.name());
    let mut random = Random(seed);
    let (start, mut told) = (Instant::now(), Instant::now());
    let (mut tried, mut accepted) = (0, 0);
    let goes_on = |tried: usize| match until {
        Until::Inputs(most) => tried < most,
        Until::Time(most) => start.elapsed() < most,
    };
    while goes_on(tried) {
        // The seeds themselves come first.
        let input = match seeds.get(tried) {
            Some(seed) => seed.clone(),
            None => mutated(&seeds, target.words(), &mut random),
        };
        fs::write(&last, &input).unwrap();
        let watch = Watch::begin();
        let outcome = catch_unwind(AssertUnwindSafe(|| target.read(&input)));
        let excess = watch.excess(input.len());
        let complaint = match (&outcome, excess) {
            (Err(_), _) => Some("it panics".to_owned()),
            (_, excess) => excess,
        };
        if let Some(complaint) = complaint {
            let kept = folder.join(format!("{}-{seed}-{tried}", target.name()));
            fs::write(&kept, &input).unwrap();
            panic!("{}: {complaint} with {}", target.name(), kept.display());
        }
        accepted += usize::from(outcome.unwrap_or_default());
        tried += 1;
        if told.elapsed() > Duration::from_secs(60) {
            told = Instant::now();
            eprintln!("{}: {tried} inputs, {accepted} accepted", target.name());
        }
    }
    fs::remove_file(&last).unwrap();
    eprintln!(
        "{}: {tried} inputs, {accepted} accepted, {:.0?}",
        target.name(),
        start.elapsed()
    );
    (tried, accepted)
}

/// Inputs that broke a target once.
fn corpus(name: &str) -> Vec<Vec<u8>> {
    files(&repository().join("tests/fuzz/corpus").join(name), "")
}

/// The files of a folder whose names end so, in the order of their names.
fn files(folder: &std::path::Path, end: &str) -> Vec<Vec<u8>> {
    let entries = fs::read_dir(folder).into_iter().flatten();
    let mut paths: Vec<PathBuf> = entries.map(|entry| entry.unwrap().path()).collect();
    paths.retain(|path| path.is_file() && path.to_str().unwrap().ends_with(end));
    paths.sort();
    paths.iter().map(|path| fs::read(path).unwrap()).collect()
}

/// Names of the targets.
const TARGETS: [&str; 9] = [
    "mesh",
    "case",
    "study",
    "results",
    "checkpoint",
    "stopped",
    "record",
    "solution",
    "factor",
];

fn target(name: &str) -> Box<dyn Target> {
    match name {
        "mesh" => Box::new(texts::Meshes),
        "case" => Box::new(texts::Cases),
        "study" => Box::new(texts::Studies::new()),
        "results" => Box::new(results::Results::new()),
        "checkpoint" => Box::new(stopped::Checkpoints::new()),
        "stopped" => Box::new(stopped::Stopped::new()),
        "record" => Box::new(records::Records::new()),
        "solution" => Box::new(solutions::Solutions::new()),
        "factor" => Box::new(factors::Factors),
        _ => panic!("there is no target {name}, but {TARGETS:?}"),
    }
}

/// A fixed number of inputs of a target from a fixed seed; some are accepted and some are not, else nothing would be tried.
fn for_short(name: &str, inputs: usize) {
    let (tried, accepted) = hammer(&mut *target(name), Until::Inputs(inputs), 1);
    assert!(
        accepted > 0 && accepted < tried,
        "{accepted} of {tried} were accepted"
    );
}

#[test]
fn meshes_of_any_bytes() {
    for_short("mesh", 3000);
}

#[test]
fn cases_of_any_text() {
    for_short("case", 1500);
}

#[test]
fn studies_of_any_text() {
    for_short("study", 300);
}

#[test]
fn results_that_were_changed() {
    for_short("results", 400);
}

#[test]
fn checkpoints_of_any_bytes() {
    for_short("checkpoint", 2000);
}

#[test]
fn stopped_runs_that_were_changed() {
    for_short("stopped", 100);
}

#[test]
fn records_that_were_changed() {
    for_short("record", 60);
}

#[test]
fn solutions_of_any_bytes() {
    for_short("solution", 1500);
}

#[test]
fn matrices_of_any_numbers() {
    for_short("factor", 3000);
}

#[test]
#[ignore = "takes the time that LIGAMENT_FUZZ says"]
fn for_long() {
    let wish = std::env::var("LIGAMENT_FUZZ").unwrap_or_else(|_| "all 60 2".to_owned());
    let words: Vec<&str> = wish.split_whitespace().collect();
    let [name, seconds, seed] = words[..] else {
        panic!("LIGAMENT_FUZZ is \"TARGET SECONDS SEED\"");
    };
    let time = Until::Time(Duration::from_secs(seconds.parse().unwrap()));
    let names = match name {
        "all" => TARGETS.to_vec(),
        one => vec![one],
    };
    for name in names {
        hammer(&mut *target(name), time, seed.parse().unwrap());
    }
}
