//! Convex parts of a body, each of one material: cells of a mesh or of a lattice.

use ligament_mesh::Cell;

use crate::cloud::PointCloud;

/// A side of a convex part: a point on it and its outward normal, of length one.
#[derive(Debug, Clone, Copy)]
pub struct Side<const D: usize> {
    point: [f64; D],
    normal: [f64; D],
}

impl<const D: usize> Side<D> {
    /// The side through a point with an outward normal of any length.
    pub(crate) fn new(point: [f64; D], normal: [f64; D]) -> Self {
        let length = normal.iter().map(|it| it * it).sum::<f64>().sqrt();
        Self {
            point,
            normal: normal.map(|it| it / length),
        }
    }

    /// Height of a position over the side, m; negative inside.
    pub(super) fn height(&self, position: [f64; D]) -> f64 {
        let along = |axis: usize| (position[axis] - self.point[axis]) * self.normal[axis];
        (0..D).map(along).sum()
    }
}

/// Convex parts of a body that touch at their sides.
pub trait Parts<const D: usize>: Sync {
    /// Number of parts.
    fn len(&self) -> usize;

    /// Whether there is none.
    fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// Number of the material of a part.
    fn material(&self, part: usize) -> u32;

    /// Lower and upper corner of the box around a part, m.
    fn bounds(&self, part: usize) -> [[f64; D]; 2];

    /// Sides of a part.
    fn sides(&self, part: usize) -> Vec<Side<D>>;
}

/// Cells of a mesh in the plane, with the index of the material of each (n_cells).
#[derive(Debug, Clone, Copy)]
pub struct PlaneCells<'a> {
    /// Cells, counter-clockwise.
    pub cells: &'a [Cell],
    /// Points at their nodes.
    pub cloud: &'a PointCloud,
    /// Index of the material of each cell (n_cells).
    pub materials: &'a [u32],
}

impl Parts<2> for PlaneCells<'_> {
    fn len(&self) -> usize {
        self.cells.len()
    }

    fn material(&self, part: usize) -> u32 {
        self.materials[part]
    }

    fn bounds(&self, part: usize) -> [[f64; 2]; 2] {
        bounds(self.cells[part].corners(), &self.cloud.positions)
    }

    fn sides(&self, part: usize) -> Vec<Side<2>> {
        let corners = self.cells[part].corners();
        let next = corners.iter().cycle().skip(1);
        let edges = corners.iter().zip(next).map(|(&p, &q)| {
            let [[x0, y0], [x1, y1]] = [p, q].map(|node| self.cloud.positions[node as usize]);
            Side::new([x0, y0], [y1 - y0, x0 - x1])
        });
        edges.collect()
    }
}

/// Cells of a lattice around the points of a cloud, with the index of the material of each (n_points).
#[derive(Debug, Clone, Copy)]
pub struct LatticeCells<'a, const D: usize> {
    /// Points at the centres of the cells.
    pub cloud: &'a PointCloud<D>,
    /// Sides of a cell, m.
    pub size: [f64; D],
    /// Index of the material of each cell (n_points).
    pub materials: &'a [u32],
}

impl<const D: usize> Parts<D> for LatticeCells<'_, D> {
    fn len(&self) -> usize {
        self.cloud.len()
    }

    fn material(&self, part: usize) -> u32 {
        self.materials[part]
    }

    fn bounds(&self, part: usize) -> [[f64; D]; 2] {
        let centre = self.cloud.positions[part];
        [-0.5, 0.5].map(|half| std::array::from_fn(|axis| centre[axis] + half * self.size[axis]))
    }

    fn sides(&self, part: usize) -> Vec<Side<D>> {
        let [lower, upper] = self.bounds(part);
        let across =
            |axis: usize, sign: f64| std::array::from_fn(|it| if it == axis { sign } else { 0.0 });
        let of_axis = |axis: usize| {
            [
                Side::new(lower, across(axis, -1.0)),
                Side::new(upper, across(axis, 1.0)),
            ]
        };
        (0..D).flat_map(of_axis).collect()
    }
}

/// Lower and upper corner of the box around some nodes, m.
pub(crate) fn bounds<const D: usize>(nodes: &[u32], positions: &[[f64; D]]) -> [[f64; D]; 2] {
    let (mut lower, mut upper) = ([f64::INFINITY; D], [f64::NEG_INFINITY; D]);
    for &node in nodes {
        for (axis, x) in positions[node as usize].into_iter().enumerate() {
            lower[axis] = lower[axis].min(x);
            upper[axis] = upper[axis].max(x);
        }
    }
    [lower, upper]
}
