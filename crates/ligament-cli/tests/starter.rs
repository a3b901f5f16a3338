//! `ligament new`: its cases check and run as they are, whatever the groups of the mesh.

#![allow(clippy::unwrap_used, reason = "a failed unwrap fails the test")]

use std::path::{Path, PathBuf};

use ligament::setup::Law;
use ligament_case::case::{CaseFile, schema};
use ligament_case::starter::{Starter, StarterError, lattice_case, mesh_case};
use ligament_cli::check::{CheckExtent, Lines, check};
use serde_json::Value;
use tempfile::TempDir;

use crate::support::ligament_in;

fn meshes() -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../../meshes")
}

/// The case of a starter, as a file in a folder would be read.
fn case(starter: &Starter, folder: &Path) -> CaseFile {
    let parsed = CaseFile::parse(&folder.join("case.toml"), starter.text.clone(), &[]);
    parsed.unwrap_or_else(|error| panic!("{error}\n{}", starter.text))
}

fn checked(case: &CaseFile, extent: CheckExtent) -> String {
    let mut report = Vec::new();
    check(case, extent, None, Lines::All, &mut report)
        .unwrap_or_else(|error| panic!("{error:#}\n{}", case.source.text));
    String::from_utf8(report).unwrap()
}

/// The text with all commented settings active.
fn with_all_settings(text: &str) -> String {
    let lines = text.lines().map(|line| match line.strip_prefix('#') {
        Some(setting) if setting.starts_with(|it: char| it.is_alphabetic() || it == '[') => setting,
        _ => line,
    });
    lines.collect::<Vec<_>>().join("\n")
}

/// Every third mesh of the repository, starting at `from`, gets a case that passes the check, also with all commented settings active.
fn meshes_have_cases_that_check(from: usize) {
    let folder = TempDir::new().unwrap();
    let files = std::fs::read_dir(meshes()).unwrap();
    let files = files.map(|entry| entry.unwrap().path());
    let mut all: Vec<PathBuf> = files
        .filter(|path| path.extension().is_some_and(|it| it == "msh"))
        .collect();
    all.sort();
    assert!(all.len() > 10, "{} meshes", all.len());
    for path in all.iter().skip(from).step_by(3) {
        let mut starter = mesh_case(path, folder.path(), Law::NHPD).unwrap();
        assert!(
            starter.warnings.is_empty(),
            "{}: {:?}",
            path.display(),
            starter.warnings
        );
        let report = checked(&case(&starter, folder.path()), CheckExtent::Model);
        assert!(report.contains("surface correction: patch"), "{report}");
        // The correction is the one of above: a coarse one is enough.
        let text = with_all_settings(&starter.text);
        starter.text = text.replace("regularisation = 3e-7", "regularisation = 1e-3");
        assert_ne!(starter.text, text);
        let report = checked(&case(&starter, folder.path()), CheckExtent::Model);
        assert!(
            !report.contains("(0 cut by pre-cracks)"),
            "{}\n{report}",
            starter.text
        );
    }
}

/// Three parts, so that the processors share them.
#[test]
fn every_mesh_has_a_case_that_checks() {
    meshes_have_cases_that_check(0);
}

#[test]
fn every_mesh_has_a_case_that_checks_on() {
    meshes_have_cases_that_check(1);
}

#[test]
fn every_mesh_has_a_case_that_checks_to_the_end() {
    meshes_have_cases_that_check(2);
}

/// Groups with usual names are supported and loaded; a platen is pressed, an end pulled, by nonzero displacements in the right
/// direction.
#[test]
fn groups_are_found_by_their_names() {
    let folder = TempDir::new().unwrap();
    for (mesh, held, loaded, axis, sign) in [
        ("plate.msh", "bottom", "top", 1, 1.0),
        ("bimaterial.msh", "left", "right", 0, 1.0),
        ("disk-2mm.msh", "platen-bottom", "platen-top", 1, -1.0),
        ("diagonal-plate.msh", "patch-bottom", "patch-top", 1, 1.0),
    ] {
        let starter = mesh_case(&meshes().join(mesh), folder.path(), Law::NHPD).unwrap();
        let case = case(&starter, folder.path()).case;
        assert_eq!(case.supports[0].group.as_deref(), Some(held), "{mesh}");
        assert_eq!(case.loads[0].group.as_deref(), Some(loaded), "{mesh}");
        let moved = case.loads[0].displacement.unwrap();
        let components = [moved.x, moved.y];
        assert!(
            components[axis].unwrap() * sign > 0.0,
            "{mesh}: {components:?}"
        );
        assert_eq!(components[1 - axis], None, "{mesh}");
    }
}

/// Without suitable groups rectangles around the lowest and the highest points are taken, which hold some.
#[test]
fn without_groups_boxes_are_taken() {
    let folder = TempDir::new().unwrap();
    for mesh in ["annulus-coarse.msh", "heated-disk.msh"] {
        let starter = mesh_case(&meshes().join(mesh), folder.path(), Law::NHPD).unwrap();
        let case = case(&starter, folder.path());
        assert!(case.case.supports[0].r#box.is_some(), "{}", starter.text);
        let report = checked(&case, CheckExtent::Matrix);
        assert!(!report.contains(" 0 points"), "{report}");
    }
}

/// Runs `new` with arguments and the case; the number of broken bonds.
fn broken(arguments: &[&str]) -> u64 {
    let folder = TempDir::new().unwrap();
    let made = ligament_in(folder.path(), &[&["new"], arguments].concat());
    assert!(made.status.success(), "{arguments:?}: {made:?}");
    let run = ligament_in(folder.path(), &["run", "case.toml", "--out", "results"]);
    let text = std::fs::read_to_string(folder.path().join("case.toml")).unwrap();
    assert!(run.status.success(), "{arguments:?}: {run:?}\n{text}");
    let summary = std::fs::read_to_string(folder.path().join("results/summary.json")).unwrap();
    let summary: Value = serde_json::from_str(&summary).unwrap();
    let rows = std::fs::read_to_string(folder.path().join("results/breaks.csv")).unwrap();
    let count = rows.lines().skip(1).count() as u64;
    assert_eq!(summary["broken_bonds"], count);
    count
}

/// The cases run as they are, and something breaks: meshes with platens, ends, two materials and no groups that suit, each with
/// other laws, and lattices.
#[test]
fn the_cases_run_and_break_bonds() {
    let at = |mesh: &str| meshes().join(mesh).to_string_lossy().into_owned();
    for (mesh, law) in [
        ("bimaterial.msh", "nhpd"),
        ("disk-4mm.msh", "nhpd"),
        ("plate-coarse.msh", "nhpd"),
        ("heated-disk.msh", "nhpd"),
        ("plate-coarse.msh", "bbpd"),
        ("plate-coarse.msh", "bbpd-conical"),
        ("plate-coarse.msh", "pds"),
        ("plate-coarse.msh", "mppd"),
        ("plate-coarse.msh", "mppd-beam"),
        ("plate-coarse.msh", "orthotropic"),
    ] {
        assert!(broken(&[&at(mesh), "--law", law]) > 10, "{mesh} by {law}");
    }
    for law in ["nhpd", "mbb-pd"] {
        assert!(
            broken(&["--lattice", "12,24,0.005", "--law", law]) > 10,
            "lattice by {law}"
        );
    }
}

/// A slender beam on two supports breaks well before its example load: within 0.7 of it, of which beam theory has a half.
#[test]
fn beams_break_within_their_example_load() {
    let folder = TempDir::new().unwrap();
    let at = "2 1 \"beam\"\n0 2 \"left\"\n0 3 \"right\"\n0 4 \"load\"\n";
    let mut text = format!(
        "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n4\n{at}$EndPhysicalNames\n$Nodes\n567\n"
    );
    let [columns, rows] = [81, 7];
    for node in 0..columns * rows {
        let [x, y] = [node % columns, node / columns].map(|it| 0.025 * f64::from(it));
        text += &format!("{} {x} {y} 0\n", node + 1);
    }
    text += "$EndNodes\n$Elements\n483\n1 15 2 2 1 1\n2 15 2 3 2 81\n3 15 2 4 3 527\n";
    for cell in 0..80 * 6 {
        let corner = cell % 80 + columns * (cell / 80) + 1;
        let above = corner + columns;
        text += &format!(
            "{} 3 2 1 1 {corner} {} {} {above}\n",
            cell + 4,
            corner + 1,
            above + 1
        );
    }
    let mesh = folder.path().join("beam.msh");
    std::fs::write(&mesh, text + "$EndElements\n").unwrap();
    let starter = mesh_case(&mesh, folder.path(), Law::NHPD).unwrap();
    let report = checked(&case(&starter, folder.path()), CheckExtent::Matrix);
    let first = report.lines().find(|it| it.starts_with("  first breakage"));
    let share = first.and_then(|it| it.split_once("at ")?.1.split(' ').next()?.parse().ok());
    let share: f64 = share.unwrap_or_else(|| panic!("{report}"));
    assert!((0.3..0.7).contains(&share), "{share}\n{report}");
}

/// A square of two by two cells of a side, with groups of these names: the left and the right half, the lower and the upper side.
fn square(side: f64, names: [&str; 4]) -> String {
    let mut text = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n4\n".to_owned();
    for (number, (dimension, name)) in [2, 2, 1, 1].into_iter().zip(names).enumerate() {
        text += &format!("{dimension} {} \"{name}\"\n", number + 1);
    }
    text += "$EndPhysicalNames\n$Nodes\n25\n";
    for node in 0..25 {
        let [x, y] = [node % 5, node / 5].map(|it| f64::from(it) * side / 4.0);
        text += &format!("{} {x} {y} 0\n", node + 1);
    }
    text += "$EndNodes\n$Elements\n24\n";
    let mut number = 0;
    for cell in 0..16 {
        let (x, y) = (cell % 4, cell / 4);
        let (corner, group) = (y * 5 + x + 1, if x < 2 { 1 } else { 2 });
        number += 1;
        text += &format!(
            "{number} 3 2 {group} {group} {corner} {} {} {}\n",
            corner + 1,
            corner + 6,
            corner + 5
        );
    }
    for (group, first) in [(3, 1), (4, 21)] {
        for edge in first..first + 4 {
            number += 1;
            text += &format!("{number} 1 2 {group} {group} {edge} {}\n", edge + 1);
        }
    }
    text + "$EndElements\n"
}

fn of_text(text: &str) -> (TempDir, Result<Starter, StarterError>) {
    let folder = TempDir::new().unwrap();
    let path = folder.path().join("a mesh.msh");
    std::fs::write(&path, text).unwrap();
    let starter = mesh_case(&path, folder.path(), Law::NHPD);
    (folder, starter)
}

/// Names with blanks, dots, commas and backslashes are quoted in the case as TOML requires.
#[test]
fn names_are_quoted() {
    let names = ["left half", "right.half", "bottom, held", "top \\ 'moved'"];
    let (folder, starter) = of_text(&square(0.1, names));
    let case = case(&starter.unwrap(), folder.path());
    let materials: Vec<_> = case
        .case
        .materials
        .iter()
        .map(|it| it.group.as_deref().unwrap())
        .collect();
    assert_eq!(materials, ["left half", "right.half"]);
    assert_eq!(case.case.supports[0].group.as_deref(), Some(names[2]));
    assert_eq!(case.case.loads[0].group.as_deref(), Some(names[3]));
    checked(&case, CheckExtent::Matrix);
    let (folder, starter) = of_text(&square(0.1, ["a", "b", "top", "bottom, \u{e9}"]));
    let case = self::case(&starter.unwrap(), folder.path());
    assert_eq!(case.case.loads[0].group.as_deref(), Some("top"));
    let (folder, starter) = of_text(&square(0.1, ["a", "b", "base", "top, moved"]));
    let case = self::case(&starter.unwrap(), folder.path());
    assert_eq!(case.case.loads[0].name.as_deref(), Some("load-1"));
}

/// Names with invisible characters, which head no column, are escaped in the case, and are loaded by another name; messages
/// show these characters, too.
#[test]
fn names_that_are_not_seen_are_escaped() {
    let names = ["a\u{200b}", "b", "bottom\tx", "top\u{202e}"];
    let (folder, starter) = of_text(&square(0.1, names));
    let starter = starter.unwrap();
    let shown = |text: &str| {
        text.chars()
            .all(|it| it == '\n' || !"\t\u{200b}\u{202e}".contains(it))
    };
    assert!(shown(&starter.text), "{:?}", starter.text);
    assert!(shown(&starter.choice), "{:?}", starter.choice);
    let case = case(&starter, folder.path());
    assert_eq!(case.case.supports[0].group.as_deref(), Some(names[2]));
    assert_eq!(case.case.loads[0].group.as_deref(), Some(names[3]));
    assert_eq!(case.case.loads[0].name.as_deref(), Some("load-1"));
    checked(&case, CheckExtent::Matrix);
}

/// Groups whose names have no meaning are used by their positions.
#[test]
fn groups_are_found_by_their_place() {
    let (folder, starter) = of_text(&square(0.1, ["1", "2", "17", "4"]));
    let case = case(&starter.unwrap(), folder.path());
    assert_eq!(case.case.supports[0].group.as_deref(), Some("17"));
    assert_eq!(case.case.loads[0].group.as_deref(), Some("4"));
    checked(&case, CheckExtent::Matrix);
}

/// Two supports are both held, the second free to slide, and the body is pressed onto them in the middle of its far side.
#[test]
fn a_beam_lies_on_both_supports() {
    let names = ["a", "b", "left-support", "right-support"];
    let (folder, starter) = of_text(&square(0.1, names));
    let case = case(&starter.unwrap(), folder.path());
    let [first, second] = case.case.supports.as_slice() else {
        panic!("{:?}", case.case.supports);
    };
    assert_eq!(first.group.as_deref(), Some("left-support"));
    assert_eq!(second.group.as_deref(), Some("right-support"));
    // The supports are the lower and the upper edge here, so that the load pushes along x.
    let held = second.displacement.unwrap();
    assert_eq!((held.x, held.y), (Some(0.0), None));
    let load = &case.case.loads[0];
    assert_eq!(load.group, None);
    assert!(load.displacement.unwrap().x.is_some_and(|x| x != 0.0));
    checked(&case, CheckExtent::Matrix);
}

/// A beam whose ends are called left and right and that has a load between them: three-point bending, as a beam between supports.
#[test]
fn a_load_between_two_ends_bends() {
    let folder = TempDir::new().unwrap();
    let mesh = meshes().join("notched-beam-10mm.msh");
    let starter = mesh_case(&mesh, folder.path(), Law::NHPD).unwrap();
    let case = case(&starter, folder.path());
    let supports = case.case.supports.iter();
    let supports: Vec<_> = supports
        .map(|it| (it.group.as_deref(), it.displacement.unwrap()))
        .map(|(group, held)| (group, held.x, held.y))
        .collect();
    assert_eq!(
        supports,
        [
            (Some("left"), Some(0.0), Some(0.0)),
            (Some("right"), None, Some(0.0))
        ]
    );
    assert_eq!(case.case.loads.len(), 1);
    assert_eq!(case.case.loads[0].group.as_deref(), Some("load"));
    let moved = case.case.loads[0].displacement.unwrap();
    assert!(moved.x.is_none() && moved.y.is_some_and(|y| y < 0.0));
    checked(&case, CheckExtent::Matrix);
    // With one named side beside the load, that side is held.
    let (folder, starter) = of_text(&square(0.1, ["a", "b", "bottom", "load"]));
    let case = self::case(&starter.unwrap(), folder.path()).case;
    assert_eq!(case.supports[0].group.as_deref(), Some("bottom"));
    assert_eq!(case.loads[0].group.as_deref(), Some("load"));
}

/// A body of 100 m was meant in mm; bodies of all other sizes get numbers that suit them.
#[test]
fn sizes_are_sensible() {
    let names = ["left", "right", "bottom", "top"];
    let (_folder, large) = of_text(&square(100.0, names));
    let large = large.unwrap();
    assert!(
        large.warnings[0].contains("100.0 m across"),
        "{:?}",
        large.warnings
    );
    assert!(
        large.text.contains("# WARNING: the body is 100.0 m across"),
        "{}",
        large.text
    );
    for side in [1e-7, 0.1, 19.0] {
        let (folder, starter) = of_text(&square(side, names));
        let starter = starter.unwrap();
        assert_eq!(starter.warnings, Vec::<String>::new());
        checked(&case(&starter, folder.path()), CheckExtent::Matrix);
    }
}

/// A mesh with the same z everywhere, and the same square in the plane of x and z, y in the place of z: both cases have one body.
#[test]
fn a_mesh_in_another_plane_is_turned() {
    let names = ["left", "right", "bottom", "top"];
    let text = square(0.1, names);
    let nodes = text
        .lines()
        .map(|line| match line.split(' ').collect::<Vec<_>>()[..] {
            [node, x, y, "0"] => format!("{node} {x} 0.25 {y}\n"),
            _ => format!("{line}\n"),
        });
    let turned = nodes.collect::<String>();
    let bodies = [&text, &turned].map(|text| {
        let (folder, starter) = of_text(text);
        let starter = starter.unwrap();
        assert_eq!(
            starter.text.contains("coordinates = \"xz\""),
            text == &turned
        );
        let body = case(&starter, folder.path()).read_body(&mut ()).unwrap();
        let body = body.as_body();
        let points = 0..body.n_points() as u32;
        points.map(|it| body.position(it)).collect::<Vec<_>>()
    });
    assert_eq!(bodies[0], bodies[1]);
    let (folder, starter) = of_text(&turned);
    let text = starter.unwrap().text.replace("coordinates", "#");
    let wrong = CaseFile::parse(&folder.path().join("case.toml"), text, &[]).unwrap();
    let error = wrong.read_body(&mut ()).unwrap_err().to_string();
    assert!(
        error.contains("`coordinates = \"xz\"` in [mesh]"),
        "{error}"
    );
}

#[test]
fn a_lattice_takes_the_place_of_a_mesh() {
    for law in Law::ALL {
        let starter = lattice_case([12, 30], 0.001, law);
        let case = case(&starter, Path::new(""));
        checked(&case, CheckExtent::Matrix);
    }
    let small = lattice_case([4, 4], 2.0, Law::NHPD);
    checked(&case(&small, Path::new("")), CheckExtent::Matrix);
}

/// The case of every law is valid by the schema, as an editor will see it.
#[test]
fn the_cases_are_valid_for_editors() {
    let (mut schemas, mut compiler) = (boon::Schemas::new(), boon::Compiler::new());
    compiler.add_resource("case.json", schema()).unwrap();
    let index = compiler.compile("case.json", &mut schemas).unwrap();
    for law in Law::ALL {
        let text = lattice_case([12, 30], 0.001, law).text;
        for text in [text.clone(), with_all_settings(&text)] {
            let document: Value = toml::from_str(&text).unwrap();
            let valid = schemas.validate(&document, index);
            assert!(valid.is_ok(), "{:#}\n{text}", valid.unwrap_err());
        }
    }
}

#[test]
fn what_is_no_mesh_is_refused() {
    let folder = TempDir::new().unwrap();
    let of = |name: &str, text: &str, law: Law| {
        let path = folder.path().join(name);
        std::fs::write(&path, text).unwrap();
        mesh_case(&path, folder.path(), law)
            .unwrap_err()
            .to_string()
    };
    let error = of("plate.geo", "Point(1) = {0, 0, 0};", Law::NHPD);
    assert!(
        error.contains("is a geometry") && error.contains("ligament mesh"),
        "{error}"
    );
    let error = of("plate.inp", "*NODE\n", Law::NHPD);
    assert!(
        error.contains("not a Gmsh mesh") && error.contains("--via-meshio"),
        "{error}"
    );
    let error = of("plate.msh", "*NODE\n", Law::NHPD);
    assert!(error.contains("cannot use the mesh"), "{error}");
    let lattices = Law::MBB_PD;
    let error = of("a.msh", &square(1.0, ["a", "b", "c", "d"]), lattices);
    assert!(error.contains("--lattice"), "{error}");
    let missing = mesh_case(Path::new("nowhere.msh"), folder.path(), Law::NHPD).unwrap_err();
    assert!(
        missing
            .to_string()
            .contains("cannot read the mesh nowhere.msh"),
        "{missing}"
    );
}

/// An existing case is not replaced unless asked for, and an error leaves no file.
#[test]
fn cases_are_not_overwritten() {
    let folder = TempDir::new().unwrap();
    let mesh = meshes().join("plate-coarse.msh");
    let mesh = mesh.to_str().unwrap();
    let wrong = ligament_in(folder.path(), &["new", "nowhere.msh"]);
    assert_eq!(wrong.status.code(), Some(1));
    assert!(!folder.path().join("case.toml").exists());
    assert!(ligament_in(folder.path(), &["new", mesh]).status.success());
    std::fs::write(folder.path().join("case.toml"), "mine").unwrap();
    let again = ligament_in(folder.path(), &["new", mesh]);
    assert_eq!(again.status.code(), Some(1));
    let said = String::from_utf8(again.stderr).unwrap();
    assert!(
        said.contains("case.toml exists already") && said.contains("--force"),
        "{said}"
    );
    let kept = std::fs::read_to_string(folder.path().join("case.toml")).unwrap();
    assert_eq!(kept, "mine");
    assert!(
        ligament_in(folder.path(), &["new", mesh, "--force"])
            .status
            .success()
    );
    assert_eq!(ligament_in(folder.path(), &["new"]).status.code(), Some(2));
    let elsewhere = ligament_in(folder.path(), &["new", mesh, "--out", "a/b/case.toml"]);
    assert!(elsewhere.status.success(), "{elsewhere:?}");
    assert!(CaseFile::load(&folder.path().join("a/b/case.toml"), &[]).is_ok());
}
