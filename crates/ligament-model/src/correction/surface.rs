//! Surface correction by volumes: bonds of points whose families a surface cuts are stiffened.

use std::f64::consts::PI;

use crate::bonds::BondSet;
use crate::cloud::PointCloud;
use crate::horizon::Horizons;
use crate::parallel;

/// Factors lambda (n_bonds), MPPD section 2:
///
/// lambda_AB = (V0_A + V0_B)/(V(H_A) + V(H_B)), V0 = pi h^2 t, in space 4/3 pi h^3, V(H_A) = sum over B of alpha V_B (without A itself)
///
/// with the factors alpha (n_bonds). With one horizon for all points V0_A + V0_B is the paper's 2 V0.
pub fn surface_factors<const D: usize>(
    bonds: &BondSet<D>,
    cloud: &PointCloud<D>,
    horizons: &Horizons,
    length_factor: &[f64],
) -> Vec<f64> {
    let volumes: Vec<[f64; 2]> = cloud.over_families(|point| {
        let family = bonds.incidence.at(point).iter();
        let present = family.map(|&bond| {
            length_factor[bond as usize] * cloud.volumes[bonds.neighbour(bond, point) as usize]
        });
        let radius = horizons.radius[point as usize];
        let whole = match D {
            2 => PI * radius * radius * cloud.thickness,
            _ => 4.0 / 3.0 * PI * radius.powi(3),
        };
        [whole, present.sum()]
    });
    parallel::values(bonds.len(), 0.0, |bond| {
        let [a, b] = bonds.ends[bond].map(|end| volumes[end as usize]);
        (a[0] + b[0]) / (a[1] + b[1])
    })
}
