//! Interface of cells that can be bisected, and edges by length.

use std::cmp::Reverse;
use std::collections::BTreeMap;

use thiserror::Error;

use super::outline::Piece;
use crate::cell::MeshCell;
use crate::mesh::Mesh;

/// A kind of cells that can be bisected: planar cells, and solid cells if they are tetrahedra.
pub trait Bisectable<const D: usize>: MeshCell<D> {
    /// A cell with its refinement edge.
    type Marked: MarkedCell<Cell = Self>;

    /// The cells of a mesh with their refinement edges.
    ///
    /// # Errors
    /// Returns an error if the mesh has a cell that cannot be bisected.
    fn marked(mesh: &Mesh<D, Self>) -> Result<Vec<Self::Marked>, Unbisectable>;

    /// Edges of the outline that are taken for pieces of curves.
    fn curves(mesh: &Mesh<D, Self>) -> BTreeMap<[u32; 2], Piece<D>>;
}

/// A cell with its refinement edge, the edge at whose middle it is bisected.
pub trait MarkedCell: Copy + std::fmt::Debug {
    /// The cell without a refinement edge.
    type Cell;

    /// The cell without a refinement edge.
    fn cell(&self) -> Self::Cell;

    /// The refinement edge, from the lower to the higher node.
    fn refinement_edge(&self) -> [u32; 2];

    /// Cells into which the node at the middle of the refinement edge, with the highest number so far, divides the cell.
    fn children(&self, middle: u32) -> impl Iterator<Item = Self> + use<Self>;
}

/// A mesh with cells that cannot be bisected.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[error(
    "of solid cells only tetrahedra can be bisected, but the mesh has {}; mesh the body with tetrahedra",
    .cells.iter().map(|(shape, count)| format!("{count} of the shape \"{shape}\"")).collect::<Vec<_>>().join(" and ")
)]
pub struct Unbisectable {
    /// Name of each shape that cannot be bisected, and the number of its cells.
    pub cells: BTreeMap<&'static str, usize>,
}

/// Number of binary digits of a squared length that are dropped: 40 remain, a relative difference of 1e-12.
const DROPPED_DIGITS: u32 = 12;

/// Squared length of an edge in rounded binary digits, which order lengths as the lengths themselves: lengths that differ by the rounding
/// of their nodes' positions are equal, without which a symmetric mesh would have refinement edges at random.
fn rounded_length<const D: usize>([a, b]: [u32; 2], positions: &[[f64; D]]) -> u64 {
    let [p, q] = [a, b].map(|node| positions[node as usize]);
    let squares = p.iter().zip(&q).map(|(from, to)| (to - from).powi(2));
    (squares.sum::<f64>().to_bits() + (1 << (DROPPED_DIGITS - 1))) >> DROPPED_DIGITS
}

/// Longest of some ascending edges, of equally long ones the edge with the lowest nodes: the first one in an order of all edges of a mesh.
/// Cells with a common face therefore agree on the longest edge of the face.
pub(super) fn longest<const D: usize>(
    edges: impl Iterator<Item = [u32; 2]>,
    positions: &[[f64; D]],
) -> [u32; 2] {
    let longest = edges.max_by_key(|&edge| (rounded_length(edge, positions), Reverse(edge)));
    longest.unwrap_or_default()
}

/// Shorter of two ascending edges, of equally long ones the edge with the lowest node.
pub(super) fn shorter<const D: usize>(edges: [[u32; 2]; 2], positions: &[[f64; D]]) -> [u32; 2] {
    let [one, other] = edges.map(|edge| (rounded_length(edge, positions), edge));
    one.min(other).1
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Sides of a square whose corners are rounded, one side longer by 1e-15, and a side that is longer by 1e-10.
    #[test]
    fn lengths_that_differ_by_rounding_are_equal() {
        let positions = [[0.0, 0.0], [0.3, 0.0], [0.3, 0.1 + 0.2], [-3e-11, 0.3]];
        assert_ne!(positions[1][0], positions[2][1]);
        let longest = |edges: &[[u32; 2]]| longest(edges.iter().copied(), &positions);
        assert_eq!(longest(&[[1, 2], [0, 1]]), [0, 1]);
        assert_eq!(longest(&[[0, 1], [1, 2]]), [0, 1]);
        assert_eq!(longest(&[[0, 1], [1, 2], [2, 3]]), [2, 3]);
        assert_eq!(shorter([[1, 2], [0, 1]], &positions), [0, 1]);
        assert_eq!(shorter([[2, 3], [1, 2]], &positions), [1, 2]);
    }
}
