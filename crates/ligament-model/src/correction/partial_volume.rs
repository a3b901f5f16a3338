//! The partial-volume factor: of a cell that the horizon cuts only a part belongs to the family.

use rayon::prelude::*;

use crate::bonds::BondSet;
use crate::cloud::PointCloud;

/// Factors alpha (n_bonds), MPPD eq. 9 (printed with the opposite sign of the length):
///
/// alpha = 1 for l <= H - dx/2, (H + dx/2 - l)/dx for H - dx/2 < l <= H, with the bond horizon H;
///
/// 1/2 where the centre of the cell lies on the horizon. On a mesh dx is the mean over both ends of the side of a square with
/// the point's area.
pub fn partial_volume_factors(bonds: &BondSet, cloud: &PointCloud) -> Vec<f64> {
    let side = |point: u32| {
        let [dx, dy] = cloud.cell_size(point);
        0.5 * (dx + dy)
    };
    (&bonds.ends, &bonds.length, &bonds.horizon)
        .into_par_iter()
        .map(|(&[a, b], length, horizon)| {
            let dx = 0.5 * (side(a) + side(b));
            ((horizon + 0.5 * dx - length) / dx).min(1.0)
        })
        .collect()
}
