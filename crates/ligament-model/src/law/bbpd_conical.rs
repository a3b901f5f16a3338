//! Bond-based peridynamics with a conical micromodulus: bonds count less the longer they are (Ha and Bobaru 2010, section
//! 2).

use super::{BondLaw, BondStiffness, Calibration, Densities, Law, LawInput, Options, constants};
use crate::material::Isotropic;

/// Bond-based law with a conical micromodulus.
pub static LAW: BondLaw = BondLaw {
    options: Options {
        calibration: Some(Calibration::Integral),
        ..Options::NONE
    },
    fixes_poisson: true,
    ..BondLaw::new(
        "bbpd-conical",
        "Central forces with a stiffness that falls with the length.",
        "Ha and Bobaru 2010, section 2",
        densities,
        Some(densities),
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
/// where c is D + 2 times the constant micromodulus of [`super::bbpd`]: the integral of (1 - l/H) l^D over the horizon is that part of the
/// integral of l^D. Bonds as long as the horizon carry nothing. Poisson's ratio is 1/3 or 1/4, as for [`super::bbpd`].
fn densities<const D: usize>(input: &LawInput<'_, D>) -> BondStiffness {
    let constant = |material: &Isotropic, space, thickness| {
        (D + 2) as f64 * constants::central_axial(material, space, thickness)
    };
    input.isotropic_bonds([constant], |[c], bond| Densities {
        axial: c / bond.horizon.powi(D as i32 + 1) * (1.0 - bond.length / bond.horizon).max(0.0),
        shear: 0.0,
        rotational: 0.0,
    })
}
