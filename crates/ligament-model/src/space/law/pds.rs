//! Bonds in space that resist stretch and shear, without rotations of the points (PDS).

use super::{ShearForm, axial_constant, bending_constant};
use crate::bonds::BondSet;
use crate::cloud::PointCloud;
use crate::law::{BondStiffness, Densities};
use crate::material::Isotropic;

/// Stiffness densities of every bond, N/m^6:
///
/// k_n = 6 E/(pi H^4 (1 - 2 nu)), k_t = 6 E (1 - 4 nu)/(pi H^4 (1 + nu)(1 - 2 nu)).
///
/// Energies of all uniform strains are those of the isotropic body. A rigid rotation omega costs 2 (mu - lambda) |omega|^2 a volume, with
/// Lame's mu and lambda: the law is stable for nu < 1/4, though not objective, and a free body is ill-posed above.
pub fn stiffness(
    bonds: &BondSet<3>,
    cloud: &PointCloud<3>,
    materials: &[Isotropic],
) -> BondStiffness {
    let constants: Vec<[f64; 2]> = (materials.iter())
        .map(|it| [axial_constant(it), bending_constant(it)])
        .collect();
    BondStiffness::from_constants(bonds, cloud, &constants, |[c, d], bond| {
        let (l, h) = (bond.length, bond.horizon);
        Densities {
            axial: c / h.powi(4),
            shear: ShearForm::Constant.density(d / h.powi(2), l, h),
            rotational: 0.0,
        }
    })
}
