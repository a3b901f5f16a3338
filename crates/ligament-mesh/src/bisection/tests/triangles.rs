//! Triangles and quadrangles with straight outlines.

use super::{Sequence, assert_is_refinement, bisect_to, generations, length, planar, shapes};
use crate::bisection::Bisection;
use crate::cell::{Cell, cells_at_edges};
use crate::gmsh;
use crate::mesh::{Mesh, NodeField};

/// A square of side 1 in n x n quadrangles or twice as many triangles, its inner nodes off by up to a quarter of the spacing times `jitter`.
fn square(n: u32, jitter: f64, in_triangles: bool) -> Mesh {
    let mut sequence = Sequence(1);
    let mut positions = Vec::new();
    for (row, column) in (0..=n).flat_map(|row| (0..=n).map(move |column| (row, column))) {
        let is_inside = [row, column].iter().all(|it| (1..n).contains(it));
        let jitter = if is_inside { jitter } else { 0.0 };
        let place = |it| (f64::from(it) + 0.5 * jitter * (sequence.next() - 0.5)) / f64::from(n);
        positions.push([column, row].map(place));
    }
    let mut cells = Vec::new();
    for (row, column) in (0..n).flat_map(|row| (0..n).map(move |column| (row, column))) {
        let a = row * (n + 1) + column;
        let [b, c, d] = [a + 1, a + n + 2, a + n + 1];
        match in_triangles {
            true => cells.extend([[a, b, c], [c, d, a]].map(Cell::Triangle)),
            false => cells.push(Cell::Quadrangle([a, b, c, d])),
        }
    }
    planar(positions, cells)
}

/// Three rows of twelve equilateral triangles each.
fn equilateral() -> Mesh {
    let position = |node: u32| {
        let (row, column) = (f64::from(node / 7), f64::from(node % 7));
        [column + 0.5 * (row % 2.0), 0.75_f64.sqrt() * row]
    };
    let cells = (0..18)
        .map(|it| (it / 6, it % 6))
        .flat_map(|(row, column)| {
            let a = 7 * row + column;
            let [b, c, d] = [a + 1, a + 8, a + 7];
            match row % 2 {
                0 => [[a, b, d], [b, c, d]],
                _ => [[a, b, c], [a, c, d]],
            }
        });
    let cells = cells.map(Cell::Triangle).collect();
    planar((0..28).map(position).collect(), cells)
}

/// With a node between the ends of an edge, the edge and its halves would have one cell each and lengthen the outline.
fn assert_conforms(mesh: &Mesh, expected: f64) {
    let edges = cells_at_edges(&mesh.cells).into_values();
    assert!(edges.map(|(n_cells, _)| n_cells).max() <= Some(2));
    let lengths = mesh.outline().into_iter();
    let outline: f64 = lengths.map(|edge| length(edge, &mesh.positions)).sum();
    assert!((outline / expected - 1.0).abs() < 1e-12, "{outline}");
}

#[test]
fn without_marks_a_mesh_stays_as_it_is() {
    for in_triangles in [true, false] {
        let mesh = square(3, 1.0, in_triangles);
        let mut bisection = Bisection::new(&mesh).unwrap();
        bisection.bisect(&vec![false; mesh.cells.len()]);
        assert_eq!(bisection.mesh(), mesh);
    }
}

/// After random marks, most of them near a corner, the mesh conforms, has all that it had, and is the same in a file.
#[test]
fn meshes_conform_after_random_marks() {
    for (jitter, in_triangles, share) in [(1.0, true, 0.05), (1.0, false, 0.05), (0.0, true, 0.01)]
    {
        let mesh = square(6, jitter, in_triangles);
        let mut bisection = Bisection::new(&mesh).unwrap();
        let mut sequence = Sequence(3);
        for _ in 0..10 {
            let before = bisection.positions().to_vec();
            let n_cells = bisection.cells().len();
            let marks = sequence.marks(n_cells, share);
            bisection.bisect(&marks);
            assert_eq!(bisection.positions()[..before.len()], before);
            let n_marked = marks.iter().filter(|it| **it).count();
            assert!(bisection.cells().len() >= n_cells + n_marked);
            let refined = bisection.mesh();
            assert_conforms(&refined, 4.0);
            assert_is_refinement(&bisection, &mesh);
            let read = gmsh::parse(gmsh::write(&refined).as_bytes()).unwrap();
            assert_eq!(read, refined);
        }
        let finest = generations(&bisection).into_iter().max();
        assert!(finest >= Some(7), "{finest:?}");
    }
}

/// Newest vertex bisection: the triangle, its halves, and one more shape. So angles do not shrink without end.
#[test]
fn descendants_of_a_triangle_have_at_most_four_shapes() {
    let mut bisection = Bisection::new(&square(3, 1.0, true)).unwrap();
    for seed in 0..8 {
        let marks = Sequence(seed).marks(bisection.cells().len(), 0.4);
        bisection.bisect(&marks);
    }
    let count = |root: u32| {
        let cells = (0..).zip(bisection.cells());
        let descendants = cells.filter(|(cell, _)| bisection.root(*cell) == root);
        shapes(descendants.map(|(_, cell)| cell), bisection.positions()).len()
    };
    let most = (0..18).map(count).max();
    assert_eq!(most, Some(4));
}

#[test]
fn two_bisections_of_all_triangles_are_the_middles_of_all_edges() {
    for mesh in [equilateral(), square(4, 1.0, true)] {
        let mut bisection = Bisection::new(&mesh).unwrap();
        bisect_to(&mut bisection, 2);
        assert!(generations(&bisection).iter().all(|it| *it == 2));
        let middle = |[a, b]: [u32; 2]| {
            let [[xa, ya], [xb, yb]] = [a, b].map(|node| mesh.positions[node as usize]);
            [0.5 * (xa + xb), 0.5 * (ya + yb)]
        };
        let mut expected: Vec<[f64; 2]> = mesh.edges().into_iter().map(middle).collect();
        let mut found = bisection.positions()[mesh.positions.len()..].to_vec();
        for middles in [&mut expected, &mut found] {
            middles.sort_by(|one, other| one.partial_cmp(other).unwrap());
        }
        assert_eq!(found, expected);
    }
}

/// By hand: the square in the middle becomes four triangles, then eight at half of the spacing. Its four neighbours become four and
/// five triangles, the squares at the corners stay.
#[test]
fn two_bisections_of_a_square_halve_its_spacing() {
    let mut bisection = Bisection::new(&square(3, 0.0, false)).unwrap();
    let mut marks = [false; 9];
    marks[4] = true;
    bisection.bisect(&marks);
    assert_eq!(bisection.cells().len(), 12);
    let marks: Vec<bool> = (0..12).map(|it| bisection.root(it) == 4).collect();
    bisection.bisect(&marks);
    let refined = bisection.mesh();
    assert_conforms(&refined, 4.0);
    let is_square = |cell: &&Cell| matches!(cell, Cell::Quadrangle(_));
    let n_squares = refined.cells.iter().filter(is_square).count();
    assert_eq!((n_squares, refined.cells.len()), (4, 4 + 8 + 4 * 5));
    let is_inside = |p: &&[f64; 2]| p.iter().all(|x| (0.3..0.7).contains(x));
    assert_eq!(refined.positions.iter().filter(is_inside).count(), 9);
}

#[test]
fn fields_have_means_at_middles_between_values() {
    let mut mesh = square(1, 0.0, true);
    mesh.fields = vec![NodeField {
        name: "T".to_owned(),
        time_step: 3,
        components: 1,
        values: vec![(0, 1.0), (2, 8.0), (3, 4.0)],
    }];
    let mut bisection = Bisection::new(&mesh).unwrap();
    bisect_to(&mut bisection, 2);
    let refined = bisection.mesh();
    let values = refined.fields[0].at_nodes(9);
    for (position, value) in refined.positions.iter().zip(values) {
        let expected = match position {
            [0.0, 0.0] => Some(1.0),
            [1.0, 1.0] => Some(4.0),
            [0.0, 1.0] => Some(8.0),
            [0.5, 0.5] => Some(2.5),
            [0.5, 1.0] => Some(6.0),
            [0.0, 0.5] => Some(4.5),
            _ => None,
        };
        assert_eq!(value, expected, "{position:?}");
    }
    assert_eq!(*refined.node_tags, [3, 6, 9, 12, 13, 14, 15, 16, 17]);
}
