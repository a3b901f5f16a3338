//! Row form of MBB-PD, after (A.9): bonds along x resist S_xx alone, bonds along y S_yy alone, all others all three strains.

use nalgebra::{Matrix3, Vector3};

use super::matrices::{bond_stiffness, plane_stiffnesses};
use crate::bonds::BondSet;
use crate::cloud::PointCloud;
use crate::element::imaginary::BondClass;
use crate::law::{BondStiffness, LawInput};

/// Micro-modulus matrices: the symmetric part of diag(psi_1, psi_2, psi_6) c, restricted to the rows of the class of a bond, with the means of
/// its ends and
///
/// psi_1 = 2/(V (sum_H + sum_S)), psi_2 = 2/(V (sum_V + sum_S)), psi_6 = 2/(V sum_S)
///
/// over the lengths of the bonds of a point by class. Every row thus has its whole energy at every point, but the matrix of a bond along an
/// axis is indefinite where c_12, c_16 or c_26 is not zero; and a straight free side has residual forces of 0.055 of the stress.
pub(super) fn densities(input: &LawInput<'_, 2>) -> BondStiffness {
    let stiffnesses = plane_stiffnesses(input);
    let (bonds, cloud) = (input.bonds, input.cloud);
    let psi: Vec<[f64; 3]> = (0..cloud.len() as u32)
        .map(|point| factors(bonds, cloud, point))
        .collect();
    let of_bond = |bond: usize| {
        let [a, b] = bonds.ends[bond].map(|end| end as usize);
        let (rows, decisive) = match BondClass::from_direction(bonds.direction[bond]) {
            BondClass::Horizontal => ([true, false, false], 0),
            BondClass::Vertical => ([false, true, false], 1),
            BondClass::Shear => ([true; 3], 2),
        };
        let mean = [0, 1, 2].map(|row| {
            if rows[row] {
                0.5 * (psi[a][row] + psi[b][row])
            } else {
                0.0
            }
        });
        let rows = Matrix3::from_diagonal(&Vector3::from(mean)) * stiffnesses[bond];
        let [of_a, of_b] = [a, b].map(|end| psi[end][decisive]);
        (0.5 * (rows + rows.transpose()), of_a / (of_a + of_b))
    };
    let matrices: Vec<(Matrix3<f64>, f64)> = (0..bonds.len()).map(of_bond).collect();
    bond_stiffness(bonds, &matrices)
}

/// Factors psi_1, psi_2 and psi_6 of a point, 1/m^4; infinite where the point has no bond that resists the strain.
fn factors(bonds: &BondSet, cloud: &PointCloud, point: u32) -> [f64; 3] {
    let mut sums = [0.0; 3];
    for &bond in bonds.incidence.at(point) {
        let (length, direction) = (bonds.length[bond as usize], bonds.direction[bond as usize]);
        let class = BondClass::from_direction(direction);
        let resists = [
            class != BondClass::Vertical,
            class != BondClass::Horizontal,
            class == BondClass::Shear,
        ];
        for (sum, resists) in sums.iter_mut().zip(resists) {
            if resists {
                *sum += length;
            }
        }
    }
    sums.map(|sum| 2.0 / (cloud.volumes[point as usize] * sum))
}
