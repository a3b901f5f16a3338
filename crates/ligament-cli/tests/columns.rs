//! The page of columns against the tables that commands write: no column is missing on either side.

#![allow(clippy::unwrap_used, reason = "a failed unwrap fails the test")]

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};

use serde_json::Value;

use crate::support::{ligament_in, stderr};

const PAGE: &str = include_str!("../../../docs/columns.md");

/// A bar with a slit of 5 x 12 cells, held and pulled at its ends, held once more at a corner by a place without a name.
const BAR: &str = r#"title = "Bar with a slit"
[lattice]
cells = [12, 6]
spacing = 0.01
thickness = 0.01
[lattice.set]
left = { left = 1 }
right = { right = 1 }
[material]
young = 1e9
poisson = 0.2
tensile_strength = 1e6
fracture_energy = 50.0
[model]
law = "nhpd"
horizon_factor = 2.2
[[precrack]]
points = [[0.06, -0.001], [0.06, 0.021]]
[[support]]
group = "left"
displacement = { x = 0.0, y = 0.0 }
[[support]]
at = [0.005, 0.005]
displacement = { x = 0.0 }
[[load]]
group = "right"
displacement = { x = 4e-4 }
[[probe]]
name = "elongation"
between = [[0.005, 0.03], [0.115, 0.03]]
component = "x"
[fracture]
steps = 10
"#;

/// The bar pulled by a sudden force that tears it from the slit on.
fn moving() -> String {
    let steps = "[fracture]\nsteps = 10";
    let motion = "[fracture]\n[motion]\nduration = 3e-4\nrows = 30";
    let load = "displacement = { x = 4e-4 }";
    let ball = "shape = \"circle\"\ncentre = [0.3, 0.03]\nradius = 0.1\nvelocity = { x = -1.0 }\n";
    let bar = BAR
        .replace(steps, motion)
        .replace(load, "force = { x = 600.0 }")
        .replace("young = 1e9", "young = 1e9\ndensity = 2000.0");
    format!("{bar}{BALL}{ball}")
}

/// A rigid ball that flies towards the bar and turns.
const BALL: &str = r#"
[[rigid]]
name = "ball"
mass = 1.0
inertia = 1e-3
"#;

/// The solid bar as a motion, beside a ball.
fn moving_solid() -> String {
    let steps = "[fracture]\nsteps = 12\nstop = { load_fraction = 0.1 }";
    let motion = "[motion]\nduration = 1e-5\nrows = 2";
    let load = "displacement = { x = 2.4e-4 }";
    let ball =
        "shape = \"sphere\"\ncentre = [0.2, 0.02, 0.02]\nradius = 0.05\nvelocity = { x = -1.0 }\n";
    let solid = SOLID
        .replace(steps, motion)
        .replace(load, "force = { x = 60.0 }");
    format!("{solid}{BALL}{ball}")
}

/// A bar in space of 8 x 4 x 4 cells.
const SOLID: &str = include_str!("support/small-solid.toml");

const STUDY: &str = r#"title = "Bars"
case = "bar.toml"
[[axis]]
key = "material.tensile_strength"
values = [1e6, 1.2e6]
labels = ["weak", "strong"]
[[axis]]
key = "model.horizon_factor"
values = [2.2, 2.7]
[[result]]
name = "relative"
of = "peak.reaction"
over = 2.0
[[result]]
name = "cracked"
of = "crack.length"
[[plot]]
x = "model.horizon_factor"
y = "relative"
by = "material.tensile_strength"
fit = {}
"#;

/// Names that stand for the words in capitals, by these words.
type Names = BTreeMap<&'static str, BTreeSet<String>>;

struct Place(tempfile::TempDir);

impl Place {
    fn path(&self, name: &str) -> PathBuf {
        self.0.path().join(name)
    }

    fn call(&self, words: &str) {
        let arguments: Vec<&str> = words.split_whitespace().collect();
        let output = ligament_in(self.0.path(), &arguments);
        let error = stderr(&output);
        // A run may end while bonds break: its tables are whole.
        assert!(
            matches!(output.status.code(), Some(0 | 6)),
            "{words}: {error}"
        );
    }

    fn header(&self, file: &str) -> Vec<String> {
        header(&self.path(file))
    }
}

fn header(path: &Path) -> Vec<String> {
    let text = fs::read_to_string(path).unwrap_or_else(|it| panic!("{}: {it}", path.display()));
    let line = text.lines().next().unwrap();
    line.split(',')
        .map(|it| it.trim_matches('"').to_owned())
        .collect()
}

/// The columns of the page by the headings of their tables.
fn page() -> BTreeMap<&'static str, Vec<&'static str>> {
    let mut tables: BTreeMap<&str, Vec<&str>> = BTreeMap::new();
    let mut heading = "";
    for line in PAGE.lines() {
        if let Some(name) = line.strip_prefix("### ") {
            heading = name;
        } else if let Some((column, rest)) =
            line.strip_prefix("| `").and_then(|it| it.split_once('`'))
        {
            assert_eq!(
                rest.matches(" | ").count() + rest.matches("| |").count(),
                2,
                "{line}"
            );
            tables.entry(heading).or_default().push(column);
        }
    }
    tables
}

/// The columns that a line of the page describes.
fn meant(column: &str, names: &Names) -> BTreeSet<String> {
    for (word, values) in names {
        let is_whole = |it: &str| {
            it.split(|c: char| !c.is_ascii_uppercase())
                .any(|it| it == *word)
        };
        if is_whole(column) {
            return values
                .iter()
                .map(|value| column.replace(word, value))
                .collect();
        }
    }
    BTreeSet::from([column.to_owned()])
}

fn set(names: &[&str]) -> BTreeSet<String> {
    names.iter().map(|it| (*it).to_owned()).collect()
}

/// Paths of all values of a summary, joined by dots.
fn paths(value: &Value, path: &str, found: &mut BTreeSet<String>) {
    let inside = |name: &str| {
        if path.is_empty() {
            name.to_owned()
        } else {
            format!("{path}.{name}")
        }
    };
    match value {
        Value::Object(map) => map
            .iter()
            .for_each(|(name, it)| paths(it, &inside(name), found)),
        Value::Array(list) => {
            let numbered = list.iter().enumerate();
            numbered.for_each(|(place, it)| paths(it, &inside(&place.to_string()), found));
        }
        _ => drop(found.insert(path.to_owned())),
    }
}

/// Compares the written headers of tables under one heading with the page.
fn compare(heading: &str, written: &[Vec<String>], names: &Names, wrong: &mut Vec<String>) {
    let page = page();
    let lines = page
        .get(heading)
        .unwrap_or_else(|| panic!("no heading {heading}"));
    let written: BTreeSet<&String> = written.iter().flatten().collect();
    let known: Vec<(&str, BTreeSet<String>)> =
        lines.iter().map(|it| (*it, meant(it, names))).collect();
    for column in &written {
        if !known.iter().any(|(_, meant)| meant.contains(*column)) {
            wrong.push(format!(
                "{heading}: `{column}` is written and not on the page"
            ));
        }
    }
    for (line, meant) in known {
        if !meant.iter().any(|it| written.contains(it)) {
            wrong.push(format!(
                "{heading}: `{line}` is on the page and not written"
            ));
        }
    }
}

/// Runs whose tables together have all columns: on a lattice, brittle and softening; with strains of their own; on a mesh; with cracks that close; in stages;
/// in space; between points of a table; in time; modes.
fn runs(place: &Place) -> [&'static str; 10] {
    fs::write(place.path("bar.toml"), BAR).unwrap();
    let meshes = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../meshes");
    let case = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../cases/brazilian-disk/case.toml");
    let disk = format!(
        "{} --set mesh.file={}/disk-4mm.msh",
        case.display(),
        meshes.display()
    );
    place.call("run bar.toml --out brittle --quiet");
    let tension = "fracture.criterion=[{kind=\"tension\",after=\"bilinear\",end=6.0}]";
    place.call(&format!("run bar.toml --out soft --quiet --set {tension}"));
    place.call("run bar.toml --out mbb --quiet --set model.law=mbb-pd --set model.horizon_factor=3 --set fracture.stop.bonds=4");
    place.call(&format!(
        "run {disk} --out mesh --quiet --set {tension} --set fracture.steps=[0.05,0.1]"
    ));
    let modal =
        Path::new(env!("CARGO_MANIFEST_DIR")).join("../ligament-case/tests/data/modal-plate.toml");
    let plate = meshes.join("plate-coarse.msh");
    place.call(&format!(
        "run {} --set mesh.file={} --set modal.modes=2 --out modal --quiet",
        modal.display(),
        plate.display()
    ));
    place.call("run bar.toml --out closing --quiet --set model.closing=true");
    let stage = "stage=[{name=\"pull\",loads={right=1.0},steps=4}]";
    place.call(&format!(
        "run bar.toml --out stages --quiet --unset fracture.steps --set {stage}"
    ));
    let mut points = "x,y,area,left,right\n".to_owned();
    for (i, j) in (0..12).flat_map(|i| (0..4).map(move |j| (i, j))) {
        let (x, y) = (0.01 * f64::from(i), 0.01 * f64::from(j));
        let [left, right] = [i < 2, i > 9].map(u8::from);
        points.push_str(&format!("{x},{y},1e-4,{left},{right}\n"));
    }
    fs::write(place.path("places.csv"), points).unwrap();
    let (_, sections) = BAR.split_once("[material]").unwrap();
    let of_points = "[mesh]\nfile = \"places.csv\"\nthickness = 0.01\n[material]";
    fs::write(place.path("points.toml"), format!("{of_points}{sections}")).unwrap();
    let volume = "--set correction.surface=volume";
    place.call(&format!(
        "run points.toml --out cloud --quiet {volume} --set {tension}"
    ));
    fs::write(place.path("solid.toml"), SOLID).unwrap();
    place.call("run solid.toml --out solid --quiet");
    place.call(
        "run solid.toml --out solid-modal --quiet --set analysis=\"modal\" --set modal.modes=1 --unset fracture --unset load --unset probe \
         --unset no_fail --unset output",
    );
    fs::write(place.path("moving.toml"), moving()).unwrap();
    place.call("run moving.toml --out moving --quiet");
    fs::write(place.path("moving-solid.toml"), moving_solid()).unwrap();
    place.call("run moving-solid.toml --out moving-solid --quiet");
    [
        "brittle",
        "soft",
        "mbb",
        "mesh",
        "closing",
        "stages",
        "solid",
        "cloud",
        "moving",
        "moving-solid",
    ]
}

#[test]
fn the_page_has_every_column_that_is_written() {
    let place = Place(tempfile::tempdir().unwrap());
    let runs = runs(&place);
    let mut names = Names::new();
    names.insert(
        "GROUP",
        set(&[
            "left",
            "right",
            "support-2",
            "platen-top",
            "platen-bottom",
            "pole-top",
            "pole-bottom",
        ]),
    );
    names.insert("LOAD", set(&["right"]));
    names.insert("CONTACT", set(&["ball"]));
    names.insert("RIGID", set(&["ball"]));
    names.insert("PROBE", set(&["elongation"]));
    names.insert("FIELD", set(&["damage", "displacement.x"]));
    names.insert(
        "CRITERION",
        set(&["strength", "tension", "mixed-mode-x", "mixed-mode-y"]),
    );
    names.insert(
        "KEY",
        set(&["material.tensile_strength", "model.horizon_factor"]),
    );
    let mut wrong = Vec::new();
    let wrong = &mut wrong;
    for file in [
        "history.csv",
        "breaks.csv",
        "criteria.csv",
        "iterations.csv",
        "timings.csv",
    ] {
        let headers = runs.map(|run| place.header(&format!("{run}/{file}")));
        compare(file, &headers, &names, wrong);
    }
    let soft = ["soft", "mesh", "cloud"].map(|run| place.header(&format!("{run}/softening.csv")));
    compare("softening.csv", &soft, &names, wrong);
    compare(
        "modes.csv",
        &["modal", "solid-modal"].map(|run| place.header(&format!("{run}/modes.csv"))),
        &names,
        wrong,
    );
    of_stored_results(&place, &names, wrong);
    of_studies(&place, &mut names, wrong);
    of_verification(&mut names, wrong);
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

fn of_stored_results(place: &Place, names: &Names, wrong: &mut Vec<String>) {
    place.call("crack brittle");
    place.call("crack moving");
    for file in ["crack.csv", "crack_tips.csv"] {
        let headers = ["brittle", "moving"].map(|run| place.header(&format!("{run}/{file}")));
        compare(file, &headers, names, wrong);
    }
    place.call("crack solid");
    let growth =
        ["brittle", "moving", "solid"].map(|run| place.header(&format!("{run}/crack_growth.csv")));
    compare("crack_growth.csv", &growth, names, wrong);
    place.call(
        "profile soft --from 0,0.03 --to 0.12,0.03 --field damage displacement.x --out profile.csv",
    );
    place.call("profile soft --from 0,0.03 --to 0.12,0.03 --opening --out opening.csv");
    compare(
        "The table of `ligament profile`",
        &["profile.csv", "opening.csv"].map(|file| place.header(file)),
        names,
        wrong,
    );
    let lives = ["brittle", "soft", "mbb", "mesh", "cloud"].map(|run| {
        place.call(&format!("explain {run} --point 40 --csv {run}.csv"));
        place.header(&format!("{run}.csv"))
    });
    compare("The table of `ligament explain`", &lives, names, wrong);
}

fn of_studies(place: &Place, names: &mut Names, wrong: &mut Vec<String>) {
    fs::write(place.path("study.toml"), STUDY).unwrap();
    place.call("sweep study.toml --out sweep");
    let table = place.header("sweep/table.csv");
    let mut results = BTreeSet::new();
    for run in fs::read_dir(place.path("sweep/runs")).unwrap() {
        let text = fs::read_to_string(run.unwrap().path().join("summary.json")).unwrap();
        paths(&serde_json::from_str(&text).unwrap(), "", &mut results);
    }
    names.insert("RESULT", results);
    names.insert(
        "LABEL",
        set(&[
            "relative",
            "cracked",
            "tensile_strength.label",
            "material.tensile_strength.label",
        ]),
    );
    let inputs = table.iter().filter_map(|it| it.strip_prefix("case."));
    names
        .get_mut("KEY")
        .unwrap()
        .extend(inputs.map(str::to_owned));
    compare("table.csv of `ligament sweep`", &[table], names, wrong);
    compare(
        "fits.csv of `ligament sweep`",
        &[place.header("sweep/fits.csv")],
        names,
        wrong,
    );
    place.call("ensemble bar.toml --set fracture.scatter.of=strength --set fracture.scatter.modulus=8 --samples 2 --points 3 --out many");
    for table in ["samples.csv", "curves.csv", "weibull.csv", "points.csv"] {
        let header = place.header(&format!("many/{table}"));
        compare(
            &format!("{table} of `ligament ensemble`"),
            &[header],
            names,
            wrong,
        );
    }
    place.call("calibrate bar.toml --key material.tensile_strength --of first_break.reaction --target 1000 --within 0.5 --out sought");
    compare(
        "calibration.csv",
        &[place.header("sought/calibration.csv")],
        names,
        wrong,
    );
    place.call("stiffness bar.toml --out stiff");
    compare(
        "stiffness.csv",
        &[place.header("stiff/stiffness.csv")],
        names,
        wrong,
    );
    place.call("yield --m 2 --criterion tension --out lattices");
    compare(
        "yield.csv over lattices, without a case",
        &[place.header("lattices/yield.csv")],
        names,
        wrong,
    );
    for file in ["orientation.csv", "locus.csv"] {
        compare(
            file,
            &[place.header(&format!("lattices/{file}"))],
            names,
            wrong,
        );
    }
    place.call("yield --case bar.toml --out points");
    compare(
        "yield.csv of a case",
        &[place.header("points/yield.csv")],
        names,
        wrong,
    );
}

/// The stored tables of the verification, which another test compares with what the command writes.
fn of_verification(names: &mut Names, wrong: &mut Vec<String>) {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../cases/verification");
    let summary = header(&folder.join("verification.csv"));
    names.insert("LABEL", summary[3..].iter().cloned().collect());
    compare(
        "verification.csv of `ligament-verify`",
        &[summary],
        names,
        wrong,
    );
    let tables = fs::read_dir(folder).unwrap().map(|it| it.unwrap().path());
    let tables = tables.filter(|it| it.extension().is_some_and(|it| it == "csv"));
    let tables = tables.filter(|it| !it.ends_with("verification.csv"));
    let headers: Vec<Vec<String>> = tables.map(|it| header(&it)).collect();
    // The name of a column precedes the known values.
    let labels = headers
        .iter()
        .flat_map(|it| it.iter().take_while(|it| *it != "known"));
    names.insert("LABEL", labels.cloned().collect());
    compare("The tables of `ligament-verify`", &headers, names, wrong);
}
