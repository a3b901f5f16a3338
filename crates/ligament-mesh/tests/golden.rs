//! Files written by Gmsh and meshio, compared with the reports of Gmsh on them (`tests/data/README.md`).

#![allow(clippy::unwrap_used, missing_docs)]

use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};

use ligament_mesh::{Cell, Group, Mesh, Remark, gmsh};

fn folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data")
}

fn read(name: &str) -> Mesh {
    let bytes = fs::read(folder().join(name)).unwrap();
    gmsh::parse(&bytes).unwrap_or_else(|error| panic!("{name}: {error}"))
}

/// The lines of `expected.tsv`: each mesh with its groups.
fn expected() -> Vec<(Vec<String>, Vec<Vec<String>>)> {
    let mut meshes: Vec<(Vec<String>, Vec<Vec<String>>)> = Vec::new();
    for line in fs::read_to_string(folder().join("expected.tsv"))
        .unwrap()
        .lines()
    {
        let mut fields = line.split('\t').map(str::to_owned);
        match fields.next().unwrap().as_str() {
            "mesh" => meshes.push((fields.collect(), Vec::new())),
            _ => meshes.last_mut().unwrap().1.push(fields.collect()),
        }
    }
    meshes
}

fn assert_near(found: f64, expected: &str, what: &str) {
    let expected: f64 = expected.parse().unwrap();
    assert!(
        (found - expected).abs() < 1e-12 * expected.abs().max(1.0),
        "{what}: {found}, not {expected}"
    );
}

fn tag_sum(mesh: &Mesh, nodes: &[u32]) -> u64 {
    nodes
        .iter()
        .map(|node| mesh.node_tags[*node as usize])
        .sum()
}

/// Number and measure of the edges or cells of a group.
fn elements(mesh: &Mesh, group: &Group) -> (usize, f64) {
    let length = |edge: &[u32; 2]| {
        let [a, b] = edge.map(|node| mesh.positions[node as usize]);
        (a[0] - b[0]).hypot(a[1] - b[1])
    };
    let area = |cell: &u32| mesh.cells[*cell as usize].area(&mesh.positions);
    match group.dimension {
        1 => (group.edges.len(), group.edges.iter().map(length).sum()),
        _ => (group.cells.len(), group.cells.iter().map(area).sum()),
    }
}

#[test]
fn every_file_holds_what_gmsh_says() {
    for (fields, groups) in expected() {
        let name = &fields[0];
        let mesh = read(name);
        assert_eq!(mesh.positions.len().to_string(), fields[1], "{name}: nodes");
        assert_eq!(
            mesh.node_tags.iter().sum::<u64>().to_string(),
            fields[2],
            "{name}: tags"
        );
        assert_near(mesh.positions.iter().map(|p| p[0]).sum(), &fields[3], name);
        assert_near(mesh.positions.iter().map(|p| p[1]).sum(), &fields[4], name);
        let triangles = mesh
            .cells
            .iter()
            .filter(|cell| matches!(cell, Cell::Triangle(_)))
            .count();
        assert_eq!(triangles.to_string(), fields[5], "{name}: triangles");
        assert_eq!(
            (mesh.cells.len() - triangles).to_string(),
            fields[6],
            "{name}: quadrangles"
        );
        assert_near(mesh.area(), &fields[7], name);

        let found: Vec<_> = mesh.groups.iter().map(|group| &group.name).collect();
        assert_eq!(
            found,
            groups.iter().map(|fields| &fields[2]).collect::<Vec<_>>(),
            "{name}"
        );
        for (group, fields) in mesh.groups.iter().zip(&groups) {
            check_group(
                &mesh,
                group,
                fields,
                &format!("{name}: group {}", group.name),
            );
        }
    }
}

fn check_group(mesh: &Mesh, group: &Group, fields: &[String], what: &str) {
    assert_eq!(group.dimension.to_string(), fields[0], "{what}");
    assert_eq!(group.number.to_string(), fields[1], "{what}");
    assert_eq!(group.nodes.len().to_string(), fields[3], "{what}");
    assert_eq!(tag_sum(mesh, &group.nodes).to_string(), fields[4], "{what}");
    let (count, measure) = elements(mesh, group);
    assert_eq!(count.to_string(), fields[5], "{what}");
    assert_near(measure, &fields[6], what);
}

#[test]
fn expectations_cover_every_file() {
    let listed: BTreeSet<String> = expected()
        .into_iter()
        .map(|(fields, _)| fields[0].clone())
        .collect();
    let present: BTreeSet<String> = fs::read_dir(folder())
        .unwrap()
        .map(|entry| entry.unwrap().file_name().into_string().unwrap())
        .filter(|name| name.ends_with(".msh") && !name.starts_with("refused-"))
        .collect();
    assert_eq!(listed, present);
}

#[test]
fn every_cell_is_counter_clockwise() {
    for (fields, _) in expected() {
        let mesh = read(&fields[0]);
        assert!(
            mesh.cells
                .iter()
                .all(|cell| cell.area(&mesh.positions) > 0.0),
            "{}",
            fields[0]
        );
    }
}

#[test]
fn encodings_and_versions_of_one_model_give_one_mesh() {
    for stem in ["triangles", "mixed", "second-order", "gaps", "periodic"] {
        let reference = read(&format!("{stem}-41-binary.msh"));
        for variant in ["22", "22-binary", "41"] {
            let mesh = read(&format!("{stem}-{variant}.msh"));
            assert_eq!(mesh.node_tags, reference.node_tags, "{stem}-{variant}");
            assert_eq!(
                mesh.groups.len(),
                reference.groups.len(),
                "{stem}-{variant}"
            );
            for (group, other) in mesh.groups.iter().zip(&reference.groups) {
                assert_eq!(
                    (&group.name, &group.nodes),
                    (&other.name, &other.nodes),
                    "{stem}-{variant}"
                );
            }
            // Text holds 16 digits.
            for (p, q) in mesh.positions.iter().zip(&reference.positions) {
                assert!(
                    (p[0] - q[0]).abs() + (p[1] - q[1]).abs() < 1e-15,
                    "{stem}-{variant}"
                );
            }
        }
    }
}

#[test]
fn group_lists_are_ascending_and_name_their_own_nodes() {
    for (fields, _) in expected() {
        let mesh = read(&fields[0]);
        for group in &mesh.groups {
            assert!(
                group.nodes.is_sorted_by(|a, b| a < b),
                "{}: {}",
                fields[0],
                group.name
            );
            assert!(
                group.cells.is_sorted_by(|a, b| a < b),
                "{}: {}",
                fields[0],
                group.name
            );
            let of_cells = group
                .cells
                .iter()
                .flat_map(|cell| mesh.cells[*cell as usize].corners());
            let named: BTreeSet<u32> = of_cells
                .chain(group.edges.iter().flatten())
                .copied()
                .collect();
            // A node at the end of a dropped edge remains in the group.
            assert!(named.iter().all(|node| group.nodes.contains(node)));
            if group.dimension == 2 {
                assert_eq!(
                    named.len(),
                    group.nodes.len(),
                    "{}: {}",
                    fields[0],
                    group.name
                );
            }
        }
    }
}

#[test]
fn sides_of_the_rectangle_lie_where_they_are_named() {
    let mesh = read("triangles-41.msh");
    for (name, x) in [("left side", 0.0), ("right side", 1.0)] {
        let group = mesh.group(name).unwrap();
        assert!(
            group
                .nodes
                .iter()
                .all(|node| mesh.positions[*node as usize][0] == x)
        );
    }
    let corner = mesh.group("corner").unwrap().nodes[0];
    assert_eq!(mesh.positions[corner as usize], [0.0, 0.0]);
}

#[test]
fn a_name_may_stand_for_groups_of_several_dimensions() {
    let mesh = read("periodic-41.msh");
    let dimensions: Vec<u8> = mesh
        .groups_named("plate")
        .map(|group| group.dimension)
        .collect();
    assert_eq!(dimensions, [1, 2]);
    assert_eq!(mesh.group("plate").unwrap().dimension, 1);
    assert!(mesh.group("disk").is_none());
}

#[test]
fn plain_files_need_no_remark() {
    for name in [
        "triangles-22.msh",
        "triangles-41-binary.msh",
        "save-all-41.msh",
        "meshio-22.msh",
    ] {
        assert_eq!(read(name).remarks, [], "{name}");
    }
}

#[test]
fn higher_order_cells_are_remarked_with_their_dropped_nodes() {
    // Sides of the cells, and the middle of each of the four nine-node quadrangles.
    let sides = 22 + 24 - 1;
    for name in [
        "second-order-22.msh",
        "second-order-22-binary.msh",
        "second-order-41.msh",
    ] {
        let expected = [Remark::HigherOrderCells {
            cells: 24,
            nodes: sides + 4,
        }];
        assert_eq!(read(name).remarks, expected, "{name}");
    }
    // Two nodes on each side, one in a triangle, four in a quadrangle.
    let expected = [Remark::HigherOrderCells {
        cells: 24,
        nodes: 2 * sides + 20 + 4 * 4,
    }];
    assert_eq!(read("third-order-41.msh").remarks, expected);
}

#[test]
fn nodes_and_groups_off_the_cells_are_remarked() {
    for name in [
        "gaps-22.msh",
        "gaps-22-binary.msh",
        "gaps-41.msh",
        "gaps-41-binary.msh",
    ] {
        // Two corners of the left half and two nodes of its lower side.
        let expected = [
            Remark::UnusedNodes { nodes: 4 },
            Remark::EmptyGroup {
                name: "off the mesh".to_owned(),
                dimension: 0,
            },
        ];
        assert_eq!(read(name).remarks, expected, "{name}");
    }
}

#[test]
fn groups_that_the_writer_dropped_are_remarked() {
    let empty = |name: &str, dimension| Remark::EmptyGroup {
        name: name.to_owned(),
        dimension,
    };
    let expected = [
        empty("corner", 0),
        empty("left side", 1),
        empty("right side", 1),
        empty("all", 2),
        empty("left half", 2),
    ];
    assert_eq!(read("save-all-22.msh").remarks, expected);

    let expected = [
        Remark::UndescribedEntities { elements: 4 },
        empty("lower right", 2),
        empty("upper left", 2),
    ];
    assert_eq!(read("meshio-plain-41.msh").remarks, expected);
    assert_eq!(read("meshio-plain-41-binary.msh").remarks, expected);
}
