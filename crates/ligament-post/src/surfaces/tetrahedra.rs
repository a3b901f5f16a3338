//! Tetrahedra between the points of a solid.

/// Tetrahedra whose corners are nodes, and the points of the nodes.
///
/// In a mesh a node is a point. On a lattice a point at the outside has additional nodes, on the faces of its box, so that surfaces reach
/// the outside of the body.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Tetrahedra {
    /// Positions of the nodes, shape (n_nodes), m.
    pub nodes: Vec<[f64; 3]>,
    /// Point that each node belongs to, shape (n_nodes).
    pub points: Vec<u32>,
    /// Corners of the tetrahedra, shape (n_tetrahedra).
    pub corners: Vec<[u32; 4]>,
    /// Cell of a mesh, or corner of boxes, that contains each tetrahedron, shape (n_tetrahedra), ascending.
    pub cells: Vec<u32>,
    /// Whether each point has further tetrahedra, without a cut edge, that the list leaves out, shape (n_points).
    pub(super) held: Vec<bool>,
}

/// Ends of the edges, as indices of the corners of a tetrahedron.
pub(super) const EDGES: [[usize; 2]; 6] = [[0, 1], [0, 2], [0, 3], [1, 2], [1, 3], [2, 3]];

impl Tetrahedra {
    /// The tetrahedra with an edge between two points that satisfies a condition, with the same nodes.
    pub fn with_edges(&self, is_selected: impl Fn([u32; 2]) -> bool) -> Self {
        let mut held = self.held.clone();
        let mut chosen = Self {
            nodes: self.nodes.clone(),
            points: self.points.clone(),
            ..Self::default()
        };
        for (corners, cell) in self.corners.iter().zip(&self.cells) {
            if EDGES
                .iter()
                .any(|ends| is_selected(self.pair(corners, *ends)))
            {
                chosen.corners.push(*corners);
                chosen.cells.push(*cell);
            } else {
                corners
                    .iter()
                    .for_each(|node| held[self.points[*node as usize] as usize] = true);
            }
        }
        chosen.held = held;
        chosen
    }

    /// Points at the ends of an edge of a tetrahedron, the lower one first.
    pub(super) fn pair(&self, corners: &[u32; 4], ends: [usize; 2]) -> [u32; 2] {
        let [a, b] = ends.map(|end| self.points[corners[end] as usize]);
        [a.min(b), a.max(b)]
    }
}
