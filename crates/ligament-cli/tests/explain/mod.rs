//! Calls of `ligament explain`, compared with closed forms and with other files of a run.

#![allow(clippy::unwrap_used, reason = "a failed unwrap fails the test")]

use std::ffi::OsStr;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Output;

use ligament_output::results::stored::StoredRun;
use serde_json::Value;

use crate::support::{ligament, text};

mod life;
mod recorded;
mod results;

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
    // 3: no state under load is in equilibrium, and there is little to explain.
    let code = output.status.code();
    assert!(matches!(code, Some(0 | 3)), "{}", text(&output.stderr));
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
    all.extend(["--force", "--json", &path]);
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
