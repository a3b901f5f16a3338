//! Calls of the program.

#![allow(clippy::unwrap_used, reason = "a failed unwrap fails the test")]

use std::ffi::OsStr;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Output;

use crate::support::{assert_success, ligament, ligament_in, stderr, stdout};

#[cfg(unix)]
mod meshing;

fn data(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR"))
        .join("../ligament-case/tests/data")
        .join(name)
}

fn plate() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../meshes/plate-coarse.msh")
}

#[test]
fn help_teaches_every_command() {
    let output = ligament(["--help"]);
    assert_eq!(output.status.code(), Some(0));
    for word in [
        "run",
        "resume",
        "sweep",
        "check",
        "explain",
        "inspect",
        "mesh",
        "new",
        "stiffness",
        "yield",
        "schema",
        "completions",
        "Examples:",
        "SI units",
    ] {
        assert!(stdout(&output).contains(word), "{word}");
    }
    for command in [
        "run",
        "resume",
        "sweep",
        "check",
        "explain",
        "inspect",
        "mesh",
        "new",
        "stiffness",
        "yield",
        "schema",
        "completions",
    ] {
        let output = ligament([command, "--help"]);
        assert_eq!(output.status.code(), Some(0));
        assert!(stdout(&output).contains("Examples:"), "{command}");
    }
}

#[test]
fn wrong_usage_exits_with_2() {
    let output = ligament(["inspct", "disk.msh"]);
    assert_eq!(output.status.code(), Some(2));
    assert!(stderr(&output).contains("'inspect'"), "{}", stderr(&output));
    assert_eq!(ligament(["run"]).status.code(), Some(2));
    assert_eq!(
        ligament(["run", "case.toml", "--threads", "0"])
            .status
            .code(),
        Some(2)
    );
    assert_eq!(
        ligament(["mesh", "a.geo", "--set", "h=2mm"]).status.code(),
        Some(2)
    );
}

#[test]
fn an_unknown_key_is_located_and_exits_with_1() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("case.toml");
    let text = fs::read_to_string(data("brazilian-disk.toml")).unwrap();
    fs::write(&path, text.replace("horizon_factor", "horizont_factor")).unwrap();
    let output = ligament([OsStr::new("run"), path.as_os_str()]);
    assert_eq!(output.status.code(), Some(1));
    let expected = format!(
        "error: {}:14:1: model.horizont_factor: unknown key",
        path.display()
    );
    assert!(
        stderr(&output).starts_with(&expected),
        "{}",
        stderr(&output)
    );
    assert!(stderr(&output).contains("did you mean `horizon_factor`?"));
}

#[test]
fn a_wrong_setting_is_blamed_on_the_command_line() {
    let path = data("brazilian-disk.toml");
    let output = ligament([
        OsStr::new("run"),
        path.as_os_str(),
        "--set".as_ref(),
        "mesh.plane=strian".as_ref(),
    ]);
    assert_eq!(output.status.code(), Some(1));
    assert!(
        stderr(&output).starts_with("error: --set mesh.plane=strian: mesh.plane: unknown value")
    );
}

#[test]
fn a_wrong_setting_of_the_solver_exits_with_1() {
    let path = data("brazilian-disk.toml");
    for (setting, message) in [
        (
            "solver.updat=refactor",
            "solver.updat: unknown key `updat` in [solver]; did you mean `update`?",
        ),
        (
            "solver.update=refactr",
            "solver.update: unknown value \"refactr\"; did you mean \"refactor\"?",
        ),
        ("solver=fast", "solver: expected \"auto\" or a table"),
        ("solver.threads=5000", "solver.threads: must be 1 to 1024"),
    ] {
        let arguments = ["run".as_ref(), path.as_os_str(), "--set".as_ref()];
        let output = ligament(arguments.into_iter().chain([setting.as_ref()]));
        assert_eq!(output.status.code(), Some(1), "{setting}");
        let expected = format!("error: --set {setting}: {message}");
        assert!(
            stderr(&output).starts_with(&expected),
            "{}",
            stderr(&output)
        );
    }
    let output = ligament(["run", "case.toml", "--threads", "5000"]);
    assert_eq!(output.status.code(), Some(2));
}

/// L L^T for a stiffness that is not positive definite (nu = 0.38): an outcome with advice, and a run that follows
/// the advice.
#[test]
fn llt_of_an_indefinite_stiffness_says_what_to_choose() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("case.toml");
    let text = format!(
        "mesh = {{ file = {:?} }}\n\
         material = {{ young = 15e9, poisson = 0.38, tensile_strength = 3.81e6 }}\n\
         model = {{ law = \"nhpd\", horizon_factor = 3.0, poisson = \"bonds\" }}\n\
         support = [{{ group = \"left\", displacement = {{ x = 0.0, y = 0.0 }} }}]\n\
         load = [{{ group = \"right\", displacement = {{ x = 1e-5 }} }}]\n\
         fracture = {{ steps = 2 }}\n",
        plate()
    );
    fs::write(&path, text).unwrap();
    let run = |setting: &str, code: i32| {
        let out = folder.path().join(setting);
        let output = ligament([
            OsStr::new("run"),
            path.as_os_str(),
            "--out".as_ref(),
            out.as_os_str(),
            "--set".as_ref(),
            OsStr::new(setting),
        ]);
        assert_eq!(output.status.code(), Some(code), "{}", stderr(&output));
        let summary = fs::read_to_string(out.join("summary.json")).unwrap();
        (stdout(&output), summary)
    };
    let (said, summary) = run("solver.factorisation=llt", 3);
    assert!(summary.contains("\"no-equilibrium\""), "{summary}");
    let advice = "let the factorisation be \"auto\" or \"ldlt\"";
    assert!(
        said.contains("not positive definite") && said.contains(advice),
        "{said}"
    );
    for setting in ["solver.factorisation=ldlt", "solver=auto"] {
        let (_, summary) = run(setting, 0);
        assert!(summary.contains("\"steps-done\""), "{summary}");
        assert!(summary.contains("\"factorisation\": \"ldlt\""), "{summary}");
    }
}

#[test]
fn files_that_are_not_there_are_named() {
    for command in ["run", "check", "inspect"] {
        let output = ligament([command, "nowhere/file"]);
        assert_eq!(output.status.code(), Some(1));
        assert!(
            stderr(&output).contains("nowhere/file"),
            "{}",
            stderr(&output)
        );
        assert!(
            stderr(&output).contains("\n  because: No such file"),
            "{}",
            stderr(&output)
        );
    }
}

#[test]
fn completions_name_the_commands() {
    for shell in ["bash", "zsh", "fish"] {
        let output = ligament(["completions", shell]);
        assert_eq!(output.status.code(), Some(0));
        assert!(stdout(&output).contains("inspect"), "{shell}");
    }
}

#[test]
fn inspect_shows_the_groups() {
    let output = ligament([OsStr::new("inspect"), plate().as_os_str()]);
    assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
    for word in [
        "nodes",
        "bounding box",
        "ratio",
        "groups",
        "surface",
        "curve",
    ] {
        assert!(
            stdout(&output).contains(word),
            "{word} in\n{}",
            stdout(&output)
        );
    }
}

/// With `--model-only` all stages of the preparation are reported and the matrix is not touched.
#[test]
fn check_can_leave_the_matrix_out() {
    let case = data("brazilian-disk.toml");
    let check = |more: &[&str]| {
        let arguments = [OsStr::new("check"), case.as_os_str()];
        let output = ligament(arguments.into_iter().chain(more.iter().map(OsStr::new)));
        assert_eq!(output.status.code(), Some(0), "{}", stderr(&output));
        stdout(&output)
    };
    let (whole, model) = (check(&["--all"]), check(&["--all", "--model-only"]));
    for stage in ["read mesh", "points", "bonds", "correction", "rigidities"] {
        let line = format!("\n  time, {stage} ");
        assert!(whole.contains(&line) && model.contains(&line), "{stage}");
    }
    for line in ["\nequations\n", "\n  time, analysis "] {
        assert!(whole.contains(line) && !model.contains(line), "{line}");
    }
    if cfg!(target_os = "linux") {
        assert!(model.contains("\n  peak memory "), "{model}");
    }
    // Beside equations and what the machine spent and has left, both say the same.
    let (head, machine) = model.split_once("time, memory and disk\n").unwrap();
    assert!(whole.starts_with(head), "{model}");
    assert!(head.contains("\n  fields on disk ") && !head.contains("free on"));
    if cfg!(unix) {
        assert!(machine.contains("\n  free on the disk "), "{model}");
    }
}

/// Without `--all` a check prints half of its lines; but for times and memory they are lines of the whole report.
#[test]
fn a_check_is_short() {
    let case = data("brazilian-disk.toml");
    let [short, whole] = [&[][..], &["--all"]].map(|more| {
        let arguments = [OsStr::new("check"), case.as_os_str()];
        let output = ligament(arguments.into_iter().chain(more.iter().map(OsStr::new)));
        assert_success(&output);
        stdout(&output)
    });
    let (short, _) = short.split_once("time, memory and disk\n").unwrap();
    assert!(short.contains("\ngrowth of cracks in "), "{short}");
    assert!(short.lines().count() <= 35, "{short}");
    assert!(2 * short.lines().count() < whole.lines().count());
    for line in short.lines() {
        assert!(whole.lines().any(|it| it == line), "{line}");
    }
}

#[test]
fn a_file_that_is_no_mesh_is_refused() {
    let output = ligament([
        OsStr::new("inspect"),
        data("brazilian-disk.toml").as_os_str(),
    ]);
    assert_eq!(output.status.code(), Some(1));
    assert!(
        stderr(&output).starts_with("error: cannot use the mesh"),
        "{}",
        stderr(&output)
    );
    assert!(
        stderr(&output).contains("\n  because: "),
        "{}",
        stderr(&output)
    );
}

/// A strip of 40 x 20 cells with a slit up to its middle, so that the ligament is 10 mm long. Above the slit the two upper rows may not fail:
/// bonds that end there do not either: a fifth of those across the ligament, most of them in its upper half. At the ends of the strip they are no part of it.
#[test]
fn the_reach_of_no_fail_into_the_ligament_is_told() {
    const STRIP: &str = r#"
lattice = { cells = [40, 20], spacing = 1e-3, thickness = 0.01, plane = "stress", set = { left = { left = 3 }, right = { right = 3 } } }
material = { young = 20e9, poisson = 0.2, fracture_energy = 50.0 }
model = { law = "nhpd", horizon_factor = 3.0 }
precrack = [{ points = [[0.02, -1e-3], [0.02, 0.01]] }]
support = [{ group = "left", displacement = { x = 0.0, y = 0.0 } }]
load = [{ group = "right", displacement = { x = 3e-5 } }]
fracture = { steps = 10, criterion = [{ kind = "bond-energy" }] }
"#;
    let folder = tempfile::tempdir().unwrap();
    let told = |no_fail: &str| {
        let case = format!("{STRIP}no_fail = [{no_fail}]\n");
        std::fs::write(folder.path().join("case.toml"), case).unwrap();
        let output = ligament_in(folder.path(), &["check", "case.toml"]);
        assert_success(&output);
        stdout(&output)
    };
    let above = told("{ box = [[0.015, 0.018], [0.025, 0.02]] }");
    assert!(
        above.contains("points with no_fail   20, and 50 others up to 3.000 mm from them"),
        "{above}"
    );
    let share = above
        .split(" % of the bonds across the smallest section")
        .next()
        .unwrap();
    let share: f64 = share.rsplit(' ').next().unwrap().parse().unwrap();
    assert!((15.0..40.0).contains(&share), "{share}");
    let beside = told("{ group = \"left\" }, { group = \"right\" }");
    assert!(
        !beside.contains("of the bonds across the smallest section"),
        "{beside}"
    );
}
