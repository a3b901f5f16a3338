//! Geometry of a body for the output of its fields.

use std::sync::Arc;

use ligament_mesh::{Cell, Numbering, SolidCell};

/// A body with its points, their tags and the cells or boxes of its fields.
#[derive(Debug, Clone, PartialEq)]
pub struct BodyGrid {
    /// Positions of the points, shape (n_points), m; in the plane z = 0.
    pub positions: Vec<[f64; 3]>,
    /// Numbering of the points, internal and in the file.
    pub numbering: Numbering,
    /// Tags of the points: of the nodes in a mesh file, or of the cells of a lattice, shape (n_points).
    pub tags: Vec<i64>,
    /// Numbers in the file of the cells between the points of a part of a body, shape (n_cells); empty for a whole body.
    pub cell_numbers: Vec<u32>,
    /// Kind of a tag: `node`, `cell` or `point`.
    pub tagged: &'static str,
    /// Cells or boxes for the fields of the points.
    pub canvas: Canvas,
    /// Tags of all points of the body, where the grid has a part of it.
    pub of_body: Option<PointTags>,
}

/// Numbering and tags of the points of a whole body.
#[derive(Debug, Clone, PartialEq)]
pub struct PointTags {
    /// Numbering of the points, internal and in the file.
    pub numbering: Numbering,
    /// Tags of the points.
    pub tags: Tags,
}

/// Tags of points.
#[derive(Debug, Clone, PartialEq)]
pub enum Tags {
    /// A tag for each point, shape (n_points).
    Listed(Arc<[u64]>),
    /// The number in the file, counted from this first tag.
    Counted(u64),
}

impl PointTags {
    /// Tags of the ends of a bond, the tag of the smaller number in the file first.
    fn of_ends(&self, ends: [u32; 2]) -> [i64; 2] {
        let tag = |point: u32| match &self.tags {
            Tags::Listed(tags) => tags[point as usize],
            Tags::Counted(first) => first + u64::from(self.numbering.in_file(point)),
        };
        self.numbering.ordered(ends).map(|end| tag(end) as i64)
    }
}

/// Cells or boxes for the fields of the points.
#[derive(Debug, Clone, PartialEq)]
pub enum Canvas {
    /// Cells between the points, whose fields are point data.
    Between(Vec<Cell>),
    /// A cell for each point, whose fields are cell data. Its corners (n_points, counter-clockwise, m) belong to no other cell: they move
    /// with the point, and cracks open.
    Around(Vec<[[f64; 2]; 4]>),
    /// Solid cells between the points, whose fields are point data.
    Solid(Vec<SolidCell>),
    /// A box for each point, whose fields are cell data: its lowest and its highest corner (n_points, m). It moves with the point, and
    /// cracks open.
    Boxes(Vec<[[f64; 3]; 2]>),
}

impl BodyGrid {
    /// The body with its points in the order of the file.
    pub fn in_order_of_file(&self) -> Self {
        let numbering = &self.numbering;
        let canvas = match self.canvas.clone() {
            Canvas::Between(cells) => Canvas::Between(numbering.cells_in_file(cells)),
            Canvas::Around(corners) => Canvas::Around(numbering.to_file(corners)),
            Canvas::Solid(cells) => Canvas::Solid(numbering.cells_in_file(cells)),
            Canvas::Boxes(boxes) => Canvas::Boxes(numbering.to_file(boxes)),
        };
        Self {
            positions: numbering.to_file(self.positions.clone()),
            numbering: Numbering::default(),
            cell_numbers: self.cell_numbers.clone(),
            tags: numbering.to_file(self.tags.clone()),
            tagged: self.tagged,
            canvas,
            of_body: self.of_body.clone(),
        }
    }

    /// Tags of the ends of a bond, given by their numbers in the body, the tag of the smaller number in the file first.
    pub fn tags_of(&self, ends: [u32; 2]) -> [i64; 2] {
        match &self.of_body {
            Some(tags) => tags.of_ends(ends),
            None => {
                let ends = self.numbering.ordered(ends);
                ends.map(|end| self.tags[end as usize])
            }
        }
    }

    /// Positions of the points along x and y, shape (n_points), m.
    pub fn positions_in_plane(&self) -> Vec<[f64; 2]> {
        self.positions.iter().map(|&[x, y, _]| [x, y]).collect()
    }
}

impl Canvas {
    /// Whether the body lies in space.
    pub fn is_solid(&self) -> bool {
        matches!(self, Self::Solid(_) | Self::Boxes(_))
    }
}

/// Positions in the plane as positions in space with z = 0.
pub fn raised<const D: usize>(positions: &[[f64; D]]) -> Vec<[f64; 3]> {
    positions.iter().copied().map(in_space).collect()
}

/// A position or a vector in the plane as one in space with z = 0.
pub fn in_space<const D: usize>(position: [f64; D]) -> [f64; 3] {
    std::array::from_fn(|axis| position.get(axis).copied().unwrap_or(0.0))
}

/// Corners of a box between its lowest and its highest corner, in the order of a hexahedron.
pub fn box_corners([low, high]: [[f64; 3]; 2]) -> [[f64; 3]; 8] {
    let [low_z, high_z] = [low[2], high[2]].map(|z| {
        [
            [low[0], low[1], z],
            [high[0], low[1], z],
            [high[0], high[1], z],
            [low[0], high[1], z],
        ]
    });
    [
        low_z[0], low_z[1], low_z[2], low_z[3], high_z[0], high_z[1], high_z[2], high_z[3],
    ]
}
