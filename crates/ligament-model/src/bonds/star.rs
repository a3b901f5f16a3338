//! Bonds of one length from one point in many directions, for the dependence of a law on the direction alone.

use super::{BondSet, Composition, Incidence};
use crate::cloud::PointCloud;

/// A point with bonds of one length (m) and one horizon (m) at given angles (n_bonds, rad), and the points at their other ends, each of
/// volume 1 and of one of `n_materials` materials.
pub fn star(
    angles: &[f64],
    [length, horizon]: [f64; 2],
    thickness: f64,
    (material, n_materials): (usize, usize),
) -> (PointCloud, BondSet) {
    let directions: Vec<[f64; 2]> = angles.iter().map(|it| [it.cos(), it.sin()]).collect();
    let others = directions.iter().map(|it| it.map(|part| length * part));
    let positions: Vec<[f64; 2]> = std::iter::once([0.0; 2]).chain(others).collect();
    let materials = vec![material as u32; positions.len()];
    let volumes = vec![1.0; positions.len()];
    let cloud = PointCloud::from_points(&positions, &volumes, thickness, &materials, n_materials);
    let ends: Vec<[u32; 2]> = (0..angles.len() as u32).map(|it| [0, it + 1]).collect();
    let bonds = BondSet {
        incidence: Incidence::new(&ends, positions.len()).into(),
        ends: ends.into(),
        length: vec![length; angles.len()],
        direction: directions,
        horizon: vec![horizon; angles.len()].into(),
        composition: Composition::default(),
    };
    (cloud, bonds)
}
