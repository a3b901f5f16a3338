//! The body as fields of its points are drawn on it.

use ligament_mesh::Cell;

/// A body with its points, their tags and what their fields are drawn on.
#[derive(Debug, Clone, PartialEq)]
pub struct BodyGrid {
    /// Positions of the points, shape (n_points), m.
    pub positions: Vec<[f64; 2]>,
    /// Tags that points go by: of the nodes in a mesh file, of the cells of a lattice, shape (n_points).
    pub tags: Vec<i64>,
    /// What a tag is one of: `node`, `cell` or `point`.
    pub tagged: &'static str,
    /// What the fields of the points are drawn on.
    pub canvas: Canvas,
}

/// What the fields of the points are drawn on.
#[derive(Debug, Clone, PartialEq)]
pub enum Canvas {
    /// Cells between the points, whose fields are point data.
    Between(Vec<Cell>),
    /// A cell of its own for each point, whose fields are cell data. Its corners (n_points, counter-clockwise, m) belong to
    /// no other cell: they move with the point, and cracks open.
    Around(Vec<[[f64; 2]; 4]>),
}
