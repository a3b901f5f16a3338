//! Calls of `ligament yield`.

#![allow(clippy::unwrap_used, reason = "a failed unwrap fails the test")]

use std::ffi::OsStr;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

use crate::support::text;

fn ligament<S: AsRef<OsStr>>(arguments: impl IntoIterator<Item = S>) -> Output {
    Command::new(env!("CARGO_BIN_EXE_ligament"))
        .arg("yield")
        .args(arguments)
        .output()
        .unwrap()
}

fn case(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR"))
        .join("../../cases")
        .join(name)
}

/// A folder for results in a temporary folder.
struct Results(tempfile::TempDir);

impl Results {
    fn new() -> Self {
        Self(tempfile::tempdir().unwrap())
    }

    fn path(&self) -> PathBuf {
        self.0.path().join("yield")
    }

    /// Runs with these arguments and this folder, and is successful.
    fn of(&self, arguments: &[&str]) -> String {
        let path = self.path();
        let arguments: Vec<&OsStr> = arguments.iter().map(OsStr::new).collect();
        let output = ligament(
            arguments
                .into_iter()
                .chain([OsStr::new("--out"), path.as_os_str()]),
        );
        assert!(output.status.success(), "{}", text(&output.stderr));
        text(&output.stdout)
    }

    fn read(&self, file: &str) -> String {
        fs::read_to_string(self.path().join(file)).unwrap()
    }
}

/// The error of a run that fails in its input.
fn refused(arguments: &[&str]) -> String {
    let results = Results::new();
    let path = results.path();
    let arguments: Vec<&OsStr> = arguments.iter().map(OsStr::new).collect();
    let output = ligament(
        arguments
            .into_iter()
            .chain([OsStr::new("--out"), path.as_os_str()]),
    );
    assert_eq!(output.status.code(), Some(1), "{}", text(&output.stdout));
    assert!(
        !path.exists(),
        "nothing is written before all is found good"
    );
    text(&output.stderr)
}

/// MPPD Table 7 (m = 2 and 3, path (0, 1)): 17.16 and 5.39 at the printed orientations; 17.16 and 5.57 at all.
#[test]
fn lattices_have_tables_diagrams_and_loci() {
    let results = Results::new();
    let shown = results.of(&[
        "--m",
        "2,3",
        "--criterion",
        "stretch",
        "--criterion",
        "frictional",
    ]);
    let rows: Vec<Vec<&str>> = shown
        .lines()
        .map(|line| line.split_whitespace().collect())
        .collect();
    for row in [
        ["0.000", "1.000", "17.16", "5.57"],
        ["0.000", "1.000", "17.16", "5.39"],
    ] {
        assert!(rows.iter().any(|it| *it == row), "{row:?}\n{shown}");
    }
    for file in [
        "error-tension-stretch.svg",
        "error-shear-frictional.svg",
        "locus-stretch.svg",
        "bond-frictional.svg",
        "orientation.csv",
    ] {
        assert!(results.path().join(file).is_file(), "{file}");
    }
    let locus = results.read("locus.csv");
    // Paths of 1 degree for each of two families; the cone of friction is open.
    let count = |criterion: &str| locus.lines().filter(|it| it.starts_with(criterion)).count();
    assert_eq!(count("stretch,"), 720);
    assert!((500..720).contains(&count("frictional,")));
    let again = ligament([OsStr::new("--out"), results.path().as_os_str()]);
    assert!(
        text(&again.stderr).contains("--force"),
        "{}",
        text(&again.stderr)
    );
    assert!(
        results
            .of(&["--m", "2", "--criterion", "sliding", "--force"])
            .contains("41.42")
    );
    assert!(
        !results.path().join("locus-stretch.svg").exists(),
        "the old results are gone"
    );
}

#[test]
fn a_point_of_a_case_and_the_field_of_all_points() {
    let disk = case("brazilian-disk/case.toml");
    let disk = disk.to_str().unwrap();
    let results = Results::new();
    let coarse = "mesh.file=\"../../meshes/disk-4mm.msh\"";
    let shown = results.of(&["--case", disk, "--set", coarse, "--at", "0.001,-0.02"]);
    assert!(
        shown.contains("family of node") && shown.contains("strength:"),
        "{shown}"
    );
    assert!(results.read("yield.csv").lines().count() > 2);

    let results = Results::new();
    let shown = results.of(&["--case", disk, "--set", coarse, "--criterion", "sliding"]);
    assert!(shown.contains("846 points are interior"), "{shown}");
    let table = results.read("yield.csv");
    let row = table
        .lines()
        .find(|it| it.starts_with("sliding,shear,interior,"))
        .unwrap();
    let cells: Vec<f64> = row
        .split(',')
        .skip(3)
        .map(|it| it.parse().unwrap())
        .collect();
    let [count, mean, low, high, worst] = cells[..5] else {
        panic!("{row}")
    };
    assert!(count > 400.0 && count < 846.0, "{row}");
    assert!(
        0.0 < low && low < mean && mean < high && high <= worst,
        "{row}"
    );
    let fields = fs::read(results.path().join("points.vtu")).unwrap();
    let header = String::from_utf8_lossy(&fields);
    for field in [
        "sliding_shear_error",
        "sliding_tension_worst_orientation",
        "interior",
        "node",
    ] {
        assert!(header.contains(&format!("Name=\"{field}\"")), "{field}");
    }
}

/// A point in the middle of a lattice is the lattice.
#[test]
fn a_point_of_a_lattice_case_agrees_with_the_lattice() {
    let lattice = case("verification/lattice.toml");
    let results = Results::new();
    let arguments = [
        "--case",
        lattice.to_str().unwrap(),
        "--at",
        "0,0",
        "--criterion",
        "stretch",
    ];
    results.of(&[&arguments[..], &["--nu", "0"]].concat());
    let table = results.read("yield.csv");
    let errors = |family: &str| -> Vec<f64> {
        let rows = table
            .lines()
            .map(|line| line.split(',').collect::<Vec<_>>());
        let rows = rows.filter(|cells| cells[1].starts_with(family));
        rows.map(|cells| cells[5].parse().unwrap()).collect()
    };
    let (point, ideal) = (errors("cell"), errors("lattice"));
    assert_eq!(point.len(), 12);
    assert_eq!(ideal.len(), 12);
    // Directions are rounded, and the search ends at 1e-9.
    for (a, b) in point.iter().zip(&ideal) {
        assert!((a - b).abs() < 1e-8, "{a} {b}");
    }
}

#[test]
fn what_makes_no_sense_is_told() {
    for (arguments, told) in [
        (&["--m", "0.5"][..], "m = 0.5"),
        (&["--nu", "1.2"], "nu = 1.2"),
        (&["--ratio", "-1"], "ratio of strengths is -1"),
        (
            &["--criterion", "frictional", "--ratio", "0.5"],
            "--ratio of 1 or more",
        ),
        (
            &[
                "--criterion",
                "frictional",
                "--nu",
                "0.4",
                "--calibration",
                "two-point",
            ],
            "--calibration printed",
        ),
        (&["--case", "nowhere.toml"], "nowhere.toml"),
    ] {
        let error = refused(arguments);
        assert!(error.contains(told), "{error}");
    }
    let lattice = case("verification/lattice.toml");
    let lattice = lattice.to_str().unwrap();
    let error = refused(&["--case", lattice]);
    assert!(
        error.contains("--criterion") && error.contains("[fracture]"),
        "{error}"
    );
    let law = [
        "model.law=mbb-pd",
        "correction.alpha=none",
        "correction.surface=none",
    ];
    let mut arguments = vec!["--case", lattice, "--criterion", "stretch"];
    arguments.extend(law.iter().flat_map(|setting| ["--set", setting]));
    let error = refused(&arguments);
    assert!(error.contains("directions weaken nothing"), "{error}");
    let error = refused(&["--case", lattice, "--criterion", "stretch", "--at", "5,5"]);
    assert!(error.contains("the nearest is cell 1369"), "{error}");
    let error = refused(&[
        "--case",
        lattice,
        "--criterion",
        "stretch",
        "--point",
        "1370",
    ]);
    assert!(error.contains("1 to 1369"), "{error}");
    for wrong in [
        &["--criterion", "strech"][..],
        &["--at", "0,0"],
        &["--case", "a.toml", "--m", "3"],
        &["--case", "a.toml", "--at", "0"],
        &["--calibration", "twopoint"],
    ] {
        assert_eq!(ligament(wrong).status.code(), Some(2), "{wrong:?}");
    }
}
