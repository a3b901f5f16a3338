//! Whole runs on one thread and on more: no bit of a table, a field or a summary differs.
//!
//! Bodies have some 5000 points or more where that matters: loops over points go in tasks of 1024 or 2048 and those over bonds in tasks
//! of 4096, which the threads share only where there are several. More threads than processors take turns, in an order that differs
//! from run to run.
#![allow(clippy::unwrap_used, clippy::print_stdout)]

use std::collections::BTreeMap;
use std::fs;
use std::path::Path;
use std::time::Instant;

use ligament_case::case::CaseFile;
use ligament_run::progress::ProgressMode;
use ligament_run::run::run;
use serde_json::Value;
use verification::repository;

/// Numbers of threads that are compared with one.
const THREADS: [usize; 2] = [2, 5];

/// The disk of 4808 points.
const DISK: &str = "mesh.file=../../meshes/disk-1.5mm.msh";

/// Stresses of both kinds.
const STRESSES: &str = "output.stress=[\"virial\", \"traction\"]";

/// The files that equal runs have in common, without what may differ: times, memory, threads and the place of the case.
fn results(folder: &Path) -> BTreeMap<String, Vec<u8>> {
    let mut files = BTreeMap::new();
    for entry in fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        let name = path.file_name().unwrap().to_str().unwrap().to_owned();
        let mut content = fs::read(&path).unwrap();
        if name == "summary.json" {
            let mut summary: Value = serde_json::from_slice(&content).unwrap();
            let all = summary.as_object_mut().unwrap();
            all.retain(|key, _| key != "stages" && key != "provenance");
            let solver = all["solver"].as_object_mut().unwrap();
            solver.retain(|key, _| key != "threads" && !key.ends_with("seconds"));
            content = summary.to_string().into_bytes();
        }
        let is_passing = ["timings.csv", "case.resolved.toml"].contains(&&*name);
        if !is_passing && !name.starts_with("checkpoint") {
            assert!(!content.is_empty(), "{name} is empty");
            files.insert(name, content);
        }
    }
    files
}

/// Runs a case of the repository on 1, 2 and 5 threads. Gives the results, which are the same.
fn assert_same(case: &str, settings: &[&str]) -> BTreeMap<String, Vec<u8>> {
    let place = tempfile::tempdir().unwrap();
    let start = Instant::now();
    let on = |threads: usize| {
        let threads = format!("solver.threads={threads}");
        let mut settings: Vec<String> = settings.iter().map(|&it| it.to_owned()).collect();
        settings.push(threads.clone());
        let case = CaseFile::load(&repository().join("cases").join(case), &settings).unwrap();
        let out = place.path().join(&threads);
        run(&case, &out, false, ProgressMode::Quiet).unwrap();
        results(&out)
    };
    let one = on(1);
    for threads in THREADS {
        let other = on(threads);
        let names = |of: &BTreeMap<String, Vec<u8>>| of.keys().cloned().collect::<Vec<_>>();
        assert_eq!(names(&one), names(&other), "{case}, {threads} threads");
        let differs = one.iter().find(|(name, content)| other[*name] != **content);
        let differs = differs.map(|(name, _)| name);
        assert_eq!(differs, None, "{case} {settings:?}, {threads} threads");
    }
    let (count, time) = (one.len(), start.elapsed());
    println!("{case} {settings:?}: {count} files the same, {time:.1?}");
    one
}

/// The summary among the results of a run.
fn summary(results: &BTreeMap<String, Vec<u8>>) -> Value {
    serde_json::from_slice(&results["summary.json"]).unwrap()
}

/// Runs a case up to so many broken bonds; in results with fields, breaks and Newton iterations.
fn assert_same_path(case: &str, n_broken: u64, settings: &[&str]) -> Value {
    let stop = format!("fracture.stop.bonds={n_broken}");
    let settings = [&[stop.as_str(), "output.bonds=true"], settings].concat();
    let results = assert_same(case, &settings);
    let fields = results.keys().filter(|name| name.ends_with(".vtu")).count();
    assert!(results.contains_key("iterations.csv") && results.contains_key("breaks.csv"));
    let summary = summary(&results);
    assert!(summary["broken_bonds"].as_u64().unwrap() >= n_broken && fields > 4);
    summary
}

/// Springs with the factor changed in place, in load steps and along the exact path, brittle and with friction.
#[test]
fn meshes_with_the_domain_correction() {
    for case in [
        "brazilian-disk/case.toml",
        "brazilian-disk-friction/case.toml",
    ] {
        let summary = assert_same_path(case, 50, &[DISK, STRESSES]);
        assert!(
            summary["points"].as_u64().unwrap() > 4096,
            "tasks are split"
        );
        let solver = &summary["solver"];
        assert!(solver["changes"].as_u64().unwrap() >= 10 && solver["factorisations"] == 1);
    }
}

/// Parts of the factor side by side along the exact path and in load steps, and events and rounds between those of the whole body.
#[test]
fn parts_left_behind() {
    let settings = [
        DISK,
        "solver.ordering=nested-dissection",
        "output.fields_every=50",
    ];
    let summary = assert_same_path("exact-path/case.toml", 200, &settings);
    let solver = &summary["solver"];
    assert!(solver["changes"].as_u64().unwrap() >= 200 && solver["factorisations"] == 1);
    let rounds = ["fracture.bonds_per_iteration=3", "output.during_breakage=0"];
    let settings = [&settings[..2], &rounds].concat();
    assert_same_path("brazilian-disk/case.toml", 80, &settings);
}

/// Products without a matrix, sums of chunks and the coarse space, along both ways.
#[test]
fn conjugate_gradients() {
    for case in ["brazilian-disk/case.toml", "exact-path/case.toml"] {
        let summary = assert_same_path(case, 30, &[DISK, "solver.method=iterative"]);
        let solver = &summary["solver"];
        assert!(solver["iterations"].as_u64().unwrap() > 300 && solver["method"] == "iterative");
    }
}

#[test]
fn the_patch_correction() {
    let settings = [DISK, "correction.surface=patch"];
    let summary = assert_same_path("brazilian-disk/case.toml", 40, &settings);
    assert!(summary["correction"]["newton_steps"].as_u64().unwrap() > 1);
}

/// A strength that varies at random, of 4800 points.
#[test]
fn random_strengths() {
    let settings = ["lattice.cells=[120, 40]", "lattice.spacing=0.0005"];
    assert_same_path("random-strength/case.toml", 40, &settings);
}

/// Elements that lean on their neighbours, on a lattice of 10,000 points.
#[test]
fn imaginary_elements() {
    assert_same_path("mbb-central-crack/case.toml", 40, &[]);
}

/// Secants that are made anew in each iteration, with what earlier steps have shown.
#[test]
fn bonds_that_soften() {
    let settings = ["lattice.cells=[120, 40]", "fracture.steps=[0.05, 0.075]"];
    let results = assert_same("softening-bar/case.toml", &settings);
    let summary = summary(&results);
    assert!(
        summary["points"].as_u64().unwrap() > 4096,
        "tasks are split"
    );
    let iterations = String::from_utf8_lossy(&results["iterations.csv"]);
    assert!(iterations.lines().count() > 10, "{iterations}");
}

/// A force is given: forces are compared with what is asked for in each step.
#[test]
fn a_force_that_rises() {
    assert_same_path("cracked-plate-force/case.toml", 200, &[]);
}

#[test]
fn natural_modes() {
    let results = assert_same("modal-plate/case.toml", &[]);
    assert!(results.contains_key("modes.csv") && results.contains_key("mode_0005.vtu"));
}
