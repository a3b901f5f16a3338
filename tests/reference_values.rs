//! Every stage of the method against numbers of an independent calculation.
//!
//! Source: `reference/README.md`, which gives the problems and how far the numbers can be trusted. The calculation is
//! plain Python (`tools/reference_nhpd.py`), written from the theory alone. Goal: bonds, factors, strengths, solutions,
//! the order of all breakages and the energies are the same. The meshes are irregular, so that no decision is close: the
//! sequences must agree exactly.
#![allow(clippy::unwrap_used, clippy::print_stdout)]

use ligament_analysis::Termination;
use ligament_analysis::user_message::Place;
use ligament_model::thermal::ThermalStrain;
use verification::bench::{Bench, Run, domain};
use verification::numbers::{component, deviation, largest, relative_error, short};
use verification::problems::DISK;
use verification::table::Table;

/// A square of side 0.1 m, E = 15 GPa, F_t = 3.81 MPa, t = 1 m, pulled upwards by 1e-5 m.
const SQUARE: &str = r#"
mesh = { file = "reference/square.msh", thickness = 1.0, plane = "stress" }
material = { young = 15e9, poisson = 0.21, tensile_strength = 3.81e6 }
model = { law = "nhpd", horizon_factor = 3.0 }
support = [{ group = "bottom", displacement = { y = 0.0 } }, { group = "corner", displacement = { x = 0.0 } }]
load = [{ group = "top", displacement = { y = 1e-5 } }]
fracture = { steps = 1 }
"#;

/// The shared disk with the mesh, the steps and the stop rule of the reference.
const AS_IN_REFERENCE: [&str; 3] = [
    "mesh.file=reference/disk.msh",
    "fracture.steps=100",
    "fracture.stop.load_fraction=0.5",
];

/// Lengths, horizons and length factors are a few operations on the coordinates of the file: rounding of 1e-16 over
/// coordinate differences of 1/20 of the coordinates.
const GEOMETRY: f64 = 1e-12;

/// Omega and s_0 are the end of an iteration whose rounding errors do not grow, but add up over 160 sweeps.
const FACTORS: f64 = 1e-9;

/// Solutions, energies and stretches: rounding times the condition number of the stiffness (1e6 or so).
const SOLUTION: f64 = 1e-8;

/// Name, horizon factor, Poisson's ratio and plane of the parameter sets.
const SETS: [(&str, &str, &str, &str); 5] = [
    ("lambda3", "3", "0.21", "stress"),
    ("lambda2", "2", "0.21", "stress"),
    ("nu038", "3", "0.38", "stress"),
    ("strain027", "3", "0.27", "strain"),
    ("strain030", "3", "0.30", "strain"),
];

fn square(horizon_factor: &str, poisson: &str, plane: &str, more: &[&str]) -> Bench {
    let settings = [
        format!("model.horizon_factor={horizon_factor}"),
        format!("material.poisson={poisson}"),
        "model.poisson=bonds".to_owned(),
        // Reference solutions are of the equations, whether or not the body is stable.
        "model.allow_unstable=true".to_owned(),
        format!("mesh.plane={plane}"),
    ];
    let settings: Vec<&str> = settings.iter().map(String::as_str).collect();
    Bench::new(SQUARE, &[settings, more.to_vec()].concat())
}

/// Bonds by their node tags in the order of the file, with length, horizon, length factor, correction and strength.
#[test]
fn bonds_of_the_square() {
    let summary = Table::reference("square-summary.csv");
    for (set, horizon_factor, poisson, plane) in SETS {
        let bench = square(horizon_factor, poisson, plane, &[]);
        let model = &bench.model;
        let expected = Table::reference(&format!("square-bonds-{set}.csv"));
        let (bonds, row) = (&model.plane().bonds, summary.row_where("set", set));
        assert_eq!(bonds.len(), expected.len(), "{set}: number of bonds");
        assert_eq!(bonds.len(), summary.count(row, "bonds"));
        assert_eq!(domain(model).sweeps, summary.count(row, "sweeps"), "{set}");
        let domain_factor = &model.fixed.domain_factor;
        let length_factor: Vec<f64> = (model.plane().weight.iter().zip(domain_factor))
            .map(|(weight, omega)| weight / omega)
            .collect();
        let numbering = model.body().numbering();
        for (bond, in_model) in bench.bonds_in_file().into_iter().enumerate() {
            let ends = numbering.ordered(bonds.ends[in_model as usize]);
            let tags = ends.map(|end| model.body().tag(end));
            let wanted = ["a", "b"].map(|end| expected.count(bond, end) as u64);
            assert_eq!(tags, wanted, "{set}: ends of bond {bond}");
        }
        let columns: [(&str, &[f64], f64); 5] = [
            ("length", &bonds.length, GEOMETRY),
            ("horizon", &bonds.horizon, GEOMETRY),
            ("alpha", &length_factor, GEOMETRY),
            ("omega", domain_factor, FACTORS),
            ("s0", &model.criteria.list[0].limit, FACTORS),
        ];
        for (column, values, tolerance) in columns {
            let wanted = expected.column(column);
            let values = bench.of_bonds(values);
            let error = largest(wanted.iter().zip(values).map(|(e, v)| v / e - 1.0));
            println!("{set:10} {column:8} {error:.1e}");
            assert!(error < tolerance, "{set}: {column} off by {error:.1e}");
        }
        // Ratios of point energies to the continuum's: biaxial strain and shear, means over the points.
        for (mode, column) in [(2, "biaxial_mean"), (3, "shear_mean")] {
            let ratios = &model.fixed.energy_ratios[mode].at_points;
            let mean = ratios.iter().sum::<f64>() / ratios.len() as f64;
            let error = relative_error(mean, summary.number(row, column));
            assert!(error < FACTORS, "{set}: {column} off by {error:.1e}");
        }
    }
}

/// Displacements, rotations, reaction, energy and the largest s/s_0 of the linear solution.
#[test]
fn solutions_of_the_square() {
    let summary = Table::reference("square-summary.csv");
    for (set, horizon_factor, poisson, plane) in SETS {
        let bench = square(horizon_factor, poisson, plane, &[]);
        let run = bench.solve();
        let expected = Table::reference(&format!("square-displacement-{set}.csv"));
        assert_eq!(bench.points(), expected.len());
        let body = bench.model.body();
        for node in 0..bench.points() {
            let tag = body.tag(body.numbering().point(node as u32));
            assert_eq!(tag, expected.count(node, "node") as u64);
        }
        let displacement = bench.in_file(run.displacement());
        let mut errors = Vec::new();
        for (c, column) in ["ux", "uy", "theta"].iter().enumerate() {
            let error = deviation(&component(&displacement, c), &expected.column(column));
            assert!(error < SOLUTION, "{set}: {column} off by {error:.1e}");
            errors.push(error);
        }
        let row = summary.row_where("set", set);
        let system = &**bench.model.plane();
        let intact = vec![true; system.bonds.len()];
        let deformations = system.deformations(&intact, run.displacement(), ThermalStrain::NONE);
        let ratios = deformations
            .iter()
            .zip(bench.limits())
            .map(|(it, limit)| it.stretch() / limit);
        let largest_ratio = ratios.fold(0.0, f64::max);
        for (name, value, column) in [
            ("reaction", run.last().reaction, "reaction_top"),
            ("energy", run.last().stored_energy, "energy"),
            ("largest s/s_0", largest_ratio, "largest_s_over_s0"),
        ] {
            let error = relative_error(value, summary.number(row, column));
            assert!(error < SOLUTION, "{set}: {name} off by {error:.1e}");
            errors.push(error);
        }
        println!(
            "{set:10} ux, uy, theta, reaction, energy, s/s_0 off by {}",
            short(&errors)
        );
    }
}

/// Where k_t < 0 the rotations give one negative eigenvalue a point. Supports do not touch rotations, and cannot add a
/// negative eigenvalue but may take one away: the 138th of `strain030`, a motion of the free body, may be gone.
#[test]
fn negative_eigenvalues_of_the_square() {
    let summary = Table::reference("square-summary.csv");
    for (set, horizon_factor, poisson, plane) in SETS {
        let bench = square(horizon_factor, poisson, plane, &[]);
        let run = bench.solve();
        let row = summary.row_where("set", set);
        let of_free_body = summary.count(row, "negative_eigenvalues");
        let Some(stability) = run.outcome.stability else {
            assert_eq!(of_free_body, 0, "{set}: k_t < 0 goes unnoticed");
            continue;
        };
        println!("{set:10} {stability:?}, free body {of_free_body}");
        assert_eq!(stability.expected, bench.points(), "{set}");
        assert!(stability.negative <= of_free_body, "{set}");
        assert!(stability.negative >= bench.points(), "{set}");
    }
}

/// Every step of a path, and every breakage in its order.
fn compare_path(bench: &Bench, run: &Run, name: &str, steps: usize) {
    let path = Table::reference(&format!("{name}-path.csv"));
    let breaks = Table::reference(&format!("{name}-breaks.csv"));
    let history = &run.outcome.history[1..];
    let end = &run.outcome.termination;
    assert_eq!(history.len(), steps, "{name}: number of load steps; {end}");
    // What is left of a quantity that went back to zero is rounding of its earlier values.
    let scales = [
        "reaction",
        "stored_energy",
        "external_work",
        "released_energy",
    ]
    .map(|column| 1e-3 * largest(path.column(column)));
    let mut worst = [0.0_f64; 5];
    for (row, step) in history.iter().enumerate() {
        assert_eq!(path.count(row, "step"), step.step);
        let values = [
            ("reaction", step.reaction),
            ("stored_energy", step.stored_energy),
            ("external_work", step.external_work),
            ("released_energy", step.released_energy),
        ];
        for (k, (column, value)) in values.into_iter().enumerate() {
            let expected = path.number(row, column);
            let error = (value - expected).abs() / expected.abs().max(scales[k]);
            worst[k] = worst[k].max(error);
            assert!(
                error < SOLUTION,
                "{name}, step {}: {column} {value:e} instead of {expected:e}",
                step.step
            );
        }
        let displacement = path.number(row, "displacement");
        assert!(relative_error(step.displacement, displacement) < GEOMETRY);
        assert_eq!(
            step.broken_bonds,
            path.count(row, "broken"),
            "{name}, step {}",
            step.step
        );
        assert_eq!(
            run.held[row + 1],
            path.count(row, "loose_unknowns_held"),
            "{name}"
        );
    }
    let broken = path.count(steps - 1, "broken");
    assert_eq!(run.breaks.len(), broken);
    for (row, record) in run.breaks.iter().enumerate() {
        assert_eq!(record.order, breaks.count(row, "order"));
        let bond = (record.step, bench.tags_of_bond(record.bond as usize));
        let tags = ["a", "b"].map(|end| breaks.count(row, end) as u64);
        let expected = (breaks.count(row, "step"), tags);
        assert_eq!(bond, expected, "{name}: breakage {} (step, nodes)", row + 1);
        let error = relative_error(record.ratio, breaks.number(row, "s_over_s0"));
        worst[4] = worst[4].max(error);
        assert!(
            error < SOLUTION,
            "{name}: s/s_0 of breakage {} off by {error:.1e}",
            row + 1
        );
    }
    println!("{name}: {steps} steps, {broken} breakages");
    println!(
        "    reaction, stored, work, released, s/s_0 off by {}",
        short(&worst)
    );
}

/// Square pulled apart: 50 steps to 5e-5 m without a stop rule.
#[test]
fn path_of_the_square() {
    let bench = square(
        "3",
        "0.21",
        "stress",
        &["load.0.displacement.y=5e-5", "fracture.steps=50"],
    );
    let run = bench.break_up();
    compare_path(&bench, &run, "square", 50);
}

/// The same with the stop rule of one half: the run ends after step 31, and is the same up to there.
#[test]
fn stop_rule_of_the_square() {
    let settings = [
        "load.0.displacement.y=5e-5",
        "fracture.steps=50",
        "fracture.stop.load_fraction=0.5",
    ];
    let bench = square("3", "0.21", "stress", &settings);
    let run = bench.break_up();
    assert_eq!(
        run.outcome.termination,
        Termination::LoadFraction { fraction: 0.5 }
    );
    compare_path(&bench, &run, "square", 31);
}

/// Square torn in two by 1e-3 m in 5 steps: after step 4 the upper part may slide along x, and one unknown is held.
///
/// The reference goes on to step 5 with a load of rounding size; the program sees that the body fell apart and ends.
#[test]
fn separation_of_the_square() {
    let bench = square(
        "3",
        "0.21",
        "stress",
        &["load.0.displacement.y=1e-3", "fracture.steps=5"],
    );
    let run = bench.break_up();
    compare_path(&bench, &run, "square-separation", 4);
    assert_eq!(run.outcome.termination, Termination::FellApart);
    let loose = run.messages.iter().filter(|it| it.kind == "parts-detached");
    let places: Vec<Place> = loose.map(|it| it.place).collect();
    assert_eq!(places, [Place::Step(4)], "one part is held");
    let held = run.state().held.iter().filter(|it| **it);
    assert_eq!(held.count(), 1, "one motion is held");
}

/// Brazilian disk: all 100 steps (the stop rule never applies), 922 breakages, through the split at step 45.
#[test]
fn path_of_the_disk() {
    let bench = Bench::new(DISK, &AS_IN_REFERENCE);
    assert_eq!(domain(&bench.model).sweeps, 72);
    let run = bench.break_up();
    compare_path(&bench, &run, "disk", 100);
    let first_peak = run.outcome.first_peak(0.02).unwrap();
    assert!(
        relative_error(first_peak.reaction, 789.5e3) < 1e-4,
        "the README gives four digits"
    );
}

/// First event of the exact path: load factor, displacement and load of the first breakage, from the linear solution.
#[test]
fn first_breakage_of_the_disk() {
    let events = Table::reference("disk-event.csv");
    let first = Bench::new(DISK, &AS_IN_REFERENCE)
        .break_up()
        .outcome
        .first_break
        .unwrap();
    for (column, value) in [
        ("factor", first.load_factor),
        ("displacement", first.displacement),
        ("load", first.reaction),
    ] {
        let error = relative_error(value, events.number(0, column));
        assert!(error < SOLUTION, "{column} off by {error:.1e}");
    }
}
