//! The exact path and load steps with parts of the body left behind, against the same ways with the whole body at each event and after each
//! breakage.
//!
//! What is left behind catches up by other sums, so that numbers agree to rounding times the condition number of the stiffness, and not to
//! the bit: 1e-10 of the largest of their kind. Bonds, and their order, are the same.
#![allow(clippy::unwrap_used, clippy::print_stdout)]

use ligament::run::follow;
use ligament_analysis::driver::Outcome;
use ligament_analysis::history::{BreakRecord, Observer, ObserverError, StepRecord, View};
use ligament_case::case::CaseFile;
use tempfile::TempDir;
use verification::bench::{Bench, run_program};
use verification::numbers::largest;
use verification::problems::{DISK, SQUARE};
use verification::repository;
use verification::table::Table;

/// Parts are those of a dissection, which is taken for large bodies unless it is named.
const DISSECTION: &str = "solver.ordering=nested-dissection";

/// Looks at events that a number divides; 0: at none.
#[derive(Default)]
struct Glance {
    every: usize,
    breaks: Vec<BreakRecord>,
    /// Events of which the whole body was seen, and others.
    seen: [usize; 2],
    /// Solutions of the whole body.
    iterations: usize,
}

impl Observer for Glance {
    fn broke(&mut self, records: &[BreakRecord]) -> Result<(), ObserverError> {
        self.breaks.extend_from_slice(records);
        Ok(())
    }

    fn iteration(&mut self, _: usize, _: f64, _: f64) -> Result<(), ObserverError> {
        self.iterations += 1;
        Ok(())
    }

    fn looks(&self, step: usize) -> bool {
        self.every > 0 && step.is_multiple_of(self.every)
    }

    fn step(&mut self, record: &StepRecord, view: &View<'_>) -> Result<(), ObserverError> {
        assert!(view.is_whole || !self.looks(record.step));
        self.seen[usize::from(!view.is_whole)] += 1;
        Ok(())
    }
}

fn path(bench: &Bench, every: usize) -> (Outcome, Glance) {
    let mut glance = Glance {
        every,
        ..Glance::default()
    };
    let outcome = follow(&bench.problem(), &bench.model.setup.analysis, &mut glance).unwrap();
    (outcome, glance)
}

/// Largest difference of two columns, relative to the largest value of their kind.
fn difference(one: &[f64], other: &[f64], scale: f64) -> f64 {
    assert_eq!(one.len(), other.len());
    let pairs = one.iter().zip(other);
    pairs.map(|(a, b)| (a - b).abs()).fold(0.0, f64::max) / scale
}

/// The numbers of a record by kind: load factor, displacement, forces, energies, probes.
fn numbers(record: &StepRecord) -> [Vec<f64>; 5] {
    let forces = record.group_forces.iter().flatten().copied();
    [
        vec![record.load_factor],
        vec![record.displacement],
        forces.chain([record.reaction]).collect(),
        vec![
            record.stored_energy,
            record.released_energy,
            record.dissipated_energy,
            record.external_work,
        ],
        record.probes.clone(),
    ]
}

/// Compares the bonds, records and last states of two ways, of which the second is that of the whole body.
fn assert_same(name: &str, passed: &(Outcome, Glance), whole: &(Outcome, Glance)) {
    let ((passed, glance), (whole, all)) = (passed, whole);
    assert_eq!(passed.termination, whole.termination, "{name}");
    assert_eq!(glance.breaks.len(), all.breaks.len(), "{name}");
    for (one, other) in glance.breaks.iter().zip(&all.breaks) {
        let key = |it: &BreakRecord| (it.order, it.step, it.round, it.bond, it.criterion);
        assert_eq!(key(one), key(other), "{name}");
        assert!((one.ratio - other.ratio).abs() < 1e-10, "{name}");
    }
    assert_eq!(passed.history.len(), whole.history.len(), "{name}");
    for kind in 0..5 {
        let all = (whole.history.iter()).flat_map(|it| numbers(it)[kind].clone());
        let scale = all.fold(1e-300, |largest: f64, it| largest.max(it.abs()));
        for (one, other) in passed.history.iter().zip(&whole.history) {
            let off = difference(&numbers(one)[kind], &numbers(other)[kind], scale);
            let step = one.step;
            assert!(off < 1e-10, "{name}: step {step}, kind {kind}: {off:.1e}");
        }
    }
    let [one, other] = [passed, whole].map(|it| &it.state.displacement);
    let off = difference(one, other, largest(other.iter().copied()));
    assert!(off < 1e-10, "{name}: displacements {off:.1e}");
    assert_eq!(passed.state.intact, whole.state.intact, "{name}");
}

/// Follows the path looking at each event, at some, and at none; gives the number of bonds that broke.
fn assert_alike(name: &str, bench: &Bench) -> usize {
    let whole = path(bench, 1);
    let broken = whole.1.breaks.len();
    assert_eq!(whole.1.seen[1], 0, "{name}");
    for every in [0, 13] {
        let passed = path(bench, every);
        let [seen, passed_over] = passed.1.seen;
        println!("{name}: {broken} bonds, {seen} events seen, {passed_over} passed over");
        assert!(passed_over > 2 * seen, "{name}");
        assert_same(name, &passed, &whole);
    }
    broken
}

/// Follows load steps with the parts of a dissection, and with minimum degree, which solves the whole body after each breakage; gives the number
/// of bonds that broke.
fn assert_steps_alike(name: &str, mesh: &str, settings: &[&str]) -> usize {
    let [passed, whole] = [DISSECTION, "solver.ordering=minimum-degree"].map(|ordering| {
        let settings = [&[ordering], settings].concat();
        path(&Bench::new(mesh, &settings), 1)
    });
    let broken = whole.1.breaks.len();
    let [few, all] = [&passed, &whole].map(|it| it.1.iterations);
    println!("{name}: {broken} bonds, {few} solutions of the whole body instead of {all}");
    assert!(2 * few < all, "{name}: {few}, {all}");
    assert_same(name, &passed, &whole);
    broken
}

const EVENT: &str = "fracture={ control = \"event\", stop = { bonds = 400 } }";

/// Beams and springs, several criteria, motions and forces as loads, and probes.
#[test]
fn disks_break_the_same_bonds() {
    const THIRD: &str = "material.poisson=0.333333333333333333";
    const FORCE: &str = "load=[{ group = \"platen-top\", force = { y = -1e6 } }]";
    const PROBE: &str =
        "probe=[{ name = \"widening\", between = [[-0.04, 0.0], [0.04, 0.0]], component = \"x\" }]";
    let many: [(&str, &[&str]); 7] = [
        ("nhpd", &[]),
        ("cells", &["material.poisson=0.4"]),
        (
            "cells, bbpd",
            &[
                "model.law=bbpd",
                "material.poisson=0.45",
                "mesh.plane=strain",
            ],
        ),
        ("bbpd", &["model.law=bbpd", THIRD]),
        ("pds", &["model.law=pds"]),
        ("force", &[FORCE]),
        ("probe", &[PROBE]),
    ];
    for (name, settings) in many {
        let settings: Vec<&str> = [&[EVENT, DISSECTION], settings].concat();
        let broken = assert_alike(name, &Bench::new(DISK, &settings));
        assert!(broken >= 200, "{name}: {broken}");
    }
}

/// Strengths at random, so that the next bond is anywhere: a bound that is too low anywhere would leave it behind.
#[test]
fn strengths_at_random_leave_no_bond_behind() {
    for seed in 1..=7 {
        // The last two with cells that carry a part of the stiffness.
        let poisson = match seed {
            6 => "material.poisson=0.38",
            7 => "material.poisson=0.45",
            _ => "material.poisson=0.21",
        };
        let scatter = format!(
            "fracture={{ control = \"event\", stop = {{ bonds = 300 }}, scatter = {{ of = \"strength\", distribution = \"weibull\", \
             modulus = 6.0, correlation_length = 0.01, seed = {seed} }} }}"
        );
        let bench = Bench::new(DISK, &[&scatter, DISSECTION, poisson]);
        assert_eq!(assert_alike(&format!("seed {seed}"), &bench), 300);
    }
}

/// Stresses around bonds depend on bonds of other parts: bounds that forget one of these would leave the next bond behind.
#[test]
fn stresses_leave_no_bond_behind() {
    const CRITERIA: [&str; 2] = ["{ kind = \"bond-rankine\" }", "{ kind = \"mohr-coulomb\" }"];
    const CRUSHED: &str = "material.compressive_strength=38.1e6";
    for (criterion, seed) in CRITERIA.iter().zip(1..) {
        let scatter = format!(
            "fracture={{ control = \"event\", criterion = [{criterion}], stop = {{ bonds = 150 }}, scatter = {{ of = \"strength\", \
             distribution = \"weibull\", modulus = 6.0, correlation_length = 0.01, seed = {seed} }} }}"
        );
        let even = format!(
            "fracture={{ control = \"event\", criterion = [{criterion}], stop = {{ bonds = 150 }} }}"
        );
        for fracture in [scatter, even] {
            let bench = Bench::new(DISK, &[&fracture, CRUSHED, DISSECTION]);
            assert!(assert_alike(criterion, &bench) > 100);
        }
    }
}

/// A square that is torn apart, and loses points on the way.
#[test]
fn a_square_is_torn_apart_alike() {
    for seed in [1, 2] {
        let scatter = format!(
            "fracture={{ control = \"event\", scatter = {{ of = \"strength\", distribution = \"weibull\", modulus = 1.0, \
             correlation_length = 0.0001, seed = {seed} }} }}"
        );
        let bench = Bench::new(
            SQUARE,
            &[&scatter, "load.0.displacement.y=5e-3", DISSECTION],
        );
        assert!(assert_alike("square", &bench) > 100);
        let history = path(&bench, 0).0.history;
        let loose = history.iter().filter(|it| it.fragments > 1);
        assert!(loose.count() > 2, "no point came loose on the way");
    }
}

/// The last numbers of the tables of two runs of a solid: along the exact path one writes fields at each event, in load steps one has no parts.
#[test]
fn solids_break_the_same_bonds() {
    let events = [1, 0].map(|every| {
        [
            DISSECTION.to_owned(),
            format!("output.fields_every={every}"),
        ]
    });
    let path = |criterion: &str, bonds: usize| {
        format!(
            "fracture={{ control = \"event\", criterion = [{{ kind = \"{criterion}\" }}], stop = {{ bonds = {bonds} }} }}"
        )
    };
    assert_solids_alike(&path("bond-energy", 300), 300, &events);
    assert_solids_alike(&path("bond-rankine", 100), 100, &events);
    let steps = ["solver.ordering=minimum-degree", DISSECTION]
        .map(|ordering| [ordering.to_owned(), "output.fields_every=0".to_owned()]);
    let rounds = "fracture={ steps = 8, bonds_per_iteration = 1, criterion = [{ kind = \"bond-energy\" }], stop = { bonds = 200 } }";
    assert_solids_alike(rounds, 200, &steps);
}

fn assert_solids_alike(fracture: &str, bonds: usize, ways: &[[String; 2]; 2]) {
    let path = repository().join("cases/split-block/case.toml");
    let folder = TempDir::new().unwrap();
    let [whole, passed] = [0, 1].map(|way| {
        let fixed = [
            "solver.method=direct",
            "model.horizon_factor=2.0",
            "material.tensile_strength=3e6",
            fracture,
        ];
        let settings = [&fixed.map(str::to_owned)[..], &ways[way]].concat();
        let out = folder.path().join(way.to_string());
        run_program(&CaseFile::load(&path, &settings).unwrap(), &out);
        ["breaks.csv", "history.csv", "iterations.csv"].map(|name| Table::read(&out.join(name)))
    });
    assert_eq!(whole[0].len(), bonds, "{fracture}");
    for column in ["order", "step", "node_a", "node_b"] {
        assert_eq!(
            whole[0].column(column),
            passed[0].column(column),
            "{column}"
        );
    }
    for column in [
        "load_factor",
        "reaction",
        "stored_energy",
        "released_energy",
        "dissipated_energy",
    ] {
        let [one, other] = [&passed, &whole].map(|it| it[1].column(column));
        let off = difference(&one, &other, largest(other.iter().copied()));
        assert!(off < 1e-10, "{column}: {off:.1e}");
    }
    // An event that is passed over has no iteration of the whole body.
    assert!(3 * passed[2].len() < whole[2].len());
}

/// Load steps that break bonds of several laws one by one and in groups, by several criteria, in both orders, and with a correction at the
/// surface.
#[test]
fn load_steps_break_the_same_bonds() {
    const ONE: &str = "fracture={ steps = 8, bonds_per_iteration = 1, stop = { bonds = 300 } }";
    const FIVE: &str = "fracture={ steps = 8, order = \"ratio\", stop = { bonds = 800 } }";
    const STRESS: &str = "fracture={ steps = 8, criterion = [{ kind = \"bond-rankine\" }], bonds_per_iteration = 2, stop = { bonds = 200 } }";
    const ENERGY: &str = "fracture={ steps = 8, criterion = [{ kind = \"bond-energy\" }], bonds_per_iteration = 1, stop = { bonds = 100 } }";
    const SCATTER: &str = "fracture={ steps = 8, bonds_per_iteration = 3, stop = { bonds = 300 }, scatter = { of = \"strength\", \
         distribution = \"weibull\", modulus = 6.0, correlation_length = 0.01, seed = 3 } }";
    let many: [(&str, &[&str]); 8] = [
        ("one by one", &[ONE]),
        ("by ratio", &[FIVE]),
        ("by stress", &[STRESS]),
        ("by energy", &[ENERGY, "material.fracture_energy=20.0"]),
        ("cells", &[FIVE, "material.poisson=0.4"]),
        ("patch", &[ONE, "correction.surface=patch"]),
        ("scatter", &[SCATTER]),
        (
            "bbpd",
            &[
                FIVE,
                "model.law=bbpd",
                "material.poisson=0.333333333333333333",
            ],
        ),
    ];
    for (name, settings) in many {
        let broken = assert_steps_alike(name, DISK, settings);
        assert!(broken >= 100, "{name}: {broken}");
    }
}

/// A square that is torn apart in load steps, and loses points on the way.
#[test]
fn load_steps_tear_a_square_apart_alike() {
    let scatter = "fracture={ steps = [0.02, 0.1, 1.0], bonds_per_iteration = 1, scatter = { of = \"strength\", distribution = \"weibull\", modulus = 1.0, \
         correlation_length = 0.0001, seed = 2 } }";
    let broken = assert_steps_alike("square", SQUARE, &[scatter, "load.0.displacement.y=5e-3"]);
    assert!(broken > 100, "{broken}");
}
