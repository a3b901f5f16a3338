//! Meshes: those of the repository, and new ones made from them.

use std::fmt::Write as _;
use std::path::{Path, PathBuf};

use ligament::body::{CellSet, LatticeBody};
use ligament_mesh::{Cell, Group, Mesh, gmsh};

/// All mesh files of the repository, sorted.
pub fn all() -> Vec<PathBuf> {
    let mut found = Vec::new();
    for folder in ["meshes", "tests/reference"] {
        for entry in std::fs::read_dir(crate::repository().join(folder)).unwrap() {
            let path = entry.unwrap().path();
            if path.extension().is_some_and(|extension| extension == "msh") {
                found.push(path);
            }
        }
    }
    found.sort();
    assert!(found.len() > 5, "the meshes of the repository are missing");
    found
}

/// Reads a mesh, by its path inside the repository.
pub fn read(path: impl AsRef<Path>) -> Mesh {
    let path = crate::repository().join(path);
    let bytes = std::fs::read(&path).unwrap_or_else(|error| panic!("{}: {error}", path.display()));
    gmsh::parse(&bytes).unwrap_or_else(|error| panic!("{}: {error}", path.display()))
}

/// A lattice of 40 by 20 square cells, `length` (m) wide, with the sets "left-half" and "right-half", and "left" and "right" of one column each.
pub fn halved_lattice(length: f64) -> LatticeBody {
    let n = 40_u32;
    let side = length / f64::from(n);
    let sets = [
        ("left", CellSet::left(1)),
        ("right", CellSet::right(1)),
        ("left-half", CellSet::left(n / 2)),
        ("right-half", CellSet::right(n / 2)),
    ];
    let sets = sets.map(|(name, set)| (name.to_owned(), set)).into();
    LatticeBody::new([n, n / 2], [side; 2], [0.5 * side; 2], &[], &sets).unwrap()
}

/// The directed edges of the cells that have a cell on one side only.
pub fn rim(mesh: &Mesh) -> Vec<[u32; 2]> {
    let mut edges = std::collections::BTreeSet::new();
    for cell in &mesh.cells {
        let corners = cell.corners();
        for (k, &from) in corners.iter().enumerate() {
            edges.insert([from, corners[(k + 1) % corners.len()]]);
        }
    }
    let is_rim = |edge: &&[u32; 2]| !edges.contains(&[edge[1], edge[0]]);
    edges.iter().filter(is_rim).copied().collect()
}

/// The same mesh with its nodes elsewhere.
pub fn moved(mesh: &Mesh, place: impl Fn([f64; 2]) -> [f64; 2]) -> Mesh {
    let mut mesh = mesh.clone();
    for position in &mut mesh.positions {
        *position = place(*position);
    }
    mesh
}

/// The same mesh with its nodes in another order: node `order[k]` becomes node k, and keeps its tag.
pub fn renumbered(mesh: &Mesh, order: &[usize]) -> Mesh {
    let mut place = vec![0; order.len()];
    for (new, &old) in order.iter().enumerate() {
        place[old] = new as u32;
    }
    let number = |old: u32| place[old as usize];
    let sorted = |nodes: &[u32]| {
        let mut nodes: Vec<u32> = nodes.iter().map(|&node| number(node)).collect();
        nodes.sort_unstable();
        nodes
    };
    Mesh {
        node_tags: order.iter().map(|&old| mesh.node_tags[old]).collect(),
        positions: order.iter().map(|&old| mesh.positions[old]).collect(),
        cells: mesh
            .cells
            .iter()
            .map(|cell| match cell {
                Cell::Triangle(corners) => Cell::Triangle(corners.map(number)),
                Cell::Quadrangle(corners) => Cell::Quadrangle(corners.map(number)),
            })
            .collect(),
        groups: mesh
            .groups
            .iter()
            .map(|group| Group {
                nodes: sorted(&group.nodes),
                edges: group.edges.iter().map(|edge| edge.map(number)).collect(),
                ..group.clone()
            })
            .collect(),
        fields: Vec::new(),
        remarks: Vec::new(),
    }
}

/// The mesh and its image in the line x = 0, where the two share their nodes (|x| < 1e-12 m); also returns the image of
/// each node. Only the groups of points and curves are kept, each with its image.
pub fn mirrored(mesh: &Mesh) -> (Mesh, Vec<usize>) {
    let half = mesh.positions.len();
    let mut positions = mesh.positions.clone();
    let mut image: Vec<usize> = (0..half).collect();
    for node in 0..half {
        let [x, y] = mesh.positions[node];
        if x.abs() < 1e-12 {
            positions[node][0] = 0.0;
        } else {
            image[node] = positions.len();
            positions.push([-x, y]);
        }
    }
    for node in 0..half {
        if image[node] != node {
            image.push(node);
        }
    }
    let number = |node: u32| image[node as usize] as u32;
    let mut cells = mesh.cells.clone();
    for cell in &mesh.cells {
        cells.push(match cell.corners() {
            [a, b, c] => Cell::Triangle([a, c, b].map(|&node| number(node))),
            [a, b, c, d] => Cell::Quadrangle([a, d, c, b].map(|&node| number(node))),
            _ => unreachable!("cells have three or four corners"),
        });
    }
    let both = |group: &Group| {
        let mut nodes: Vec<u32> = group.nodes.clone();
        nodes.extend(group.nodes.iter().map(|&node| number(node)));
        nodes.sort_unstable();
        nodes.dedup();
        let mut edges = group.edges.clone();
        edges.extend(group.edges.iter().map(|edge| edge.map(number)));
        Group {
            nodes,
            edges,
            ..group.clone()
        }
    };
    let groups = mesh.groups.iter().filter(|group| group.dimension < 2);
    let mesh = Mesh {
        node_tags: (1..=positions.len() as u64).collect(),
        positions,
        cells,
        groups: groups.map(both).collect(),
        fields: Vec::new(),
        remarks: Vec::new(),
    };
    (mesh, image)
}

/// A lattice of `n` by `n` squares of this side, its lower left corner at `corner`; curves `bottom` and `top`.
pub fn lattice(n: u32, side: f64, corner: [f64; 2]) -> Mesh {
    let row = n + 1;
    let node = |i: u32, j: u32| j * row + i;
    let grid = |count: u32| (0..count).flat_map(move |j| (0..count).map(move |i| (i, j)));
    let curve = |name: &str, number: i32, j: u32| Group {
        name: name.to_owned(),
        dimension: 1,
        number,
        nodes: (0..row).map(|i| node(i, j)).collect(),
        edges: (0..n).map(|i| [node(i, j), node(i + 1, j)]).collect(),
        ..Group::default()
    };
    Mesh {
        node_tags: (1..=u64::from(row * row)).collect(),
        positions: grid(row)
            .map(|(i, j)| {
                [
                    corner[0] + f64::from(i) * side,
                    corner[1] + f64::from(j) * side,
                ]
            })
            .collect(),
        cells: grid(n)
            .map(|(i, j)| {
                Cell::Quadrangle([
                    node(i, j),
                    node(i + 1, j),
                    node(i + 1, j + 1),
                    node(i, j + 1),
                ])
            })
            .collect(),
        groups: vec![curve("bottom", 1, 0), curve("top", 2, n)],
        fields: Vec::new(),
        remarks: Vec::new(),
    }
}

/// The mesh as a Gmsh file of format 2.2; coordinates are written so that reading gives their bits back.
///
/// A cell may belong to one surface group at most: the format has no place for more.
pub fn to_gmsh(mesh: &Mesh) -> String {
    let mut text = String::from("$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n");
    // Writing to a string cannot fail.
    let _ = writeln!(text, "{}", mesh.groups.len());
    for group in &mesh.groups {
        let _ = writeln!(
            text,
            "{} {} \"{}\"",
            group.dimension, group.number, group.name
        );
    }
    let _ = writeln!(text, "$EndPhysicalNames\n$Nodes\n{}", mesh.positions.len());
    for (tag, [x, y]) in mesh.node_tags.iter().zip(&mesh.positions) {
        let _ = writeln!(text, "{tag} {x:?} {y:?} 0");
    }
    let mut elements: Vec<(u32, i32, Vec<u32>)> = Vec::new();
    let mut surface_of_cell = vec![0; mesh.cells.len()];
    for group in &mesh.groups {
        match group.dimension {
            0 => elements.extend(
                group
                    .nodes
                    .iter()
                    .map(|&node| (15, group.number, vec![node])),
            ),
            1 => elements.extend(
                group
                    .edges
                    .iter()
                    .map(|edge| (1, group.number, edge.to_vec())),
            ),
            _ => {
                for &cell in &group.cells {
                    let before =
                        std::mem::replace(&mut surface_of_cell[cell as usize], group.number);
                    assert_eq!(before, 0, "a cell belongs to two surface groups");
                }
            }
        }
    }
    for (cell, &surface) in mesh.cells.iter().zip(&surface_of_cell) {
        let corners = cell.corners();
        elements.push((
            if corners.len() == 3 { 2 } else { 3 },
            surface,
            corners.to_vec(),
        ));
    }
    let _ = writeln!(text, "$EndNodes\n$Elements\n{}", elements.len());
    for (index, (kind, group, nodes)) in elements.iter().enumerate() {
        let _ = write!(text, "{} {kind} 2 {group} {group}", index + 1);
        for &node in nodes {
            let _ = write!(text, " {}", mesh.node_tags[node as usize]);
        }
        text.push('\n');
    }
    text.push_str("$EndElements\n");
    text
}
