//! Holes of a lattice in space: pairs of points that see each other only across a hole are no bonds.

use rayon::prelude::*;

use super::shape::SolidShape;
use crate::bonds::BondSet;
use crate::cloud::PointCloud;
use crate::horizon::INCLUSION_TOLERANCE;

/// For each bond, whether it meets the inside of a hole (coordinates of the case) by more than 1e-9 of the nearest distance of its
/// ends, shape (n_bonds). Without this slack rounding would decide about bonds along a surface.
pub fn bonds_across(holes: &[SolidShape], bonds: &BondSet<3>, cloud: &PointCloud<3>) -> Vec<bool> {
    let to_local = cloud.origin.map(|coordinate| -coordinate);
    let holes: Vec<SolidShape> = holes.iter().map(|hole| hole.moved(to_local)).collect();
    (bonds.ends.par_iter())
        .map(|&[a, b]| {
            let [a, b] = [a, b].map(|end| end as usize);
            let slack = INCLUSION_TOLERANCE * cloud.spacing[a].min(cloud.spacing[b]);
            let ends = [cloud.positions[a], cloud.positions[b]];
            let mut holes = holes.iter();
            holes.any(|hole| hole.is_crossed_by(ends[0], ends[1], slack))
        })
        .collect()
}
