//! Bisection of triangles and quadrangles at their newest vertex.

use std::collections::BTreeMap;

use super::marked_cell::{Bisectable, MarkedCell, Unbisectable, longest, shorter};
use super::outline::{Piece, curves};
use crate::cell::{Cell, MeshCell, ascending};
use crate::mesh::Mesh;

/// A planar cell, or the face of a solid one, with its refinement edge: an original triangle is bisected at its longest edge, a child at the
/// edge opposite to its newest vertex. A quadrangle has its shorter diagonal, as if it were two triangles.
#[derive(Debug, Clone, Copy)]
pub struct MarkedFace {
    face: Cell,
    /// Ascending.
    refinement_edge: [u32; 2],
}

impl MarkedFace {
    /// A face of an original mesh with the nodes at `positions`.
    pub(super) fn new<const D: usize>(face: Cell, positions: &[[f64; D]]) -> Self {
        let refinement_edge = match face {
            Cell::Triangle(_) => longest(face.edges(), positions),
            Cell::Quadrangle([a, b, c, d]) => shorter([[a, c], [b, d]].map(ascending), positions),
        };
        Self {
            face,
            refinement_edge,
        }
    }
}

impl MarkedCell for MarkedFace {
    type Cell = Cell;

    fn cell(&self) -> Cell {
        self.face
    }

    fn refinement_edge(&self) -> [u32; 2] {
        self.refinement_edge
    }

    /// Triangles between the middle and all sides but the refinement edge, in the orientation of the face. A quadrangle gives
    /// four triangles, two of each half: the middle of the common diagonal bisects both halves.
    fn children(&self, middle: u32) -> impl Iterator<Item = Self> + use<> {
        let Self {
            face,
            refinement_edge,
        } = *self;
        let n = face.corners().len();
        let sides = (0..n).map(move |place| [place, (place + 1) % n].map(|it| face.corners()[it]));
        let others = sides.filter(move |side| ascending(*side) != refinement_edge);
        others.map(move |[a, b]| Self {
            face: Cell::Triangle([a, b, middle]),
            refinement_edge: ascending([a, b]),
        })
    }
}

impl Bisectable<2> for Cell {
    type Marked = MarkedFace;

    fn marked(mesh: &Mesh) -> Result<Vec<MarkedFace>, Unbisectable> {
        let marked = |cell: &Cell| MarkedFace::new(*cell, &mesh.positions);
        Ok(mesh.cells.iter().map(marked).collect())
    }

    fn curves(mesh: &Mesh) -> BTreeMap<[u32; 2], Piece<2>> {
        curves(mesh)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn cells(faces: impl Iterator<Item = MarkedFace>) -> Vec<(Cell, [u32; 2])> {
        faces.map(|it| (it.face, it.refinement_edge)).collect()
    }

    /// By hand: a right-angled triangle at its hypotenuse, then at its legs.
    #[test]
    fn a_triangle_is_bisected_at_the_longest_edge_and_then_opposite_to_the_newest_vertex() {
        let positions = [[0.0, 0.0], [2.0, 0.0], [0.0, 1.0]];
        let triangle = MarkedFace::new(Cell::Triangle([0, 1, 2]), &positions);
        assert_eq!(triangle.refinement_edge, [1, 2]);
        let children = [
            (Cell::Triangle([0, 1, 3]), [0, 1]),
            (Cell::Triangle([2, 0, 3]), [0, 2]),
        ];
        assert_eq!(cells(triangle.children(3)), children);
        let last = triangle.children(3).last().unwrap();
        let grandchildren = [
            (Cell::Triangle([0, 3, 4]), [0, 3]),
            (Cell::Triangle([3, 2, 4]), [2, 3]),
        ];
        assert_eq!(cells(last.children(4)), grandchildren);
    }

    #[test]
    fn a_quadrangle_becomes_four_triangles_around_the_middle_of_the_shorter_diagonal() {
        let positions = [[0.0, 0.0], [2.0, 0.0], [3.0, 1.0], [1.0, 1.0]];
        let quadrangle = MarkedFace::new(Cell::Quadrangle([2, 3, 0, 1]), &positions);
        assert_eq!(quadrangle.refinement_edge, [1, 3]);
        let sides = [[2, 3], [3, 0], [0, 1], [1, 2]];
        let children = sides.map(|[a, b]| (Cell::Triangle([a, b, 4]), ascending([a, b])));
        assert_eq!(cells(quadrangle.children(4)), children);
    }
}
