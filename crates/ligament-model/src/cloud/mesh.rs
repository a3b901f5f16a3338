//! Lumping: the nodes of a mesh become material points that carry the volume of its cells.

use ligament_mesh::{Cell, Mesh, Numbering, along_hilbert_curve};

use super::{PointCloud, distance, middle_of_bounding_box, precision_of_coordinates, search_tree};
use crate::horizon::INCLUSION_TOLERANCE;

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
            numbering: Numbering::default(),
            portion: None,
            positions,
            precision: precision_of_coordinates(&mesh.positions),
            origin,
            thickness,
            volumes,
            spacing: Vec::new(),
            lattice_cell: None,
            n_materials,
            material_shares,
        };
        cloud.spacing = nearest_neighbour_distances(&cloud, &mesh.cells);
        cloud
    }
}

fn corner_area(cell: &Cell, positions: &[[f64; 2]]) -> f64 {
    cell.area(positions) / cell.corners().len() as f64
}

/// Length of the shortest cell side at each node, shape (n_points), m; infinite at nodes without a cell.
pub(crate) fn shortest_sides(cloud: &PointCloud, cells: &[Cell]) -> Vec<f64> {
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
    reach
}

/// Distance of each point to the nearest other one, m: sought no farther than the end of its shortest cell side.
fn nearest_neighbour_distances(cloud: &PointCloud, cells: &[Cell]) -> Vec<f64> {
    let reach = shortest_sides(cloud, cells);
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
