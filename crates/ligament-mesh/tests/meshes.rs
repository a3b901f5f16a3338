//! The meshes that come with the project, against their table in `meshes/README.md` and closed forms.

#![allow(clippy::unwrap_used, missing_docs)]

use std::collections::BTreeSet;
use std::f64::consts::PI;
use std::fs;
use std::path::{Path, PathBuf};

use ligament_mesh::{AnyMesh, Mesh, gmsh};

fn folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../meshes")
}

fn read(name: &str) -> Mesh {
    gmsh::parse(&fs::read(folder().join(name)).unwrap())
        .unwrap_or_else(|error| panic!("{name}: {error}"))
}

/// Positions of the nodes of a group.
fn positions(mesh: &Mesh, name: &str) -> Vec<[f64; 2]> {
    mesh.group(name)
        .unwrap()
        .nodes
        .iter()
        .map(|node| mesh.positions[*node as usize])
        .collect()
}

fn group_names(mesh: &Mesh) -> Vec<&str> {
    mesh.groups
        .iter()
        .map(|group| group.name.as_str())
        .collect()
}

#[test]
fn the_table_tells_the_counts_of_every_mesh() {
    let table = fs::read_to_string(folder().join("README.md")).unwrap();
    let mut listed = BTreeSet::new();
    for line in table.lines().filter(|line| line.contains(".msh` | ")) {
        let fields: Vec<&str> = line
            .split('|')
            .map(|field| field.trim().trim_matches('`'))
            .collect();
        let mesh = read(fields[1]);
        assert_eq!(mesh.positions.len().to_string(), fields[3], "{}", fields[1]);
        assert_eq!(mesh.cells.len().to_string(), fields[4], "{}", fields[1]);
        assert_eq!(mesh.remarks, [], "{}", fields[1]);
        listed.insert(fields[1].to_owned());
    }
    let present: BTreeSet<String> = fs::read_dir(folder())
        .unwrap()
        .map(|entry| entry.unwrap().file_name().into_string().unwrap())
        .filter(|name| name.ends_with(".msh"))
        .collect();
    assert_eq!(listed, present);
}

#[test]
fn the_table_tells_the_counts_of_every_solid_mesh() {
    let folder = folder().join("solids");
    let table = fs::read_to_string(folder.join("README.md")).unwrap();
    let present = fs::read_dir(&folder).unwrap();
    let mut present: Vec<PathBuf> = present.map(|entry| entry.unwrap().path()).collect();
    present.retain(|path| path.extension().is_some_and(|it| it == "msh"));
    assert!(!present.is_empty());
    for path in present {
        let name = path.file_name().unwrap().to_str().unwrap();
        let mesh = match gmsh::parse_any(&fs::read(&path).unwrap()) {
            Ok(AnyMesh::Solid(mesh)) => mesh,
            other => panic!("{name}: {other:?}"),
        };
        let (nodes, cells) = (mesh.positions.len(), mesh.cells.len());
        let counts = format!(" | {nodes} | {cells} |");
        let row = (table.lines()).find(|line| line.starts_with(&format!("| `{name}` |")));
        assert!(row.unwrap().ends_with(&counts), "{name}:{counts}");
        assert_eq!(mesh.remarks, [], "{name}");
    }
}

#[test]
fn disks_are_round_and_their_platens_end_where_they_should() {
    for (name, size, platen) in [
        ("disk-4mm.msh", 0.004, 0.003),
        ("disk-4mm-platen-1.5mm.msh", 0.004, 0.0015),
        ("disk-3mm.msh", 0.003, 0.003),
        ("disk-3mm-platen-1.5mm.msh", 0.003, 0.0015),
        ("disk-2mm.msh", 0.002, 0.003),
        ("disk-2mm-platen-1.5mm.msh", 0.002, 0.0015),
        ("disk-2mm-platen-5mm.msh", 0.002, 0.005),
        ("disk-1.5mm.msh", 0.0015, 0.003),
    ] {
        let mesh = read(name);
        let groups = [
            "pole-top",
            "pole-bottom",
            "platen-top",
            "platen-bottom",
            "rim",
            "disk",
        ];
        assert_eq!(group_names(&mesh), groups, "{name}");
        // Each chord of length s cuts about s³ / (12 R) off the disk.
        let disk = PI * 0.05 * 0.05;
        let cut = 2.0 * PI * size * size / 12.0;
        assert!(
            mesh.area() < disk && mesh.area() > disk - 1.1 * cut,
            "{name}: {}",
            mesh.area()
        );
        check_platens(&mesh, platen);
    }
}

fn check_platens(mesh: &Mesh, platen: f64) {
    for (group, pole, sign) in [
        ("platen-top", "pole-top", 1.0),
        ("platen-bottom", "pole-bottom", -1.0),
    ] {
        assert_eq!(positions(mesh, pole), [[0.0, sign * 0.05]]);
        let arc = positions(mesh, group);
        assert!(
            arc.iter()
                .all(|[x, y]| (x.hypot(*y) - 0.05).abs() < 1e-12 && y * sign > 0.0)
        );
        let xs = || arc.iter().map(|position| position[0]);
        assert_eq!(xs().fold(0.0, f64::min), -platen, "{group}");
        assert_eq!(xs().fold(0.0, f64::max), platen, "{group}");
    }
}

#[test]
fn plates_have_their_sides() {
    for name in ["plate.msh", "plate-coarse.msh"] {
        let mesh = read(name);
        assert_eq!(
            group_names(&mesh),
            ["corner", "left", "right", "bottom", "top", "plate"]
        );
        assert!((mesh.area() - 0.02).abs() < 1e-15, "{name}");
        assert_eq!(positions(&mesh, "corner"), [[0.0, 0.0]]);
        for (side, axis, at) in [
            ("left", 0, 0.0),
            ("right", 0, 0.2),
            ("bottom", 1, 0.0),
            ("top", 1, 0.1),
        ] {
            assert!(
                positions(&mesh, side)
                    .iter()
                    .all(|position| position[axis] == at),
                "{name}: {side}"
            );
        }
    }
}

#[test]
fn the_diagonal_plate_has_its_patches_within_the_plate() {
    let mesh = read("diagonal-plate.msh");
    assert_eq!(group_names(&mesh), ["plate", "patch-top", "patch-bottom"]);
    assert!((mesh.area() - 0.15 * 0.15).abs() < 1e-15);
    assert_eq!(mesh.group("plate").unwrap().cells.len(), mesh.cells.len());
    let corner = 0.15 / 2.0_f64.sqrt();
    for (name, sign) in [("patch-top", 1.0), ("patch-bottom", -1.0)] {
        let heights = positions(&mesh, name)
            .into_iter()
            .map(|position| sign * position[1]);
        assert!(heights.clone().all(|y| y > corner - 0.02 - 1e-12));
        assert!((heights.fold(0.0, f64::max) - corner).abs() < 1e-12);
        let cells = &mesh.group(name).unwrap().cells;
        let area: f64 = cells
            .iter()
            .map(|cell| mesh.cells[*cell as usize].area(&mesh.positions))
            .sum();
        assert!((area - 0.02 * 0.02).abs() < 1e-15, "{name}: {area}");
    }
}

#[test]
fn the_two_halves_share_the_nodes_of_their_interface() {
    let mesh = read("bimaterial.msh");
    assert_eq!(
        group_names(&mesh),
        ["left", "right", "left-half", "right-half"]
    );
    let nodes = |name| {
        mesh.group(name)
            .unwrap()
            .nodes
            .iter()
            .copied()
            .collect::<BTreeSet<u32>>()
    };
    let (left, right) = (nodes("left-half"), nodes("right-half"));
    let shared: Vec<u32> = left.intersection(&right).copied().collect();
    assert_eq!(shared.len(), 11, "a node each 5 mm along 50 mm");
    assert!(
        shared
            .iter()
            .all(|node| (mesh.positions[*node as usize][0] - 0.05).abs() < 1e-12)
    );
    assert_eq!(
        left.len() + right.len() - shared.len(),
        mesh.positions.len()
    );
}
