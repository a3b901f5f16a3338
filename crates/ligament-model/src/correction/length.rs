//! Length factor alpha: short bonds count more than long ones.

use crate::bonds::BondSet;
use crate::cloud::PointCloud;
use crate::parallel;

/// Length factors alpha (n_bonds), NHPD eq. 7:
///
/// alpha = 1/2 [exp((l_minA - l)/(l_maxA - l_minA)) + exp((l_minB - l)/(l_maxB - l_minB))]
///
/// with the shortest and longest bond of either end. An end whose bonds all have one length contributes exp(0) = 1.
pub fn length_factors<const D: usize>(bonds: &BondSet<D>, cloud: &PointCloud<D>) -> Vec<f64> {
    let ranges = cloud.over_families(|point| {
        let family = bonds.incidence.at(point).iter();
        let lengths = family.map(|&bond| bonds.length[bond as usize]);
        lengths.fold([f64::INFINITY, 0.0], |[shortest, longest], l: f64| {
            [l.min(shortest), l.max(longest)]
        })
    });
    let contribution = |point: u32, length: f64| {
        let [shortest, longest] = ranges[point as usize];
        if longest > shortest {
            ((shortest - length) / (longest - shortest)).exp()
        } else {
            1.0
        }
    };
    parallel::values(bonds.len(), 0.0, |bond| {
        let ([a, b], length) = (bonds.ends[bond], bonds.length[bond]);
        0.5 * (contribution(a, length) + contribution(b, length))
    })
}
