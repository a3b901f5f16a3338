//! Tetrahedra of solid cells as the convex parts of a body.

use ligament_mesh::SolidCell;

use crate::bonds::parts::{Parts, Side, bounds};
use crate::cloud::PointCloud;
use crate::tensor::{cross, dot, minus};

/// The tetrahedra that solid cells consist of, with their materials.
#[derive(Debug, Clone)]
pub struct Tetrahedra<'a> {
    cloud: &'a PointCloud<3>,
    corners: Vec<[u32; 4]>,
    materials: Vec<u32>,
}

impl<'a> Tetrahedra<'a> {
    /// The tetrahedra of cells with the index of the material of each (n_cells), between the points of a cloud at their nodes.
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
        bounds(&self.corners[part], &self.cloud.positions)
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
