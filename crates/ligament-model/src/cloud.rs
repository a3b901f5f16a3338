//! Lumping: the nodes of a mesh become material points that carry the volume of its cells.

use ligament_mesh::{Cell, Mesh};
use rayon::prelude::*;
use rstar::RTree;
use rstar::primitives::GeomWithData;

use crate::curve::along_hilbert_curve;
use crate::horizon::INCLUSION_TOLERANCE;

/// Material points with their volumes, nearest-neighbour distances and materials.
///
/// Positions are kept relative to the middle of the bounding box: differences of coordinates of a body that lies far
/// from the origin would lose digits. [`PointCloud::local`] takes a position of the mesh file to these coordinates.
#[derive(Debug, Clone)]
pub struct PointCloud {
    /// Positions X_i relative to [`PointCloud::origin`], shape (n_points), m.
    pub positions: Vec<[f64; 2]>,
    /// What was subtracted from the positions of the mesh file, m.
    pub origin: [f64; 2],
    /// Thickness t, m.
    pub thickness: f64,
    /// Volumes V_i, shape (n_points), m^3.
    pub volumes: Vec<f64>,
    /// Distance to the nearest point dmin_i, shape (n_points), m.
    pub spacing: Vec<f64>,
    /// Number of materials.
    pub n_materials: usize,
    /// Share of each material in the volume of each point, shape (n_points, n_materials) row-major; rows sum to one.
    pub material_shares: Vec<f64>,
    /// All points in the order of a Hilbert curve, shape (n_points): for loops that visit the neighbours of points.
    pub curve: Vec<u32>,
}

/// A point of the search tree, with its number.
pub(crate) type NumberedPoint = GeomWithData<[f64; 2], u32>;

impl PointCloud {
    /// Lumps the cells of a mesh: a cell's area times the thickness is shared equally among its corners
    /// (NHPD section 2.1: a third each for a triangle; a quarter each for a quadrangle).
    ///
    /// `material_of_cell` (n_cells) holds the index of each cell's material. A point at an interface takes its share
    /// of volume from the cells of either side.
    pub fn from_mesh(
        mesh: &Mesh,
        thickness: f64,
        material_of_cell: &[u32],
        n_materials: usize,
    ) -> Self {
        let origin = middle_of_bounding_box(&mesh.positions);
        let positions: Vec<[f64; 2]> = mesh
            .positions
            .iter()
            .map(|p| [p[0] - origin[0], p[1] - origin[1]])
            .collect();
        let mut material_volumes = vec![0.0; positions.len() * n_materials];
        for (cell, &material) in mesh.cells.iter().zip(material_of_cell) {
            let corners = cell.corners();
            let volume_of_corner = corner_area(cell, &positions) * thickness;
            for &corner in corners {
                material_volumes[corner as usize * n_materials + material as usize] +=
                    volume_of_corner;
            }
        }
        let volumes: Vec<f64> = material_volumes
            .chunks(n_materials)
            .map(|shares| shares.iter().sum())
            .collect();
        let material_shares = material_volumes
            .iter()
            .enumerate()
            .map(|(k, volume)| volume / volumes[k / n_materials])
            .collect();
        let mut cloud = Self {
            curve: along_hilbert_curve(&positions),
            positions,
            origin,
            thickness,
            volumes,
            spacing: Vec::new(),
            n_materials,
            material_shares,
        };
        cloud.spacing = nearest_neighbour_distances(&cloud, &mesh.cells);
        cloud
    }

    /// Number of points.
    pub fn len(&self) -> usize {
        self.positions.len()
    }

    /// Whether there is no point.
    pub fn is_empty(&self) -> bool {
        self.positions.is_empty()
    }

    /// A value for each point, shape (n_points), computed in parallel along the curve.
    pub(crate) fn over_points<T: Copy + Default + Send>(
        &self,
        value: impl Fn(u32) -> T + Sync,
    ) -> Vec<T> {
        let along_curve: Vec<T> = self.curve.par_iter().map(|&point| value(point)).collect();
        let mut values = vec![T::default(); self.len()];
        for (&point, &value) in self.curve.iter().zip(&along_curve) {
            values[point as usize] = value;
        }
        values
    }

    /// Takes a position of the mesh file to the coordinates of [`PointCloud::positions`].
    pub fn local(&self, position: [f64; 2]) -> [f64; 2] {
        [position[0] - self.origin[0], position[1] - self.origin[1]]
    }

    /// Sides of the rectangle that a point stands for, m: on a mesh those of a square with its area V_i/t.
    pub fn cell_size(&self, point: u32) -> [f64; 2] {
        [(self.volumes[point as usize] / self.thickness).sqrt(); 2]
    }

    /// Shares of the materials in the volume of a point, shape (n_materials).
    pub fn shares(&self, point: usize) -> &[f64] {
        &self.material_shares[point * self.n_materials..(point + 1) * self.n_materials]
    }

    /// Volume-weighted mean of a property of the materials (n_materials) at a point.
    pub fn mean_property(&self, point: usize, property: &[f64]) -> f64 {
        self.shares(point)
            .iter()
            .zip(property)
            .map(|(share, value)| share * value)
            .sum()
    }

    /// Squared radius of gyration r_i of a point about its own middle, m^2: (dx^2 + dy^2)/12 (MPPD before eq. 63, which calls
    /// it the radius) of the square that has the point's volume, so (V_i/t)/6.
    pub fn gyration(&self, point: usize) -> f64 {
        self.volumes[point] / self.thickness / 6.0
    }

    /// The point nearest to a position of the mesh file (the one with the smallest number where several are).
    ///
    /// # Panics
    ///
    /// Panics if there is no point at all, which no mesh with a cell gives.
    pub fn nearest_point(&self, position: [f64; 2]) -> u32 {
        let target = self.local(position);
        let squared_distance =
            |p: &[f64; 2]| (p[0] - target[0]).powi(2) + (p[1] - target[1]).powi(2);
        (0..self.len())
            .min_by(|&i, &j| {
                squared_distance(&self.positions[i])
                    .total_cmp(&squared_distance(&self.positions[j]))
            })
            .expect("a cloud has points") as u32
    }

    /// Points inside the box (mesh-file coordinates, rim included), ascending.
    pub fn points_in_box(&self, lower: [f64; 2], upper: [f64; 2]) -> Vec<u32> {
        let (lower, upper) = (self.local(lower), self.local(upper));
        (0..self.len() as u32)
            .filter(|&point| {
                let p = self.positions[point as usize];
                (0..2).all(|axis| lower[axis] <= p[axis] && p[axis] <= upper[axis])
            })
            .collect()
    }
}

fn corner_area(cell: &Cell, positions: &[[f64; 2]]) -> f64 {
    cell.area(positions) / cell.corners().len() as f64
}

fn middle_of_bounding_box(positions: &[[f64; 2]]) -> [f64; 2] {
    [0, 1].map(|axis| {
        let (lower, upper) = positions
            .iter()
            .fold((f64::INFINITY, f64::NEG_INFINITY), |(lower, upper), p| {
                (lower.min(p[axis]), upper.max(p[axis]))
            });
        if lower <= upper {
            0.5 * (lower + upper)
        } else {
            0.0
        }
    })
}

/// A search tree over the points.
pub(crate) fn search_tree(positions: &[[f64; 2]]) -> RTree<NumberedPoint> {
    RTree::bulk_load(
        positions
            .iter()
            .enumerate()
            .map(|(number, &p)| GeomWithData::new(p, number as u32))
            .collect(),
    )
}

/// Distance of two points, m; the same bits whichever comes first.
pub(crate) fn distance(a: [f64; 2], b: [f64; 2]) -> f64 {
    ((b[0] - a[0]).powi(2) + (b[1] - a[1]).powi(2)).sqrt()
}

/// Distance of each point to the nearest other one, m: sought no farther than the end of its shortest cell side.
fn nearest_neighbour_distances(cloud: &PointCloud, cells: &[Cell]) -> Vec<f64> {
    let mut reach = vec![f64::INFINITY; cloud.len()];
    for cell in cells {
        let corners = cell.corners();
        for (k, &from) in corners.iter().enumerate() {
            let to = corners[(k + 1) % corners.len()];
            let [from, to] = [from, to].map(|corner| corner as usize);
            let side = distance(cloud.positions[from], cloud.positions[to]);
            reach[from] = side.min(reach[from]);
            reach[to] = side.min(reach[to]);
        }
    }
    let tree = search_tree(&cloud.positions);
    cloud.over_points(|point| {
        let position = cloud.positions[point as usize];
        let reach = reach[point as usize] * (1.0 + 2.0 * INCLUSION_TOLERANCE);
        tree.locate_within_distance(position, reach * reach)
            .filter(|neighbour| neighbour.data != point)
            .map(|neighbour| distance(position, *neighbour.geom()))
            .fold(f64::INFINITY, f64::min)
    })
}
