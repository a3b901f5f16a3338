//! Bond-based peridynamics with a conical micromodulus: bonds count less the longer they are (Ha and Bobaru 2010, section
//! 2).

use super::{BondLaw, BondStiffness, Calibration, Densities, Law, Options, constants, everywhere};
use crate::bonds::BondSet;
use crate::cloud::PointCloud;
use crate::material::{Isotropic, Space};

/// The law.
pub const LAW: BondLaw = BondLaw {
    options: Options {
        calibration: Some(Calibration::Integral),
        ..Options::NONE
    },
    fixes_poisson: true,
    ..BondLaw::new(
        "bbpd-conical",
        "Central forces with a stiffness that falls with the length.",
        "Ha and Bobaru 2010, section 2",
        everywhere!(it => stiffness(it.bonds, it.cloud, &it.isotropic(), it.space)),
    )
};

impl Law {
    /// Central forces with a stiffness that falls with the length of the bond.
    pub const BBPD_CONICAL: Self = Self::usual(&LAW);
}

/// Stiffness densities of every bond: k_n alone,
///
/// k_n = c (1 - l/H) with c = 36 E / (pi t H^3) in plane stress, 192 E / (5 pi t H^3) in plane strain, 60 E / (pi H^4) in space (N/m^6),
///
/// D + 2 times the constant micromodulus of [`super::bbpd`]: the integral of (1 - l/H) l^D over the horizon is that part of the integral of
/// l^D. Bonds as long as the horizon carry nothing. Poisson's ratio is 1/3 or 1/4, as for [`super::bbpd`].
pub fn stiffness<const D: usize>(
    bonds: &BondSet<D>,
    cloud: &PointCloud<D>,
    materials: &[Isotropic],
    space: Space,
) -> BondStiffness {
    let constant = |material: &Isotropic| {
        let central = material.with_central_forces(space);
        let constant = constants::axial(&central, space, cloud.thickness);
        [(D + 2) as f64 * constant]
    };
    let constants: Vec<[f64; 1]> = materials.iter().map(constant).collect();
    BondStiffness::from_constants(bonds, cloud, &constants, |[c], bond| Densities {
        axial: c / bond.horizon.powi(D as i32 + 1) * (1.0 - bond.length / bond.horizon).max(0.0),
        shear: 0.0,
        rotational: 0.0,
    })
}
