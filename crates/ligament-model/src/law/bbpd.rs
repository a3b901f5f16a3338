//! Bond-based peridynamics: bonds that only resist stretch (Silling 2000, in the plane in the linear form of MPPD section 2).

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
        "bbpd",
        "Central forces alone; Poisson's ratio 1/3, or 1/4 in plane strain.",
        "Silling 2000; MPPD section 2",
        everywhere!(it => stiffness(it.bonds, it.cloud, &it.isotropic(), it.space)),
    )
};

impl Law {
    /// Central forces alone.
    pub const BBPD: Self = Self::usual(&LAW);
}

/// Stiffness densities of every bond: k_n alone,
///
/// k_n = 9 E / (pi t H^3) in plane stress, 48 E / (5 pi t H^3) in plane strain, 12 E / (pi H^4) in space (N/m^6).
///
/// Poisson's ratio is what central forces give, 1/3 or 1/4, whatever that of the materials ([`Isotropic::with_central_forces`]).
pub fn stiffness<const D: usize>(
    bonds: &BondSet<D>,
    cloud: &PointCloud<D>,
    materials: &[Isotropic],
    space: Space,
) -> BondStiffness {
    let constant = |material: &Isotropic| {
        let central = material.with_central_forces(space);
        [constants::axial(&central, space, cloud.thickness)]
    };
    let constants: Vec<[f64; 1]> = materials.iter().map(constant).collect();
    BondStiffness::from_constants(bonds, cloud, &constants, |[c], bond| Densities {
        axial: c / bond.horizon.powi(D as i32 + 1),
        shear: 0.0,
        rotational: 0.0,
    })
}
