//! Cracks that are in the mesh: places where nodes are doubled, so that the cells on either side have their own.

use crate::cell::{Cell, MeshCell};
use crate::coincidence::lowest_at_place;
use crate::edges::outer_edges;
use crate::mesh::{Mesh, SolidMesh};
use crate::solid::{Faces, SolidCell};

impl Mesh {
    /// Pairs of outline edges at one place with cells on both sides, ascending: the faces of a crack that is in the mesh, or of a seam
    /// between parts that are not joined.
    ///
    /// Both edges run in the same direction: the first one has its cell on the left, the second one on the right. At a tip of the crack
    /// they have the same node.
    pub fn crack_faces(&self) -> Vec<[[u32; 2]; 2]> {
        let Some(lowest) = lowest_at_place(&self.positions) else {
            return Vec::new();
        };
        let ends = |side: Vec<u32>| [side[0], side[1]];
        let pairs = opposite_sides(outer_edges_of(&self.cells), &lowest);
        pairs.into_iter().map(|pair| pair.map(ends)).collect()
    }
}

impl SolidMesh {
    /// Pairs of outline faces at one place with cells on both sides, ascending: the faces of a crack that is in the mesh, or of a seam
    /// between parts that are not joined.
    ///
    /// The corners of both faces are in the same order, counter-clockwise seen from outside of the cell of the first face. At the edge of
    /// the crack they have the same nodes.
    pub fn crack_faces(&self) -> Vec<[Cell; 2]> {
        let Some(lowest) = lowest_at_place(&self.positions) else {
            return Vec::new();
        };
        let sides = outer_faces_of(&self.cells, self.positions.len());
        let pairs = opposite_sides(sides, &lowest).into_iter();
        let faces = pairs.filter_map(|[one, other]| {
            Some([Cell::from_corners(&one)?, Cell::from_corners(&other)?])
        });
        faces.collect()
    }
}

/// Nodes of the edges that belong to one cell alone, with the cell on their left.
pub(crate) fn outer_edges_of(cells: &[Cell]) -> Vec<Vec<u32>> {
    let edges = outer_edges(cells).into_iter();
    edges.map(|edge| edge.to_vec()).collect()
}

/// Corners of the faces that belong to one cell alone, counter-clockwise seen from outside.
pub(crate) fn outer_faces_of(cells: &[SolidCell], n_nodes: usize) -> Vec<Vec<u32>> {
    let sides = Faces::new(cells, n_nodes).outer().into_iter();
    sides.map(|side| side.face.corners().to_vec()).collect()
}

/// Pairs of sides at one place that run around it in opposite directions, with the nodes of the second side in the order of the first one,
/// for the lowest node at the place of each node (n_nodes).
pub(crate) fn opposite_sides(sides: Vec<Vec<u32>>, lowest: &[u32]) -> Vec<[Vec<u32>; 2]> {
    let at = |node: u32| lowest[node as usize];
    let with_key = |side: Vec<u32>| {
        let places: Vec<u32> = side.iter().map(|&node| at(node)).collect();
        let (key, is_reversed) = order_around(&places);
        (key, is_reversed, side)
    };
    let mut keyed: Vec<(Vec<u32>, bool, Vec<u32>)> = sides.into_iter().map(with_key).collect();
    keyed.sort_unstable();
    let mut pairs = Vec::new();
    for at_place in keyed.chunk_by(|a, b| a.0 == b.0) {
        let n_forward = at_place.partition_point(|(_, is_reversed, _)| !is_reversed);
        let (forward, backward) = at_place.split_at(n_forward);
        for ((_, _, one), (_, _, other)) in forward.iter().zip(backward) {
            let [first, second] = if one < other {
                [one, other]
            } else {
                [other, one]
            };
            let over = |node: &u32| second.iter().find(|it| at(**it) == at(*node)).copied();
            let second: Option<Vec<u32>> = first.iter().map(over).collect();
            pairs.extend(second.map(|second| [first.clone(), second]));
        }
    }
    pairs.sort_unstable();
    pairs
}

/// Places around a side from the lowest one on towards the lower of its neighbours, and whether this is against their order.
fn order_around(places: &[u32]) -> (Vec<u32>, bool) {
    let n = places.len();
    let start = (0..n).min_by_key(|&it| places[it]).unwrap_or_default();
    let after = |steps: usize| places[(start + steps) % n];
    let is_reversed = match n {
        2 => start == 1,
        _ => after(n - 1) < after(1),
    };
    let steps = (0..n).map(|step| if is_reversed { n - step } else { step });
    (steps.map(after).collect(), is_reversed)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Two rows of three unit squares: between the rows a crack over the first two of them, which is open at the left, with its tip at node
    /// 6. Nodes 4 and 5 are below it, nodes 8 and 9 above.
    fn cracked() -> Mesh {
        let row = |y: f64, n: usize| (0..n).map(move |x| [x as f64, y]);
        let positions = row(0.0, 4)
            .chain(row(1.0, 4))
            .chain(row(1.0, 2))
            .chain(row(2.0, 4));
        let below = [0, 1, 2].map(|it| Cell::Quadrangle([it, it + 1, it + 5, it + 4]));
        let above = [[8, 9, 11, 10], [9, 6, 12, 11], [6, 7, 13, 12]].map(Cell::Quadrangle);
        Mesh {
            positions: positions.collect(),
            cells: [below, above].concat(),
            ..Mesh::default()
        }
    }

    #[test]
    fn edges_of_a_crack_are_opposite_to_each_other() {
        let mesh = cracked();
        let pairs = mesh.crack_faces();
        // The cells below are on the left of edges from right to left.
        assert_eq!(pairs, [[[5, 4], [9, 8]], [[6, 5], [6, 9]]]);
    }

    /// Merged nodes, a crack that stands open by a thousandth, and cells that touch at one node have no crack.
    #[test]
    fn other_meshes_have_no_crack() {
        let mut open = cracked();
        for node in [8, 9] {
            open.positions[node][1] += 1e-3;
        }
        assert_eq!(open.crack_faces(), Vec::<[[u32; 2]; 2]>::new());
        let mut merged = cracked();
        for cell in &mut merged.cells {
            for node in cell.corners_mut() {
                *node = match *node {
                    8 => 4,
                    9 => 5,
                    other => other,
                };
            }
        }
        // The nodes that no cell has any more are still in the list.
        assert_eq!(merged.crack_faces(), Vec::<[[u32; 2]; 2]>::new());
        let touching = Mesh {
            positions: vec![
                [0.0, 0.0],
                [1.0, 0.0],
                [0.0, 1.0],
                [0.0, 0.0],
                [-1.0, 0.0],
                [0.0, -1.0],
            ],
            cells: vec![Cell::Triangle([0, 1, 2]), Cell::Triangle([3, 4, 5])],
            ..Mesh::default()
        };
        assert_eq!(touching.crack_faces(), Vec::<[[u32; 2]; 2]>::new());
    }

    /// Two cells over each other have their edges on the same side.
    #[test]
    fn a_mesh_over_its_copy_has_no_crack() {
        let corners = [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]];
        let twice = Mesh {
            positions: [corners, corners].concat(),
            cells: vec![Cell::Triangle([0, 1, 2]), Cell::Triangle([3, 4, 5])],
            ..Mesh::default()
        };
        assert_eq!(twice.crack_faces(), Vec::<[[u32; 2]; 2]>::new());
    }

    /// A cross of four squares, each with its own node in the middle: four arms of cracks.
    #[test]
    fn cracks_may_cross() {
        let places = |x: f64, y: f64| [[0.0, 0.0], [x, 0.0], [x, y], [0.0, y]];
        let squares = [(1.0, 1.0), (-1.0, 1.0), (-1.0, -1.0), (1.0, -1.0)];
        let positions: Vec<_> = squares
            .into_iter()
            .flat_map(|(x, y)| places(x, y))
            .collect();
        let cells = (0..4).map(|k| match k % 2 {
            0 => Cell::Quadrangle([4 * k, 4 * k + 1, 4 * k + 2, 4 * k + 3]),
            _ => Cell::Quadrangle([4 * k, 4 * k + 3, 4 * k + 2, 4 * k + 1]),
        });
        let mesh = Mesh {
            cells: cells.collect(),
            positions,
            ..Mesh::default()
        };
        let expected = [
            [[0, 1], [12, 13]],
            [[3, 0], [7, 4]],
            [[5, 4], [9, 8]],
            [[11, 8], [15, 12]],
        ];
        assert_eq!(mesh.crack_faces(), expected);
    }

    /// Two cubes in a row over two others: a crack under the first of the upper cubes, whose tip is the edge of nodes 5 and 6. Node 4 below
    /// is at the place of node 18, node 7 at that of node 19.
    #[test]
    fn faces_of_a_crack_in_space_are_opposite_to_each_other() {
        let mut positions = Vec::new();
        for z in 0..3 {
            for (x, y) in [(0, 0), (1, 0), (1, 1), (0, 1), (2, 0), (2, 1)] {
                positions.push([f64::from(x), f64::from(y), f64::from(z)]);
            }
        }
        positions.extend([positions[6], positions[9]]);
        // Corners of a layer at its first node, in x and y: 0 1 2 3 around the first cube, 1 4 5 2 around the second one.
        let first = [0, 1, 2, 3];
        let second = [1, 4, 5, 2];
        let cube = |base: [u32; 4], layer: u32| {
            let [a, b, c, d] = base.map(|it| it + 6 * layer);
            let [e, f, g, h] = base.map(|it| it + 6 * (layer + 1));
            SolidCell::Hexahedron([a, b, c, d, e, f, g, h])
        };
        let mut upper = cube(first, 1);
        for node in upper.corners_mut() {
            *node = match *node {
                6 => 18,
                9 => 19,
                other => other,
            };
        }
        let cells = vec![cube(first, 0), cube(second, 0), upper, cube(second, 1)];
        let mesh = SolidMesh {
            positions,
            cells,
            ..SolidMesh::default()
        };
        let pairs = mesh.crack_faces();
        assert_eq!(pairs.len(), 1);
        let [below, above] = pairs[0];
        assert_eq!(below.corners(), [6, 7, 8, 9]);
        assert_eq!(above.corners(), [18, 7, 8, 19]);
        let upwards = below.area_vector(&mesh.positions);
        assert_eq!(upwards, [0.0, 0.0, 1.0]);
    }
}
