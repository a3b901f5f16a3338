//! How runs end: one table of ends, models that are unstable, motions whose energy grows, and numbers of states that are to be ignored.
#![allow(clippy::unwrap_used, reason = "a failed unwrap fails the test")]

use std::fs;
use std::path::Path;

use ligament_analysis::termination::{ENDS, Row};
use serde_json::Value;

use crate::support::{ligament_in, stderr, stdout};

/// A plate of steel in plane strain with an edge crack: with nu = .3 it has 102 negative eigenvalues for 100 rotations.
const STEEL: &str = r#"
lattice = { cells = [10, 10], spacing = 1e-4, thickness = 1e-3, plane = "strain", set = { bottom = { bottom = 1 }, top = { top = 1 } } }
material = { young = 210e9, poisson = 0.3, fracture_energy = 2700.0, density = 7800.0 }
model = { law = "nhpd", horizon_factor = 3.0, poisson = "bonds" }
correction = { surface = "patch" }
precrack = [{ points = [[-1e-4, 5.03e-4], [5.03e-4, 5.03e-4]] }]
support = [{ group = "bottom", displacement = { x = 0.0, y = 0.0 } }]
"#;

const PULLED: &str = "load = [{ group = \"top\", displacement = { x = 0.0, y = 1e-6 } }]\n";

const BY_ENERGY: &str = "[[fracture.criterion]]\nkind = \"bond-energy\"\n";

/// Exit code, output and errors of a command in a folder with a case.
fn told(folder: &Path, case: &str, arguments: &[&str]) -> (Option<i32>, String, String) {
    fs::write(folder.join("case.toml"), case).unwrap();
    let output = ligament_in(folder, arguments);
    (output.status.code(), stdout(&output), stderr(&output))
}

const RUN: [&str; 6] = ["run", "case.toml", "--out", "out", "--force", "-q"];

fn run(folder: &Path, case: &str, settings: &[&str]) -> (Option<i32>, String, String) {
    let sets = settings.iter().flat_map(|it| ["--set", *it]);
    told(
        folder,
        case,
        &RUN.into_iter().chain(sets).collect::<Vec<_>>(),
    )
}

fn summary(folder: &Path) -> Value {
    let text = fs::read_to_string(folder.join("out/summary.json")).unwrap();
    serde_json::from_str(&text).unwrap()
}

/// Each end is in one row of the table of `docs/commands.md`, with its exit codes where a state under load is at rest and where none is.
#[test]
fn the_documentation_has_the_table_of_ends() {
    let page = include_str!("../../../docs/commands.md");
    for row in ENDS {
        let name = format!("`{}`", row.name);
        let mut lines = page.lines().filter(|it| it.starts_with("| `"));
        let line = lines.find(|it| it.split('|').nth(1).is_some_and(|it| it.contains(&name)));
        let line = line.unwrap_or_else(|| panic!("{name} is not in the table"));
        let cells: Vec<Vec<u8>> = line.split('|').skip(2).take(2).map(codes).collect();
        assert_eq!(cells, [with_rest(row), vec![without_rest(row)]], "{line}");
    }
}

/// The exit codes that a cell names.
fn codes(cell: &str) -> Vec<u8> {
    let words = cell.split(|it: char| !it.is_ascii_digit());
    words.filter_map(|it| it.parse().ok()).collect()
}

fn with_rest(row: &Row) -> Vec<u8> {
    let mut codes = [false, true]
        .map(|it| row.verdict.end(false, it).exit_code())
        .to_vec();
    codes.dedup();
    codes
}

fn without_rest(row: &Row) -> u8 {
    row.verdict.end(row.verdict.needs_rest(), false).exit_code()
}

/// Elastic, in load steps and on the exact path: an unstable model ends the run and the check with code 3, without a number of a state under load,
/// and both name the key and the same Poisson's ratio. There the model is stable, and not three thousandths above; with the key it runs.
#[test]
fn an_unstable_model_ends_before_its_first_load() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    let elastic = format!("{STEEL}{PULLED}");
    for rest in [
        String::new(),
        format!("[fracture]\nsteps = 2\n{BY_ENERGY}"),
        format!("[fracture]\ncontrol = \"event\"\nstop = {{ bonds = 1 }}\n{BY_ENERGY}"),
    ] {
        let case = format!("{elastic}{rest}");
        let (code, shown, error) = run(folder, &case, &[]);
        assert_eq!(code, Some(3), "{shown}{error}");
        for number in ["elastic stiffness", "load  ", "energies"] {
            assert!(!shown.contains(number), "{shown}");
        }
        assert!(
            shown.contains("NO RESULT") && error.contains("allow_unstable"),
            "{error}"
        );
        let summary = summary(folder);
        assert_eq!(summary["termination"], "unstable");
        assert!(summary["peak"].is_null() && summary["certificate"].is_null());
        let (code, _, of_check) = told(folder, &case, &["check", "case.toml"]);
        assert_eq!((code, of_check), (Some(3), error), "{rest}");
        let (code, shown, _) = run(folder, &case, &["model.allow_unstable=true"]);
        assert_eq!(code, Some(0), "{shown}");
        assert!(shown.contains("results are not to be trusted"), "{shown}");
    }
    let (_, _, error) = run(folder, &elastic, &[]);
    let (_, from) = error.split_once("for this body and law is ").unwrap();
    let largest: f64 = from.split(',').next().unwrap().parse().unwrap();
    assert!((0.25..0.3).contains(&largest), "{error}");
    for (poisson, wanted) in [(largest, 0), (largest + 3e-3, 3)] {
        let poisson = format!("material.poisson={poisson}");
        assert_eq!(
            run(folder, &elastic, &[&poisson]).0,
            Some(wanted),
            "{poisson}"
        );
    }
}

/// Studies and calibrations take no number of an unstable model, ensembles no sample, and modes of one end with code 3.
#[test]
fn studies_refuse_an_unstable_model() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    let stepped = format!("{STEEL}{PULLED}[fracture]\nsteps = 2\n{BY_ENERGY}");
    let study = "case = \"case.toml\"\n[[axis]]\nkey = \"material.poisson\"\nvalues = [0.2, 0.3]\n";
    fs::write(folder.join("study.toml"), study).unwrap();
    let (code, shown, _) = told(folder, &stepped, &["sweep", "study.toml", "--out", "study"]);
    assert_eq!(code, Some(1), "{shown}");
    assert!(shown.contains("1 done, 1 failed"), "{shown}");
    let words =
        "calibrate case.toml --key material.young --of elastic_stiffness --target 1e8 --out found";
    let (code, _, error) = told(folder, &stepped, &words.split(' ').collect::<Vec<_>>());
    assert_eq!(code, Some(1), "{error}");
    assert!(error.contains("the intact model is unstable"), "{error}");
    let scatter =
        "scatter = { of = \"fracture-energy\", distribution = \"weibull\", modulus = 10.0 }\n";
    let scattered = stepped.replace("steps = 2\n", &format!("steps = 2\n{scatter}"));
    let words = "ensemble case.toml --samples 2 --out samples -q";
    let (code, _, error) = told(folder, &scattered, &words.split(' ').collect::<Vec<_>>());
    assert_eq!(code, Some(1), "{error}");
    assert!(error.contains("no sample has a result"), "{error}");
    let modes = format!("analysis = \"modal\"\n{STEEL}[modal]\nmodes = 3\n");
    let (code, shown, _) = run(folder, &modes, &[]);
    assert_eq!(code, Some(3), "{shown}");
    assert!(shown.contains("NOT TO BE TRUSTED"), "{shown}");
}

/// Implicit steps of an unstable body grow without end: the code is 3, the last row is marked, and none of its numbers is shown.
#[test]
fn a_motion_that_grows_has_no_success() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    let motion = format!(
        "analysis = \"motion\"\n{STEEL}load = [{{ group = \"top\", velocity = {{ y = 1.0 }} }}]\n\
         motion = {{ scheme = \"implicit\", step = 5e-8, duration = 2e-6, rows = 40 }}\n"
    );
    let (code, shown, error) = run(folder, &motion, &[]);
    assert_eq!(code, Some(3), "{shown}{error}");
    let summary = summary(folder);
    assert_eq!(summary["termination"], "energy-grew");
    let history = fs::read_to_string(folder.join("out/history.csv")).unwrap();
    let mut lines = history.lines().map(|it| it.split(',').collect::<Vec<_>>());
    let names = lines.next().unwrap();
    let column = |name: &str| names.iter().position(|it| *it == name).unwrap();
    let rows: Vec<Vec<&str>> = lines.collect();
    let (last, before) = (&rows[rows.len() - 1], &rows[rows.len() - 2]);
    assert_eq!([last, before].map(|it| it[column("at_rest")]), ["0", "1"]);
    let stored = summary["motion"]["energies"]["stored_energy"]
        .as_f64()
        .unwrap();
    assert_eq!(
        stored,
        before[column("stored_energy")].parse::<f64>().unwrap()
    );
}

/// A strip collapses under a force in a load step: its certificate describes the last state at rest, and the bonds that broke after it are
/// counted separately.
#[test]
fn numbers_of_a_state_to_ignore_are_no_results() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    let strip = r#"
lattice = { cells = [20, 20], spacing = 0.01, thickness = 0.01, set = { bottom = { bottom = 1 }, top = { top = 1 } } }
material = { young = 25e9, poisson = 0.2, fracture_energy = 50.0 }
model = { law = "nhpd", horizon_factor = 3.0 }
precrack = [{ points = [[-0.01, 0.1], [0.06, 0.1]] }]
support = [{ group = "bottom", displacement = { x = 0.0, y = 0.0 } }]
load = [{ group = "top", force = { y = 1e4 } }]
fracture = { steps = 20, criterion = [{ kind = "bond-energy" }] }
"#;
    let (code, shown, error) = run(folder, strip, &[]);
    assert_eq!(code, Some(6), "{shown}{error}");
    let summary = summary(folder);
    let certificate = &summary["certificate"];
    let history = fs::read_to_string(folder.join("out/history.csv")).unwrap();
    let mut lines = history.lines().map(|it| it.split(',').collect::<Vec<_>>());
    let names = lines.next().unwrap();
    let column = |name: &str| names.iter().position(|it| *it == name).unwrap();
    let at_rest = lines.rfind(|it| it[column("at_rest")] == "1").unwrap();
    let number = |name: &str| at_rest[column(name)].parse::<f64>().unwrap();
    assert_eq!(
        certificate["work"].as_f64().unwrap(),
        number("external_work")
    );
    assert_eq!(certificate["step"].as_f64().unwrap(), number("step"));
    assert_eq!(
        certificate["broken_bonds"].as_f64().unwrap(),
        number("broken_bonds")
    );
    assert!(summary["broken_bonds"].as_f64().unwrap() > number("broken_bonds"));
    assert!(shown.contains("up to the last state at rest"), "{shown}");
    // The state of the collapse has a thousand times the work.
    assert!(number("external_work") < 1.0, "{history}");
}
