//! Convex parts of a body, each of one material: cells of a mesh or of a lattice.

use ligament_mesh::{Cell, SolidCell};

use crate::cloud::PointCloud;
use crate::geometry::bounding_box;
use crate::tensor::{cross, dot, minus, norm};

/// A side of a convex part: a point on it and its outward unit normal.
#[derive(Debug, Clone, Copy)]
pub struct Side<const D: usize> {
    point: [f64; D],
    normal: [f64; D],
}

impl<const D: usize> Side<D> {
    /// The side through a point with an outward normal of any length.
    fn new(point: [f64; D], normal: [f64; D]) -> Self {
        Self {
            point,
            normal: normal.map(|it| it / norm(normal)),
        }
    }

    /// Height of a position over the side, m; negative inside.
    pub(super) fn height(&self, position: [f64; D]) -> f64 {
        dot(minus(position, self.point), self.normal)
    }
}

/// Convex parts of a body that touch at their sides.
pub trait Parts<const D: usize>: Sync {
    /// Number of parts.
    fn len(&self) -> usize;

    /// Whether the body has no part.
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
        corner_box(self.cells[part].corners(), self.cloud)
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

/// Tetrahedra of solid cells, with their materials.
#[derive(Debug, Clone)]
pub struct Tetrahedra<'a> {
    cloud: &'a PointCloud<3>,
    corners: Vec<[u32; 4]>,
    materials: Vec<u32>,
}

impl<'a> Tetrahedra<'a> {
    /// The tetrahedra of cells between the points of a cloud at their nodes, with the index of the material of each cell (n_cells).
    pub fn new(cells: &[SolidCell], cloud: &'a PointCloud<3>, material_of_cell: &[u32]) -> Self {
        let of_cells = cells.iter().zip(material_of_cell);
        let (corners, materials) = of_cells
            .flat_map(|(cell, &material)| cell.tetrahedra().map(move |it| (it, material)))
            .unzip();
        Self {
            cloud,
            corners,
            materials,
        }
    }
}

impl Parts<3> for Tetrahedra<'_> {
    fn len(&self) -> usize {
        self.corners.len()
    }

    fn material(&self, part: usize) -> u32 {
        self.materials[part]
    }

    fn bounds(&self, part: usize) -> [[f64; 3]; 2] {
        corner_box(&self.corners[part], self.cloud)
    }

    fn sides(&self, part: usize) -> Vec<Side<3>> {
        let places = self.corners[part].map(|node| self.cloud.positions[node as usize]);
        let opposite_to = |k: usize| {
            let [p, q, r] = [1, 2, 3].map(|step| places[(k + step) % 4]);
            let normal = cross(minus(q, p), minus(r, p));
            let is_outward = dot(normal, minus(places[k], p)) < 0.0;
            Side::new(p, normal.map(|it| if is_outward { it } else { -it }))
        };
        (0..4).map(opposite_to).collect()
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
fn corner_box<const D: usize>(nodes: &[u32], cloud: &PointCloud<D>) -> [[f64; D]; 2] {
    bounding_box(nodes.iter().map(|&node| cloud.positions[node as usize]))
}
