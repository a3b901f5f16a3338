//! The partial-volume factor in space: of a cell that the horizon cuts only a part belongs to the family.

use rayon::prelude::*;

use crate::bonds::BondSet;
use crate::cloud::PointCloud;

/// Factors alpha (n_bonds): 1 for l <= H - dx/2, (H + dx/2 - l)/dx for H - dx/2 < l <= H, with the bond horizon H, as in the
/// [plane](crate::correction::partial_volume).
///
/// On a mesh dx is the mean over both ends of the side of a cube with the point's volume, on a lattice that of its cell.
pub fn partial_volume_factors(bonds: &BondSet<3>, cloud: &PointCloud<3>) -> Vec<f64> {
    let side = |point: u32| match cloud.lattice_cell {
        Some(sides) => sides.iter().sum::<f64>() / 3.0,
        None => cloud.volumes[point as usize].cbrt(),
    };
    (&bonds.ends, &bonds.length, &bonds.horizon)
        .into_par_iter()
        .map(|(&[a, b], length, horizon)| {
            let dx = 0.5 * (side(a) + side(b));
            ((horizon + 0.5 * dx - length) / dx).min(1.0)
        })
        .collect()
}
