//! Cells of a body that are cut into pieces along its cracks.

use std::collections::HashMap;

/// Whole cells, and pieces of the cells that a crack cuts, which move apart.
#[derive(Debug, Clone, PartialEq)]
pub struct OpenedCells<C> {
    /// Points whose mean displacement each corner of the cells has, shape (n_corners).
    pub follows: Vec<Vec<u32>>,
    /// Positions of the corners, shape (n_corners), m; z = 0 in the plane.
    pub positions: Vec<[f64; 3]>,
    /// Cells between the corners.
    pub cells: Vec<C>,
    /// Cell of the mesh that contains each cell or piece, shape (n_cells).
    pub of: Vec<u32>,
}

/// Corners of pieces by number: the key has the points between which a corner lies, and the subset of these points on its side.
pub(crate) type PieceCorners = HashMap<(Vec<u32>, Vec<u32>), u32>;

impl<C> OpenedCells<C> {
    /// Opened cells without any cell, with a corner at each point (n_points, m).
    pub(crate) fn at_points(positions: Vec<[f64; 3]>) -> Self {
        let points = 0..positions.len() as u32;
        Self {
            follows: points.map(|point| vec![point]).collect(),
            positions,
            cells: Vec::new(),
            of: Vec::new(),
        }
    }

    /// The corner in the middle of some points that follows `own` of them, both ascending: an existing one, or else a new one.
    pub(crate) fn corner(
        &mut self,
        between: Vec<u32>,
        own: Vec<u32>,
        found: &mut PieceCorners,
    ) -> u32 {
        if let &[point] = between.as_slice() {
            return point;
        }
        *found
            .entry((between, own))
            .or_insert_with_key(|(between, own)| {
                let mean = |axis: usize| {
                    let all = between.iter().map(|it| self.positions[*it as usize][axis]);
                    all.sum::<f64>() / between.len() as f64
                };
                let middle = [0, 1, 2].map(mean);
                self.positions.push(middle);
                self.follows.push(own.clone());
                self.positions.len() as u32 - 1
            })
    }

    /// Mean over the points that each corner follows, shape (n_corners), of a value of the points.
    pub fn means(&self, value: impl Fn(usize) -> f64) -> Vec<f64> {
        let mean = |points: &Vec<u32>| {
            let sum: f64 = points.iter().map(|it| value(*it as usize)).sum();
            sum / points.len() as f64
        };
        self.follows.iter().map(mean).collect()
    }
}
