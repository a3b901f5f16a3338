//! Results of a motion in time: words, tables, pictures and the page are over the time.

#![allow(clippy::unwrap_used, reason = "a failed unwrap fails the test")]

use std::collections::BTreeMap;
use std::fs;
use std::path::Path;

use serde_json::Value;

use crate::support::{assert_success, ligament_in, stderr, stdout};

/// A plate of 60 x 24 cells with a slit, pulled by sudden forces that drive a crack through it.
const PLATE: &str = r#"title = "Plate with a slit"
[lattice]
cells = [60, 24]
spacing = 5e-4
thickness = 1e-3
[lattice.set]
top = { top = 1 }
bottom = { bottom = 1 }
[material]
young = 32e9
poisson = 0.2
density = 2450.0
fracture_energy = 3.0
[model]
law = "nhpd"
horizon_factor = 3.0
[[precrack]]
points = [[-0.001, 0.006], [0.01, 0.006]]
[motion]
duration = 30e-6
rows = 30
[fracture]
criterion = [{ kind = "critical-stretch" }]
[[load]]
group = "top"
force_per_length = { y = 2.5e3 }
[[load]]
group = "bottom"
force_per_length = { y = -2.5e3 }
[[probe]]
name = "mouth"
at = [0.0, 0.0063]
field = "velocity.y"
[[probe]]
name = "edge"
at = [0.0, 0.0118]
field = "velocity.y"
[output]
fields_every = 5
"#;

/// A bar in implicit steps, held at its left end.
const BAR: &str = r#"title = "A body comes against a bar"
analysis = "motion"
[lattice]
cells = [12, 4]
spacing = 1e-3
[lattice.set]
left = { left = 1 }
[material]
young = 1e9
poisson = 0.2
density = 1000.0
[model]
law = "nhpd"
horizon_factor = 3.0
[motion]
duration = 20e-6
rows = 4
scheme = "implicit"
step = 1e-6
[[support]]
group = "left"
displacement = { x = 0.0, y = 0.0 }
"#;

/// Runs a command and returns its messages on both streams.
fn said(folder: &Path, words: &str) -> String {
    let arguments: Vec<&str> = words.split_whitespace().collect();
    let output = ligament_in(folder, &arguments);
    assert_success(&output);
    stdout(&output) + &stderr(&output)
}

fn folder() -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("plate.toml"), PLATE).unwrap();
    said(folder.path(), "run plate.toml --out out --quiet");
    folder
}

/// Rows of a table by the names of its columns; empty values are NaN.
fn table(path: &Path) -> Vec<BTreeMap<String, f64>> {
    let text = fs::read_to_string(path).unwrap();
    let mut lines = text.lines();
    let names: Vec<&str> = lines.next().unwrap().split(',').collect();
    let number = |it: &str| it.parse().unwrap_or(f64::NAN);
    let row = |line: &str| {
        let values = line.split(',').map(number);
        names
            .iter()
            .map(|it| (*it).to_owned())
            .zip(values)
            .collect()
    };
    lines.map(row).collect()
}

#[test]
fn a_run_and_its_summary_tell_times_steps_and_energies() {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("plate.toml"), PLATE).unwrap();
    let words = said(folder.path(), "run plate.toml --out out");
    for expected in [
        "row 1 of 30: 1.000 us, ",
        "row 30 of 30: 30.00 us, ",
        "\n  motion             30.00 us in ",
        "\n  critical step      ",
        "\n  energies           work ",
        ", kinetic ",
        " us, by critical-stretch",
        " time steps\n",
    ] {
        assert!(words.contains(expected), "{expected} in\n{words}");
    }
    assert!(
        !words.contains("load factor") && !words.contains("first peak"),
        "{words}"
    );
    let text = fs::read_to_string(folder.path().join("out/summary.json")).unwrap();
    let summary: Value = serde_json::from_str(&text).unwrap();
    let motion = &summary["motion"];
    let history = table(&folder.path().join("out/history.csv"));
    let last = history.last().unwrap();
    assert_eq!(motion["duration"], 30e-6);
    assert_eq!(motion["time"].as_f64().unwrap(), last["time"]);
    assert_eq!(motion["time_steps"].as_f64().unwrap(), last["time_steps"]);
    let step = motion["time_step"].as_f64().unwrap();
    assert!(step < motion["critical_step"].as_f64().unwrap());
    // All steps have one length, but for rounding.
    assert!((step * last["time_steps"] / last["time"] - 1.0).abs() < 1e-12);
    let energies = motion["energies"].as_object().unwrap();
    // The reader of JSON rounds the last digit of a number.
    for (name, value) in energies {
        let (found, expected) = (value.as_f64().unwrap(), last[name]);
        let apart = (found - expected).abs();
        assert!(
            apart <= f64::EPSILON * expected.abs(),
            "{name}: {found} {expected}"
        );
    }
    // Columns of time are the load factor under its name.
    assert!(history.iter().all(|it| it["time"] == it["load_factor"]));
    assert!(summary["first_peak"].is_null());
}

/// Rates of crack growth are taken over five rows, from cracks that later rows still have, and each tip moved by its speed.
#[test]
fn cracks_have_speeds_over_their_ways() {
    let folder = folder();
    let words = said(folder.path(), "crack out --step t=21.2e-6");
    assert!(words.starts_with("t = 21.00 us: "), "{words}");
    assert!(
        words.contains("  the tip at (") && words.contains(" moves at "),
        "{words}"
    );
    let growth = table(&folder.path().join("out/crack_growth.csv"));
    assert!(growth.len() > 5, "{growth:?}");
    assert!(growth[0]["length_rate"].is_nan());
    for (rate, size) in [("length_rate", "length"), ("area_rate", "area")] {
        let lasting = |place: usize| {
            let later = growth[place..].iter().map(|it| it[size]);
            later.fold(f64::INFINITY, f64::min)
        };
        assert!(lasting(growth.len() - 1) > lasting(0));
        for place in 1..growth.len() {
            let first = place.saturating_sub(5);
            let time = growth[place]["time"] - growth[first]["time"];
            let expected = (lasting(place) - lasting(first)) / time;
            let found = growth[place][rate];
            assert!(
                found >= 0.0 && (found - expected).abs() <= 1e-9 * expected,
                "{rate}"
            );
        }
    }
    let tips = table(&folder.path().join("out/crack_tips.csv"));
    let alone: Vec<_> = (tips.iter())
        .filter(|tip| tips.iter().filter(|it| it["time"] == tip["time"]).count() == 1)
        .collect();
    assert!(alone.len() > 3, "{tips:?}");
    // Rows that follow one another, with a single tip in each.
    for rows in alone.windows(6) {
        let (first, last) = (rows[0], rows[5]);
        let between =
            (tips.iter()).filter(|it| it["time"] >= first["time"] && it["time"] <= last["time"]);
        if between.count() == 6 && rows[1..].iter().all(|it| !it["speed"].is_nan()) {
            let straight = (last["x"] - first["x"]).hypot(last["y"] - first["y"]);
            // Smoothing moves the line that the way follows by less than a cell from row to row.
            let away = (last["speed"] * (last["time"] - first["time"]) - straight).abs();
            assert!(away < 5.0 * 5e-4, "{rows:?}: {away}");
        }
    }
    // No crack is faster than waves of pressure, sqrt(E/rho/(1 - nu^2)); where it branches, tips jump by some cells.
    let fastest = alone.iter().map(|it| it["speed"]).fold(0.0, f64::max);
    assert!(fastest > 100.0 && fastest < 3700.0, "{fastest}");
}

#[test]
fn curves_and_pictures_are_over_the_time() {
    let folder = folder();
    let svg = |words: &str| {
        said(folder.path(), &format!("plot {words} --out a.svg --force"));
        fs::read_to_string(folder.path().join("a.svg")).unwrap()
    };
    let force = svg("--curve out");
    assert!(
        force.contains(">time (µs)<") && force.contains(">reaction (N)<"),
        "{force}"
    );
    assert!(!force.contains("first peak"));
    let energies = svg("--curve out --y energies");
    for name in [
        "external work",
        "kinetic energy",
        "stored energy",
        "released energy",
    ] {
        assert!(energies.contains(&format!(">{name}<")), "{name}");
    }
    assert!(
        !energies.contains("friction") && energies.contains(">energy ("),
        "{energies}"
    );
    let probes = svg("--curve out --y probes");
    assert!(
        probes.contains(">mouth<")
            && probes.contains(">edge<")
            && probes.contains(">velocity (m/s)<")
    );
    let refused = |words: &str| {
        let arguments: Vec<&str> = words.split_whitespace().collect();
        let output = ligament_in(folder.path(), &arguments);
        assert_ne!(output.status.code(), Some(0));
        stderr(&output)
    };
    let error = refused("plot --curve out --y mouth reaction");
    assert!(error.contains("different units (m/s and N)"), "{error}");
    let error = refused("plot --curve out --y length_rate");
    assert!(error.contains("`ligament crack` writes it"), "{error}");
    said(folder.path(), "crack out");
    assert!(svg("--curve out --y length_rate").contains(">length rate (m/s)<"));
    assert!(svg("--curve out --y speed").contains(">speed (m/s)<"));
    let strip = svg("out --step t=0 t=14e-6");
    assert!(
        strip.contains("t = 0") && strip.contains("t = 15.00 µs"),
        "{strip}"
    );
    assert!(!strip.contains("step "), "{strip}");
}

#[test]
fn bonds_and_the_page_tell_times() {
    let folder = folder();
    let breaks = table(&folder.path().join("out/breaks.csv"));
    let [a, b] = ["cell_a", "cell_b"].map(|it| breaks[0][it]);
    let words = said(folder.path(), &format!("explain out --bond {a} {b}"));
    assert!(
        words.contains("It broke after ") && words.contains(" us, in time step "),
        "{words}"
    );
    assert!(
        words.contains("times with fields") && !words.contains("load factor"),
        "{words}"
    );
    said(folder.path(), "report out");
    let page = fs::read_to_string(folder.path().join("out/report.html")).unwrap();
    let (_, rest) = page.split_once("id=\"description\">").unwrap();
    let page: Value = serde_json::from_str(rest.split_once("</script>").unwrap().0).unwrap();
    let run = &page["runs"][0];
    assert_eq!(run["inTime"], true);
    assert_eq!(run["opensAt"], 6);
    let columns = run["history"].as_array().unwrap();
    let time = columns.iter().find(|it| it["name"] == "time").unwrap();
    assert_eq!((&time["unit"], &time["si"]), (&"µs".into(), &"s".into()));
}

/// An implicit motion writes the columns of a rigid body: a wall that comes at 0.1 m/s has moved by 0.1 m/s times 20 us, and presses
/// the bar.
#[test]
fn an_implicit_motion_writes_its_rigid_bodies() {
    const WALL: &str = r#"
[[rigid]]
name = "wall"
shape = "wall"
centre = [0.012, 0.0]
normal = [-1.0, 0.0]
velocity = { x = -0.1 }
"#;
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("case.toml"), BAR.to_owned() + WALL).unwrap();
    said(folder.path(), "run case.toml --out results");
    let rows = table(&folder.path().join("results/history.csv"));
    let last = rows.last().unwrap();
    assert!((last["wall.displacement_x"] + 2e-6).abs() < 1e-15);
    assert_eq!(last["wall.velocity_x"], -0.1);
    assert!(last["wall.force_x"] < 0.0, "{}", last["wall.force_x"]);
}

/// A ball with a mass, which moves freely onto a bar, is told by `check`, drives the curve and is drawn.
#[test]
fn free_rigid_bodies_are_seen() {
    const BALL: &str = r#"
[[rigid]]
name = "ball"
shape = "circle"
centre = [0.01505, 0.002]
radius = 0.003
mass = 1e-3
velocity = { x = -10.0 }
"#;
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("case.toml"), BAR.to_owned() + BALL).unwrap();
    let words = said(folder.path(), "check case.toml");
    // The bar ends at 12 mm: 15.05 - 3 - 12.
    let ball =
        "rigid ball            circle, 50.00 um from the body, 0.001000 kg, 10.00 m/s at the start";
    assert!(words.contains(ball), "{words}");
    assert!(
        words.contains("controlled by         nothing; the curve is of `ball`"),
        "{words}"
    );
    said(
        folder.path(),
        "run case.toml --out results --set motion.rows=20",
    );
    let results = folder.path().join("results");
    let rows = table(&results.join("history.csv"));
    let last = rows.last().unwrap();
    // Along the way of the ball, which goes to the left through the gap of 50 um and comes back: the body resists it.
    let farthest = rows.iter().map(|it| it["displacement"]).fold(0.0, f64::max);
    assert!(farthest > 5e-5, "{farthest}");
    assert_eq!(last["displacement"], -last["ball.displacement_x"]);
    let largest = rows.iter().map(|it| it["reaction"]).fold(0.0, f64::max);
    assert!(largest > 0.0);
    assert!(rows.iter().all(|it| it["reaction"] == -it["ball.force_x"]));
    assert!(results.join("rigid.pvd").is_file() && results.join("rigid_0020.vtu").is_file());
    said(folder.path(), "plot results --out a.svg");
    let svg = fs::read_to_string(folder.path().join("a.svg")).unwrap();
    assert!(svg.contains("#8f98a3"), "the ball is grey");
    said(folder.path(), "report results");
    let page = fs::read_to_string(results.join("report.html")).unwrap();
    let start = page.find("\"rigid\":{").unwrap();
    assert!(page[start..].contains("\"displacements\":[[0.0,"));
}

/// Without external work the energy balance is measured by the energy at time zero, which is that of a ball of 1 g at 0.1 m/s: 5 uJ.
#[test]
fn a_motion_without_work_has_an_energy_balance() {
    const BALL: &str = r#"
[[rigid]]
name = "ball"
shape = "circle"
centre = [0.01505, 0.002]
radius = 0.003
mass = 1e-3
velocity = { x = -0.1 }
"#;
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("case.toml"), BAR.to_owned() + BALL).unwrap();
    let said = said(folder.path(), "run case.toml --out results");
    assert!(said.contains("of the energy put in"), "{said}");
    let results = folder.path().join("results");
    let rows = table(&results.join("history.csv"));
    let missing = |row: &BTreeMap<String, f64>| {
        let held = ["kinetic_energy", "stored_energy", "contact_energy"];
        (5e-6 - held.iter().map(|it| row[*it]).sum::<f64>()).abs()
    };
    let off = rows.iter().map(missing).fold(0.0, f64::max) / 5e-6;
    let summary = fs::read_to_string(results.join("summary.json")).unwrap();
    let summary: Value = serde_json::from_str(&summary).unwrap();
    let written = summary["energy_balance_error"].as_f64().unwrap();
    // The columns have 17 digits: their sum is rounded a few times.
    assert!(
        written > 0.0 && (written - off).abs() < 1e-14,
        "{written} {off}"
    );
}
