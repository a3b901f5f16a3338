//! Search of the pairs of points that are bonded.

use rayon::prelude::*;

use super::{BondSet, Incidence};
use crate::cloud::{PointCloud, distance, search_tree};
use crate::horizon::{Horizons, INCLUSION_TOLERANCE};

impl BondSet {
    /// Bonds every pair with l <= max(h_A, h_B), found with an R*-tree: one query a point, O(N log N) in all.
    ///
    /// The bond horizon (NHPD eq. 1) is the mean of the two where each point holds the other, and the larger one where
    /// only that one holds the other point.
    pub fn search(cloud: &PointCloud, horizons: &Horizons) -> Self {
        let tree = search_tree(&cloud.positions);
        let pairs_of_points: Vec<Vec<[u32; 2]>> = (0..cloud.len() as u32)
            .into_par_iter()
            .map(|point| {
                let position = cloud.positions[point as usize];
                // The tree compares squared distances: ask for a little more and let `contains` decide.
                let reach = horizons.radius[point as usize] * (1.0 + 2.0 * INCLUSION_TOLERANCE);
                tree.locate_within_distance(position, reach * reach)
                    .map(|neighbour| neighbour.data)
                    .filter(|&neighbour| is_recorded_by(point, neighbour, cloud, horizons))
                    .map(|neighbour| [point.min(neighbour), point.max(neighbour)])
                    .collect()
            })
            .collect();
        let mut ends = pairs_of_points.concat();
        ends.par_sort_unstable();
        Self::from_ends(ends, cloud, horizons)
    }

    /// Bonds the given pairs (A < B, ascending, each once) whatever their distance.
    fn from_ends(ends: Vec<[u32; 2]>, cloud: &PointCloud, horizons: &Horizons) -> Self {
        let position = |point: u32| cloud.positions[point as usize];
        let length: Vec<f64> = ends
            .par_iter()
            .map(|&[a, b]| distance(position(a), position(b)))
            .collect();
        let direction = ends
            .par_iter()
            .zip(&length)
            .map(|(&[a, b], l)| {
                [
                    (position(b)[0] - position(a)[0]) / l,
                    (position(b)[1] - position(a)[1]) / l,
                ]
            })
            .collect();
        let horizon = ends
            .par_iter()
            .zip(&length)
            .map(|(&pair, &l)| bond_horizon(pair, l, horizons))
            .collect();
        let incidence = Incidence::new(&ends, cloud.len());
        Self {
            ends,
            length,
            direction,
            horizon,
            incidence,
        }
    }
}

/// Whether the query around `point` is the one that records the pair: the lower point does where its horizon holds the
/// other, else the upper one.
fn is_recorded_by(point: u32, neighbour: u32, cloud: &PointCloud, horizons: &Horizons) -> bool {
    let l = distance(
        cloud.positions[point as usize],
        cloud.positions[neighbour as usize],
    );
    neighbour != point
        && horizons.contains(point, l)
        && (point < neighbour || !horizons.contains(neighbour, l))
}

fn bond_horizon([a, b]: [u32; 2], length: f64, horizons: &Horizons) -> f64 {
    let (h_a, h_b) = (horizons.radius[a as usize], horizons.radius[b as usize]);
    if horizons.contains(a, length) && horizons.contains(b, length) {
        0.5 * (h_a + h_b)
    } else {
        h_a.max(h_b)
    }
}
