//! Points that are given one by one, with their volumes.

use ligament_mesh::{Numbering, along_hilbert_curve};

use super::{PointCloud, search_tree};

impl<const D: usize> PointCloud<D> {
    /// The cloud of points at `positions` (n_points, m) with their volumes (n_points, m^3) and the index of the material of each
    /// (n_points).
    pub fn from_points(
        positions: &[[f64; D]],
        volumes: &[f64],
        thickness: f64,
        material_of_point: &[u32],
        n_materials: usize,
    ) -> Self {
        let origin = super::middle_of_bounding_box(positions);
        let precision = super::precision_of_coordinates(positions);
        let positions: Vec<[f64; D]> = (positions.iter())
            .map(|p| std::array::from_fn(|axis| p[axis] - origin[axis]))
            .collect();
        let mut material_shares = vec![0.0; positions.len() * n_materials];
        for (point, &material) in material_of_point.iter().enumerate() {
            material_shares[point * n_materials + material as usize] = 1.0;
        }
        let mut cloud = Self {
            curve: along_hilbert_curve(&positions),
            positions,
            precision,
            origin,
            thickness,
            volumes: volumes.to_vec(),
            spacing: Vec::new(),
            lattice_cell: None,
            n_materials,
            material_shares,
            numbering: Numbering::default(),
            portion: None,
        };
        let tree = search_tree(&cloud.positions);
        cloud.spacing = cloud.over_points(|point| {
            let position = cloud.positions[point as usize];
            (tree.nearest_neighbor_iter_with_distance_2(position))
                .find(|(neighbour, _)| neighbour.data != point)
                .map_or(f64::INFINITY, |(neighbour, _)| {
                    super::distance(position, *neighbour.geom())
                })
        });
        cloud
    }
}
