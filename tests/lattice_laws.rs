//! The laws on regular lattices against an independent calculation (`tools/reference_lattice.py`), which shares no code with the
//! program: plates under load, natural frequencies, and the elastic constants of infinite lattices.
#![allow(clippy::unwrap_used, clippy::print_stdout)]

use ligament_analysis::internal;
use ligament_analysis::state::UnbrokenBonds;
use ligament_model::interface::StressReading;
use ligament_model::moduli::{EngineeringConstants, family_stiffness};
use ligament_model::thermal::ThermalStrain;
use ligament_run::progress::ProgressMode;
use ligament_run::run;
use tempfile::TempDir;
use verification::bench::{self, Bench};
use verification::numbers::{by_point, deviation, of_all, relative_error};
use verification::stresses::of_reading;
use verification::table::Table;

/// 12 x 8 cells of 5 mm around the origin, held at the left and pulled aslant at the right.
const PLATE: &str = r#"
lattice = { cells = [12, 8], spacing = 0.005, corner = [-0.03, -0.02], thickness = 0.001, set = { base = { left = 2 }, end = { right = 1 } } }
material = { young = 70e9, poisson = 0.2, density = 2500 }
model = { law = "mppd", horizon_factor = 3.0 }
support = [{ group = "base", displacement = { x = 0.0, y = 0.0, rotation = 0.0 } }]
load = [{ group = "end", force = { x = 8e3, y = -4e3 } }]
"#;

const LAMINA: &str = "material={ young_1 = 15e9, young_2 = 5e9, poisson_12 = 0.25, shear_modulus = 4.8e9, angle = 0.5235987755982988, density = 2500 }";

const HOLE: &str = "lattice.remove=[{ circle = { centre = [0.0, 0.0], radius = 0.004 } }]";

/// The sets of the reference, and the settings that make them.
const SETS: [(&str, &[&str]); 14] = [
    (
        "bbpd",
        &["model.law=bbpd", "material.poisson=0.333333333333333333"],
    ),
    ("pds", &["model.law=pds"]),
    ("pds-strain", &["model.law=pds", "lattice.plane=strain"]),
    ("mppd", &[]),
    ("mppd-strain", &["lattice.plane=strain"]),
    ("mppd-no-surface", &["correction.surface=none"]),
    (
        "mppd-no-partial",
        &["correction.alpha=none", "correction.surface=none"],
    ),
    ("mppd-quarter", &["model.rotational_stiffness=quarter"]),
    (
        "mppd-negative",
        &["material.poisson=0.4", "model.poisson=bonds"],
    ),
    ("mppd-hole", &[HOLE]),
    (
        "beam",
        &["model.law=mppd-beam", "model.calibration=integral"],
    ),
    (
        "beam-strain",
        &[
            "model.law=mppd-beam",
            "model.calibration=integral",
            "lattice.plane=strain",
        ],
    ),
    ("beam-discrete", &["model.law=mppd-beam"]),
    ("orthotropic", &["model.law=orthotropic", LAMINA]),
];

/// Displacements of all points, energy and number of bonds of every set. Two direct solvers on the same well-conditioned
/// equations differ by rounding; 1e-10 leaves room for the condition of 1e5.
#[test]
fn plates_are_those_of_the_independent_calculation() {
    let reference = Table::reference("lattice-plate.csv");
    let summary = Table::reference("lattice-plate-summary.csv");
    for (set, settings) in SETS {
        let bench = Bench::new(PLATE, settings);
        let row = summary.row_where("set", set);
        assert_eq!(bench.points(), summary.count(row, "points"), "{set}");
        assert_eq!(
            bench.model.plane().bonds.len(),
            summary.count(row, "bonds"),
            "{set}"
        );
        let run = bench.solve();
        let rows: Vec<usize> = (0..reference.len())
            .filter(|&row| reference.text(row, "set") == set)
            .collect();
        assert_eq!(rows.len(), bench.points(), "{set}");
        for (component, column) in ["ux", "uy", "theta"].into_iter().enumerate() {
            let expected: Vec<f64> = rows
                .iter()
                .map(|&row| reference.number(row, column))
                .collect();
            let motions = by_point(bench.model.plane().topology().layout, run.displacement());
            let found: Vec<f64> = motions.iter().map(|it| it[component]).collect();
            let error = deviation(&found, &expected);
            let is_zero = expected.iter().all(|&value| value == 0.0);
            println!("{set} {column}: {error:.1e}");
            assert!(
                if is_zero {
                    found == expected
                } else {
                    error < 1e-10
                },
                "{set} {column}: {error:e}"
            );
        }
        let error = relative_error(run.last().stored_energy, summary.number(row, "energy"));
        assert!(error < 1e-11, "{set}: energy {error:e}");
    }
}

/// The three lowest frequencies of the same plates by the whole program. Eigenvalues of a lumped mass are as accurate as the
/// solves; `mppd-negative` has none in the reference.
#[test]
fn frequencies_are_those_of_the_independent_calculation() {
    let summary = Table::reference("lattice-plate-summary.csv");
    for (set, settings) in SETS {
        let row = summary.row_where("set", set);
        if summary.text(row, "f1").is_empty() {
            continue;
        }
        let text: Vec<&str> = PLATE
            .lines()
            .filter(|line| !line.starts_with("load"))
            .collect();
        let case = bench::case(
            &format!(
                "analysis = \"modal\"\n{}\nmodal = {{ modes = 3 }}",
                text.join("\n")
            ),
            settings,
        );
        let folder = TempDir::new().unwrap();
        let out = folder.path().join("out");
        run::run(&case, &out, false, ProgressMode::Quiet).unwrap();
        let modes = Table::read(&out.join("modes.csv"));
        for (mode, column) in ["f1", "f2", "f3"].into_iter().enumerate() {
            let error = relative_error(
                modes.number(mode, "frequency_hz"),
                summary.number(row, column),
            );
            assert!(error < 1e-9, "{set} {column}: {error:e}");
        }
    }
}

/// What the calibrations of the reference are called here.
const CALIBRATIONS: [(&str, &[&str]); 8] = [
    ("central", &["model.law=bbpd", "correction.surface=none"]),
    ("central-lambda", &["model.law=bbpd"]),
    ("constant", &["model.law=mppd", "correction.surface=none"]),
    ("constant-lambda", &["model.law=mppd"]),
    (
        "constant-discrete",
        &["model.law=mppd", "model.calibration=discrete"],
    ),
    (
        "beam",
        &[
            "model.law=mppd-beam",
            "model.calibration=integral",
            "correction.surface=none",
        ],
    ),
    (
        "beam-lambda",
        &["model.law=mppd-beam", "model.calibration=integral"],
    ),
    ("beam-discrete", &["model.law=mppd-beam"]),
];

/// Effective E, nu and G of infinite lattices for m = 2 to 8, all laws, calibrations and Poisson's ratios, in both planes: the
/// family in the middle of a lattice that is large enough for the families of its members to be whole. MPPD section 3.
#[test]
fn moduli_are_those_of_the_infinite_lattice() {
    let reference = Table::reference("lattice-moduli.csv");
    let mut largest: f64 = 0.0;
    for row in 0..reference.len() {
        let (plane, m) = (reference.text(row, "plane"), reference.text(row, "m"));
        let nu = match reference.text(row, "nu") {
            "1/3" => 1.0 / 3.0,
            "1/4" => 0.25,
            number => number.parse().unwrap(),
        };
        let calibration = reference.text(row, "calibration");
        let (_, settings) = CALIBRATIONS
            .into_iter()
            .find(|(name, _)| *name == calibration)
            .unwrap();
        let reach = m.parse::<f64>().unwrap().floor() as usize;
        let cells = 4 * reach + 1;
        let own = [
            format!("material.poisson={nu:?}"),
            format!("lattice.plane={plane}"),
            format!("model.horizon_factor={m}"),
            format!("lattice.cells=[{cells}, {cells}]"),
        ];
        let all: Vec<&str> = own
            .iter()
            .map(String::as_str)
            .chain(settings.iter().copied())
            .collect();
        let system = Bench::new(PLATE, &all).model.plane().clone();
        let middle = (cells * cells / 2) as u32;
        let in_plane =
            EngineeringConstants::from_stiffness(family_stiffness(&system, middle)).unwrap();
        let found = as_plane(plane, in_plane);
        let shear = 70e9 / (2.0 * (1.0 + nu));
        let expected = ["young", "poisson", "shear"].map(|column| reference.number(row, column));
        let found = [found[0] / 70e9, found[1], found[2] / shear];
        let error = (0..3)
            .map(|k| (found[k] - expected[k]).abs())
            .fold(0.0, f64::max);
        // Rounding of sums of 200 terms.
        assert!(
            error < 1e-12,
            "{plane} {calibration} nu {nu} m {m}: {found:?}, {expected:?}"
        );
        largest = largest.max(error);
    }
    println!(
        "{} lattices, largest difference {largest:.1e}",
        reference.len()
    );
}

/// E, nu and G of the material whose constants in the plane are given: plane strain shows E/(1 - nu^2) and nu/(1 - nu).
fn as_plane(plane: &str, constants: EngineeringConstants) -> [f64; 3] {
    let (young, poisson) = (constants.young[0], constants.poisson[0][1]);
    let shear_modulus = constants.shear_modulus.at(0, 1);
    if plane == "stress" {
        return [young, poisson, shear_modulus];
    }
    let nu = poisson / (1.0 + poisson);
    [young * (1.0 - nu * nu), nu, shear_modulus]
}

/// Stresses of uniform strains on a lattice, two horizons from its sides, against Hooke's law in plane stress: 1 % of the largest
/// component, which is what the infinite lattice of m = 3 misses its moduli by (0.8 %). Both readings, tension along x and shear.
#[test]
fn uniform_strains_of_a_lattice_have_the_stress_of_the_continuum() {
    let (young, poisson) = (70e9, 0.25);
    for law in ["model.law=pds", "model.law=mppd"] {
        let settings = [law, "material.poisson=0.25", "lattice.cells=[25, 25]"];
        let bench = Bench::new(PLATE, &settings);
        let system = &**bench.model.plane();
        let intact = vec![true; system.bonds.len()];
        let inner: Vec<usize> = (0..bench.points())
            .filter(|&point| {
                system.cloud.positions[point]
                    .iter()
                    .all(|x| x.abs() < 0.031)
            })
            .collect();
        assert_eq!(inner.len(), 13 * 13);
        let reduced = young / (1.0 - poisson * poisson);
        let shear = young / (2.0 * (1.0 + poisson));
        let strains: [([f64; 3], [f64; 3]); 2] = [
            (
                [1e-4, 0.0, 0.0],
                [reduced * 1e-4, poisson * reduced * 1e-4, 0.0],
            ),
            ([0.0, 0.0, 1e-4], [0.0, 0.0, shear * 2e-4]),
        ];
        for ([xx, yy, xy], expected) in strains {
            let motion = |p: &[f64; 2]| [xx * p[0] + xy * p[1], xy * p[0] + yy * p[1], 0.0];
            let u = of_all(
                system.topology().layout,
                system.cloud.positions.iter().map(motion),
            );
            let deformations = internal::sweep(
                system,
                UnbrokenBonds::whole(&intact),
                &u,
                ThermalStrain::NONE,
            )
            .deformations;
            let left = UnbrokenBonds::whole(&intact);
            let virial = of_reading(StressReading::Virial, system, left, &deformations);
            let traction: Vec<[f64; 4]> =
                of_reading(StressReading::Traction, system, left, &deformations);
            let largest: f64 = expected
                .iter()
                .fold(0.0, |most: f64, value| most.max(value.abs()));
            let mut worst = [0.0_f64; 2];
            for &point in &inner {
                let [t_xx, t_yx, t_yy, t_xy] = traction[point];
                let both = [virial[point], [t_xx, t_yy, 0.5 * (t_xy + t_yx)]];
                for (worst, found) in worst.iter_mut().zip(both) {
                    let miss = |k: usize| (found[k] - expected[k]).abs() / largest;
                    *worst = (0..3).map(miss).fold(*worst, f64::max);
                }
            }
            println!(
                "{law} {xx} {xy}: virial {:.4}, traction {:.4}",
                worst[0], worst[1]
            );
            assert!(worst[0] < 0.01 && worst[1] < 0.01, "{law}: {worst:?}");
        }
    }
}
