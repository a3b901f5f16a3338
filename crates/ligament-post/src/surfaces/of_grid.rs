//! Tetrahedra of a body.

use ligament_model::{BodyGrid, Canvas};

use super::lattice;
use super::tetrahedra::Tetrahedra;

impl Tetrahedra {
    /// The tetrahedra of a body; none in the plane, or for boxes that do not fit together.
    pub fn new(grid: &BodyGrid) -> Self {
        match &grid.canvas {
            Canvas::Solid(cells) => {
                let numbered = (0..).zip(cells);
                let all = numbered.flat_map(|(cell, it)| it.tetrahedra().map(move |of| (of, cell)));
                let (corners, cells) = all.unzip();
                Self {
                    nodes: grid.positions.clone(),
                    points: (0..grid.positions.len() as u32).collect(),
                    corners,
                    cells,
                    held: vec![false; grid.positions.len()],
                }
            }
            Canvas::Boxes(boxes) => lattice::between_boxes(boxes),
            Canvas::Between(_) | Canvas::Around(_) => Self::default(),
        }
    }
}
