//! Properties of bisected meshes.

mod curved;
mod tetrahedra;
mod triangles;

use std::collections::BTreeSet;

use super::{Bisectable, Bisection};
use crate::cell::{Cell, MeshCell, ascending};
use crate::mesh::{Group, Mesh};

/// Numbers between 0 and 1 of a linear congruential sequence (D. E. Knuth's MMIX).
struct Sequence(u64);

impl Sequence {
    fn next(&mut self) -> f64 {
        let [factor, term] = [6_364_136_223_846_793_005, 1_442_695_040_888_963_407];
        self.0 = self.0.wrapping_mul(factor).wrapping_add(term);
        (self.0 >> 11) as f64 / (1_u64 << 53) as f64
    }

    /// Marks on the first cell and on a share of the others.
    fn marks(&mut self, n_cells: usize, share: f64) -> Vec<bool> {
        let mark = |cell| self.next() < share || cell == 0;
        (0..n_cells).map(mark).collect()
    }
}

fn group(name: &str, dimension: u8, number: i32) -> Group {
    Group {
        name: name.to_owned(),
        dimension,
        number,
        ..Group::default()
    }
}

/// A mesh with tags of its nodes, and groups with the nodes of their edges, faces and cells; groups without nodes are left out.
fn complete<const D: usize, C: MeshCell<D>>(mut mesh: Mesh<D, C>) -> Mesh<D, C> {
    mesh.node_tags = (1..=mesh.positions.len() as u64).map(|it| 3 * it).collect();
    for group in &mut mesh.groups {
        let cells = group.cells.iter().map(|&it| &mesh.cells[it as usize]);
        let mut nodes: BTreeSet<u32> = group.nodes.iter().copied().collect();
        nodes.extend(group.edges.as_flattened());
        nodes.extend(group.faces.iter().flat_map(Cell::corners));
        nodes.extend(cells.flat_map(C::corners));
        group.nodes = nodes.into_iter().collect();
    }
    mesh.groups.retain(|group| !group.nodes.is_empty());
    mesh
}

/// A planar mesh with two nodes, its outline, its other edges and the first half of its cells as groups.
fn planar(positions: Vec<[f64; 2]>, cells: Vec<Cell>) -> Mesh {
    let mut mesh = Mesh {
        positions,
        cells,
        ..Mesh::default()
    };
    let mut outline: Vec<[u32; 2]> = mesh.outline().into_iter().map(ascending).collect();
    outline.sort_unstable();
    let mut inner = mesh.edges();
    inner.retain(|edge| !outline.contains(edge));
    mesh.groups = vec![
        Group {
            nodes: vec![0, 2],
            ..group("points", 0, 1)
        },
        Group {
            edges: outline,
            ..group("outline", 1, 2)
        },
        Group {
            edges: inner,
            ..group("inside", 1, 3)
        },
        Group {
            cells: (0..mesh.cells.len().div_ceil(2) as u32).collect(),
            ..group("half", 2, 4)
        },
    ];
    complete(mesh)
}

fn length<const D: usize>([a, b]: [u32; 2], positions: &[[f64; D]]) -> f64 {
    let [p, q] = [a, b].map(|node| positions[node as usize]);
    let squares = p.iter().zip(&q).map(|(p, q)| (q - p).powi(2));
    squares.sum::<f64>().sqrt()
}

fn generations<const D: usize, C: Bisectable<D>>(bisection: &Bisection<D, C>) -> Vec<u32> {
    let cells = 0..bisection.cells().len() as u32;
    cells.map(|cell| bisection.generation(cell)).collect()
}

/// Bisects cells of lower generations until none is left.
fn bisect_to<const D: usize, C: Bisectable<D>>(bisection: &mut Bisection<D, C>, generation: u32) {
    loop {
        let generations = generations(bisection);
        let marks: Vec<bool> = generations.iter().map(|it| *it < generation).collect();
        if !marks.contains(&true) {
            return;
        }
        bisection.bisect(&marks);
    }
}

/// Nothing is lost, doubled or turned over: nodes stay, cells and groups have their sizes, to the roundings of many parts, and an original
/// cell the sum of its descendants. A simplex is halved by each bisection.
fn assert_is_refinement<const D: usize, C: Bisectable<D>>(
    bisection: &Bisection<D, C>,
    original: &Mesh<D, C>,
) {
    let mesh = bisection.mesh();
    let n_nodes = original.positions.len();
    assert_eq!(mesh.positions[..n_nodes], original.positions);
    assert_eq!(mesh.node_tags[..n_nodes], original.node_tags[..]);
    assert!(mesh.node_tags.is_sorted());
    let mut sums = vec![0.0; original.cells.len()];
    for (number, cell) in (0..).zip(&mesh.cells) {
        let root = bisection.root(number) as usize;
        let size = cell.size(&mesh.positions);
        sums[root] += size;
        let share = 0.5_f64.powi(bisection.generation(number) as i32);
        let expected = share * original.cells[root].size(&original.positions);
        let is_halved = (size / expected - 1.0).abs() < 1e-10;
        assert!(size > 0.0 && (is_halved || original.cells[root].corners().len() > D + 1));
    }
    for (sum, cell) in sums.iter().zip(&original.cells) {
        assert!((sum / cell.size(&original.positions) - 1.0).abs() < 1e-12);
    }
    let size = |group: &Group, mesh: &Mesh<D, C>| {
        let edges = group.edges.iter();
        let cells = group.cells.iter().map(|&it| &mesh.cells[it as usize]);
        let lengths = edges.map(|&edge| length(edge, &mesh.positions));
        lengths
            .chain(cells.map(|cell| cell.size(&mesh.positions)))
            .sum::<f64>()
    };
    let edges: BTreeSet<[u32; 2]> = mesh.edges().into_iter().collect();
    for (group, before) in mesh.groups.iter().zip(&original.groups) {
        let [now, before] = [size(group, &mesh), size(before, original)];
        assert!((now - before).abs() <= 1e-12 * before, "{}", group.name);
        assert!(group.edges.iter().all(|edge| edges.contains(edge)));
    }
}

/// Shapes of cells, each once: ascending lengths of their edges relative to their size. Mirror images are of one shape.
fn shapes<const D: usize, C: MeshCell<D>>(
    cells: impl Iterator<Item = C>,
    positions: &[[f64; D]],
) -> Vec<Vec<f64>> {
    let mut known: Vec<Vec<f64>> = Vec::new();
    for cell in cells {
        let unit = cell.size(positions).powf(1.0 / D as f64);
        let lengths = cell.edges().map(|edge| length(edge, positions) / unit);
        let mut shape: Vec<f64> = lengths.collect();
        shape.sort_by(f64::total_cmp);
        // Far above rounding, far below differences of random shapes.
        let is_same = |it: &Vec<f64>| it.iter().zip(&shape).all(|(a, b)| (a - b).abs() < 1e-7);
        if !known.iter().any(is_same) {
            known.push(shape);
        }
    }
    known
}
