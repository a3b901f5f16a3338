//! The printed factors psi of MBB-PD (eq. 19).

use crate::bonds::BondSet;
use crate::cloud::PointCloud;
use crate::element::imaginary::BondClass;

/// Ratios of the printed factors psi_1, psi_2, psi_6 of each bond to the factors of the energy form ([`super::factors`]), as means of its ends,
/// shape (n_bonds, 3):
///
/// psi_1 = 2/(V (sum_H abs(xi) + sum_S (1 + tan(theta)/2)^2 abs(xi))), psi_2 with V and cot, psi_6 = 2/(V sum_S (csc(2 theta) + 1)^2 abs(xi)).
///
/// The sums are over the bonds that a point has, instead of the corrections of appendix B. The printed "2 V (...)^-1" does not have the unit
/// 1/m^4: it stands for 2/(V (...)). The angle is that of the bond to the x axis, with its sign. A row without a bond at a point has the
/// factor 0.
pub fn row_factors(bonds: &BondSet, cloud: &PointCloud) -> Vec<[f64; 3]> {
    let printed: Vec<[f64; 3]> = (0..cloud.len() as u32)
        .map(|point| printed_factors(bonds, cloud, point))
        .collect();
    let of_energy = super::factors(bonds, cloud);
    let of_bond = |ends: &[u32; 2]| {
        let [a, b] = ends.map(|end| end as usize);
        [0, 1, 2].map(|row| (printed[a][row] + printed[b][row]) / (of_energy[a] + of_energy[b]))
    };
    bonds.ends.iter().map(of_bond).collect()
}

fn printed_factors(bonds: &BondSet, cloud: &PointCloud, point: u32) -> [f64; 3] {
    let mut sums = [0.0; 3];
    for &bond in bonds.incidence.at(point) {
        let (length, direction) = (bonds.length[bond as usize], bonds.direction[bond as usize]);
        match BondClass::from_direction(direction) {
            BondClass::Horizontal => sums[0] += length,
            BondClass::Vertical => sums[1] += length,
            BondClass::Shear => {
                let tan = direction[1] / direction[0];
                // Identity csc(2 theta) = (tan + cot)/2.
                let csc = 0.5 * (tan + 1.0 / tan);
                sums[0] += (1.0 + 0.5 * tan).powi(2) * length;
                sums[1] += (1.0 + 0.5 / tan).powi(2) * length;
                sums[2] += (csc + 1.0).powi(2) * length;
            }
        }
    }
    sums.map(|sum| {
        if sum > 0.0 {
            2.0 / (cloud.volumes[point as usize] * sum)
        } else {
            0.0
        }
    })
}
