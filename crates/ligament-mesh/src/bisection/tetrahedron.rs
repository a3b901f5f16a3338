//! Bisection of tetrahedra.

use std::collections::BTreeMap;

use super::marked_cell::{Bisectable, MarkedCell, Unbisectable, longest};
use super::outline::Piece;
use crate::cell::{MeshCell, ascending};
use crate::mesh::{Mesh, SolidMesh};
use crate::solid::SolidCell;

/// A marked tetrahedron (D. N. Arnold, A. Mukherjee and L. Pouly, Locally adapted tetrahedral meshes using bisection, SIAM J. Sci. Comput. 22,
/// 2000): each face has a marked edge, which is the refinement edge if the face has it. All edges are ascending.
///
/// In an original mesh the marked edge is the longest one of the face, and the refinement edge that of the tetrahedron. Cells therefore
/// agree on the marked edges of their common faces.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct MarkedTetrahedron {
    /// Corners in the order of Gmsh.
    corners: [u32; 4],
    refinement_edge: [u32; 2],
    /// Marked edges of the face without the first node of the refinement edge, and of the face without the second.
    marked_edges: [[u32; 2]; 2],
    /// Whether the marked edges of the parent lie in one plane.
    flagged: bool,
}

impl MarkedTetrahedron {
    /// A tetrahedron of an original mesh with the nodes at `positions`.
    fn new(corners: [u32; 4], positions: &[[f64; 3]]) -> Self {
        let edges = || SolidCell::Tetrahedron(corners).edges();
        let refinement_edge = longest(edges(), positions);
        let of_face_without =
            |node| longest(edges().filter(|edge| !edge.contains(&node)), positions);
        Self {
            corners,
            refinement_edge,
            marked_edges: refinement_edge.map(of_face_without),
            flagged: false,
        }
    }

    /// Whether all marked edges lie in one plane: the marked edges of the two faces without the refinement edge meet its ends, and each other.
    fn is_planar(&self) -> bool {
        let other_end = |[p, q]: [u32; 2], end: u32| match end {
            _ if end == p => Some(q),
            _ if end == q => Some(p),
            _ => None,
        };
        let [a, b] = self.refinement_edge;
        let [without_a, without_b] = self.marked_edges;
        let tip = other_end(without_a, b);
        tip.is_some() && tip == other_end(without_b, a)
    }

    /// Child with one end of the refinement edge, whose uncut face has its marked edge as refinement edge.
    ///
    /// The marked edge of a face with the middle is the edge opposite to it. Only the face between the children of a flagged planar
    /// tetrahedron is marked at the edge from the middle to the refinement edges of the children, which they both reach.
    fn child(&self, end: u32, refinement_edge: [u32; 2], middle: u32) -> Self {
        let [a, b] = self.refinement_edge;
        let corners = self.corners.map(|node| match node == a + b - end {
            true => middle,
            false => node,
        });
        let is_third = |node: &u32| *node != middle && !refinement_edge.contains(node);
        let third = corners.into_iter().find(is_third).unwrap_or_default();
        let is_planar = self.is_planar();
        let [p, q] = refinement_edge;
        let of_face_without = |node: u32| {
            let opposite = if is_planar && self.flagged && node == end {
                middle
            } else {
                third
            };
            ascending([p + q - node, opposite])
        };
        Self {
            corners,
            refinement_edge,
            marked_edges: refinement_edge.map(of_face_without),
            flagged: is_planar,
        }
    }
}

impl MarkedCell for MarkedTetrahedron {
    type Cell = SolidCell;

    fn cell(&self) -> SolidCell {
        SolidCell::Tetrahedron(self.corners)
    }

    fn refinement_edge(&self) -> [u32; 2] {
        self.refinement_edge
    }

    fn children(&self, middle: u32) -> impl Iterator<Item = Self> + use<> {
        let [a, b] = self.refinement_edge;
        let [without_a, without_b] = self.marked_edges;
        let ends = [(a, without_b), (b, without_a)];
        ends.map(|(end, edge)| self.child(end, edge, middle))
            .into_iter()
    }
}

impl Bisectable<3> for SolidCell {
    type Marked = MarkedTetrahedron;

    fn marked(mesh: &SolidMesh) -> Result<Vec<MarkedTetrahedron>, Unbisectable> {
        let mut marked = Vec::with_capacity(mesh.cells.len());
        let mut cells = BTreeMap::new();
        for cell in &mesh.cells {
            match *cell {
                SolidCell::Tetrahedron(corners) => {
                    marked.push(MarkedTetrahedron::new(corners, &mesh.positions));
                }
                SolidCell::Hexahedron(_) | SolidCell::Prism(_) | SolidCell::Pyramid(_) => {
                    *cells.entry(cell.shape_name()).or_default() += 1;
                }
            }
        }
        match cells.is_empty() {
            true => Ok(marked),
            false => Err(Unbisectable { cells }),
        }
    }

    fn curves(_: &Mesh<3, Self>) -> BTreeMap<[u32; 2], Piece<3>> {
        BTreeMap::new()
    }
}
