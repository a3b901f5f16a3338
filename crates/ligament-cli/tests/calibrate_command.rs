//! Calls of `ligament calibrate`.

#![allow(clippy::unwrap_used, reason = "a failed unwrap fails the test")]

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

use serde_json::Value;

use crate::support::text;

fn case(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR"))
        .join("../../cases")
        .join(name)
}

/// Calibrates a case into a folder of the given parent.
fn calibrate(parent: &Path, name: &str, arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_ligament"))
        .arg("calibrate")
        .arg(case(name))
        .args(arguments)
        .arg("--out")
        .arg(parent.join("out"))
        .output()
        .unwrap()
}

fn record(parent: &Path) -> Value {
    let text = fs::read_to_string(parent.join("out/calibration.json")).unwrap();
    serde_json::from_str(&text).unwrap()
}

/// The error of a calibration that cannot begin; nothing is written.
fn refused(name: &str, arguments: &[&str]) -> String {
    let parent = tempfile::tempdir().unwrap();
    let output = calibrate(parent.path(), name, arguments);
    assert_eq!(output.status.code(), Some(1), "{}", text(&output.stdout));
    assert!(!parent.path().join("out").exists());
    text(&output.stderr)
}

const PLATE: &str = "plate-tension/case.toml";

#[test]
fn the_stiffness_of_a_plate_is_proportional_to_youngs_modulus() {
    let parent = tempfile::tempdir().unwrap();
    let of = ["--key", "material.young", "--of", "elastic_stiffness"];
    let goal = ["--target", "1e8", "--within", "1e-6"];
    let output = calibrate(parent.path(), PLATE, &[&of[..], &goal].concat());
    assert!(output.status.success(), "{}", text(&output.stderr));
    let record = record(parent.path());
    assert_eq!(record["outcome"], "met");
    let runs = record["runs"].as_array().unwrap();
    assert_eq!(runs.len(), 2, "in proportion: the second run meets it");
    let number = |run: usize, of: &str| runs[run][of].as_f64().unwrap();
    // Stiffness and modulus have the same ratio in both runs, and the second has the target.
    let ratio = |run| number(run, "result") / number(run, "key");
    assert!((ratio(0) / ratio(1) - 1.0).abs() < 1e-9);
    assert!((number(1, "result") / 1e8 - 1.0).abs() < 1e-6);
    let stdout = text(&output.stdout);
    let setting = format!(
        "--set material.young={:?}",
        record["value"].as_f64().unwrap()
    );
    assert!(stdout.contains(&setting), "{stdout}");
    // The runs are stored as any other run is, and the table has a row for each.
    for run in ["run-01", "run-02"] {
        assert!(
            parent
                .path()
                .join("out")
                .join(run)
                .join("summary.json")
                .is_file()
        );
    }
    let table = fs::read_to_string(parent.path().join("out/calibration.csv")).unwrap();
    assert_eq!(table.lines().count(), 3);
    assert!(table.starts_with("run,material.young,elastic_stiffness,off,"));
}

#[test]
fn a_frequency_goes_with_the_root_of_the_stiffness() {
    let parent = tempfile::tempdir().unwrap();
    let of = ["--key", "material.young", "--of", "modes.0.frequency"];
    let goal = ["--target", "400", "--within", "1e-4"];
    let output = calibrate(parent.path(), "modal-plate/case.toml", &[of, goal].concat());
    assert!(output.status.success(), "{}", text(&output.stderr));
    let record = record(parent.path());
    let runs = record["runs"].as_array().unwrap();
    let of_run = |run: &Value, of: &str| run[of].as_f64().unwrap();
    let (first, last) = (&runs[0], &runs[runs.len() - 1]);
    let ratio = of_run(last, "result") / of_run(first, "result");
    let expected = (of_run(last, "key") / of_run(first, "key")).sqrt();
    assert!((ratio / expected - 1.0).abs() < 1e-9);
    assert!((of_run(last, "result") / 400.0 - 1.0).abs() <= 1e-4);
    assert!(runs.len() <= 8, "{} runs", runs.len());
}

#[test]
fn a_result_that_jumps_is_told_with_both_sides() {
    let parent = tempfile::tempdir().unwrap();
    // The number of broken bonds is an integer, so that a half is jumped over.
    let of = ["--key", "material.tensile_strength", "--of", "broken_bonds"];
    let goal = ["--target", "0.5", "--max-runs", "40"];
    let case = "cracked-plate-force/case.toml";
    let output = calibrate(parent.path(), case, &[of, goal].concat());
    let error = text(&output.stderr);
    assert_eq!(output.status.code(), Some(1), "{error}");
    assert!(
        error.contains("broken_bonds jumps over the target"),
        "{error}"
    );
    let record = record(parent.path());
    assert_eq!(record["outcome"], "jump");
    assert_eq!(record["value"], Value::Null);
}

#[test]
fn limits_out_of_reach_keep_the_record() {
    let parent = tempfile::tempdir().unwrap();
    let of = ["--key", "material.young", "--of", "elastic_stiffness"];
    let goal = ["--target", "1e15", "--from", "1e10", "--to", "2e11"];
    let output = calibrate(parent.path(), PLATE, &[&of[..], &goal].concat());
    let error = text(&output.stderr);
    assert_eq!(output.status.code(), Some(1), "{error}");
    assert!(
        error.contains("no value of material.young between --from and --to"),
        "{error}"
    );
    let record = record(parent.path());
    assert_eq!(record["outcome"], "out-of-reach");
    let tried = record["runs"].as_array().unwrap();
    let keys: Vec<f64> = tried
        .iter()
        .map(|run| run["key"].as_f64().unwrap())
        .collect();
    assert!(keys.contains(&2e11) && keys.contains(&1e10), "{keys:?}");
    // A calibration of something else is replaced only on demand.
    let other = ["--key", "material.poisson", "--of", "elastic_stiffness"];
    let again = calibrate(parent.path(), PLATE, &[&other[..], &goal].concat());
    assert!(text(&again.stderr).contains("is one of material.young"));
    let set = ["--set", "material.poisson=0.25"];
    let again = calibrate(parent.path(), PLATE, &[&of[..], &goal, &set].concat());
    let error = text(&again.stderr);
    assert!(
        error.contains("another case: now poisson = 0.25; --force"),
        "{error}"
    );
}

#[test]
fn what_cannot_begin_is_told_before_anything_is_written() {
    let of = |key, target| {
        [
            "--key",
            key,
            "--target",
            target,
            "--of",
            "elastic_stiffness",
        ]
    };
    let misspelt = refused(PLATE, &of("material.yuong", "1e9"));
    assert!(misspelt.contains("did you mean `young`?"), "{misspelt}");
    for (name, said) in [
        ("peak.force", "--of peak.force: there is no result"),
        ("elastic_stifness", "did you mean `elastic_stiffness`?"),
        ("modes.0.frequency", "there is no result"),
    ] {
        let key = ["--key", "material.young", "--target", "1", "--of", name];
        let unknown = refused(PLATE, &key);
        assert!(unknown.contains(said), "{unknown}");
    }
    let absent = refused(PLATE, &of("material.density", "1e9"));
    assert!(absent.contains("--from and --to"), "{absent}");
    let zero = refused(PLATE, &of("material.young", "0"));
    assert!(zero.contains("other than 0"), "{zero}");
    let limits = ["--from", "2e9", "--to", "1e9"];
    let empty = refused(PLATE, &[&of("material.young", "1e9")[..], &limits].concat());
    assert!(empty.contains("is not below"), "{empty}");
}

#[test]
fn a_line_of_a_table_takes_the_place_of_runs() {
    let parent = tempfile::tempdir().unwrap();
    let table = parent.path().join("table.csv");
    let rows = "run,status,model.horizon_factor,material.tensile_strength,first_peak.reaction\n\
        a,done,2,3.81e6,62.5\nb,done,3,3.81e6,100\nc,done,4,3.81e6,137.5\n";
    fs::write(&table, rows).unwrap();
    let calibrate = |arguments: &[&str]| {
        Command::new(env!("CARGO_BIN_EXE_ligament"))
            .args(["calibrate", "--key", "material.tensile_strength"])
            .args(["--target", "100"])
            .arg(&table)
            .args(arguments)
            .output()
            .unwrap()
    };
    let output = calibrate(&["--at", "2.5,3.5"]);
    let stdout = text(&output.stdout);
    assert!(output.status.success(), "{}", text(&output.stderr));
    assert!(stdout.contains("0.3750 x - 0.1250"), "{stdout}");
    assert!(
        stdout.contains("= 2.5: material.tensile_strength = 4.6892e6"),
        "{stdout}"
    );
    let stray = calibrate(&["--within", "0.1"]);
    assert!(text(&stray.stderr).contains("--within goes with a case"));
    let stray = refused(
        PLATE,
        &["--key", "material.young", "--target", "1", "--at", "2"],
    );
    assert!(
        stray.contains("--at goes with the folder or the table of a sweep"),
        "{stray}"
    );
}

#[test]
fn a_calibration_goes_on_with_the_runs_that_it_has() {
    let parent = tempfile::tempdir().unwrap();
    let of = ["--key", "material.young", "--of", "elastic_stiffness"];
    let goal = ["--target", "1e8", "--within", "1e-6"];
    let first = calibrate(parent.path(), PLATE, &[of, goal].concat());
    assert!(first.status.success(), "{}", text(&first.stderr));
    let whole = record(parent.path());
    // As if killed in the second run: this run has no end, and its folder is begun.
    let mut cut = whole.clone();
    cut["runs"].as_array_mut().unwrap().truncate(1);
    fs::write(parent.path().join("out/calibration.json"), cut.to_string()).unwrap();
    fs::remove_file(parent.path().join("out/run-02/summary.json")).unwrap();
    let of_first = || fs::metadata(parent.path().join("out/run-01/summary.json"));
    let written = of_first().unwrap().modified().unwrap();
    let again = calibrate(parent.path(), PLATE, &[of, goal].concat());
    assert!(again.status.success(), "{}", text(&again.stderr));
    assert!(text(&again.stderr).contains("(from an earlier calibration)"));
    assert_eq!(
        of_first().unwrap().modified().unwrap(),
        written,
        "not run again"
    );
    let after = record(parent.path());
    assert_eq!(after["value"], whole["value"]);
    assert_eq!(after["runs"].as_array().unwrap().len(), 2);
    // Another target uses the runs as trials.
    let other = calibrate(
        parent.path(),
        PLATE,
        &[of, ["--target", "9e7", "--within", "1e-6"]].concat(),
    );
    assert!(other.status.success(), "{}", text(&other.stderr));
    assert_eq!(record(parent.path())["runs"].as_array().unwrap().len(), 3);
}
