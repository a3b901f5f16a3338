//! Tetrahedra.

use std::collections::{BTreeMap, BTreeSet};

use super::{Sequence, assert_is_refinement, bisect_to, complete, generations, group, shapes};
use crate::bisection::Bisection;
use crate::cell::Cell;
use crate::gmsh;
use crate::mesh::{AnyMesh, Group, SolidMesh};
use crate::solid::SolidCell;

/// Corners of the tetrahedra of a cube (H. W. Kuhn's), by the axes along which their nodes follow each other.
const ORDERS: [[usize; 3]; 6] = [
    [0, 1, 2],
    [1, 2, 0],
    [2, 0, 1],
    [1, 0, 2],
    [0, 2, 1],
    [2, 1, 0],
];

/// A cube of side 1 in n x n x n cubes of six tetrahedra each. Inner nodes are off by up to a fifth of the spacing times `jitter`, but for
/// those in the middle planes. An edge of the cube, the face z = 0, the plane x = 1/2 of an even n and the half below z = 1/2 are groups.
fn cube(n: u32, jitter: f64) -> SolidMesh {
    let mut sequence = Sequence(2);
    let side = n + 1;
    let mut positions = Vec::new();
    for node in 0..side.pow(3) {
        let place = [node % side, node / side % side, node / side / side];
        let is_free = place.iter().all(|it| (1..n).contains(it) && 2 * it != n);
        let jitter = if is_free { jitter } else { 0.0 };
        let shifted = |it| (f64::from(it) + 0.4 * jitter * (sequence.next() - 0.5)) / f64::from(n);
        positions.push(place.map(shifted));
    }
    let steps = [1, side, side * side];
    let mut cells = Vec::new();
    for cube in 0..n.pow(3) {
        let first = cube % n + cube / n % n * side + cube / n / n * side * side;
        for (place, [one, other, _]) in ORDERS.into_iter().enumerate() {
            let a = first + steps[one];
            let b = a + steps[other];
            let last = first + steps.iter().sum::<u32>();
            let [a, b] = if place < 3 { [a, b] } else { [b, a] };
            cells.push(SolidCell::Tetrahedron([first, a, b, last]));
        }
    }
    let mesh = SolidMesh {
        positions,
        cells,
        ..SolidMesh::default()
    };
    let groups = groups(&mesh);
    complete(SolidMesh { groups, ..mesh })
}

fn groups(mesh: &SolidMesh) -> Vec<Group> {
    let at = |node: &u32, axis: usize| mesh.positions[*node as usize][axis];
    let mut faces: Vec<Cell> = mesh.cells.iter().flat_map(SolidCell::faces).collect();
    faces.sort_by_key(Cell::sorted_corners);
    faces.dedup_by_key(|face| face.sorted_corners());
    let in_plane = |axis: usize, value: f64| -> Vec<Cell> {
        let is_in = |face: &&Cell| face.corners().iter().all(|node| at(node, axis) == value);
        faces.iter().filter(is_in).copied().collect()
    };
    let mut edges = mesh.edges();
    edges.retain(|edge| {
        edge.iter()
            .all(|node| at(node, 0) == 0.0 && at(node, 1) == 0.0)
    });
    let is_below = |cell: &SolidCell| cell.corners().iter().all(|node| at(node, 2) <= 0.5);
    let numbered = (0..).zip(&mesh.cells);
    let below = numbered.filter(|(_, cell)| is_below(cell));
    vec![
        Group {
            edges,
            ..group("edge", 1, 1)
        },
        Group {
            faces: in_plane(2, 0.0),
            ..group("bottom", 2, 1)
        },
        Group {
            faces: in_plane(0, 0.5),
            ..group("middle", 2, 2)
        },
        Group {
            cells: below.map(|(number, _)| number).collect(),
            ..group("below", 3, 1)
        },
    ]
}

/// A mesh of one tetrahedron.
fn tetrahedron(positions: [[f64; 3]; 4]) -> SolidMesh {
    let mut cell = SolidCell::Tetrahedron([0, 1, 2, 3]);
    if cell.volume(&positions) < 0.0 {
        cell = SolidCell::Tetrahedron([1, 0, 2, 3]);
    }
    complete(SolidMesh {
        positions: positions.to_vec(),
        cells: vec![cell],
        ..SolidMesh::default()
    })
}

fn area(face: &Cell, mesh: &SolidMesh) -> f64 {
    let vector = face.area_vector(&mesh.positions);
    vector.iter().map(|it| it * it).sum::<f64>().sqrt()
}

/// With a node on a face, the face and its parts would have one cell each and enlarge the surface. Faces of groups are faces of cells, and
/// have the areas of the plane sections of the cube, 1.
fn assert_conforms(mesh: &SolidMesh) {
    let mut faces: BTreeMap<[u32; 4], (usize, Cell)> = BTreeMap::new();
    for face in mesh.cells.iter().flat_map(SolidCell::faces) {
        let entry = faces.entry(face.sorted_corners()).or_insert((0, face));
        entry.0 += 1;
    }
    assert!(faces.values().all(|(n_cells, _)| *n_cells <= 2));
    let outer = faces.values().filter(|(n_cells, _)| *n_cells == 1);
    let surface: f64 = outer.map(|(_, face)| area(face, mesh)).sum();
    assert!((surface - 6.0).abs() < 1e-11, "{surface}");
    for group in mesh.groups.iter().filter(|it| it.dimension == 2) {
        let is_of_cell = |face: &Cell| faces.contains_key(&face.sorted_corners());
        assert!(group.faces.iter().all(is_of_cell), "{}", group.name);
        let sum: f64 = group.faces.iter().map(|face| area(face, mesh)).sum();
        assert!((sum - 1.0).abs() < 1e-12, "{} {sum}", group.name);
    }
}

#[test]
fn without_marks_a_mesh_stays_as_it_is() {
    let mesh = cube(2, 1.0);
    assert_eq!(mesh.groups.len(), 4);
    let mut bisection = Bisection::new(&mesh).unwrap();
    bisection.bisect(&[false; 48]);
    assert_eq!(bisection.mesh(), mesh);
}

/// After random marks, most of them near a corner, the mesh conforms, has all that it had, and is the same in a file.
#[test]
fn meshes_conform_after_random_marks() {
    for (n, jitter, share) in [(2, 0.0, 0.05), (3, 1.0, 0.02), (4, 1.0, 0.002)] {
        let mesh = cube(n, jitter);
        let mut bisection = Bisection::new(&mesh).unwrap();
        let mut sequence = Sequence(5);
        for _ in 0..10 {
            let marks = sequence.marks(bisection.cells().len(), share);
            bisection.bisect(&marks);
            assert_conforms(&bisection.mesh());
            assert_is_refinement(&bisection, &mesh);
        }
        let finest = generations(&bisection).into_iter().max();
        assert!(finest >= Some(8), "{finest:?}");
        let refined = bisection.mesh();
        let read = gmsh::parse_any(gmsh::write(&refined).as_bytes()).unwrap();
        assert_eq!(read, AnyMesh::Solid(refined));
    }
}

#[test]
fn three_bisections_of_all_tetrahedra_are_the_middles_of_all_edges() {
    let mesh = cube(3, 1.0);
    let mut bisection = Bisection::new(&mesh).unwrap();
    bisect_to(&mut bisection, 3);
    assert!(generations(&bisection).iter().all(|it| *it == 3));
    let edges: BTreeSet<[u32; 2]> = mesh.edges().into_iter().collect();
    let n_added = bisection.positions().len() - mesh.positions.len();
    assert_eq!(n_added, edges.len());
    assert!(
        edges
            .iter()
            .all(|edge| bisection.middles.contains_key(edge))
    );
}

/// Descendants have at most 72 shapes (Arnold, Mukherjee and Pouly), so from some generation on none is new and the quality stays: the same
/// for every third one, as all edges are halved in three.
#[test]
fn descendants_of_a_tetrahedron_have_a_bounded_number_of_shapes() {
    let height = 0.5_f64.sqrt();
    let regular = [
        [1.0, 0.0, -height],
        [-1.0, 0.0, -height],
        [0.0, 1.0, height],
        [0.0, -1.0, height],
    ];
    let mut sequence = Sequence(9);
    let random = || [0; 4].map(|_| [0; 3].map(|_| sequence.next()));
    let random: Vec<[[f64; 3]; 4]> = std::iter::repeat_with(random).take(8).collect();
    for positions in random.into_iter().chain([regular]) {
        let mesh = tetrahedron(positions);
        let mut bisection = Bisection::new(&mesh).unwrap();
        let mut known = Vec::new();
        let mut least = Vec::new();
        for generation in 1..=13 {
            bisect_to(&mut bisection, generation);
            let of_generation = shapes(bisection.cells(), bisection.positions());
            known.push(of_generation.len());
            let quality = |cell: SolidCell| cell.radius_ratio(bisection.positions()).unwrap();
            least.push(bisection.cells().map(quality).fold(1.0, f64::min));
        }
        assert!(known.iter().all(|it| *it <= 72), "{known:?}");
        for (early, late) in [(6, 9), (7, 10), (8, 11), (9, 12)] {
            assert_eq!(known[early], known[late]);
            assert!((least[late] / least[early] - 1.0).abs() < 1e-6, "{least:?}");
        }
        let first = mesh.cells[0].radius_ratio(&mesh.positions).unwrap();
        let smallest = least.into_iter().fold(1.0, f64::min);
        assert!(smallest > 0.1 * first);
    }
}

#[test]
fn shapes_other_than_tetrahedra_are_named() {
    let mut mesh = cube(1, 0.0);
    mesh.cells.push(SolidCell::Pyramid([0, 1, 3, 2, 7]));
    mesh.cells.extend([SolidCell::Prism([0, 1, 3, 4, 5, 7]); 2]);
    let refusal = Bisection::new(&mesh).map(|_| ()).unwrap_err();
    assert_eq!(refusal.cells, [("prism", 2), ("pyramid", 1)].into());
    let message = refusal.to_string();
    assert!(
        message.contains("2 of the shape \"prism\" and 1 of the shape \"pyramid\""),
        "{message}"
    );
}
