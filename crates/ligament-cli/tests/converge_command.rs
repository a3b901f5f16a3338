//! Calls of `ligament converge`.

#![allow(clippy::unwrap_used, reason = "a failed unwrap fails the test")]

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

use serde_json::Value;

use crate::support::{SMALL_BAR, assert_success, stderr, stdout};

/// A folder with a case.
struct Place {
    folder: tempfile::TempDir,
}

impl Place {
    fn with(case: &str) -> Self {
        let folder = tempfile::tempdir().unwrap();
        fs::write(folder.path().join("bar.toml"), case).unwrap();
        Self { folder }
    }

    fn path(&self, name: &str) -> PathBuf {
        self.folder.path().join(name)
    }

    fn converge(&self, arguments: &[&str]) -> Output {
        let mut command = Command::new(env!("CARGO_BIN_EXE_ligament"));
        command.current_dir(self.folder.path());
        command.args(["converge", "bar.toml", "--quiet", "--out", "out"]);
        command.args(arguments).output().unwrap()
    }

    /// A result of `convergence.json`.
    fn result(&self, name: &str) -> Value {
        let text = fs::read_to_string(self.path("out/convergence.json")).unwrap();
        let document: Value = serde_json::from_str(&text).unwrap();
        let results = document["results"].as_array().unwrap();
        let mut found = results.iter().filter(|it| it["name"] == name);
        found
            .next()
            .unwrap_or_else(|| panic!("no {name} in {text}"))
            .clone()
    }
}

/// An elastic bar on 24 x 12 cells that is pulled without a restraint across it: its stiffness is E A/L.
fn elastic_bar() -> String {
    let bar = SMALL_BAR.replace("cells = [12, 6]", "cells = [24, 12]");
    let bar = bar.replace("spacing = 0.01", "spacing = 0.005");
    let bar = bar.replace(
        "displacement = { x = 0.0, y = 0.0 }",
        "displacement = { x = 0.0 }",
    );
    let (until, _) = bar.split_once("[fracture]").unwrap();
    until.to_owned() + "[correction]\nsurface = \"patch\"\n"
}

/// The stiffness of a bar whose ends are rows of points, half a spacing inside: E A/(L - h), which goes to E A/L = 1e9 * .06 * .01/.12 N/m. The
/// limit is in the interval, which has no scatter to hide behind: each lattice gives its own closed form.
#[test]
fn the_limit_of_a_bar_is_in_its_interval() {
    let place = Place::with(&elastic_bar());
    let output = place.converge(&[]);
    assert_success(&output);
    let stiffness = place.result("elastic_stiffness");
    let limit = 1e9 * 0.06 * 0.01 / 0.12;
    let bound = |name: &str| stiffness["interval"][name].as_f64().unwrap();
    let fine = stiffness["samples"]["fine"].as_array().unwrap();
    for (value, cells) in fine.iter().zip([24.0, 26.0]) {
        // 1 %: the rows at the ends are held across no line, and the patch correction is exact for uniform strains alone.
        let exact = limit / (1.0 - 1.0 / cells);
        assert!(
            (value.as_f64().unwrap() / exact - 1.0).abs() < 0.01,
            "{fine:?}, {exact}"
        );
    }
    assert!(
        bound("lower") < limit && limit < bound("upper"),
        "{stiffness}"
    );
    assert!(
        bound("fine") > bound("upper").min(limit),
        "the runs lie above the limit"
    );
    assert!(stdout(&output).contains("intervals of convergence, 95 %"));
    for file in [
        "convergence.csv",
        "elastic_stiffness-over-h.svg",
        "study.toml",
        "case.toml",
    ] {
        assert!(place.path("out").join(file).is_file(), "{file}");
    }
    // The page of the study has the intervals above the runs.
    let mut report = Command::new(env!("CARGO_BIN_EXE_ligament"));
    let report = report
        .current_dir(place.folder.path())
        .args(["report", "out"]);
    assert_success(&report.output().unwrap());
    let page = fs::read_to_string(place.path("out/report.html")).unwrap();
    assert!(page.contains("Intervals of convergence, 95 %") && page.contains("data:image/svg+xml"));
    // The same command again has nothing to compute.
    let written = fs::metadata(place.path("out/runs"))
        .unwrap()
        .modified()
        .unwrap();
    assert_success(&place.converge(&[]));
    let again = fs::metadata(place.path("out/runs"))
        .unwrap()
        .modified()
        .unwrap();
    assert_eq!(written, again);
}

/// Splitting the cells of a mesh needs no Gmsh, and keeps its groups.
#[test]
fn a_mesh_alone_is_split() {
    let case = elastic_bar();
    let (from, to) = (
        case.find("[lattice]").unwrap(),
        case.find("[material]").unwrap(),
    );
    let mesh = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../meshes/plate-coarse.msh");
    let section = format!(
        "[mesh]\nfile = {:?}\nthickness = 0.01\n",
        mesh.to_string_lossy()
    );
    let place = Place::with(&(case[..from].to_owned() + &section + &case[to..]));
    let output = place.converge(&["--split"]);
    assert_success(&output);
    let stiffness = place.result("elastic_stiffness");
    // The plate is .2 x .1 m.
    let limit = 1e9 * 0.1 * 0.01 / 0.2;
    let bound = |name: &str| stiffness["interval"][name].as_f64().unwrap();
    assert!(
        bound("lower") < limit && limit < bound("upper"),
        "{stiffness}"
    );
    assert!(
        stdout(&output).contains("split in four"),
        "{}",
        stdout(&output)
    );
}

/// A Gmsh file of a bar of 12 x 4 x 4 cubes of 5 mm, each of six tetrahedra along its diagonal, with the planes of its ends and the planes of
/// symmetry as groups.
fn bar_of_tetrahedra() -> String {
    const PERMUTATIONS: [[usize; 3]; 6] = [
        [0, 1, 2],
        [0, 2, 1],
        [1, 0, 2],
        [1, 2, 0],
        [2, 0, 1],
        [2, 1, 0],
    ];
    const SIZE: [usize; 3] = [12, 4, 4];
    let number = |[x, y, z]: [usize; 3]| 1 + x + 13 * (y + 5 * z);
    let mut nodes = String::new();
    let mut elements = Vec::new();
    for z in 0..=SIZE[2] {
        for y in 0..=SIZE[1] {
            for x in 0..=SIZE[0] {
                let [px, py, pz] = [x, y, z].map(|it| 0.005 * it as f64);
                nodes += &format!("{} {px} {py} {pz}\n", number([x, y, z]));
                if x == SIZE[0] || y == SIZE[1] || z == SIZE[2] {
                    continue;
                }
                for axes in PERMUTATIONS {
                    let mut at = [x, y, z];
                    let mut corners = vec![at];
                    for axis in axes {
                        at[axis] += 1;
                        corners.push(at);
                    }
                    elements.push((4, 1, corners.clone()));
                    let planes = [(2, 0, 0), (3, 0, SIZE[0]), (4, 1, 0), (5, 2, 0)];
                    for (group, axis, place) in planes {
                        let face = corners.iter().filter(|it| it[axis] == place);
                        let face: Vec<_> = face.copied().collect();
                        if face.len() == 3 {
                            elements.push((2, group, face));
                        }
                    }
                }
            }
        }
    }
    let rows = (1..).zip(&elements).map(|(tag, (kind, group, corners))| {
        let corners = corners.iter().map(|it| number(*it).to_string());
        let corners: Vec<String> = corners.collect();
        format!("{tag} {kind} 2 {group} {group} {}\n", corners.join(" "))
    });
    let rows: String = rows.collect();
    format!(
        "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n5\n3 1 \"bar\"\n2 2 \"left\"\n2 3 \"right\"\n2 4 \"side\"\n2 5 \"bottom\"\n\
         $EndPhysicalNames\n$Nodes\n{}\n{nodes}$EndNodes\n$Elements\n{}\n{rows}$EndElements\n",
        13 * 5 * 5,
        elements.len()
    )
}

/// A solid of tetrahedra is split in eight without Gmsh: the interval of the stiffness of a bar has E A/L. A solid of hexahedra is refused.
#[test]
fn a_solid_of_tetrahedra_is_split() {
    let place = Place::with(
        "title = \"Bar\"\n[mesh]\nfile = \"bar.msh\"\n[material]\nyoung = 1e9\npoisson = 0.25\n[model]\nlaw = \"bbpd\"\n\
         horizon_factor = 2.5\n[correction]\nsurface = \"patch\"\n[[support]]\ngroup = \"left\"\ndisplacement = { x = 0.0 }\n[[support]]\ngroup = \"side\"\n\
         displacement = { y = 0.0 }\n[[support]]\ngroup = \"bottom\"\ndisplacement = { z = 0.0 }\n[[load]]\ngroup = \"right\"\n\
         displacement = { x = 6e-6 }\n",
    );
    fs::write(place.path("bar.msh"), bar_of_tetrahedra()).unwrap();
    let output = place.converge(&[]);
    assert_success(&output);
    let words = stdout(&output);
    assert!(words.contains("split in eight"), "{words}");
    assert!(
        words.contains("2025 and 2025 points at h, 325 and 325 at 2h"),
        "{words}"
    );
    let stiffness = place.result("elastic_stiffness");
    // The bar is 60 x 20 x 20 mm.
    let limit = 1e9 * 0.02 * 0.02 / 0.06;
    let bound = |name: &str| stiffness["interval"][name].as_f64().unwrap();
    assert!(
        bound("lower") < limit && limit < bound("upper"),
        "{stiffness}"
    );
    // Bodies with the patch correction have the stiffness of a bar within 1 %.
    assert!(
        bound("upper") - bound("lower") < 0.03 * limit,
        "{stiffness}"
    );
    let cube = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n8\n1 0 0 0\n2 1 0 0\n3 1 1 0\n4 0 1 0\n5 0 0 1\n6 1 0 1\n7 1 1 1\n\
                8 0 1 1\n$EndNodes\n$Elements\n1\n1 5 2 1 1 1 2 3 4 5 6 7 8\n$EndElements\n";
    fs::write(place.path("bar.msh"), cube).unwrap();
    let output = place.converge(&[]);
    assert_eq!(output.status.code(), Some(1));
    let words = stderr(&output);
    assert!(words.contains("1 of the shape \"hexahedron\""), "{words}");
    assert!(words.contains("--geometry"), "{words}");
}

/// What has no limit is refused with the reason and a remedy.
#[test]
fn what_has_no_limit_is_refused() {
    let cracked = SMALL_BAR
        .replace("cells = [12, 6]", "cells = [24, 12]")
        .replace("spacing = 0.01", "spacing = 0.005")
        + "[[precrack]]\npoints = [[0.06, -0.01], [0.06, 0.03]]\n";
    let place = Place::with(&cracked);
    // Before any run, if nothing else is asked for.
    let output = place.converge(&["--of", "peak.reaction"]);
    assert_eq!(output.status.code(), Some(1));
    assert!(
        stderr(&output).contains("peak.reaction has no limit"),
        "{}",
        stderr(&output)
    );
    let runs = fs::read_dir(place.path("out/runs")).unwrap().count();
    assert_eq!(runs, 0);
    let output = place.converge(&["--of", "peak.reaction", "--of", "elastic_stiffness"]);
    assert_success(&output);
    let refused = place.result("peak.reaction")["refused"]
        .as_str()
        .unwrap()
        .to_owned();
    assert!(
        refused.contains("`strength`") && refused.contains("tip of a pre-crack"),
        "{refused}"
    );
    assert!(place.result("elastic_stiffness")["interval"].is_object());

    let point = elastic_bar().replace("group = \"right\"", "at = [0.12, 0.03]");
    let place = Place::with(&point);
    assert_success(&place.converge(&[]));
    let refused = place.result("elastic_stiffness")["refused"]
        .as_str()
        .unwrap()
        .to_owned();
    assert!(refused.contains("one point"), "{refused}");
}

/// Cases of other kinds are refused before anything is written.
#[test]
fn motions_ensembles_and_odd_lattices_are_refused() {
    let error = |case: &str| {
        let place = Place::with(case);
        let output = place.converge(&[]);
        assert_eq!(output.status.code(), Some(1));
        stderr(&output)
    };
    let odd = error(&SMALL_BAR.replace("cells = [12, 6]", "cells = [12, 5]"));
    assert!(odd.contains("even numbers, not 5"), "{odd}");
    let scattered = error(&format!(
        "{SMALL_BAR}[fracture.scatter]\nof = \"strength\"\nmodulus = 8.0\n"
    ));
    assert!(scattered.contains("ligament ensemble"), "{scattered}");
    let unknown = Place::with(&elastic_bar()).converge(&["--of", "elastic_stifness"]);
    assert!(
        stderr(&unknown).contains("`elastic_stiffness`"),
        "{}",
        stderr(&unknown)
    );
}
