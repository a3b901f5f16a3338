//! The beam-like bond in space: NHPD's law with three displacements and three rotations a point.

use super::{ShearForm, axial_constant, bending_constant};
use crate::bonds::BondSet;
use crate::cloud::PointCloud;
use crate::law::{BondStiffness, Densities};
use crate::material::Isotropic;

/// Stiffness densities of every bond, N/m^6 and N/m^5, with
///
/// c = 6 E/(pi H^4 (1 - 2 nu)), d = E (1 - 4 nu)/(4 pi H^2 (1 + nu)(1 - 2 nu)):
///
/// k_n = c, k_t = 24 d/H^2 or 12 d/l^2 by its form, k_theta = d/l.
///
/// A uniform strain does not see k_theta, which bending and torsion share: with k_phi = g/l for torsion the energy of a uniform curvature
/// chi is (pi H^4/60) ((g - d)(tr^2 chi + chi : chi^T) + (g + 4 d) chi : chi), and g = d leaves chi : chi alone.
pub fn stiffness(
    bonds: &BondSet<3>,
    cloud: &PointCloud<3>,
    materials: &[Isotropic],
    form: ShearForm,
) -> BondStiffness {
    let constants: Vec<[f64; 2]> = (materials.iter())
        .map(|it| [axial_constant(it), bending_constant(it)])
        .collect();
    BondStiffness::from_constants(bonds, cloud, &constants, |[c, d], bond| {
        let (l, h) = (bond.length, bond.horizon);
        let d = d / h.powi(2);
        Densities {
            axial: c / h.powi(4),
            shear: form.density(d, l, h),
            rotational: d / l,
        }
    })
}
