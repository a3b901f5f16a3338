//! `ligament explain` as it is called, against closed forms and against what other files of a run say.

#![allow(clippy::unwrap_used, reason = "a failed unwrap fails the test")]

use std::ffi::OsStr;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

use ligament_output::results::stored::StoredRun;
use serde_json::Value;

fn ligament<S: AsRef<OsStr>>(arguments: impl IntoIterator<Item = S>) -> Output {
    Command::new(env!("CARGO_BIN_EXE_ligament"))
        .args(arguments)
        .output()
        .unwrap()
}

fn text(bytes: &[u8]) -> String {
    String::from_utf8(bytes.to_vec()).unwrap()
}

/// Runs a case in a folder; the results are in `results` there.
fn run(folder: &Path, case: &str, settings: &[&str]) -> PathBuf {
    let (path, out) = (folder.join("case.toml"), folder.join("results"));
    fs::write(&path, case).unwrap();
    let mut arguments: Vec<&OsStr> = vec!["run".as_ref(), path.as_ref(), "--out".as_ref()];
    arguments.extend([out.as_os_str(), "--force".as_ref(), "--quiet".as_ref()]);
    for setting in settings {
        arguments.extend([OsStr::new("--set"), OsStr::new(setting)]);
    }
    let output = ligament(arguments);
    assert_eq!(output.status.code(), Some(0), "{}", text(&output.stderr));
    out
}

fn explain(results: &Path, words: &[&str]) -> String {
    let output = call(results, words);
    assert_eq!(output.status.code(), Some(0), "{}", text(&output.stderr));
    text(&output.stdout)
}

fn call(results: &Path, words: &[&str]) -> Output {
    let start = [OsStr::new("explain"), results.as_os_str()];
    ligament(start.into_iter().chain(words.iter().map(OsStr::new)))
}

fn refusal(results: &Path, words: &[&str]) -> String {
    let output = call(results, words);
    assert_eq!(output.status.code(), Some(1), "{}", text(&output.stdout));
    text(&output.stderr)
}

/// The bonds that `--json` gives.
fn bonds(results: &Path, words: &[&str]) -> Vec<Value> {
    let file = results.with_extension("json");
    let mut all = words.to_vec();
    let path = file.display().to_string();
    all.extend(["--json", &path]);
    explain(results, &all);
    let document: Value = serde_json::from_str(&fs::read_to_string(file).unwrap()).unwrap();
    document["bonds"].as_array().unwrap().clone()
}

fn bond(results: &Path, a: u32, b: u32) -> Value {
    let [a, b] = [a, b].map(|tag| tag.to_string());
    let found = bonds(results, &["--bond", &a, &b]);
    assert_eq!(found.len(), 1);
    found[0].clone()
}

fn number(value: &Value) -> f64 {
    value.as_f64().unwrap()
}

/// A lattice of 9 by 5 cells of 10 mm whose points all move along x in proportion to x: the strain of load factor f is f/1000 along x.
/// Points of the middle row are free along y and stay there by symmetry. Bonds resist stretch alone, without any correction.
/// A pre-crack cuts the bonds along the middle row between columns 0 and 1; bonds of the last column never fail.
const BAR: &str = r#"
[lattice]
cells = [9, 5]
spacing = 0.01
thickness = 0.01
[lattice.set]
below = { bottom = 2 }
above = { top = 2 }
all = { bottom = 5 }
last = { right = 1 }
[material]
young = 15e9
poisson = 0.3333333333333333
tensile_strength = 4.4e6
[model]
law = "bbpd"
horizon_factor = 3.0
[correction]
alpha = "none"
surface = "none"
[[precrack]]
points = [[0.01, 0.021], [0.01, 0.029]]
[[no_fail]]
group = "last"
[[support]]
group = "below"
displacement = { y = 0.0 }
[[support]]
group = "above"
displacement = { y = 0.0 }
[[load]]
group = "all"
displacement = { x = 9e-5 }
profile = { along = "x", zero = 0.0, one = 0.09 }
[fracture]
steps = 10
[output]
fields_every = 1
"#;

const SPACING: f64 = 0.01;

/// Tag of the cell in a column and a row, both from 0.
fn cell(column: u32, row: u32) -> u32 {
    9 * row + column + 1
}

/// s_0 = sqrt(2 e_0/(V c l)), e_0 = F^2/(2 E (1 - nu^2)), c = 9 E/(pi t H^3) for a length l.
fn critical_stretch(length: f64) -> f64 {
    let (young, thickness, strength): (f64, f64, f64) = (15e9, 0.01, 4.4e6);
    let energy = strength.powi(2) / (2.0 * young * (1.0 - 1.0 / 9.0));
    let volume = SPACING * SPACING * thickness;
    let constant = 9.0 * young / (std::f64::consts::PI * thickness * (3.0 * SPACING).powi(3));
    (2.0 * energy / (volume * constant * length)).sqrt()
}

/// A bond over (across, up) cells: length, s over load factor, and s_0.
fn closed_form(across: f64, up: f64) -> [f64; 3] {
    let length = SPACING * across.hypot(up);
    let stretch = 1e-3 * (across * SPACING / length).powi(2);
    [length, stretch, critical_stretch(length)]
}

/// Stretches, utilisations and steps of breaking of a bar under uniform strain, for bonds in three directions.
///
/// Horizons and factors are stored with seven digits, the rest with all; positions of the cells are rounded to 1e-17 of 1e-2.
#[test]
fn a_uniform_strain_gives_the_closed_form() {
    let folder = tempfile::tempdir().unwrap();
    let results = run(folder.path(), BAR, &[]);
    for (across, up) in [(1, 0), (2, 0), (3, 0), (2, 1), (1, 1), (1, 2), (0, 1)] {
        let [length, stretch, limit] = closed_form(f64::from(across), f64::from(up));
        let found = bond(&results, cell(2, 2), cell(2 + across, 2 + up));
        assert!((number(&found["length"]) / length - 1.0).abs() < 1e-12);
        assert!((number(&found["horizon"]) / 0.03 - 1.0).abs() < 1e-7);
        assert_eq!(
            (number(&found["alpha"]), number(&found["omega"])),
            (1.0, 1.0)
        );
        let expected = f64::from(up).atan2(f64::from(across)).to_degrees();
        assert!((number(&found["angle"]) - expected).abs() < 1e-9);
        let of_criterion = &found["limits"][0];
        assert_eq!(of_criterion["criterion"], "strength");
        assert_eq!(of_criterion["measure"], "tension");
        assert!((number(&of_criterion["limit"]) / limit - 1.0).abs() < 1e-12);

        // It breaks in the first step in which s >= s_0.
        let breaks_in = (1..=10).find(|step| *step as f64 / 10.0 * stretch >= limit);
        let path = found["path"].as_array().unwrap();
        assert_eq!(path.len(), 11);
        for (step, moment) in path.iter().enumerate() {
            let load_factor = step as f64 / 10.0;
            assert!((number(&moment["load_factor"]) - load_factor).abs() < 1e-15);
            assert!((number(&moment["stretch"]) - load_factor * stretch).abs() < 1e-15);
            let expected = load_factor * stretch / limit;
            assert!((number(&moment["utilisation"][0]) - expected).abs() < 1e-11);
            let is_intact = breaks_in.is_none_or(|breaks_in| step < breaks_in);
            assert_eq!(moment["intact"], is_intact, "{across}, {up} in step {step}");
        }
        match breaks_in {
            Some(step) => {
                let breakage = &found["breakage"];
                assert_eq!(number(&breakage["step"]), step as f64);
                assert_eq!(breakage["criterion"], "strength");
                let ratio = step as f64 / 10.0 * stretch / limit;
                assert!((number(&breakage["utilisation"]) - ratio).abs() < 1e-11);
                assert!((number(&found["largest"]["utilisation"]) - ratio).abs() < 1e-11);
            }
            None => {
                assert_eq!(found["breakage"], Value::Null);
                // Seven digits.
                let largest = number(&found["largest"]["utilisation"]);
                assert!((largest - stretch / limit).abs() < 1e-7, "{largest}");
            }
        }
    }
}

/// The stored largest utilisation is that of the steps in which a bond was intact, not of the gap that it left.
#[test]
fn a_broken_bond_has_the_largest_utilisation_from_before() {
    let folder = tempfile::tempdir().unwrap();
    let model = StoredRun::open(&run(folder.path(), BAR, &[]))
        .unwrap()
        .model;
    let [a, b] = [cell(2, 2), cell(5, 2)].map(|tag| tag - 1);
    let pair = model
        .bonds
        .ends
        .iter()
        .position(|ends| *ends == [a, b])
        .unwrap();
    let [_, stretch, limit] = closed_form(3.0, 0.0);
    let breaks_in = (1..=10)
        .find(|step| f64::from(*step) / 10.0 * stretch >= limit)
        .unwrap();
    let largest = model.largest.unwrap();
    let expected = f64::from(breaks_in - 1) / 10.0 * stretch / limit;
    // Seven digits.
    assert!((largest.utilisation[pair] - expected).abs() < 1e-7);
    assert_eq!(largest.step[pair], i64::from(breaks_in - 1));
}

/// What `explain` says of the order of breaking is what `breaks.csv` says.
#[test]
fn breakages_are_those_of_the_table() {
    let folder = tempfile::tempdir().unwrap();
    let results = run(folder.path(), BAR, &[]);
    let table = fs::read_to_string(results.join("breaks.csv")).unwrap();
    let rows: Vec<Vec<&str>> = table
        .lines()
        .skip(1)
        .map(|line| line.split(',').collect())
        .collect();
    let point = cell(4, 2).to_string();
    let expected: Vec<(&str, &str)> = rows
        .iter()
        .filter(|row| row[6] == point || row[7] == point)
        .map(|row| (row[0], if row[6] == point { row[7] } else { row[6] }))
        .collect();
    assert!(expected.len() > 8, "{}", expected.len());
    let said = explain(&results, &["--point", &point]);
    let told: Vec<(&str, &str)> = said
        .lines()
        .filter_map(|line| line.split_once("broke, number "))
        .map(|(line, order)| (order, line.split_whitespace().next().unwrap()))
        .collect();
    assert_eq!(told, expected);
    let count = format!("{} broke, from number {}", expected.len(), expected[0].0);
    assert!(said.contains(&count), "{said}");
    let of_all = format!("of {} broken bonds", rows.len());
    let said = explain(&results, &["--bond", &point, expected[0].1]);
    assert!(said.contains(&of_all), "{said}");
}

#[test]
fn it_says_why_there_is_no_bond_or_no_breakage() {
    let folder = tempfile::tempdir().unwrap();
    let results = run(folder.path(), BAR, &[]);
    let say = |a: u32, b: u32| {
        let tags = [a, b].map(|tag| tag.to_string());
        explain(&results, &["--bond", &tags[0], &tags[1]])
    };
    let cut = say(cell(0, 2), cell(1, 2));
    assert!(cut.contains("a pre-crack cut it"), "{cut}");
    let far = say(cell(8, 4), cell(0, 0));
    let distance = SPACING * 8_f64.hypot(4.0);
    assert!(
        far.contains(&format!("distance is {distance:.4e} m")),
        "{far}"
    );
    assert!(
        far.contains("neither lies in the horizon of the other"),
        "{far}"
    );
    assert!(far.contains("reach 3.0000e-2 m"), "{far}");
    let held = say(cell(6, 2), cell(8, 2));
    assert!(held.contains("never fails by its stretch s"), "{held}");
    let why = format!("bonds of cell {} never fail (`no_fail`)", cell(8, 2));
    assert!(held.contains(&why), "{held}");
    let upright = say(cell(4, 2), cell(4, 3));
    assert!(
        upright.contains("its utilisation was 0 all along"),
        "{upright}"
    );
    let slanted = say(cell(4, 2), cell(5, 3));
    let [_, stretch, limit] = closed_form(1.0, 1.0);
    let largest = format!(
        "largest utilisation was {:.4}, in step 10, by `strength`",
        stretch / limit
    );
    assert!(slanted.contains(&largest), "{slanted}");
}

/// A plate that is stretched and sheared, along the exact path.
const SHEARED: &str = r#"
[lattice]
cells = [10, 6]
spacing = 0.01
[lattice.set]
left = { left = 1 }
right = { right = 1 }
[material]
young = 15e9
poisson = 0.21
tensile_strength = 3.81e6
[model]
law = "nhpd"
horizon_factor = 3.0
[[support]]
group = "left"
displacement = { x = 0.0, y = 0.0 }
[[load]]
group = "right"
displacement = { x = 1e-4, y = 3e-5 }
[fracture]
control = "event"
stop = { bonds = 12 }
[output]
fields_every = 1
"#;

/// A hole takes the middle column but its ends: no cell there has a bond across, and the tags count what is left.
#[test]
fn a_hole_parts_its_sides() {
    let folder = tempfile::tempdir().unwrap();
    let hole = "remove = [{ rectangle = [[0.04, 0.01], [0.05, 0.04]] }]\n[lattice.set]";
    let results = run(folder.path(), &BAR.replacen("[lattice.set]", hole, 1), &[]);
    // Row 0 is whole; rows 1 and 2 have 8 cells each: columns 3 and 5 of row 2 are beside the hole.
    let [left, right] = [9 + 8 + 4, 9 + 8 + 5].map(|tag| tag.to_string());
    let said = explain(&results, &["--bond", &left, &right]);
    assert!(said.contains("distance is 2.0000e-2 m"), "{said}");
    assert!(said.contains("a hole lies between them"), "{said}");
    let family = explain(&results, &["--point", &left]);
    assert!(family.contains("across a hole"), "{family}");
}

/// Along the exact path a bond is at its limit in the event in which it breaks, and before it in proportion to the load: with
/// rotations of the points, from fields that know nothing of limits.
#[test]
fn on_the_exact_path_bonds_break_at_their_limit() {
    let folder = tempfile::tempdir().unwrap();
    let results = run(folder.path(), SHEARED, &[]);
    let table = fs::read_to_string(results.join("breaks.csv")).unwrap();
    let mut seen = 0;
    for row in table.lines().skip(1) {
        let row: Vec<&str> = row.split(',').collect();
        let step: usize = row[1].parse().unwrap();
        let found = bonds(&results, &["--bond", row[6], row[7]]);
        let path = found[0]["path"].as_array().unwrap();
        let utilisation = |step: usize| number(&path[step]["utilisation"][0]);
        // The fields hold the displacements to the last bit: rounding of their differences over a bond is left.
        assert!((utilisation(step) - 1.0).abs() < 1e-9, "{row:?}");
        assert_eq!(path[step]["intact"], true);
        assert_eq!(path[step + 1]["intact"], false);
        let broke = &found[0]["breakage"];
        for quantity in ["stretch", "shear"] {
            let (then, of_fields) = (number(&broke[quantity]), number(&path[step][quantity]));
            assert!(
                (then - of_fields).abs() < 1e-9 * number(&broke["stretch"]),
                "{quantity}"
            );
        }
        if step == 1 {
            // The first event is the end of the line from the unloaded body.
            let first_load: f64 = row[3].parse().unwrap();
            assert!((number(&path[1]["load_factor"]) - first_load).abs() < 1e-12 * first_load);
            seen += 1;
        }
    }
    assert!(seen > 0);
    // Before the first breakage everything grows with the load: a stepped run below it.
    let first: Vec<&str> = table.lines().nth(1).unwrap().split(',').collect();
    let critical: f64 = first[3].parse().unwrap();
    let stepped = SHEARED.replace("control = \"event\"", "steps = [0.05, 0.1]");
    let results = run(folder.path(), &stepped, &[]);
    let found = bonds(&results, &["--bond", first[6], first[7]]);
    for (step, factor) in [(1, 0.05), (2, 0.1)] {
        if factor < critical {
            let utilisation = number(&found[0]["path"][step]["utilisation"][0]);
            assert!(
                (utilisation - factor / critical).abs() < 1e-9,
                "{utilisation}"
            );
        }
    }
}

/// The largest utilisation is that of all events, also of those without fields, and the last is not the worst for all bonds.
#[test]
fn the_largest_utilisation_is_of_all_events() {
    let folder = tempfile::tempdir().unwrap();
    let point = ["--point", "25"];
    let all = bonds(&run(folder.path(), SHEARED, &[]), &point);
    let results = run(folder.path(), SHEARED, &["output.fields_every=0"]);
    let history = fs::read_to_string(results.join("history.csv")).unwrap();
    let note = format!("2 of {} steps have fields", history.lines().count() - 1);
    assert!(explain(&results, &point).contains(&note), "{note}");
    let few = bonds(&results, &point);
    assert_eq!(all.len(), few.len());
    let mut before_the_end = 0;
    for (all, few) in all
        .iter()
        .zip(&few)
        .filter(|(all, _)| all["breakage"].is_null())
    {
        let path = all["path"].as_array().unwrap();
        let of_path = path.iter().map(|it| number(&it["utilisation"][0]));
        let largest = of_path.fold(0.0, f64::max);
        // Seven digits.
        let told = number(&few["largest"]["utilisation"]);
        assert!((told - largest).abs() <= 4e-7 * largest, "{told} {largest}");
        let step = number(&few["largest"]["step"]) as usize;
        assert!((number(&path[step]["utilisation"][0]) - largest).abs() <= 4e-7 * largest);
        before_the_end += usize::from(0 < step && step + 1 < path.len());
    }
    assert!(before_the_end > 3, "{before_the_end}");
}

/// The mesh may be gone and the folder elsewhere.
#[test]
fn the_folder_alone_is_enough() {
    let folder = tempfile::tempdir().unwrap();
    let mesh = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../meshes/plate-coarse.msh");
    fs::copy(mesh, folder.path().join("plate.msh")).unwrap();
    let case = r#"
mesh = { file = "plate.msh" }
material = { young = 15e9, poisson = 0.21, tensile_strength = 3.81e6 }
model = { law = "nhpd", horizon_factor = 3.0 }
support = [{ group = "left", displacement = { x = 0.0, y = 0.0 } }]
load = [{ group = "right", displacement = { x = 5e-5 } }]
fracture = { steps = 4 }
output = { fields_every = 2 }
"#;
    let results = run(folder.path(), case, &[]);
    let at = ["--at", "-0.5,0.031"];
    let before = explain(&results, &at);
    let elsewhere = tempfile::tempdir().unwrap();
    let moved = elsewhere.path().join("moved");
    fs::rename(&results, &moved).unwrap();
    fs::remove_file(folder.path().join("plate.msh")).unwrap();
    let after = explain(&moved, &at);
    let below_title = |text: &str| text.split_once('\n').unwrap().1.to_owned();
    assert_eq!(below_title(&before), below_title(&after));
    assert!(after.starts_with("node "), "{after}");
    assert!(
        after.contains("nearest to        (-0.500000, 0.031000) m"),
        "{after}"
    );
    assert!(after.contains("3 of 5 steps have fields"), "{after}");
}

#[test]
fn what_is_not_there_is_named() {
    let folder = tempfile::tempdir().unwrap();
    let results = run(folder.path(), BAR, &["output.fields_every=0"]);
    let unknown = refusal(&results, &["--point", "46"]);
    let expected = "error: there is no cell 46: the tags go from 1 to 45, the nearest is 45\n";
    assert_eq!(unknown, expected);
    let unknown = refusal(&results, &["--bond", "1", "0"]);
    assert!(
        unknown.contains("no cell 0: the tags go from 1 to 45, the nearest is 1"),
        "{unknown}"
    );
    let same = refusal(&results, &["--bond", "7", "7"]);
    assert!(
        same.contains("both are cell 7") && same.contains("--point 7"),
        "{same}"
    );
    let nowhere = refusal(&folder.path().join("nowhere"), &["--point", "1"]);
    assert!(nowhere.contains("there is no such folder"), "{nowhere}");
    let no_results = refusal(folder.path(), &["--point", "1"]);
    assert!(
        no_results.contains("it has no case.resolved.toml"),
        "{no_results}"
    );
    let file = refusal(&folder.path().join("case.toml"), &["--point", "1"]);
    assert!(file.contains("it is a file"), "{file}");
    for wrong in [
        vec![],
        vec!["--at", "1"],
        vec!["--bond", "1"],
        vec!["--point", "1", "--at", "0,0"],
    ] {
        assert_eq!(call(&results, &wrong).status.code(), Some(2), "{wrong:?}");
    }
    // What an earlier version, or a case without it, leaves out.
    let without = run(folder.path(), BAR, &["output.model=false"]);
    assert!(!without.join("model.vtu").exists());
    let message = refusal(&without, &["--point", "1"]);
    assert!(
        message.contains("no model.vtu") && message.contains("--set output.model=true"),
        "{message}"
    );
    assert!(
        fs::read_to_string(without.join("case.resolved.toml"))
            .unwrap()
            .contains("model = false")
    );
}

#[test]
fn a_damaged_result_is_named() {
    let folder = tempfile::tempdir().unwrap();
    let results = run(folder.path(), BAR, &[]);
    let model = results.join("model.vtu");
    let whole = fs::read(&model).unwrap();
    fs::write(&model, &whole[..whole.len() / 2]).unwrap();
    let message = refusal(&results, &["--point", "1"]);
    assert!(
        message.starts_with("error: cannot use ") && message.contains("model.vtu"),
        "{message}"
    );
    fs::write(&model, whole).unwrap();
    fs::remove_file(results.join("fields_0004.vtu")).unwrap();
    let said = explain(&results, &["--point", "1"]);
    assert!(said.contains("10 of 11 steps have fields"), "{said}");
}

/// A run that found no equilibrium at all: there is a model, and no path.
#[test]
fn a_run_without_an_end_is_told_as_such() {
    let folder = tempfile::tempdir().unwrap();
    // A stiffness that is not positive definite.
    let settings = ["material.poisson=0.38", "solver.factorisation=llt"];
    let results = run(folder.path(), SHEARED, &settings);
    let said = explain(&results, &["--bond", "25", "26"]);
    assert!(said.contains("the run did not get to its end"), "{said}");
    assert!(said.contains("its utilisation was 0 all along"), "{said}");
}

#[test]
fn modes_have_no_life_of_bonds() {
    let folder = tempfile::tempdir().unwrap();
    let case = r#"
analysis = "modal"
lattice = { cells = [6, 4], spacing = 0.01 }
material = { young = 15e9, poisson = 0.21, density = 2500.0 }
model = { law = "nhpd", horizon_factor = 3.0 }
modal = { modes = 4 }
"#;
    let results = run(folder.path(), case, &[]);
    let message = refusal(&results, &["--point", "1"]);
    assert!(message.contains("it has natural modes"), "{message}");
}

/// An elastic solution has no limits; its deformations are told all the same.
#[test]
fn an_elastic_solution_is_told_without_limits() {
    let folder = tempfile::tempdir().unwrap();
    let case = BAR.replace("[fracture]\nsteps = 10\n", "");
    let results = run(folder.path(), &case, &[]);
    let said = explain(&results, &["--bond", "22", "23"]);
    assert!(
        said.contains("nothing fails in an elastic analysis"),
        "{said}"
    );
    let found = bond(&results, 22, 23);
    assert!((number(&found["path"][1]["stretch"]) - 1e-3).abs() < 1e-15);
}

/// A table has a row a bond and step, with the numbers of the text.
#[test]
fn the_table_has_a_row_a_bond_and_step() {
    let folder = tempfile::tempdir().unwrap();
    let results = run(folder.path(), BAR, &[]);
    let file = folder.path().join("bonds.csv");
    let path = file.display().to_string();
    explain(&results, &["--bond", "22", "23", "--csv", &path]);
    let table = fs::read_to_string(&file).unwrap();
    let header = "cell_a,cell_b,step,load_factor,displacement,reaction,intact,stretch,shear,limit.strength,\
                  measure.strength,utilisation.strength";
    assert_eq!(table.lines().next().unwrap(), header);
    assert_eq!(table.lines().count(), 12);
    let row: Vec<&str> = table.lines().nth(6).unwrap().split(',').collect();
    assert_eq!(row[..3], ["22", "23", "5"]);
    let [_, stretch, limit] = closed_form(1.0, 0.0);
    let utilisation: f64 = row[11].parse().unwrap();
    assert!((utilisation - 0.5 * stretch / limit).abs() < 1e-11);
}
