//! Fracture of solids from case files: a block of tetrahedra that is split, and runs that must agree with one another.
#![allow(clippy::unwrap_used)]

use std::path::Path;
use std::sync::atomic::{AtomicUsize, Ordering};

use ligament_case::case::CaseFile;
use ligament_output::summary::Build;
use ligament_output::summary::Summary;
use ligament_run::progress::ProgressMode;
use ligament_run::{resume, run};
use verification::bench::run_program;
use verification::repository;
use verification::table::Table;

/// Fracture energy of the case `split-block`, J/m^2.
const FRACTURE_ENERGY: f64 = 20.0;

/// What its starter crack leaves of the plane that comes apart, m^2.
const AREA: f64 = 0.045 * 0.03;

/// Few neighbours, few breakages and the central law: runs of some seconds.
const SHORT: [&str; 3] = [
    "model.horizon_factor=2.0",
    "model.law=pds",
    "fracture.stop.bonds=60",
];

/// Its criterion, and others that look at vectors besides the stretch of a bond.
const CRITERIA: [&[&str]; 3] = [
    &[],
    &[
        "fracture.criterion.0.kind=frictional",
        "material.tensile_strength=3e6",
        "material.compressive_strength=12e6",
    ],
    &[
        "model.law=nhpd",
        "fracture.criterion.0.kind=fibre",
        "fracture.criterion.0.fibre_distance=1e-3",
        "material.tensile_strength=3e6",
    ],
];

/// The case `split-block` with other settings.
fn split_block(settings: &[&str]) -> CaseFile {
    let path = repository().join("cases/split-block/case.toml");
    let settings: Vec<String> = settings.iter().map(|&it| it.to_owned()).collect();
    CaseFile::load(&path, &settings).unwrap()
}

/// Runs the case with other settings and writes its results into a folder.
fn split(settings: &[&str], out: &Path) -> Summary {
    run_program(&split_block(settings), out)
}

/// The last value of a column of the history.
fn last(folder: &Path, column: &str) -> f64 {
    *column_of(folder, "history.csv", column).last().unwrap()
}

/// A column of a table of results.
fn column_of(folder: &Path, table: &str, column: &str) -> Vec<f64> {
    Table::read(&folder.join(table)).column(column)
}

/// The ends of the broken bonds in their order.
fn broken(folder: &Path) -> Vec<[f64; 2]> {
    let a = column_of(folder, "breaks.csv", "node_a");
    let b = column_of(folder, "breaks.csv", "node_b");
    a.into_iter().zip(b).map(|(a, b)| [a, b]).collect()
}

/// The tables that say what happened, without times.
fn tables(folder: &Path) -> [Vec<u8>; 3] {
    ["history.csv", "breaks.csv", "iterations.csv"]
        .map(|name| std::fs::read(folder.join(name)).unwrap())
}

/// The whole block comes apart along the exact path. What broken bonds took is the fracture energy times the area within a tenth,
/// the scatter of such sums on irregular meshes (0.90 to 1.07 on four of this block); what left the body is no less, and work,
/// stored and released energy balance at every breakage to rounding.
#[test]
fn splitting_a_block_takes_the_fracture_energy() {
    let folder = tempfile::tempdir().unwrap();
    let out = folder.path().join("split");
    let summary = split(&["output.fields_every=0"], &out);
    assert_eq!(summary.termination, "load-fraction");
    let dissipated = last(&out, "dissipated_energy") / (FRACTURE_ENERGY * AREA);
    let released = last(&out, "released_energy") / (FRACTURE_ENERGY * AREA);
    assert!((dissipated - 1.0).abs() < 0.1, "{dissipated}");
    assert!(released > dissipated && released < 1.1, "{released}");
    for error in column_of(&out, "history.csv", "energy_error") {
        assert!(error.abs() < 1e-11, "{error}");
    }
}

/// Between breakages all deformations are in proportion to the load, so that load steps which break one bond at a time, the one that is
/// furthest beyond its limit, find the order of the exact path; and a bond breaks in the first step that is not below the largest load
/// of the path up to it.
#[test]
fn load_steps_break_bonds_in_the_order_of_the_exact_path() {
    for criterion in CRITERIA {
        assert_same_order(&[&SHORT[..], criterion].concat());
    }
}

fn assert_same_order(settings: &[&str]) {
    const STEPS: u32 = 400;
    let folder = tempfile::tempdir().unwrap();
    let exact = folder.path().join("exact");
    let stepped = folder.path().join("stepped");
    split(settings, &exact);
    let steps = format!("fracture.steps={STEPS}");
    let one_by_one = [
        "fracture.control=stepped",
        "fracture.bonds_per_iteration=1",
        "fracture.order=ratio",
        &steps,
    ];
    split(&[settings, &one_by_one].concat(), &stepped);
    let path = broken(&exact);
    assert_eq!(path.len(), 60);
    assert_eq!(path, broken(&stepped));
    let mut largest = 0.0_f64;
    let loads = column_of(&exact, "breaks.csv", "load_factor");
    let at = column_of(&stepped, "breaks.csv", "load_factor");
    for (load, at) in loads.into_iter().zip(at) {
        largest = largest.max(load);
        let step = (largest * f64::from(STEPS)).ceil() / f64::from(STEPS);
        assert!((at - step).abs() < 1e-9, "{at} in place of {step}");
    }
}

/// Conjugate gradients to their default tolerance and a factor of the matrix break the same bonds in the same order, at loads that differ
/// by no more than the tie tolerance of 1e-6 that the order of breaking needs.
#[test]
fn both_solvers_break_the_same_bonds() {
    let folder = tempfile::tempdir().unwrap();
    let runs = ["direct", "iterative"].map(|method| {
        let out = folder.path().join(method);
        let method = format!("solver.method={method}");
        split(&[&SHORT[..], &[&method]].concat(), &out);
        (broken(&out), column_of(&out, "breaks.csv", "load_factor"))
    });
    let [(bonds, loads), (others, other_loads)] = runs;
    assert_eq!(bonds, others);
    for (load, other) in loads.iter().zip(other_loads) {
        assert!((load / other - 1.0).abs() < 1e-6, "{load} {other}");
    }
}

/// One thread and two give the same bits, with either solver.
#[test]
fn threads_do_not_change_a_bit() {
    for method in ["direct", "iterative"] {
        let folder = tempfile::tempdir().unwrap();
        let method = format!("solver.method={method}");
        let [one, two] = ["solver.threads=1", "solver.threads=2"].map(|threads| {
            let out = folder.path().join(threads);
            split(&[&SHORT[..], &[&method, threads]].concat(), &out);
            tables(&out)
        });
        assert!(one == two, "{method}");
    }
}

/// A run that is stopped and goes on gives the bits of one that was never stopped, with either solver.
#[test]
fn a_resumed_run_gives_the_same_bits() {
    for method in ["direct", "iterative"] {
        let folder = tempfile::tempdir().unwrap();
        let method = format!("solver.method={method}");
        let settings = [&SHORT[..], &[&method]].concat();
        let whole = folder.path().join("whole");
        split(&settings, &whole);

        let out = folder.path().join("stopped");
        let asked = AtomicUsize::new(0);
        let case = split_block(&settings);
        let request = run::Request {
            is_stopped: &|| asked.fetch_add(1, Ordering::Relaxed) > 20,
            ..run::Request::new(&case, &out, Build::default())
        };
        assert!(request.run(ProgressMode::Quiet).unwrap().is_stopped());
        assert!(broken(&out).len() < 60);
        let request = resume::Request {
            folder: &out,
            mesh: None,
            settings: &[],
            threads: None,
            build: Build::default(),
            communicator: std::sync::Arc::new(ligament_analysis::distributed_matrix::SingleProcess),
            is_stopped: &|| false,
        };
        request.resume(ProgressMode::Quiet).unwrap();
        assert!(tables(&whole) == tables(&out), "{method}");
    }
}
