//! Partial-volume factor alpha: only part of a cell that the horizon cuts belongs to the family.

use crate::bonds::BondSet;
use crate::cloud::PointCloud;
use crate::parallel;

/// Factors alpha (n_bonds), MPPD eq. 9 (printed with the opposite sign of the length):
///
/// alpha = 1 for l <= H - dx/2, (H + dx/2 - l)/dx for H - dx/2 < l <= H, with the bond horizon H;
///
/// Alpha is 1/2 where the centre of the cell lies on the horizon. On a mesh dx is the mean over both ends of the side of a square with the
/// point's area, in space of a cube with its volume; on a lattice it is the mean side of a cell.
pub fn partial_volume_factors<const D: usize>(
    bonds: &BondSet<D>,
    cloud: &PointCloud<D>,
) -> Vec<f64> {
    let side = |point: u32| match cloud.lattice_cell {
        Some(sides) => sides.iter().sum::<f64>() / D as f64,
        None => {
            let size = cloud.volumes[point as usize] / cloud.thickness;
            if D == 2 { size.sqrt() } else { size.cbrt() }
        }
    };
    parallel::values(bonds.len(), 0.0, |bond| {
        let [a, b] = bonds.ends[bond];
        let dx = 0.5 * (side(a) + side(b));
        ((bonds.horizon[bond] + 0.5 * dx - bonds.length[bond]) / dx).min(1.0)
    })
}
