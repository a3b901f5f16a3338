//! Series of output files: times that increase whatever the loads do, and the numbers of the history in each file.
#![allow(clippy::unwrap_used, reason = "a failed unwrap fails the test")]

use std::fs;
use std::path::Path;
use std::process::Command;

use ligament_output::csv::read::CsvTable;
use ligament_output::vtu::read::VtuFile;
use tempfile::TempDir;

const PLATE: &str = r#"
lattice = { cells = [8, 6], spacing = 0.001, thickness = 0.001, set = { bottom = { bottom = 1 }, top = { top = 1 } } }
material = { young = 30e9, poisson = 0.2, density = 2500.0, tensile_strength = 3e6 }
model = { law = "nhpd", horizon_factor = 3.0 }
support = [{ group = "bottom", displacement = { x = 0.0, y = 0.0 } }]
"#;

/// Runs a case into `out`.
fn run(folder: &Path, case: &str) {
    fs::write(folder.join("case.toml"), case).unwrap();
    let mut command = Command::new(env!("CARGO_BIN_EXE_ligament"));
    command.current_dir(folder);
    command.args(["run", "case.toml", "--out", "out", "--quiet"]);
    let output = command.output().unwrap();
    let said = String::from_utf8_lossy(&output.stderr).into_owned();
    assert!(output.status.success(), "{said}");
}

/// Times and files of a series.
fn series(path: &Path) -> Vec<(f64, String)> {
    let text = fs::read_to_string(path).unwrap();
    let attribute = |line: &str, name: &str| {
        let rest = line.split(&format!("{name}=\"")).nth(1)?;
        Some(rest.split('"').next()?.to_owned())
    };
    let lines = text.lines().filter(|line| line.starts_with("<DataSet"));
    let listed = lines.map(|line| {
        let time = attribute(line, "timestep").unwrap().parse().unwrap();
        (time, attribute(line, "file").unwrap())
    });
    listed.collect()
}

/// Times of the series of a run, which grow; its files have them and the numbers of the history.
fn times(out: &Path, name: &str) -> Vec<f64> {
    let columns = ["step", "load_factor", "displacement", "reaction"];
    let sheet = CsvTable::read(out.join("history.csv")).unwrap();
    let rows = sheet.numbers(columns).unwrap();
    let listed = series(&out.join(format!("{name}.pvd")));
    assert!(listed.windows(2).all(|it| it[0].0 < it[1].0), "{listed:?}");
    assert_eq!(listed.len(), rows.len());
    for ((time, file), [step, factor, displacement, reaction]) in listed.iter().zip(rows) {
        assert_eq!(*file, format!("{name}_{step:04}.vtu"));
        let expected = [
            ("TimeValue", *time),
            ("load_factor", factor),
            ("load_displacement", displacement),
            ("load_reaction", reaction),
        ];
        let found = VtuFile::open(out.join(file)).unwrap();
        assert_eq!(found.field_data().unwrap(), expected, "{file}");
    }
    listed.into_iter().map(|it| it.0).collect()
}

/// Loads that are constant, decrease, return and are zero: a time is the number of the row, for displacements and for forces, in load steps
/// and along the exact path.
#[test]
fn times_are_rows_where_loads_go_back() {
    let stages = "stage = [{ loads = { pull = 1.0 }, steps = 2 }, { loads = { pull = 1.0 }, steps = 1 }, { loads = { pull = 0.0 }, steps = 2 }, { loads = { pull = 1.0 }, steps = 2 }]\n";
    let cases = [
        ("displacement = { y = 1e-7 }", stages, ""),
        ("force = { y = 1.0 }", stages, ""),
        (
            "displacement = { y = 1e-7 }",
            "",
            "steps = [0.5, 1.0, 0.5, 1.0, 0.5, 0.0, 1.0]",
        ),
        (
            "displacement = { y = 1e-5 }",
            "",
            "control = \"event\", stop = { bonds = 12 }",
        ),
    ];
    for (load, stages, fracture) in cases {
        let place = TempDir::new().unwrap();
        let load = format!("load = [{{ name = \"pull\", group = \"top\", {load} }}]\n");
        let fracture =
            format!("fracture = {{ {fracture} }}\noutput = {{ bonds = true, fields_every = 1 }}\n");
        run(place.path(), &format!("{PLATE}{load}{stages}{fracture}"));
        let out = place.path().join("out");
        let found = times(&out, "fields");
        assert_eq!(times(&out, "bonds"), found);
        let rows: Vec<f64> = (0..found.len()).map(|row| row as f64).collect();
        assert!(found.len() > 4 && found == rows, "{found:?}");
    }
}

/// In a motion a time is the time, while the load comes and goes.
#[test]
fn times_are_times_in_a_motion() {
    for scheme in ["", "scheme = \"implicit\", step = 1e-7"] {
        let place = TempDir::new().unwrap();
        let load = "load = [{ group = \"top\", force = { y = 1.0 }, amplitude = { shape = \"half-sine\", duration = 1e-6 } }]\n";
        let motion = format!("motion = {{ duration = 2e-6, rows = 4, {scheme} }}\n");
        let output = "output = { bonds = true, fields_every = 1 }\n";
        run(
            place.path(),
            &format!("analysis = \"motion\"\n{PLATE}{load}{motion}{output}"),
        );
        let out = place.path().join("out");
        let found = times(&out, "fields");
        assert_eq!(times(&out, "bonds"), found);
        let sheet = CsvTable::read(out.join("history.csv")).unwrap();
        let rows = sheet.numbers(["time"]).unwrap();
        assert_eq!(found, rows.as_flattened());
        assert_eq!((found.len(), found[4]), (5, 2e-6));
    }
}

/// The time of a mode is its number; beside it stands the frequency.
#[test]
fn times_are_numbers_of_modes() {
    let place = TempDir::new().unwrap();
    run(
        place.path(),
        &format!("analysis = \"modal\"\n{PLATE}modal = {{ modes = 3 }}\n"),
    );
    let out = place.path().join("out");
    let sheet = CsvTable::read(out.join("modes.csv")).unwrap();
    let rows = sheet.numbers(["mode", "frequency_hz"]).unwrap();
    let listed = series(&out.join("modes.pvd"));
    assert_eq!(listed.len(), rows.len());
    for ((time, file), [mode, frequency]) in listed.iter().zip(rows) {
        assert_eq!(*time, mode);
        let expected = [("TimeValue", mode), ("frequency_hz", frequency)];
        let found = VtuFile::open(out.join(file)).unwrap();
        assert_eq!(found.field_data().unwrap(), expected);
    }
}
