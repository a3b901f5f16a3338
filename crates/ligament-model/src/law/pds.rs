//! Law with stretch and shear stiffness, without rotations of the points (PDS; MPPD section 2.1).

use super::{BondLaw, BondStiffness, Calibration, Densities, Law, LawInput, Options, constants};
use crate::material::PoissonForm;

/// Law with stretch and constant shear stiffness, without rotations.
pub static LAW: BondLaw = BondLaw {
    options: Options {
        calibration: Some(Calibration::Integral),
        poisson: Some(PoissonForm::Cells),
        ..Options::NONE
    },
    ..BondLaw::new(
        "pds",
        "Normal and constant shear stiffness, no rotations of the points.",
        "MPPD eqs 7, 21; OMPPD eqs 54 to 57",
        densities,
        Some(densities),
    )
};

impl Law {
    /// Normal and constant shear stiffness, no rotations of the points.
    pub const PDS: Self = Self::usual(&LAW);
}

/// Stiffness densities of every bond, MPPD eqs 7 and 21 (OMPPD eqs 54 to 57); in space our own:
///
/// | | k_n (N/m^6) | k_t (N/m^6) |
/// |---|---|---|
/// | plane stress | 6 E / (pi t H^3 (1 - nu)) | 6 E (1 - 3 nu) / (pi t H^3 (1 - nu^2)) |
/// | plane strain | 6 E / (pi t H^3 (1 + nu)(1 - 2 nu)) | 6 E (1 - 4 nu) / (pi t H^3 (1 + nu)(1 - 2 nu)) |
/// | space | 6 E / (pi H^4 (1 - 2 nu)) | 6 E (1 - 4 nu) / (pi H^4 (1 + nu)(1 - 2 nu)) |
///
/// All uniform strains have the energies of the isotropic body. In space a rigid rotation omega costs 2 (mu - lambda) |omega|^2 a
/// volume, with Lame's mu and lambda: the law is stable for nu < 1/4, though not objective, and a free body is ill-posed above.
pub(super) fn densities<const D: usize>(input: &LawInput<'_, D>) -> BondStiffness {
    input.isotropic_bonds(
        [constants::axial, constants::shear],
        |[axial, shear], bond| {
            let power = bond.horizon.powi(D as i32 + 1);
            Densities {
                axial: axial / power,
                shear: shear / power,
                rotational: 0.0,
            }
        },
    )
}
