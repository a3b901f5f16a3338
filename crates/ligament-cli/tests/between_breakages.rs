//! `output.during_breakage`: the states between the breakages of a load step in files, pictures and on the page.
#![allow(clippy::unwrap_used, reason = "a failed unwrap fails the test")]

use std::collections::BTreeMap;
use std::fs;
use std::path::Path;

use ligament_output::FieldLocation;
use ligament_output::csv::read::CsvTable;
use ligament_output::vtu::read::VtuFile;
use tempfile::TempDir;

use crate::support::{assert_success, ligament_in, stderr, stdout};

/// A plate with a pre-crack that separates in the second of two load steps.
const PLATE: &str = r#"
lattice = { cells = [12, 8], spacing = 0.01, set = { bottom = { bottom = 1 }, top = { top = 1 } } }
material = { young = 10e9, poisson = 0.2, tensile_strength = 1e6 }
model = { law = "nhpd", horizon_factor = 3.0 }
support = [{ group = "bottom", displacement = { x = 0.0, y = 0.0 } }]
precrack = [{ points = [[-0.01, 0.04], [0.04, 0.04]] }]
load = [{ group = "top", displacement = { x = 0.0, y = 2e-5 } }]
fracture = { steps = 2, bonds_per_iteration = 1 }
output = { fields_every = 1, bonds = true }
"#;

/// Most states of a step.
const MOST: usize = 8;

fn run(place: &Path, name: &str, settings: &[&str]) {
    fs::write(place.join("case.toml"), PLATE).unwrap();
    let mut words = vec!["run", "case.toml", "--out", name, "--quiet"];
    words.extend(settings.iter().flat_map(|it| ["--set", *it]));
    assert_success(&ligament_in(place, &words));
}

/// A folder with the plain run in `plain` and the one with states between breakages in `out`.
fn runs() -> TempDir {
    let place = TempDir::new().unwrap();
    run(place.path(), "plain", &[]);
    run(place.path(), "out", &["output.during_breakage=8"]);
    place
}

/// Files of a folder by their names.
fn files(folder: &Path) -> BTreeMap<String, Vec<u8>> {
    let entries = fs::read_dir(folder).unwrap().map(|it| it.unwrap().path());
    let named = entries.map(|it| (it.file_name().unwrap().to_str().unwrap().to_owned(), it));
    named
        .map(|(name, path)| (name, fs::read(path).unwrap()))
        .collect()
}

/// Steps and breakages of the states between breakages, ascending.
fn between(folder: &Path) -> Vec<[usize; 2]> {
    let names = files(folder).into_keys();
    let numbers = names.filter_map(|name| {
        let number = name.strip_prefix("fields_")?.strip_suffix(".vtu")?;
        let (step, breakages) = number.split_once('_')?;
        Some([step.parse().ok()?, breakages.parse().ok()?])
    });
    let mut all: Vec<[usize; 2]> = numbers.collect();
    all.sort_unstable();
    all
}

/// Bonds broken in each step.
fn broken_in_steps(folder: &Path) -> Vec<usize> {
    let rows = CsvTable::read(folder.join("history.csv")).unwrap();
    rows.values("broken_in_step").unwrap()
}

/// The files of the run without the key are the same with it, byte by byte.
#[test]
fn other_results_stay_as_they_are() {
    let place = runs();
    let [plain, with] = ["plain", "out"].map(|it| files(&place.path().join(it)));
    let is_compared = |name: &str| {
        let is_series = name.starts_with("fields_") || name.starts_with("bonds_");
        is_series || (name.ends_with(".csv") && name != "timings.csv") || name == "model.vtu"
    };
    let names: Vec<&String> = plain.keys().filter(|it| is_compared(it)).collect();
    assert!(names.len() > 9, "{names:?}");
    for name in names {
        assert!(plain[name] == with[name], "{name}");
    }
    assert_eq!(
        with.len(),
        plain.len() + 2 * between(&place.path().join("out")).len()
    );
}

/// One bond breaks at a time, or some that tie: the states of the step that breaks most are at the multiples of a power of two.
#[test]
fn states_are_evenly_spread_over_the_breakages_of_a_step() {
    let place = runs();
    let out = place.path().join("out");
    let all = broken_in_steps(&out);
    let step = (0..all.len()).max_by_key(|it| all[*it]).unwrap();
    let states = between(&out);
    let of_step: Vec<usize> = states
        .iter()
        .filter(|it| it[0] == step)
        .map(|it| it[1])
        .collect();
    assert!(
        (MOST / 2..=MOST).contains(&of_step.len()),
        "{of_step:?} of {}",
        all[step]
    );
    let spacing = (all[step] / (of_step.len() + 1)).next_power_of_two();
    for (place, breakages) in (1..).zip(&of_step) {
        let late = breakages - place * spacing;
        assert!(late < 4, "{of_step:?} by {spacing}");
    }
}

/// A state has the broken bonds and the bits of a run that ends after as many bonds, and times grow from step to step.
#[test]
fn a_state_is_that_of_a_run_that_stops_there() {
    let place = runs();
    let out = place.path().join("out");
    let before: usize = broken_in_steps(&out)[..2].iter().sum();
    let states = between(&out);
    let [step, breakages] = states[states.len() / 2];
    assert_eq!(step, 2, "{states:?}");
    let bonds = format!("fracture.stop.bonds={}", before + breakages);
    run(place.path(), "stopped", &[&bonds]);
    let state = VtuFile::open(out.join(format!("fields_0002_{breakages:04}.vtu"))).unwrap();
    let stopped = VtuFile::open(place.path().join("stopped/fields_0002.vtu")).unwrap();
    for name in [
        "displacement",
        "rotation",
        "damage",
        "reaction",
        "strain_energy_density",
    ] {
        let of = |file: &VtuFile| file.finite_numbers(FieldLocation::Cell, name).unwrap();
        assert!(of(&state) == of(&stopped), "{name}");
    }
    let mut last = (f64::NEG_INFINITY, 0);
    for [step, breakages] in states {
        let number = format!("{step:04}_{breakages:04}.vtu");
        let bonds = VtuFile::open(out.join(format!("bonds_{number}"))).unwrap();
        let intact = bonds
            .required_integers(FieldLocation::Cell, "intact")
            .unwrap();
        let broken = intact.iter().filter(|it| **it == 0).count();
        let until: usize = broken_in_steps(&out)[..step].iter().sum();
        assert_eq!(broken, until + breakages);
        let time = bonds.time().unwrap().unwrap();
        let share = breakages as f64 / intact.len() as f64;
        assert_eq!(time, step as f64 - 1.0 + share);
        assert!(time > last.0 && broken > last.1);
        last = (time, broken);
    }
}

/// The collection lists all states, in the order of the run.
#[test]
fn the_collection_has_the_states_before_the_end_of_their_step() {
    let place = runs();
    let text = fs::read_to_string(place.path().join("out/fields.pvd")).unwrap();
    let listed = text.split("file=\"fields_").skip(1);
    let listed: Vec<&str> = listed.map(|it| it.split(".vtu").next().unwrap()).collect();
    let mut expected = vec!["0000".to_owned()];
    for step in [1, 2] {
        let of_step = between(&place.path().join("out"))
            .into_iter()
            .filter(|it| it[0] == step);
        expected.extend(of_step.map(|it| format!("{step:04}_{:04}", it[1])));
        expected.push(format!("{step:04}"));
    }
    assert_eq!(listed, expected);
}

#[test]
fn pictures_animations_and_the_page_show_the_states() {
    let place = runs();
    let call = |words: &[&str]| {
        let output = ligament_in(place.path(), words);
        assert_success(&output);
        stdout(&output)
    };
    let states = between(&place.path().join("out"));
    let [step, breakages] = states[states.len() - 1];
    let name = format!("{step}:{breakages}");
    call(&[
        "plot", "out", "--step", &name, "--crack", "--out", "one.svg", "--width", "180",
    ]);
    let one = fs::read_to_string(place.path().join("one.svg")).unwrap();
    let title = format!("step {step} after {breakages} breakages");
    assert!(one.contains(&title), "{title}");
    let written = call(&["plot", "out", "--step", "all", "--out", "all.png"]);
    assert_eq!(written.lines().count(), states.len() + 3);
    assert!(
        written.contains(&format!("all-{step:04}_{breakages:04}.png")),
        "{written}"
    );
    call(&["plot", "out", "--animate", "all.gif", "--width", "40"]);
    let bytes = fs::read(place.path().join("all.gif")).unwrap();
    let mut frames = gif::DecodeOptions::new().read_info(&bytes[..]).unwrap();
    let mut count = 0;
    while frames.read_next_frame().unwrap().is_some() {
        count += 1;
    }
    assert_eq!(count, states.len() + 3);
    call(&["report", "out"]);
    let page = fs::read_to_string(place.path().join("out/report.html")).unwrap();
    let (_, rest) = page.split_once("id=\"description\">").unwrap();
    let description: serde_json::Value =
        serde_json::from_str(rest.split_once("</script>").unwrap().0).unwrap();
    let run = &description["runs"][0];
    assert_eq!(run["steps"].as_array().unwrap().len(), states.len() + 3);
    let last = &run["between"][(states.len() + 1).to_string()];
    assert_eq!(last["breakages"].as_u64().unwrap() as usize, breakages);
    assert!(last["reaction"].as_f64().unwrap() > 0.0);
    let tables = call(&["crack", "out", "--step", &name]);
    assert!(tables.contains(&format!("step {name}: ")), "{tables}");
    let missing = ligament_in(place.path(), &["plot", "out", "--step", "2:100000"]);
    assert!(stderr(&missing).contains("no output of step 2:100000; there are 0, "));
}

#[test]
fn the_key_is_refused_where_there_are_no_load_steps() {
    let place = TempDir::new().unwrap();
    let refused = |case: &str| {
        fs::write(place.path().join("case.toml"), case).unwrap();
        let output = ligament_in(place.path(), &["check", "case.toml"]);
        assert_eq!(output.status.code(), Some(1));
        stderr(&output)
    };
    let with = PLATE.replace("bonds = true", "during_breakage = 8");
    let event = with.replace("steps = 2, bonds_per_iteration = 1", "control = \"event\"");
    let error = refused(&event);
    assert!(error.contains("output.during_breakage"), "{error}");
    assert!(error.contains("`fields_every` chooses"), "{error}");
    let elastic = with.replace("fracture = { steps = 2, bonds_per_iteration = 1 }", "");
    assert!(refused(&elastic).contains("no bond breaks in an elastic solution"));
    let negative = with.replace("during_breakage = 8", "during_breakage = -1");
    assert!(refused(&negative).contains("expected a whole number, 0 or more"));
}
