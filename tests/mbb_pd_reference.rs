//! Imaginary elements against an independent calculation (`tools/reference_mbb_pd.py`), which shares no code with the program:
//! small plates with cracks, a hole, anisotropy and temperature; the order in which bonds break.
#![allow(clippy::unwrap_used, clippy::print_stdout)]

use std::collections::BTreeSet;

use ligament_analysis::Termination;
use ligament_analysis::internal;
use ligament_analysis::state::UnbrokenBonds;
use ligament_model::thermal::ThermalStrain;
use tempfile::TempDir;
use verification::bench::Bench;
use verification::numbers::{by_point, deviation, relative_error, short};
use verification::table::Table;

/// 14 x 11 cells of 2 mm about the origin, held below and moved above.
const PLATE: &str = r#"
lattice = { cells = [14, 11], spacing = 0.002, corner = [-0.014, -0.011], thickness = 0.001, set = { base = { bottom = 1 }, end = { top = 1 } } }
material = { young = 65.8e9, poisson = 0.3 }
model = { law = "mbb-pd", horizon_factor = 3.0 }
support = [{ group = "base", displacement = { x = 0.0, y = 0.0 } }]
load = [{ group = "end", displacement = { x = 1e-5, y = 2e-5 } }]
"#;

/// The pre-cracks of the reference, longer by 1e-9 m: bonds through their ends are cut whatever rounding does.
const CRACKS: &str = "precrack=[\
    { points = [[-0.016, 0.001], [-0.004999999, 0.001]] }, \
    { points = [[0.003999999, -0.007000002], [0.009300001, 0.006100002]] }, \
    { points = [[0.010, -0.002000001], [0.010, 0.013]] }]";

const LAMINA: &str = "material={ young_1 = 120e9, young_2 = 10e9, poisson_12 = 0.3, shear_modulus = 5e9, angle = 0.5235987755982988 }";

const HOLE: &str = "lattice.remove=[{ circle = { centre = [0.0, 0.0], radius = 0.003 } }]";

/// 14 points with (50, 100) N each.
const FORCE: &str = "load=[{ group = \"end\", force = { x = 700.0, y = 1400.0 } }]";

/// The sets of the reference, and the settings that make them.
const SETS: [(&str, &[&str]); 11] = [
    ("stress", &[]),
    ("m2", &["model.horizon_factor=2.0"]),
    ("m4", &["model.horizon_factor=4.0"]),
    ("strain", &["lattice.plane=strain", "material.poisson=0.45"]),
    ("auxetic", &["material.poisson=-0.4"]),
    ("cracks", &[CRACKS]),
    ("cracks-m2", &[CRACKS, "model.horizon_factor=2.0"]),
    ("lamina", &[CRACKS, LAMINA]),
    ("hole", &[HOLE]),
    ("force", &[CRACKS, FORCE]),
    ("thermal", &["load=[]", "material.thermal_expansion=23e-6"]),
];

/// The plate of a set. That with a temperature has its field, dT = 40 + 1000 x - 500 y (K, m), in a file.
fn plate(set: &str, settings: &[&str], folder: &TempDir) -> Bench {
    if set != "thermal" {
        return Bench::new(PLATE, settings);
    }
    let reference = Table::reference("mbb-pd-plate.csv");
    let mut text = "x,y,change\n".to_owned();
    for row in (0..reference.len()).filter(|&row| reference.text(row, "set") == set) {
        let [x, y] = ["x", "y"].map(|column| reference.number(row, column));
        text += &format!("{x},{y},{}\n", 40.0 + 1000.0 * x - 500.0 * y);
    }
    let file = folder.path().join("temperature.csv");
    std::fs::write(&file, text).unwrap();
    let temperature = format!("temperature=[{{ file = {file:?} }}]");
    let settings: Vec<&str> = settings
        .iter()
        .copied()
        .chain([temperature.as_str()])
        .collect();
    Bench::new(PLATE, &settings)
}

/// Displacements of all points, energy, number of bonds and of those that pre-cracks cut, of every set. Two direct solvers on the same
/// well-conditioned equations differ by rounding; 1e-10 leaves room for the condition of 1e5.
#[test]
fn plates_are_those_of_the_independent_calculation() {
    let reference = Table::reference("mbb-pd-plate.csv");
    let summary = Table::reference("mbb-pd-plate-summary.csv");
    let folder = TempDir::new().unwrap();
    for (set, settings) in SETS {
        let bench = plate(set, settings, &folder);
        let row = summary.row_where("set", set);
        let run = bench.solve();
        let cut = bench.model.cut_bonds();
        let bonds = bench.model.plane().bonds.len() + cut;
        assert_eq!(bench.points(), summary.count(row, "points"), "{set}");
        assert_eq!(bonds, summary.count(row, "bonds"), "{set}");
        assert_eq!(cut, summary.count(row, "cut"), "{set}");
        let rows = || (0..reference.len()).filter(|&row| reference.text(row, "set") == set);
        let mut errors = Vec::new();
        for (component, column) in ["ux", "uy"].into_iter().enumerate() {
            let expected: Vec<f64> = rows().map(|row| reference.number(row, column)).collect();
            let found = by_point(bench.model.plane().topology().layout, run.displacement());
            let found: Vec<f64> = found.iter().map(|motion| motion[component]).collect();
            errors.push(deviation(&found, &expected));
        }
        let energy = run.last().stored_energy;
        errors.push(relative_error(energy, summary.number(row, "energy")));
        println!("{set}: u_x, u_y, energy off by {}", short(&errors));
        assert!(
            errors.iter().all(|&error| error < 1e-10),
            "{set}: {errors:?}"
        );
    }
}

/// Strains of the bonds of the plate with cracks and m = 2, by the numbers of their ends; of strains of 1e-3, to rounding times the
/// condition of the displacements.
#[test]
fn strains_of_bonds_beside_cracks() {
    let expected = Table::reference("mbb-pd-bonds.csv");
    let bench = Bench::new(PLATE, &[CRACKS, "model.horizon_factor=2.0"]);
    let run = bench.solve();
    let (system, intact) = (&**bench.model.plane(), &run.state().intact);
    let found = system.deformations(intact, run.displacement(), ThermalStrain::NONE);
    let bonds = &system.bonds;
    let size = 1e-3;
    let mut worst = [0.0_f64; 3];
    for row in 0..expected.len() {
        let tags = ["a", "b"].map(|end| expected.count(row, end) as u64);
        let bond = (0..bonds.len())
            .find(|&bond| bench.tags_of_bond(bond) == tags)
            .unwrap();
        let [xx, yy, xy] = found[bond].strain();
        for (k, (strain, column)) in [(xx, "xx"), (yy, "yy"), (xy, "xy")].into_iter().enumerate() {
            worst[k] = worst[k].max((strain - expected.number(row, column)).abs() / size);
        }
    }
    println!(
        "{} bonds: xx, yy, xy off by {}",
        expected.len(),
        short(&worst)
    );
    assert!(worst.iter().all(|&error| error < 1e-10), "{worst:?}");
}

/// Forces on all points at a unit displacement of one: rows of the stiffness of the plate with cracks, at a corner and beside the ends
/// of two cracks. Sums of some hundred terms of either sign: 1e-13 of the largest.
#[test]
fn stiffness_beside_cracks() {
    let expected = Table::reference("mbb-pd-stiffness.csv");
    let bench = Bench::new(PLATE, &[CRACKS]);
    let system = &**bench.model.plane();
    let intact = vec![true; system.bonds.len()];
    let axis = |row: usize, column: &str| usize::from(expected.text(row, column) == "y");
    let unknown = |row: usize, point: &str, of: &str| {
        let point = expected.count(row, point) - 1;
        system.topology().layout.range(point as u32).start + axis(row, of)
    };
    let moved: BTreeSet<usize> = (0..expected.len())
        .map(|row| unknown(row, "a", "i"))
        .collect();
    assert_eq!(moved.len(), 6);
    for moved in moved {
        let mut u = vec![0.0; system.topology().layout.n_degrees_of_freedom()];
        u[moved] = 1.0;
        let sweep = internal::sweep(
            system,
            UnbrokenBonds::whole(&intact),
            &u,
            ThermalStrain::NONE,
        );
        let mut row_of_stiffness = vec![0.0; u.len()];
        for row in (0..expected.len()).filter(|&row| unknown(row, "a", "i") == moved) {
            row_of_stiffness[unknown(row, "b", "j")] = expected.number(row, "stiffness");
        }
        let error = deviation(&sweep.internal.values, &row_of_stiffness);
        println!("unknown {moved}: {error:.1e}");
        assert!(error < 1e-13, "unknown {moved}: {error:e}");
    }
}

/// The first 50 events of a plate with two pre-cracks that is pulled aslant, bond for bond, with load factor and energy. The two
/// diagonals of a rectangle have the same strains and break together; no other decision of the reference is closer than 2.5e-5.
///
/// A bond passes through (0.0061, 0.0052), where the second pre-crack of the reference ends and cuts it; here it ends 0.1 um beyond.
///
/// 1e-8: rounding times the condition number of the stiffness.
#[test]
fn bonds_break_in_the_order_of_the_independent_calculation() {
    const SQUARE: &str = r#"
lattice = { cells = [20, 20], spacing = 0.001, corner = [-0.01, -0.01], thickness = 0.001, set = { base = { bottom = 1 }, end = { top = 1 }, lower = { bottom = 3 }, upper = { top = 3 } } }
material = { young = 65.8e9, poisson = 0.3, fracture_energy = 6137.0 }
model = { law = "mbb-pd", horizon_factor = 3.0 }
support = [{ group = "base", displacement = { x = 0.0, y = 0.0 } }]
load = [{ group = "end", displacement = { x = 3e-4, y = 1e-3 } }]
no_fail = [{ group = "lower" }, { group = "upper" }]
precrack = [{ points = [[-0.011, -0.0013], [-0.0031, 0.00045]] }, { points = [[0.0022, 0.003], [0.0061001, 0.0052001]] }]
fracture = { control = "event", criterion = [{ kind = "mixed-mode" }] }
"#;
    let expected = Table::reference("mbb-pd-breaks.csv");
    for m in ["3", "2"] {
        let rows: Vec<usize> = (0..expected.len())
            .filter(|&row| expected.text(row, "m") == m)
            .collect();
        let horizon = format!("model.horizon_factor={m}.0");
        let stop = format!("fracture.stop.bonds={}", rows.len());
        let bench = Bench::new(SQUARE, &[&horizon, &stop]);
        let run = bench.break_up();
        let bonds = rows.len();
        assert_eq!(run.outcome.termination, Termination::BondsBroken { bonds });
        assert_eq!(
            (expected.count(rows[bonds - 1], "event"), run.breaks.len()),
            (50, bonds)
        );
        let mut worst = [0.0_f64; 2];
        for (row, record) in rows.into_iter().zip(&run.breaks) {
            let tags = ["a", "b"].map(|end| expected.count(row, end) as u64);
            let event = expected.count(row, "event");
            assert_eq!(
                (record.step, bench.tags_of_bond(record.bond as usize)),
                (event, tags),
                "m = {m}"
            );
            let energy = run.outcome.history[record.step].stored_energy;
            let found = [("factor", record.load_factor), ("energy", energy)];
            for (worst, (column, value)) in worst.iter_mut().zip(found) {
                *worst = worst.max(relative_error(value, expected.number(row, column)));
            }
        }
        println!("m = {m}: factor, energy off by {}", short(&worst));
        assert!(worst.iter().all(|&error| error < 1e-8), "{worst:?}");
    }
}
