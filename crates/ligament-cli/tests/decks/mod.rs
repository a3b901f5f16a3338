//! `ligament new` of input decks: cases that check, values in SI units, and displacements against CalculiX.

#![allow(clippy::unwrap_used, reason = "a failed unwrap fails the test")]

use std::fs;
use std::path::{Path, PathBuf};

use tempfile::TempDir;

use crate::support::{assert_success, ligament_in, stderr, stdout, text};

fn decks() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/decks")
}

/// The case of a deck in a folder, as text, with what the command says; an error with its message. Decks without a folder are those beside
/// this file.
fn case(folder: &Path, deck: &str, units: &str) -> Result<(String, String), String> {
    let file = decks().join(deck).with_extension("inp");
    let path = file.to_str().unwrap();
    let made = ligament_in(folder, &["new", path, "--units", units, "--force"]);
    match made.status.success() {
        true => {
            let case = fs::read_to_string(folder.join("case.toml")).unwrap();
            Ok((case, text(&made.stderr) + &stdout(&made)))
        }
        false => Err(stderr(&made)),
    }
}

/// Decks of the kinds that public repositories have, with their units and lines that their cases have, in SI units by hand.
const ACCEPTED: [(&str, &str, &[&str]); 34] = [
    (
        "plate-tension",
        "mm-N-MPa",
        &[
            "title = \"A plate in tension\"",
            "scale = 0.001",
            "thickness = 0.005 # m",
            "plane = \"stress\"",
            "young = 2.1e11 # Pa",
            "density = 7850.0 # kg/m^3",
            // Eleven nodes of 500 N.
            "force = { x = 5500.0 } # N in total",
            "profile = { file = \"plate-tension-factor-1.csv\" }",
        ],
    ),
    (
        "annulus",
        "mm-N-MPa",
        &[
            "plane = \"strain\"",
            "group = \"INSIDE.P4\"\npressure = 1e8 # Pa",
        ],
    ),
    (
        "dam",
        "m-N-Pa",
        &["acceleration = { y = -9.81 }", "density = 2400.0"],
    ),
    // 1e7 psi, and 81 nodes of 10 lbf.
    (
        "cantilever",
        "in-lbf-psi",
        &[
            "young = 6.89475729317e10",
            "scale = 0.0254",
            "force = { z = -3603.05950836 }",
        ],
    ),
    ("tetra-bar", "mm-N-MPa", &["displacement = { x = 6e-5 }"]),
    (
        "cae-plate",
        "m-N-Pa",
        &[
            "group = \"Set-1\"\ndisplacement = { x = 0.0, y = 0.0, rotation = 0.0 }",
            "group = \"Surf-1\"\npressure = 1e6",
        ],
    ),
    (
        "cae-two-parts",
        "m-N-Pa",
        &[
            "*TIE, NAME=Joint, ADJUST=yes: parts are joined",
            "young = 5e10",
        ],
    ),
    ("calculix", "mm-N-MPa", &["force = { x = 550.0 }"]),
    (
        "thermal",
        "mm-N-MPa",
        &[
            "thermal_expansion = 1.2e-5",
            "[[temperature]]\nchange = 100.0 # K",
        ],
    ),
    (
        "bimetal",
        "mm-N-MPa",
        &[
            "[material.BRASS]\ngroup = \"LOWER\"\nyoung = 1e11",
            "[material.STEEL]\ngroup = \"UPPER\"",
        ],
    ),
    (
        "impact",
        "m-N-Pa",
        &["[motion]\nduration = 2e-5", "velocity = { x = -5.0 }"],
    ),
    (
        "pulse",
        "mm-N-MPa",
        &[
            "amplitude = { points = [[0.0, 0.0], [2e-6, 1.0], [4e-6, 0.0]] }",
            "pressure = 1e8",
        ],
    ),
    (
        "steps",
        "mm-N-MPa",
        // The second step halves the force to the right, the third one takes it away.
        &[
            "loads = { \"cload-34-x\" = 1.0 }",
            "\"cload-34-x\" = 0.5",
            "\"cload-34-x\" = 0.0, \"cload-40-y\" = 2.0",
        ],
    ),
    (
        "cycle",
        "mm-N-MPa",
        &["= [[0.333333333333, 1.0], [0.666666666667, -1.0], [1.0, 0.0]]"],
    ),
    (
        "pressure",
        "mm-N-MPa",
        &[
            "group = \"FRONT\"\npressure = 5e7",
            "force_per_area = { z = 5e6 }",
        ],
    ),
    ("column", "m-N-Pa", &["acceleration = { z = -9.81 }"]),
    ("equation", "mm-N-MPa", &["displacement = { x = 1e-4 }"]),
    (
        "periodic",
        "mm-N-MPa",
        &["*EQUATION: of equations a case has those"],
    ),
    (
        "rigid-body",
        "mm-N-MPa",
        &["group = \"RIGHT\"\ndisplacement = { x = 1e-4 }"],
    ),
    (
        "coupling",
        "mm-N-MPa",
        &["tilts = true\nforce = { x = 1000.0 }"],
    ),
    (
        "distributing",
        "mm-N-MPa",
        &["force = { z = -1000.0 }", "degree of freedom"],
    ),
    (
        "contact",
        "m-N-Pa",
        &["*CONTACT PAIR, INTERACTION=IntProp-1: a case has [[contact]]"],
    ),
    (
        "cohesive",
        "m-N-Pa",
        &["*COHESIVE SECTION", "*DAMAGE INITIATION", "young = 3e9"],
    ),
    ("c3d20", "mm-N-MPa", &["displacement = { z = -1e-4 }"]),
    // Consistent forces of 10 edges of 6 times 100/6 N.
    ("cps8", "mm-N-MPa", &["force = { x = 1000.0"]),
    (
        "nodal-forces",
        "mm-N-MPa",
        &["[material] # CALCULIX-STEEL", "force = { z = -400.0 }"],
    ),
    (
        "element-pressure",
        "mm-N-MPa",
        &["pressure = 1e7", "pressure = 2e7"],
    ),
    (
        "frequency",
        "mm-N-MPa",
        &["analysis = \"modal\"", "[modal]\nmodes = 4"],
    ),
    (
        "implicit",
        "mm-N-MPa",
        &[
            "scheme = \"implicit\"\nstep = 1e-6",
            "shape = \"smooth-ramp\", start = 0.0, duration = 1e-4",
        ],
    ),
    ("velocity", "m-N-Pa", &["velocity = { x = 2.0 }"]),
    (
        "plastic",
        "mm-N-MPa",
        &[
            "plastic.inp:23 *ELASTIC: constants that depend on temperature",
            "plastic.inp:24 *PLASTIC: the material is elastic",
            "plastic.inp:32 *STEP, NLGEOM, INC=100: NLGEOM",
            "displacement = { x = 0.0, rotation = 0.0 }",
        ],
    ),
    (
        "orthotropic",
        "mm-N-MPa",
        &["*ELASTIC, TYPE=LAMINA", "young = 3e10 # Pa, EXAMPLE"],
    ),
    (
        "prisms",
        "mm-N-MPa",
        &[
            "displacement = { x = 0.0, y = 0.0, z = 0.0, rotation_x = 0.0, rotation_y = 0.0, rotation_z = 0.0 }",
        ],
    ),
    (
        "shells",
        "mm-N-MPa",
        &[
            "thickness = 0.002",
            "shells or membranes read as plane cells",
        ],
    ),
];

/// Cases of 34 kinds of decks pass the check and have the values of the deck in SI units.
#[test]
fn decks_give_cases_that_check() {
    let folder = TempDir::new().unwrap();
    for (deck, units, lines) in ACCEPTED {
        let (case, _) = case(folder.path(), deck, units).unwrap();
        for line in lines {
            assert!(case.contains(line), "{deck}: {line}\n{case}");
        }
        let checked = ligament_in(folder.path(), &["check", "case.toml"]);
        assert!(
            checked.status.success(),
            "{deck}: {}\n{case}",
            stderr(&checked)
        );
    }
}

/// Decks without a body that the program has are refused, and other arguments that do not fit.
#[test]
fn decks_without_a_body_are_refused() {
    let folder = TempDir::new().unwrap();
    for (deck, reason) in [
        ("axisymmetric", "CAX4"),
        ("truss", "no plane or solid elements"),
    ] {
        let message = case(folder.path(), deck, "m-N-Pa").unwrap_err();
        assert!(message.contains(reason), "{deck}: {message}");
        assert!(!folder.path().join("case.toml").exists());
    }
    let message = case(folder.path(), "dam", "furlong-stone").unwrap_err();
    assert!(message.contains("mm-N-MPa"), "{message}");
}

/// A warning tells of numbers that look like millimetres where no units are given; the message counts what is not carried out.
#[test]
fn numbers_of_other_units_are_warned_of() {
    let folder = TempDir::new().unwrap();
    let deck = decks().join("plastic.inp");
    let made = ligament_in(folder.path(), &["new", deck.to_str().unwrap()]);
    assert_success(&made);
    let said = stderr(&made) + &stdout(&made);
    assert!(
        said.contains("--units (mm-N-MPa, mm-kN-GPa, in-lbf-psi)"),
        "{said}"
    );
    assert!(said.contains("not carried out of the deck: 3;"), "{said}");
    // Neither the case nor its mesh is replaced without consent.
    let mesh = folder.path().join("plastic.msh");
    fs::remove_file(folder.path().join("case.toml")).unwrap();
    fs::write(&mesh, "mine").unwrap();
    let again = ligament_in(folder.path(), &["new", deck.to_str().unwrap()]);
    assert!(stderr(&again).contains("plastic.msh"), "{}", stderr(&again));
    assert_eq!(fs::read_to_string(&mesh).unwrap(), "mine");
    assert!(!folder.path().join("case.toml").exists());
}

/// Nodes with two values of a component have the last one: the corner of two edges of a plate.
#[test]
fn the_last_value_holds() {
    let folder = TempDir::new().unwrap();
    let (case, _) = case(folder.path(), "last-holds", "mm-N-MPa").unwrap();
    // TOP loses its support along y; RIGHT moves as a whole, with its corners.
    assert!(
        case.contains("group = \"TOP\"\ndisplacement = { x = 0.0 }"),
        "{case}"
    );
    let loads: Vec<&str> = case.split("[[load]]").skip(1).collect();
    assert!(loads[0].contains("displacement = { y = -5e-5 }"), "{case}");
    assert!(!loads[0].contains("group = \"TOP\""), "{case}");
    assert!(
        loads[1].contains("group = \"RIGHT\"\ndisplacement = { y = 1e-5 }"),
        "{case}"
    );
    assert_success(&ligament_in(folder.path(), &["check", "case.toml"]));
}

/// A later step that would change a part of an earlier load is named, and the whole of the earlier load stays; for the same set it gets the
/// new value.
#[test]
fn parts_of_earlier_loads_do_not_change() {
    let folder = TempDir::new().unwrap();
    let text = fs::read_to_string(decks().join("steps.inp")).unwrap();
    let deck = folder.path().join("part.inp");
    fs::write(&deck, text.replacen("RIGHT, 1, 50.", "21, 1, 50.", 1)).unwrap();
    let (case, _) = case(folder.path(), deck.to_str().unwrap(), "mm-N-MPa").unwrap();
    let named = "part.inp:39 *CLOAD: it would change a part of a load of an earlier step";
    assert!(case.contains(named), "{case}");
    assert!(
        case.contains("name = \"PRESS\"\nloads = { \"cload-40-y\" = 1.0 }"),
        "{case}"
    );
    assert_success(&ligament_in(folder.path(), &["check", "case.toml"]));
}

/// Displacements of a node by CalculiX 2.20 on the same mesh (`tools/calculix_displacements.py DECK NODE`), in units of the deck: deck,
/// place, axis and displacement, m. Bonds and elements are two discretisations of one body, whose errors on these meshes are up to 2 %.
const CALCULIX: [(&str, &str, [&str; 2], f64); 5] = [
    ("dam", "m-N-Pa", ["[5.0, 20.0]", "y"], -1.80246e-4),
    ("annulus", "mm-N-MPa", ["[0.01, 0.0]", "x"], 7.27010e-6),
    ("bimetal", "mm-N-MPa", ["[0.1, 0.005]", "y"], 5.12222e-4),
    (
        "cantilever",
        "in-lbf-psi",
        ["[0.2032, 0.0254, 0.0254]", "z"],
        -1.06109e-2 * 0.0254,
    ),
    (
        "element-pressure",
        "mm-N-MPa",
        ["[0.05, 0.05]", "y"],
        -3.36335e-6,
    ),
];

#[test]
fn displacements_are_those_of_calculix() {
    let folder = TempDir::new().unwrap();
    for (deck, units, [place, axis], expected) in CALCULIX {
        let (case, _) = case(folder.path(), deck, units).unwrap();
        let probe = format!(
            "\n[[probe]]\nname = \"node\"\nat = {place}\nfield = \"displacement.{axis}\"\n"
        );
        fs::write(folder.path().join("probed.toml"), case + &probe).unwrap();
        let run = ligament_in(
            folder.path(),
            &[
                "run",
                "probed.toml",
                "--out",
                "results",
                "--force",
                "--quiet",
            ],
        );
        assert_success(&run);
        let history = fs::read_to_string(folder.path().join("results/history.csv")).unwrap();
        let last = history
            .lines()
            .last()
            .and_then(|row| row.split(',').next_back());
        let found: f64 = last.unwrap().parse().unwrap();
        assert!(
            (found / expected - 1.0).abs() < 0.02,
            "{deck}: {found:e}, not {expected:e}"
        );
    }
}
