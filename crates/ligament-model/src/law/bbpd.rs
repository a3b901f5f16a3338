//! Bond-based peridynamics: bonds that only resist stretch (Silling 2000, in the plane in the linear form of MPPD section 2).

use super::{BondLaw, BondStiffness, Calibration, Densities, Law, LawInput, Options, constants};
use crate::material::PoissonForm;

/// Bond-based law with a constant micromodulus.
pub static LAW: BondLaw = BondLaw {
    options: Options {
        calibration: Some(Calibration::Integral),
        poisson: Some(PoissonForm::Cells),
        ..Options::NONE
    },
    fixes_poisson: true,
    ..BondLaw::new(
        "bbpd",
        "Central forces alone; Poisson's ratio 1/3, or 1/4 in plane strain.",
        "Silling 2000; MPPD section 2",
        densities,
        Some(densities),
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
/// Poisson's ratio is the ratio of central forces, 1/3 or 1/4, for all materials ([`Isotropic::with_central_forces`]).
fn densities<const D: usize>(input: &LawInput<'_, D>) -> BondStiffness {
    input.isotropic_bonds([constants::central_axial], |[c], bond| Densities {
        axial: c / bond.horizon.powi(D as i32 + 1),
        shear: 0.0,
        rotational: 0.0,
    })
}
