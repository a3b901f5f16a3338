//! Calls of `ligament plot`: contents and texts of the pictures, and refusals.

#![allow(clippy::unwrap_used, reason = "a failed unwrap fails the test")]

mod fields;
mod lines;
mod series;

use std::ffi::OsStr;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Output;

use roxmltree::Document;

use crate::support::{ligament, text};

/// A plate of 12 x 8 cells with a pre-crack, pulled until it separates; every step has fields.
const LATTICE: &str = r#"
title = "Plate"
[lattice]
cells = [12, 8]
spacing = 0.01
[lattice.set]
bottom = { bottom = 1 }
top = { top = 1 }
[material]
young = 10e9
poisson = 0.2
tensile_strength = 1e6
[model]
law = "nhpd"
horizon_factor = 3.0
[[support]]
group = "bottom"
displacement = { x = 0.0, y = 0.0 }
[[precrack]]
points = [[-0.01, 0.04], [0.04, 0.04]]
[[load]]
group = "top"
displacement = { x = 0.0, y = 2e-5 }
[fracture]
steps = 10
[output]
fields_every = 1
"#;

/// Runs a case; the results are in the folder that is returned.
fn run(folder: &Path, case: &str, name: &str, settings: &[&str]) -> PathBuf {
    let (path, out) = (folder.join("case.toml"), folder.join(name));
    fs::write(&path, case).unwrap();
    let mut arguments: Vec<&OsStr> = vec!["run".as_ref(), path.as_ref(), "--out".as_ref()];
    arguments.extend([out.as_os_str(), "--quiet".as_ref()]);
    for setting in settings {
        arguments.extend([OsStr::new("--set"), OsStr::new(setting)]);
    }
    let output = ligament(arguments);
    assert_eq!(output.status.code(), Some(0), "{}", text(&output.stderr));
    out
}

fn call(words: &[&str]) -> Output {
    ligament(["plot"].iter().chain(words))
}

/// Calls the command, replacing earlier pictures, and returns the file that it names.
fn plot(words: &[&str]) -> Vec<u8> {
    let output = call(&[words, &["--force"]].concat());
    assert_eq!(output.status.code(), Some(0), "{}", text(&output.stderr));
    fs::read(text(&output.stdout).trim_end()).unwrap()
}

fn refusal(words: &[&str]) -> String {
    let output = call(words);
    assert_eq!(output.status.code(), Some(1), "{}", text(&output.stdout));
    text(&output.stderr)
}

/// The texts of an SVG, which must be XML.
fn texts(svg: &[u8]) -> Vec<String> {
    let svg = text(svg);
    let document = Document::parse(&svg).unwrap();
    let nodes = document.descendants();
    let lines = nodes.filter(|node| node.tag_name().name() == "text");
    lines
        .filter_map(|node| node.text().map(|it| it.trim().to_owned()))
        .collect()
}

/// Width and height, and the red, green and blue of all pixels.
fn pixels(png: &[u8]) -> ([usize; 2], Vec<u8>) {
    let decoder = png::Decoder::new(std::io::Cursor::new(png));
    let mut reader = decoder.read_info().unwrap();
    let mut pixels = vec![0; reader.output_buffer_size().unwrap()];
    let info = reader.next_frame(&mut pixels).unwrap();
    assert_eq!(info.color_type, png::ColorType::Rgb);
    ([info.width as usize, info.height as usize], pixels)
}

/// The last step of a run, and its displacement, from its history.
fn steps(results: &Path) -> Vec<(usize, f64, f64)> {
    let table = fs::read_to_string(results.join("history.csv")).unwrap();
    let row = |line: &str| {
        let values: Vec<f64> = line
            .split(',')
            .take(4)
            .map(|it| it.parse().unwrap())
            .collect();
        (values[0] as usize, values[2], values[3])
    };
    table.lines().skip(1).map(row).collect()
}
