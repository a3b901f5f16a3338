//! Bond-based peridynamics with a conical micromodulus: bonds count less the longer they are (Ha and Bobaru 2010, section
//! 2).

use super::bbpd::central;
use super::beam::axial_constant;
use super::{BondStiffness, Densities};
use crate::bonds::BondSet;
use crate::cloud::PointCloud;
use crate::material::{Isotropic, Plane};

/// Stiffness densities of every bond: k_n alone,
///
/// k_n = c (1 - l/H) with c = 36 E / (pi t H^3) in plane stress, 192 E / (5 pi t H^3) in plane strain (N/m^6),
///
/// four times the constant micromodulus of [`super::bbpd`]: the integral of (1 - l/H) l^2 is a fourth of that of l^2. Bonds as long
/// as the horizon carry nothing. Poisson's ratio is 1/3 or 1/4, as for [`super::bbpd`].
pub fn stiffness(
    bonds: &BondSet,
    cloud: &PointCloud,
    materials: &[Isotropic],
    plane: Plane,
) -> BondStiffness {
    let constant =
        |material| [4.0 * axial_constant(&central(material, plane), plane, cloud.thickness)];
    let constants: Vec<[f64; 1]> = materials.iter().map(constant).collect();
    BondStiffness::from_constants(bonds, cloud, &constants, |[c], bond| Densities {
        axial: c / bond.horizon.powi(3) * (1.0 - bond.length / bond.horizon).max(0.0),
        shear: 0.0,
        rotational: 0.0,
    })
}
