//! `ligament ensemble`: the same files from one process, from shards, and after a stop; each sample as a run of its own.
#![allow(clippy::unwrap_used, reason = "a failed unwrap fails the test")]

use std::collections::BTreeSet;
use std::fs;
use std::io::Write as _;
use std::path::PathBuf;
use std::process::Output;

use ligament_output::FieldLocation;
use ligament_output::csv::read::CsvTable;
use ligament_output::vtu::read::VtuFile;
use serde_json::Value;

use crate::support::{assert_success, ligament_in, stderr, stdout};

/// A bar of 72 cells whose strength varies from place to place.
const CASE: &str = r#"title = "Bars"
[lattice]
cells = [12, 6]
spacing = 0.01
thickness = 0.01
set = { left = { left = 2 }, right = { right = 2 } }
[material]
young = 1e9
poisson = 0.2
tensile_strength = 1e6
[model]
law = "mppd"
horizon_factor = 2.2
[[support]]
group = "left"
displacement = { x = 0.0, y = 0.0 }
[[load]]
group = "right"
displacement = { x = 4e-4 }
[fracture]
control = "event"
stop = { load_fraction = 0.5 }
criterion = [{ kind = "tension" }]
scatter = { of = "strength", modulus = 8.0 }
"#;

/// Files whose bits depend on nothing but case, seed and number of samples.
const FILES: [&str; 6] = [
    "samples.csv",
    "curves.csv",
    "weibull.csv",
    "ensemble.vtu",
    "curves.svg",
    "weibull.svg",
];

struct Place {
    folder: tempfile::TempDir,
}

impl Place {
    fn new() -> Self {
        let folder = tempfile::tempdir().unwrap();
        fs::write(folder.path().join("case.toml"), CASE).unwrap();
        Self { folder }
    }

    fn path(&self, name: &str) -> PathBuf {
        self.folder.path().join(name)
    }

    fn call(&self, arguments: &str) -> Output {
        let words: Vec<&str> = arguments.split_whitespace().collect();
        ligament_in(self.folder.path(), &words)
    }

    fn ensemble(&self, arguments: &str) -> Output {
        let output = self.call(&format!(
            "ensemble case.toml --seed 3 --points 11 {arguments}"
        ));
        assert_success(&output);
        output
    }

    fn files(&self, out: &str) -> Vec<Vec<u8>> {
        let read = |it| fs::read(self.path(out).join(it)).unwrap();
        FILES.map(read).to_vec()
    }
}

/// Twelve samples at once; one after the other; first five, then all; in shards in one folder and in two; and after a process that was
/// killed while it wrote, so that there are rows beyond the valid length: always the same bits.
#[test]
fn all_ways_to_the_same_samples_give_the_same_files() {
    let place = Place::new();
    let output = place.ensemble("--samples 12 --threads 2 --out whole");
    assert!(
        stdout(&output).contains("12 of 12 samples, seed 3"),
        "{}",
        stdout(&output)
    );
    let known = place.files("whole");

    place.ensemble("--samples 5 --threads 1 --out again");
    let part = place.path("again/parts/whole.csv");
    let mut rows = fs::File::options().append(true).open(&part).unwrap();
    rows.write_all(b"5,1,2,3\n6,").unwrap();
    let first_rows = fs::read_to_string(&part)
        .unwrap()
        .lines()
        .take(6)
        .collect::<Vec<_>>()
        .join("\n");
    place.ensemble("--samples 12 --threads 1 --jobs 1 --out again");
    assert_eq!(place.files("again"), known);
    let now = fs::read_to_string(&part).unwrap();
    assert!(
        now.starts_with(&first_rows),
        "what was stored is not computed again"
    );

    for shard in 1..=3 {
        let out = if shard == 2 { "elsewhere" } else { "shards" };
        let output = place.ensemble(&format!("--samples 12 --shard {shard}/3 --out {out}"));
        assert!(stdout(&output).contains("--collect"));
    }
    let collected = place.ensemble("--samples 12 --collect --out shards");
    assert!(
        stdout(&collected).contains("8 of 12 samples"),
        "{}",
        stdout(&collected)
    );
    place.ensemble("--samples 12 --collect --out all --from shards --from elsewhere --from shards");
    assert_eq!(place.files("all"), known);
    // The other shards of a shared folder.
    place.ensemble("--samples 12 --out shards");
    assert_eq!(place.files("shards"), known);
    // A folder with all and one with a part of it count once.
    place.ensemble("--samples 12 --collect --out both --from elsewhere --from whole");
    assert_eq!(place.files("both"), known);
    let output = place.call("ensemble case.toml --seed 3 --points 11 --collect --out both --from again --from shards --from elsewhere");
    assert_success(&output);
}

/// The row of a sample equals the run with its seed; the fields count the rows.
#[test]
fn rows_and_fields_are_those_of_runs() {
    let place = Place::new();
    place.ensemble("--samples 6 --out out");
    let sheet = CsvTable::read(place.path("out/samples.csv")).unwrap();
    let seeds: Vec<u64> = sheet.values("seed").unwrap();
    let numbers = |column: &str| sheet.values::<f64>(column).unwrap();
    let (first, peak) = (numbers("first_load"), numbers("peak_load"));
    let n = seeds.len() as f64;
    let mut firsts = vec![0.0; 72];
    let mut damaged = vec![0.0; 72];
    for (sample, seed) in seeds.iter().enumerate() {
        let run = place.call(&format!(
            "run case.toml --set fracture.scatter.seed={seed} --out run-{sample} --quiet"
        ));
        assert_success(&run);
        let summary =
            fs::read_to_string(place.path(&format!("run-{sample}/summary.json"))).unwrap();
        let summary: Value = serde_json::from_str(&summary).unwrap();
        // Numbers of JSON are read to the last bit but one.
        let found = summary["peak"]["reaction"].as_f64().unwrap();
        assert!((found / peak[sample] - 1.0).abs() < 1e-15, "{found}");
        let broken = CsvTable::read(place.path(&format!("run-{sample}/breaks.csv"))).unwrap();
        let column = |it| broken.values::<usize>(it).unwrap();
        let [steps, a, b] = ["step", "cell_a", "cell_b"].map(column);
        assert_eq!(broken.values::<f64>("reaction").unwrap()[0], first[sample]);
        let mut is_first = BTreeSet::new();
        let mut is_damaged = BTreeSet::new();
        for bond in 0..steps.len() {
            for point in [a[bond], b[bond]] {
                is_damaged.insert(point);
                if steps[bond] == steps[0] {
                    is_first.insert(point);
                }
            }
        }
        is_first.iter().for_each(|it| firsts[it - 1] += 1.0 / n);
        is_damaged.iter().for_each(|it| damaged[it - 1] += 1.0 / n);
    }
    for (field, known) in [("first_break_share", firsts), ("damaged_share", damaged)] {
        let file = VtuFile::open(place.path("out/ensemble.vtu")).unwrap();
        let found = file.required_numbers(FieldLocation::Cell, field).unwrap();
        let off = found.iter().zip(&known).map(|(a, b)| (a - b).abs());
        assert!(
            off.fold(0.0, f64::max) < 1e-14,
            "{field}: {found:?} {known:?}"
        );
    }
}

/// Samples of another case or seed are not counted together; what was stored stays until it is to be removed.
#[test]
fn other_samples_are_refused() {
    let place = Place::new();
    place.ensemble("--samples 2 --out out");
    let before = place.files("out");
    for (arguments, words) in [
        ("--seed 4", "samples of another seed, 3"),
        (
            "--seed 3 --set material.young=2e9",
            "samples of another case (now young = ",
        ),
        ("--seed 3 --to 1.0", "samples of another grid"),
    ] {
        let output = place.call(&format!(
            "ensemble case.toml --points 11 --samples 2 --out out {arguments}"
        ));
        assert_eq!(output.status.code(), Some(1));
        assert!(stderr(&output).contains(words), "{}", stderr(&output));
    }
    assert_eq!(place.files("out"), before);
    let output =
        place.call("ensemble case.toml --points 11 --samples 2 --out out --seed 4 --force");
    assert_success(&output);
    assert!(stdout(&output).contains("2 of 2 samples, seed 4"));
    let output = place.call("ensemble case.toml --unset fracture.scatter --out none");
    assert_eq!(output.status.code(), Some(1));
    assert!(
        stderr(&output).contains("varies at random"),
        "{}",
        stderr(&output)
    );
    assert!(!place.path("none").exists());
}

/// More samples than memory has room for are refused before anything is written.
#[test]
fn samples_without_end_are_refused() {
    let place = Place::new();
    for samples in ["99999999999", "18446744073709551615"] {
        let output = place.call(&format!(
            "ensemble case.toml --samples {samples} --out none"
        ));
        assert_eq!(output.status.code(), Some(2));
        assert!(stderr(&output).contains("10000000"), "{}", stderr(&output));
    }
    assert!(!place.path("none").exists());
}
