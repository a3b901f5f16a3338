//! Clouds of points that are given one by one, with their volumes.

use std::sync::Arc;

use ligament_mesh::{Numbering, along_hilbert_curve};

use super::precision::precision_of_coordinates;
use super::{PointCloud, distance, search_tree};
use crate::geometry::bounding_box;
use crate::subdomain::Subdomain;
use crate::tensor::minus;

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
        let mut cloud = Self {
            volumes: volumes.into(),
            material_shares: whole_shares(material_of_point, n_materials),
            ..Self::at(positions, thickness, n_materials)
        };
        let tree = search_tree(&cloud.positions);
        let spacing = cloud.over_points(|point| {
            let position = cloud.positions[point as usize];
            (tree.nearest_neighbor_iter_with_distance_2(position))
                .find(|(neighbour, _)| neighbour.data != point)
                .map_or(f64::INFINITY, |(neighbour, _)| {
                    distance(position, *neighbour.geom())
                })
        });
        cloud.spacing = spacing.into();
        cloud
    }

    /// Points at `positions` (n_points, m) of the case, not yet with volumes, materials and spacing.
    pub fn at(positions: &[[f64; D]], thickness: f64, n_materials: usize) -> Self {
        let [lower, upper] = bounding_box(positions.iter().copied());
        let origin = std::array::from_fn(|axis| match lower[axis] <= upper[axis] {
            true => 0.5 * (lower[axis] + upper[axis]),
            false => 0.0,
        });
        let precision = precision_of_coordinates(positions);
        let positions: Vec<[f64; D]> = positions.iter().map(|p| minus(*p, origin)).collect();
        Self {
            subdomain: Subdomain::whole(positions.len()),
            curve: along_hilbert_curve(&positions),
            positions,
            precision,
            origin,
            thickness,
            volumes: Arc::default(),
            spacing: Arc::default(),
            lattice_cell: None,
            n_materials,
            material_shares: Vec::new(),
            numbering: Numbering::default(),
        }
    }
}

/// Fractions of the materials in the volumes of points (n_points, n_materials) of one material each, given by its index (n_points).
pub(super) fn whole_shares(material_of_point: &[u32], n_materials: usize) -> Vec<f64> {
    let mut shares = vec![0.0; material_of_point.len() * n_materials];
    for (point, &material) in material_of_point.iter().enumerate() {
        shares[point * n_materials + material as usize] = 1.0;
    }
    shares
}
