//! Random meshes written in every format and read back, and files damaged at random.

#![allow(clippy::unwrap_used, missing_docs)]

use std::fs;
use std::path::Path;
use std::sync::LazyLock;

use crate::writer::{Encoding, Model, Version};
use ligament_mesh::{Cell, Group, Remark, gmsh};
use proptest::prelude::*;

const FORMATS: [(Version, Encoding); 6] = [
    (Version::V2, Encoding::Ascii),
    (Version::V2, Encoding::LittleEndian),
    (Version::V2, Encoding::BigEndian),
    (Version::V4, Encoding::Ascii),
    (Version::V4, Encoding::LittleEndian),
    (Version::V4, Encoding::BigEndian),
];

/// The numbers of groups that an entity may be in.
fn physicals() -> impl Strategy<Value = Vec<Vec<i32>>> {
    let some = prop::sample::subsequence(vec![1, 2, 5, 40], 0..=3);
    prop::collection::vec(some, 3)
}

/// A square of the grid: quadrangle or which two triangles, whether clockwise, and its entity.
type Square = (u8, bool, usize);

fn cells(
    index: usize,
    columns: usize,
    (kind, reversed, entity): Square,
) -> Vec<(Vec<usize>, bool, usize)> {
    let first = (index / columns) * (columns + 1) + index % columns;
    let [a, b, c, d] = [first, first + 1, first + columns + 2, first + columns + 1];
    let corners = match kind {
        0 => vec![vec![a, b, c, d]],
        1 => vec![vec![a, b, c], vec![a, c, d]],
        _ => vec![vec![a, b, d], vec![b, c, d]],
    };
    corners
        .into_iter()
        .map(|corners| (corners, reversed, entity))
        .collect()
}

/// Nodes of a grid, jittered, with gaps in their tags.
fn nodes(columns: usize, jitter: Vec<(f64, f64, u64)>) -> Vec<(u64, [f64; 2])> {
    let mut tag = 0;
    let node = |(index, (dx, dy, step)): (usize, (f64, f64, u64))| {
        tag += step;
        let (column, row) = (index % (columns + 1), index / (columns + 1));
        (tag, [column as f64 + dx, row as f64 + dy])
    };
    jitter.into_iter().enumerate().map(node).collect()
}

/// A grid of jittered nodes, each of its squares a quadrangle or two triangles, in random orientation.
fn models() -> impl Strategy<Value = Model> {
    let parts = |(columns, rows): (usize, usize)| {
        let n = (columns + 1) * (rows + 1);
        (
            Just(columns),
            prop::collection::vec((-0.2..0.2, -0.2..0.2, 1..4_u64), n),
            prop::collection::vec((0..3_u8, any::<bool>(), 0..3_usize), columns * rows),
            prop::collection::vec(0..3_usize, columns),
            [physicals(), physicals(), physicals()],
            prop::collection::vec(0..n, 0..3),
        )
    };
    (1..6_usize, 1..5_usize).prop_flat_map(parts).prop_map(
        |(columns, jitter, squares, sides, physicals, points)| {
            let squares = squares.into_iter().enumerate();
            let sides = sides.into_iter().enumerate();
            Model {
                nodes: nodes(columns, jitter),
                cells: squares
                    .flat_map(|(index, square)| cells(index, columns, square))
                    .collect(),
                edges: sides
                    .map(|(index, entity)| ([index, index + 1], entity))
                    .collect(),
                points: points
                    .into_iter()
                    .enumerate()
                    .map(|(i, node)| (node, i))
                    .collect(),
                physicals,
            }
        },
    )
}

/// The groups of a model that are not empty, by looking for the elements of each number.
fn expected_groups(model: &Model) -> Vec<Group> {
    let numbers = |dimension| [1, 2, 5, 40].map(|number| (dimension, number));
    let groups = (0..3)
        .flat_map(numbers)
        .map(|(dimension, number)| expected_group(model, dimension, number));
    groups.filter(|group| !group.nodes.is_empty()).collect()
}

fn expected_group(model: &Model, dimension: u8, number: i32) -> Group {
    let is_in = |entity: usize| model.physicals[dimension as usize][entity].contains(&number);
    let (mut nodes, mut edges, mut cells) = (Vec::<usize>::new(), Vec::new(), Vec::new());
    match dimension {
        0 => {
            let inside = model.points.iter().filter(|point| is_in(point.1));
            nodes.extend(inside.map(|point| point.0));
        }
        1 => {
            for (edge, _) in model.edges.iter().filter(|edge| is_in(edge.1)) {
                edges.push(edge.map(|node| node as u32));
                nodes.extend(edge);
            }
        }
        _ => {
            for (index, cell) in model
                .cells
                .iter()
                .enumerate()
                .filter(|(_, cell)| is_in(cell.2))
            {
                cells.push(index as u32);
                nodes.extend(&cell.0);
            }
        }
    }
    nodes.sort_unstable();
    nodes.dedup();
    let nodes = nodes.into_iter().map(|node| node as u32).collect();
    Group {
        name: number.to_string(),
        dimension,
        number,
        nodes,
        edges,
        cells,
        ..Group::default()
    }
}

/// Remarks on the groups that no element of the model is in.
fn empty_groups(model: &Model) -> Vec<Remark> {
    let full = expected_groups(model);
    let all = (0..3_u8).flat_map(|dimension| [1, 2, 5, 40].map(|number| (dimension, number)));
    all.filter(|(dimension, number)| {
        let announced = model.physicals[*dimension as usize]
            .iter()
            .flatten()
            .any(|n| n == number);
        announced
            && !full
                .iter()
                .any(|group| (group.dimension, group.number) == (*dimension, *number))
    })
    .map(|(dimension, number)| Remark::EmptyGroup {
        name: number.to_string(),
        dimension,
    })
    .collect()
}

fn expected_cell(corners: &[usize]) -> Cell {
    match *corners {
        [a, b, c] => Cell::Triangle([a, b, c].map(|node| node as u32)),
        [a, b, c, d] => Cell::Quadrangle([a, b, c, d].map(|node| node as u32)),
        _ => panic!("a cell has three or four corners"),
    }
}

/// Files of every format with every kind of section.
static GOLDEN: LazyLock<Vec<Vec<u8>>> = LazyLock::new(|| {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data");
    let files = fs::read_dir(folder)
        .unwrap()
        .map(|entry| entry.unwrap().path());
    let mut files: Vec<_> = files
        .filter(|path| path.extension().is_some_and(|end| end == "msh"))
        .collect();
    files.sort();
    files.iter().map(|path| fs::read(path).unwrap()).collect()
});

/// A damage: place, length, and the bytes that replace it.
fn damages() -> impl Strategy<Value = Vec<(prop::sample::Index, usize, Vec<u8>)>> {
    // Digits and separators pass the reader of words and reach the code behind it.
    let byte = prop_oneof![any::<u8>(), prop::sample::select(&b"0123456789 -.\n$"[..])];
    let damage = (
        any::<prop::sample::Index>(),
        0..12_usize,
        prop::collection::vec(byte, 0..12),
    );
    prop::collection::vec(damage, 1..4)
}

fn damaged(file: &[u8], damages: &[(prop::sample::Index, usize, Vec<u8>)]) -> Vec<u8> {
    let mut bytes = file.to_vec();
    for (at, length, instead) in damages {
        let begin = at.index(bytes.len() + 1);
        let end = bytes.len().min(begin + length);
        bytes.splice(begin..end, instead.iter().copied());
    }
    bytes
}

/// Conditions that every mesh satisfies, whatever its origin.
fn check_sound(mesh: &ligament_mesh::Mesh) -> Result<(), TestCaseError> {
    let n = mesh.positions.len() as u32;
    prop_assert_eq!(mesh.node_tags.len(), mesh.positions.len());
    prop_assert!(
        mesh.cells
            .iter()
            .flat_map(|cell| cell.corners())
            .all(|node| *node < n)
    );
    prop_assert!(
        mesh.cells
            .iter()
            .all(|cell| cell.area(&mesh.positions) > 0.0)
    );
    for group in &mesh.groups {
        prop_assert!(!group.nodes.is_empty() && group.nodes.iter().all(|node| *node < n));
        prop_assert!(group.edges.iter().flatten().all(|node| *node < n));
        prop_assert!(
            group
                .cells
                .iter()
                .all(|cell| (*cell as usize) < mesh.cells.len())
        );
    }
    Ok(())
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::with_cases(200) })]

    #[test]
    fn a_mesh_is_read_as_it_was_written(model in models()) {
        for (version, encoding) in FORMATS {
            let bytes = model.write(version, encoding);
            let mesh = gmsh::parse(&bytes).map_err(|error| TestCaseError::fail(error.to_string()))?;
            let (tags, positions): (Vec<_>, Vec<_>) = model.nodes.iter().copied().unzip();
            prop_assert_eq!(&*mesh.node_tags, &tags, "{:?} {:?}", version, encoding);
            prop_assert_eq!(&mesh.positions, &positions);
            let cells: Vec<_> = model.cells.iter().map(|(corners, ..)| expected_cell(corners)).collect();
            prop_assert_eq!(&mesh.cells, &cells);
            prop_assert_eq!(&mesh.groups, &expected_groups(&model));
            // Only 4.1 tells of the groups of an entity without elements.
            let empty = if version == Version::V4 { empty_groups(&model) } else { Vec::new() };
            prop_assert_eq!(&mesh.remarks, &empty);
        }
    }

    /// A mesh that the crate writes is read back as the same mesh, whatever groups its elements are in.
    #[test]
    fn a_mesh_that_is_written_is_read_back(model in models()) {
        let mut mesh = gmsh::parse(&model.write(Version::V4, Encoding::Ascii)).unwrap();
        mesh.remarks.clear();
        prop_assert_eq!(gmsh::parse(gmsh::write(&mesh).as_bytes()).unwrap(), mesh);
    }

    #[test]
    fn a_node_of_no_cell_is_dropped_wherever_it_stands(model in models(), at in any::<prop::sample::Index>()) {
        let mut longer = model.clone();
        let at = at.index(model.nodes.len() + 1);
        longer.nodes.insert(at, (1_000_000, [0.5, 0.5]));
        longer.shift_nodes(at);
        for (version, encoding) in FORMATS {
            let mut mesh = gmsh::parse(&longer.write(version, encoding)).unwrap();
            prop_assert_eq!(mesh.remarks.remove(0), Remark::UnusedNodes { nodes: 1 });
            prop_assert_eq!(mesh, gmsh::parse(&model.write(version, encoding)).unwrap());
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::with_cases(6000) })]

    #[test]
    fn a_damaged_file_is_refused_or_makes_a_sound_mesh(
        file in any::<prop::sample::Index>(),
        damages in damages(),
    ) {
        if let Ok(mesh) = gmsh::parse(&damaged(&GOLDEN[file.index(GOLDEN.len())], &damages)) {
            check_sound(&mesh)?;
        }
    }

    #[test]
    fn any_bytes_behind_a_format_are_refused_or_make_a_sound_mesh(
        format in prop::sample::select(&["2.2 0 8\n", "4.1 0 8\n", "2.2 1 8\n\x01\0\0\0", "4.1 1 8\n\x01\0\0\0"][..]),
        section in prop::sample::select(
            &[
                "Nodes", "Elements", "Entities", "PartitionedEntities", "PhysicalNames", "ParametricNodes", "NSets", "Fasets", "Groups",
            ][..],
        ),
        bytes in prop::collection::vec(any::<u8>(), 0..200),
    ) {
        let mut file = format!("$MeshFormat\n{format}\n$EndMeshFormat\n${section}\n").into_bytes();
        file.extend(bytes);
        if let Ok(mesh) = gmsh::parse(&file) {
            check_sound(&mesh)?;
        }
    }
}
