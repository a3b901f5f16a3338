//! Holes of a lattice: no bond crosses a hole.

use super::BondSet;
use crate::cloud::PointCloud;
use crate::parallel;
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
    parallel::values(bonds.len(), false, |bond| {
        let slack = cloud.slack_between(bonds.ends[bond]);
        let [a, b] = bonds.ends[bond].map(|end| cloud.positions[end as usize]);
        holes.iter().any(|hole| hole.is_crossed_by(a, b, slack))
    })
}
