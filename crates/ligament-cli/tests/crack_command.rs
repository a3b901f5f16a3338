//! Calls of `ligament crack` and `ligament profile`, and the place at which a run reports the failure of the body.

#![allow(clippy::unwrap_used, reason = "a failed unwrap fails the test")]

use std::fs;
use std::path::Path;
use std::process::Output;

use serde_json::Value;

use crate::support::{ligament_in, text};

/// A bar of 120 x 60 x 10 mm with a slit of 20 mm from below in its middle, between two columns of cells, pulled apart along the exact path.
const BAR: &str = r#"title = "Bar with a slit"
[lattice]
cells = [24, 12]
spacing = 0.005
thickness = 0.01
[lattice.set]
left = { left = 1 }
right = { right = 1 }
[material]
young = 1e9
poisson = 0.2
fracture_energy = 50.0
[model]
law = "nhpd"
horizon_factor = 3.0
[[precrack]]
points = [[0.06, -0.001], [0.06, 0.0201]]
[[support]]
group = "left"
displacement = { x = 0.0, y = 0.0 }
[[load]]
group = "right"
displacement = { x = 4e-3, y = 0.0 }
[fracture]
control = "event"
stop = { load_fraction = 0.01 }
criterion = [{ kind = "bond-energy" }]
"#;

struct Place(tempfile::TempDir);

impl Place {
    fn with(case: &str, settings: &[&str]) -> Self {
        let place = Self(tempfile::tempdir().unwrap());
        fs::write(place.0.path().join("bar.toml"), case).unwrap();
        let mut words = vec!["run", "bar.toml", "--out", "out", "--quiet"];
        words.extend(settings.iter().flat_map(|it| ["--set", it]));
        let output = place.call(&words);
        assert!(output.status.success(), "{}", text(&output.stderr));
        place
    }

    fn call(&self, words: &[&str]) -> Output {
        ligament_in(self.0.path(), words)
    }

    fn table(&self, file: &str) -> Vec<Vec<String>> {
        let text = fs::read_to_string(self.0.path().join("out").join(file)).unwrap();
        let cells = |line: &str| line.split(',').map(str::to_owned).collect();
        text.lines().skip(1).map(cells).collect()
    }

    fn summary(&self) -> Value {
        let path = self.0.path().join("out/summary.json");
        serde_json::from_str(&fs::read_to_string(path).unwrap()).unwrap()
    }
}

fn number(text: &str) -> f64 {
    text.parse().unwrap()
}

/// The ligament of 40 mm above the slit parts between the two middle columns: one line at x = 60 mm from the slit to the outline, 400 mm^2.
/// The bonds across a crack along the rows hold 0.99 of the fracture energy at m = 3, the other bonds of a family none: the energy that
/// they dissipated is within a tenth of 50 J/m^2, and the compliance and the energies release no less.
#[test]
fn a_ligament_that_parts_is_one_crack_with_its_energy() {
    let place = Place::with(BAR, &[]);
    let output = place.call(&["crack", "out"]);
    assert!(output.status.success(), "{}", text(&output.stderr));
    assert!(text(&output.stdout).contains("1 crack line(s), 40.00 mm long, 400.0 mm^2 in area"));
    let line = place.table("crack.csv");
    let ends = [&line[0], &line[line.len() - 1]].map(|it| it[5].as_str());
    assert_eq!(ends, ["pre-crack", "outline"]);
    for row in &line {
        assert!((number(&row[2]) - 0.06).abs() < 1e-9, "{row:?}");
    }
    let growth = place.table("crack_growth.csv");
    let rates = growth.iter().filter(|row| !row[8].is_empty());
    let rates: Vec<[f64; 3]> = rates
        .map(|row| [8, 9, 10].map(|it| number(&row[it])))
        .collect();
    let mean = |of: usize| rates.iter().map(|it| it[of]).sum::<f64>() / rates.len() as f64;
    assert!(rates.len() > 3);
    assert!((mean(2) / 50.0 - 1.0).abs() < 0.1, "{}", mean(2));
    assert!(mean(1) > 0.99 * mean(2) && (mean(0) / mean(1) - 1.0).abs() < 0.15);
    let tips = place.table("crack_tips.csv");
    let heights: Vec<f64> = tips.iter().map(|row| number(&row[5])).collect();
    assert!(heights.len() > 3 && heights.is_sorted(), "{heights:?}");

    let summary = place.summary();
    let first = &summary["first_broken_bond"];
    let at = [0, 1].map(|axis| first["place"][axis].as_f64().unwrap());
    assert!(
        (at[0] - 0.06).abs() < 1e-9 && (at[1] - 0.02).abs() < 0.01,
        "{at:?}"
    );
    assert_eq!(
        (&first["step"], &first["criterion"]),
        (&1.into(), &"bond-energy".into())
    );
    let foretold = summary["first_break"]["reaction"].as_f64().unwrap();
    assert!((first["reaction"].as_f64().unwrap() / foretold - 1.0).abs() < 1e-9);
    let held = |group: &str| {
        summary["reactions_at_peak"][group]["force_x"]
            .as_f64()
            .unwrap()
    };
    let peak = summary["peak"]["reaction"].as_f64().unwrap();
    assert!((held("right") - peak).abs() < 1e-9 * peak);
    assert!((held("left") + peak).abs() < 1e-9 * peak);

    let repeated = place.call(&["repeat", "out"]);
    assert!(
        repeated.status.success(),
        "crack files are no results of the run"
    );
}

/// Softening begins before a bond breaks, and a crack opens before its bonds have lost all force.
#[test]
fn a_bar_that_softens_tells_where_that_began() {
    let fracture = "fracture={ steps = 30, stop = { load_fraction = 0.2 }, criterion = [{ kind = \"bond-energy\", limit = 2e-3, after = \"exponential\" }] }";
    let tough = "material.fracture_energy=2000";
    let place = Place::with(BAR, &[fracture, tough, "load.0.displacement.x=3e-3"]);
    let summary = place.summary();
    let begun = &summary["first_softened_bond"];
    let rows = place.table("softening.csv");
    assert_eq!(
        (rows[0][0].as_str(), rows[0][4].as_str()),
        (&*begun["step"].to_string(), "begins")
    );
    let ends = [5, 6].map(|it| number(&rows[0][it]) as i64);
    assert_eq!(begun["ends"], serde_json::json!(ends));
    let opened = rows.iter().filter(|row| row[4] == "opens");
    let opened: Vec<usize> = opened.map(|row| row[0].parse().unwrap()).collect();
    assert!(!opened.is_empty() && opened.is_sorted());
    assert!(opened[0] > number(&rows[0][0]) as usize);
    assert_eq!(
        summary["broken_bonds"], 0,
        "the load fell to a fifth, and no bond has lost all its force"
    );
    let count = |event: &str| rows.iter().filter(|row| row[4] == event).count();
    assert!(count("begins") >= count("half") && count("half") >= count("quarter"));
    assert!(count("quarter") >= opened.len());
    assert!(place.call(&["crack", "out"]).status.success());
    let growth = place.table("crack_growth.csv");
    let length = number(&growth[growth.len() - 1][6]);
    assert!((length - 0.04).abs() < 1e-9, "{growth:?}");
    // Before that, a crack at half of the force is longer than one at a tenth.
    let step = opened[0].to_string();
    let length_below = |share: &str| {
        let output = place.call(&["crack", "out", "--step", &step, "--force-left", share]);
        assert!(output.status.success(), "{}", text(&output.stderr));
        let lines = place.table("crack.csv");
        lines.iter().map(|row| number(&row[4])).fold(0.0, f64::max)
    };
    assert!(length_below("0.5") > length_below("0.1"));
    let wrong = place.call(&["crack", "out", "--force-left", "0.3"]);
    assert_eq!(wrong.status.code(), Some(2));
    assert!(text(&wrong.stderr).contains("0.5, 0.25, 0.1"));
}

/// A bar without a slit that carries 1e-3 all over, read along its axis: u = 1e-3 (x - x_0) in each cell, nothing beyond the body.
#[test]
fn a_profile_has_the_values_of_the_cells_along_a_line() {
    let elastic = BAR.split("[fracture]").next().unwrap();
    let (head, rest) = elastic.split_once("[[precrack]]").unwrap();
    let (_, rest) = rest.split_once("[[support]]").unwrap();
    let case = format!("{head}[[support]]{rest}").replace("poisson = 0.2", "poisson = 0.0");
    let place = Place::with(&case, &["load.0.displacement.x=1.15e-4"]);
    let words = [
        "profile",
        "out",
        "--from",
        "0.0025,0.03",
        "--to",
        "0.1225,0.03",
    ];
    let more = ["--field", "displacement.x", "volume", "--samples", "25"];
    let output = place.call(&[&words[..], &more[..]].concat());
    assert!(output.status.success(), "{}", text(&output.stderr));
    let shown = text(&output.stdout);
    let mut lines = shown.lines();
    assert_eq!(lines.next(), Some("step,along,x,y,displacement.x,volume"));
    let rows: Vec<Vec<&str>> = lines.map(|it| it.split(',').collect()).collect();
    assert_eq!(rows.len(), 25);
    for row in &rows[..24] {
        let [x, u] = [2, 4].map(|it| number(row[it]));
        // Bonds are fewer near the outline: the strain is uniform to some per cent.
        assert!((u - 1e-3 * (x - 0.0025)).abs() < 5e-6, "{row:?}");
        assert!((number(row[5]) - 2.5e-7).abs() < 1e-15);
    }
    assert_eq!(rows[24][4..], ["", ""], "beyond the body");
    let wrong = place.call(&[&words[..], &["--field", "damge"]].concat());
    assert_eq!(wrong.status.code(), Some(1));
    assert!(text(&wrong.stderr).contains("did you mean `damage`?"));
    let none = place.call(&["crack", "out"]);
    assert!(none.status.success() && text(&none.stdout).contains("0 crack line(s), 0 m long"));
    assert!(!Path::new(&place.0.path().join("out/crack.vtu")).exists());
}
