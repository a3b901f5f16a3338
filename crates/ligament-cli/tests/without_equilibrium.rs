//! A run without a result, or whose last state is no result, is marked wherever it is shown.
#![allow(clippy::unwrap_used, reason = "a failed unwrap fails the test")]

use std::fs;
use std::path::Path;

use crate::support::ligament_in;

/// A strip under a force; its loaded points lose their bonds one by one.
const STRIP: &str = r#"
lattice = { cells = [10, 5], spacing = 0.01, thickness = 0.01, set = { left = { left = 1 }, right = { right = 1 } } }
material = { young = 15e9, poisson = 0.3333, fracture_energy = 10.0 }
model = { law = "bbpd", horizon_factor = 2.0 }
support = [{ group = "left", displacement = { x = 0.0, y = 0.0 } }]
load = [{ group = "right", force = { x = 1e6 } }]
"#;

fn run(folder: &Path, case: &str) -> (Option<i32>, String, String) {
    fs::write(folder.join("case.toml"), case).unwrap();
    let output = ligament_in(
        folder,
        &["run", "case.toml", "--out", "out", "--force", "-q"],
    );
    let text = |bytes: Vec<u8>| String::from_utf8(bytes).unwrap();
    (
        output.status.code(),
        text(output.stdout),
        text(output.stderr),
    )
}

/// Elastic, in load steps that are too large, and on the exact path without a support: the exit code is 3, no load is shown, and
/// the summary is marked.
#[test]
fn a_run_without_a_result_has_its_own_exit_code() {
    let folder = tempfile::tempdir().unwrap();
    let criterion = "[[fracture.criterion]]\nkind = \"critical-stretch\"\n";
    let unheld = STRIP.replace("support = ", "# ");
    for case in [
        unheld.clone(),
        format!("{STRIP}[fracture]\nsteps = 50\n{criterion}"),
        format!("{unheld}[fracture]\ncontrol = \"event\"\n{criterion}"),
    ] {
        let (code, shown, error) = run(folder.path(), &case);
        assert_eq!(code, Some(3), "{shown}{error}");
        assert!(
            shown.contains("NO EQUILIBRIUM") && !shown.contains("largest load"),
            "{shown}"
        );
        assert!(
            error.starts_with("error: no result under load: "),
            "{error}"
        );
        assert!(error.contains("resists the motion of cell "), "{error}");
        let summary = fs::read_to_string(folder.path().join("out/summary.json")).unwrap();
        let summary: serde_json::Value = serde_json::from_str(&summary).unwrap();
        assert_eq!(summary["without_equilibrium"], true);
        assert!(summary["peak"].is_null() && summary["first_peak"].is_null());
    }
}

/// The strip collapses on the exact path: its peak stands, and its last state is marked in the summary, the lines at the end,
/// the explanation of a point and the pictures.
#[test]
fn a_last_state_that_is_not_at_rest_is_marked() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    let event =
        "[fracture]\ncontrol = \"event\"\n[[fracture.criterion]]\nkind = \"critical-stretch\"\n";
    let (code, shown, _) = run(folder, &format!("{STRIP}{event}"));
    assert_eq!(code, Some(6), "{shown}");
    assert!(
        shown.contains("NOT CONVERGED") && shown.contains("largest load"),
        "{shown}"
    );
    let summary = fs::read_to_string(folder.join("out/summary.json")).unwrap();
    let summary: serde_json::Value = serde_json::from_str(&summary).unwrap();
    assert_eq!(summary["last_state_not_at_rest"], true);
    assert_eq!(summary["termination"], "collapsed");
    let told = ligament_in(folder, &["explain", "out", "--point", "30"]);
    let told = String::from_utf8(told.stdout).unwrap();
    assert!(told.contains("4 (not converged)"), "{told}");
    for (file, more) in [("fields.svg", None), ("curve.svg", Some("--curve"))] {
        let arguments = ["plot", "out", "--out", file].into_iter().chain(more);
        let drawn = ligament_in(folder, &arguments.collect::<Vec<_>>());
        assert_eq!(
            drawn.status.code(),
            Some(0),
            "{}",
            String::from_utf8_lossy(&drawn.stderr)
        );
        let picture = fs::read_to_string(folder.join(file)).unwrap();
        assert!(picture.contains("not converged"), "{file}");
    }
}

/// A stop rule that ends the strip while its bonds break was requested: the state is marked, and the run succeeded.
#[test]
fn a_run_that_a_rule_ends_went_well() {
    let folder = tempfile::tempdir().unwrap();
    let event = "[fracture]\ncontrol = \"event\"\nstop = { bonds = 2 }\n\
         [[fracture.criterion]]\nkind = \"critical-stretch\"\n";
    let (code, shown, _) = run(folder.path(), &format!("{STRIP}{event}"));
    assert_eq!(code, Some(0), "{shown}");
    assert!(shown.contains("bonds were broken"), "{shown}");
}

/// A body that is free to move across, pulled and then lifted: the first stage has an equilibrium, the second none, elastic, in load
/// steps and on the exact path. The exit code is 3 for all, the end says why, and a study takes none of them as done.
#[test]
fn a_load_without_equilibrium_after_others_ends_with_one_code() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    let free = r#"
lattice = { cells = [10, 5], spacing = 0.01, thickness = 0.01, set = { left = { left = 1 }, right = { right = 1 } } }
material = { young = 15e9, poisson = 0.3333, fracture_energy = 10.0 }
model = { law = "bbpd", horizon_factor = 2.0 }
support = [{ group = "left", displacement = { x = 0.0 } }]
load = [{ name = "pull", group = "right", force = { x = 500.0 } }, { name = "lift", group = "right", force = { y = 100.0 } }]
"#;
    let stages = |steps: &str| {
        format!(
            "stage = [{{ name = \"pull\", loads = {{ pull = [0.0, 1.0] }}{steps} }}, {{ name = \"lift\", loads = {{ lift = [0.0, 1.0] \
             }}{steps} }}]\n"
        )
    };
    let criterion = "[[fracture.criterion]]\nkind = \"critical-stretch\"\n";
    for case in [
        format!("{free}{}", stages("")),
        format!("{free}{}[fracture]\n{criterion}", stages(", steps = 2")),
        format!(
            "{free}{}[fracture]\ncontrol = \"event\"\n{criterion}",
            stages("")
        ),
    ] {
        let (code, shown, _) = run(folder, &case);
        assert_eq!(code, Some(3), "{shown}");
        // What was pulled stands.
        assert!(shown.contains("largest load       500.0 N"), "{shown}");
        assert!(shown.contains("NO EQUILIBRIUM"), "{shown}");
        let summary = fs::read_to_string(folder.join("out/summary.json")).unwrap();
        let summary: serde_json::Value = serde_json::from_str(&summary).unwrap();
        assert_eq!(summary["termination"], "no-equilibrium");
        let warnings = summary["warnings"].as_array().unwrap().iter();
        let told = |it: &serde_json::Value| it.as_str().unwrap().contains("no equilibrium");
        assert!(warnings.clone().any(told), "{summary}");
    }
    let study = "case = \"case.toml\"\n[[axis]]\nkey = \"load.0.force.x\"\nvalues = [500.0]\n";
    fs::write(folder.join("study.toml"), study).unwrap();
    let output = ligament_in(folder, &["sweep", "study.toml", "--out", "study"]);
    let shown = String::from_utf8_lossy(&output.stdout);
    assert_eq!(output.status.code(), Some(1), "{shown}");
    assert!(shown.contains("0 done, 1 failed"), "{shown}");
}

/// Loads that move a body as a whole break nothing: the run is refused before its first load step, and earlier results stay.
#[test]
fn loads_that_nothing_resists_are_refused() {
    let folder = tempfile::tempdir().unwrap();
    let moved = STRIP
        .replace("force = { x = 1e6 }", "displacement = { x = 1e-5 }")
        .replace("support = ", "# ");
    let stepped = "[fracture]\nsteps = 50\n[[fracture.criterion]]\nkind = \"critical-stretch\"\n";
    let (code, shown, error) = run(folder.path(), &format!("{moved}{stepped}"));
    assert_eq!(code, Some(1), "{shown}");
    assert!(error.contains("nothing resists the loads"), "{error}");
    assert!(error.contains("[[support]]"), "{error}");
}

/// A study has no results of a run that found no equilibrium, however often it is run, and names runs whose last state is no result; a
/// calibration takes no result of the first kind, and marks the second.
#[test]
fn studies_and_calibrations_mark_such_runs() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    let criterion = "[[fracture.criterion]]\nkind = \"critical-stretch\"\n";
    let stepped = format!("{STRIP}[fracture]\nsteps = 50\n{criterion}");
    let event = format!("{STRIP}[fracture]\ncontrol = \"event\"\n{criterion}");
    fs::write(folder.join("stepped.toml"), stepped).unwrap();
    fs::write(folder.join("event.toml"), event).unwrap();
    let study = |case: &str, values: &str| {
        let text = format!(
            "case = \"{case}.toml\"\n[[axis]]\nkey = \"load.0.force.x\"\nvalues = {values}\n"
        );
        fs::write(folder.join("study.toml"), text).unwrap();
        let output = ligament_in(folder, &["sweep", "study.toml", "--out", case]);
        let shown = String::from_utf8_lossy(&output.stdout).into_owned();
        let table = fs::read_to_string(folder.join(case).join("table.csv")).unwrap();
        (output.status.code(), shown, table)
    };
    for _ in 0..2 {
        let (code, shown, table) = study("stepped", "[1e3, 1e6]");
        assert_eq!(code, Some(1));
        assert!(shown.contains("1 done, 1 failed"), "{shown}");
        let row = table.lines().nth(2).unwrap();
        assert!(row.contains(",failed,"), "{row}");
        assert!(row.contains("no result under load"), "{row}");
    }
    let (code, shown, table) = study("event", "[1e3, 1e6]");
    assert_eq!(code, Some(0), "{shown}");
    assert!(
        shown.contains("not converged at the end: force.x=1e6"),
        "{shown}"
    );
    assert!(
        !shown.contains("not converged at the end: force.x=1000"),
        "{shown}"
    );
    assert!(
        table
            .lines()
            .next()
            .unwrap()
            .contains(",last_state_not_at_rest,")
    );

    let calibrate = |case: &str, of: &str| {
        let case_file = format!("{case}.toml");
        let out = format!("{case}-found");
        let arguments = [
            "calibrate",
            &case_file,
            "--key",
            "material.fracture_energy",
            "--of",
            of,
            "--target",
            "1500",
            "--out",
            &out,
        ];
        let output = ligament_in(folder, &arguments);
        let text = |bytes: &[u8]| String::from_utf8_lossy(bytes).into_owned();
        (
            output.status.code(),
            text(&output.stdout),
            text(&output.stderr),
        )
    };
    let (code, shown, error) = calibrate("stepped", "first_break.reaction");
    assert_eq!(code, Some(1), "{shown}");
    assert!(shown.is_empty(), "{shown}");
    assert!(
        error.contains("run 1 (") && error.contains("no result under load"),
        "{error}"
    );
    let (code, shown, error) = calibrate("event", "peak.reaction");
    assert_eq!(code, Some(0), "{error}");
    assert!(shown.contains("NOT CONVERGED"), "{shown}");
    assert!(error.contains("not converged"), "{error}");
    let record = fs::read_to_string(folder.join("event-found/calibration.json")).unwrap();
    assert!(
        record.contains("\"last_state_not_at_rest\": true"),
        "{record}"
    );
}

/// Bonds soften in one step of a force that is reversed in another: the work follows the chords of both and adds up to zero, while bonds
/// dissipated 8 % of the largest. The run reports that its steps are too coarse; with 200 steps both agree to 1 %, without a message.
#[test]
fn steps_that_are_too_coarse_for_softening_are_told() {
    let folder = tempfile::tempdir().unwrap();
    let folder = folder.path();
    for (steps, is_told) in [(1, true), (200, false)] {
        let loads = |name: &str, from: f64, to: f64| {
            format!(
                "{{ name = \"{name}\", loads = {{ pull = [{from:?}, {to:?}] }}, steps = {steps} }}"
            )
        };
        let case = STRIP.replace(
            "{ group = \"right\", force = { x = 1e6 } }",
            "{ name = \"pull\", group = \"right\", force = { x = 2200.0 } }",
        ) + &format!(
            "stage = [{}, {}]\n",
            loads("up", 0.0, 1.0),
            loads("down", 1.0, 0.0)
        ) + "[[fracture.criterion]]\nkind = \"critical-stretch\"\nafter = \"linear\"\nend = 20.0\n";
        let (code, shown, error) = run(folder, &case);
        assert_eq!(code, Some(0), "{shown}{error}");
        assert_eq!(shown.contains("steps are too coarse"), is_told, "{shown}");
    }
}
