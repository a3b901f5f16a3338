//! Holes of a lattice: no bond crosses a hole.

use rayon::prelude::*;

use super::BondSet;
use crate::cloud::PointCloud;
use crate::shape::Region;

/// Whether each bond enters a hole (coordinates of the case) by more than 1e-5 of the nearest distance of its ends, shape (n_bonds). Without
/// this slack rounding would decide about bonds along a rim.
pub fn bonds_across<const D: usize, S: Region<D>>(
    holes: &[S],
    bonds: &BondSet<D>,
    cloud: &PointCloud<D>,
) -> Vec<bool> {
    let to_local = cloud.origin.map(|coordinate| -coordinate);
    let holes: Vec<S> = holes.iter().map(|hole| hole.moved(to_local)).collect();
    (bonds.ends.par_iter())
        .map(|&[a, b]| {
            let slack = cloud.slack_between([a, b]);
            let ends = [a, b].map(|end| cloud.positions[end as usize]);
            holes
                .iter()
                .any(|hole| hole.is_crossed_by(ends[0], ends[1], slack))
        })
        .collect()
}
