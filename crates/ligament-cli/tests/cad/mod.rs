//! `ligament mesh` of CAD files: lengths in metres, groups by the names of the file and by numbers, and the picture of the numbers.
//! README.md says how the files were made.

#![allow(clippy::unwrap_used, reason = "a failed unwrap fails the test")]

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

use ligament_mesh::{AnyMesh, Group, SolidMesh, gmsh};
use tempfile::TempDir;

use crate::support::{assert_success, stderr, stdout};

/// Makes `out.msh` in a folder of a CAD file of the tests, by the gmsh beside `LIGAMENT_PYTHON`.
fn mesh(folder: &Path, file: &str, more: &[&str]) -> Output {
    let python = std::env::var_os("LIGAMENT_PYTHON");
    let python = PathBuf::from(
        python.expect("set LIGAMENT_PYTHON to a Python with tools/requirements.txt installed"),
    );
    let programs = python.parent().unwrap();
    let source = Path::new(env!("CARGO_MANIFEST_DIR"))
        .join("tests/cad")
        .join(file);
    Command::new(env!("CARGO_BIN_EXE_ligament"))
        .env("PATH", programs)
        .arg("mesh")
        .args([&source, Path::new("--out"), &folder.join("out.msh")])
        .args(more)
        .output()
        .unwrap()
}

fn read(folder: &Path) -> AnyMesh {
    gmsh::parse_any(&fs::read(folder.join("out.msh")).unwrap()).unwrap()
}

fn names(groups: &[Group]) -> Vec<String> {
    groups.iter().map(|it| it.name.clone()).collect()
}

fn area(mesh: &SolidMesh, group: &str) -> f64 {
    let faces = mesh.group(group).unwrap().faces.iter();
    let areas = faces.map(|it| {
        it.area_vector(&mesh.positions)
            .map(|it| it * it)
            .iter()
            .sum::<f64>()
            .sqrt()
    });
    areas.sum()
}

/// A box of 10 x 20 x 30 mm without names: its faces have the areas of rectangles, and all of them are in the table and in a picture.
#[test]
#[ignore = "needs LIGAMENT_PYTHON; run by tools/test"]
fn faces_without_names_are_numbered() {
    let folder = TempDir::new().unwrap();
    let output = mesh(folder.path(), "plain.step", &["--size", "5e-3"]);
    assert_success(&output);
    let AnyMesh::Solid(mesh) = read(folder.path()) else {
        panic!("a solid mesh");
    };
    let faces = (1..=6).map(|it| format!("face-{it}"));
    assert_eq!(
        names(&mesh.groups),
        faces
            .clone()
            .chain(["solid-1".to_owned()])
            .collect::<Vec<_>>()
    );
    // The coordinates of the file are rounded to about 1e-16 m.
    assert!((mesh.volume() - 6e-6).abs() < 1e-15);
    let mut areas: Vec<f64> = faces.map(|it| (1e6 * area(&mesh, &it)).round()).collect();
    areas.sort_by(f64::total_cmp);
    assert_eq!(areas, [200.0, 200.0, 300.0, 300.0, 600.0, 600.0]);
    let said = stdout(&output);
    assert!(said.contains("600.0 mm^2  (0, 10.00, 15.00) mm"), "{said}");
    let picture = fs::read(folder.path().join("out.png")).unwrap();
    assert!(picture.starts_with(b"\x89PNG"));
}

/// Two boxes of 10 and 20 m in a file in metres touch, and one has a name: they share the nodes of their common face.
#[test]
#[ignore = "needs LIGAMENT_PYTHON; run by tools/test"]
fn names_of_parts_are_groups_and_parts_are_joined() {
    let folder = TempDir::new().unwrap();
    assert_success(&mesh(folder.path(), "pair.step", &["--size", "5"]));
    let AnyMesh::Solid(mesh) = read(folder.path()) else {
        panic!("a solid mesh");
    };
    let names = names(&mesh.groups);
    assert_eq!(names[names.len() - 2..], ["clamp", "solid-2"]);
    assert_eq!(
        names.iter().filter(|it| it.starts_with("face-")).count(),
        11
    );
    let [clamp, other] = ["clamp", "solid-2"].map(|it| mesh.group(it).unwrap());
    let volume = |group: &Group| {
        let cells = group
            .cells
            .iter()
            .map(|it| mesh.cells[*it as usize].volume(&mesh.positions));
        cells.sum::<f64>()
    };
    // Sums of some hundred volumes.
    assert!(
        (volume(clamp) / 1000.0 - 1.0).abs() < 1e-12
            && (volume(other) / 2000.0 - 1.0).abs() < 1e-12
    );
    let common = clamp
        .nodes
        .iter()
        .filter(|it| other.nodes.binary_search(it).is_ok());
    let on_face =
        (0..mesh.positions.len()).filter(|it| (mesh.positions[*it][0] - 10.0).abs() < 1e-9);
    assert_eq!(common.count(), on_face.count());
}

/// A rectangle of 20 x 10 mm in the plane of x and z: a mesh in the plane, with its edges as curves. Without the plane the error says how to turn it.
#[test]
#[ignore = "needs LIGAMENT_PYTHON; run by tools/test"]
fn a_sheet_is_a_mesh_in_the_plane() {
    let folder = TempDir::new().unwrap();
    let refused = mesh(folder.path(), "sheet.step", &["--size", "2e-3"]);
    assert_eq!(refused.status.code(), Some(1));
    assert!(
        stderr(&refused).contains("--plane xz"),
        "{}",
        stderr(&refused)
    );
    assert_success(&mesh(
        folder.path(),
        "sheet.step",
        &["--size", "2e-3", "--plane", "xz"],
    ));
    let AnyMesh::Plane(mesh) = read(folder.path()) else {
        panic!("a mesh in the plane");
    };
    assert_eq!(
        names(&mesh.groups),
        ["edge-1", "edge-2", "edge-3", "edge-4", "face-1"]
    );
    // Sums of some hundred areas.
    assert!((mesh.area() / 2e-4 - 1.0).abs() < 1e-12);
}

/// Without a size nothing is written, and the message has one: 6e-6 m^3 are 5000 cubes of 1.06 mm.
#[test]
#[ignore = "needs LIGAMENT_PYTHON; run by tools/test"]
fn without_a_size_one_is_proposed() {
    let folder = TempDir::new().unwrap();
    let output = mesh(folder.path(), "plain.step", &[]);
    assert_eq!(output.status.code(), Some(1));
    assert!(
        stderr(&output).contains("`--size 1e-3` makes about 5000 cells"),
        "{}",
        stderr(&output)
    );
    assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 0);
    let output = mesh(folder.path(), "README.step", &["--size", "1"]);
    assert!(
        stderr(&output).contains("there is no geometry"),
        "{}",
        stderr(&output)
    );
}
