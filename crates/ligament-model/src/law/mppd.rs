//! The micropolar law with a constant shear stiffness (MPPD section 2); in space its rotational stiffness is that of bending and torsion.

use super::rotational::RotationalStiffness;
use super::{BondLaw, BondStiffness, Calibration, Law, LawInput, Options, ShearForm, pds};
use crate::element::ElementKind;
use crate::material::PoissonForm;
use crate::parallel;

/// Micropolar law with a constant shear stiffness.
pub static LAW: BondLaw = BondLaw {
    options: Options {
        calibration: Some(Calibration::Integral),
        rotational_stiffness: Some(RotationalStiffness::Decaying),
        poisson: Some(PoissonForm::Cells),
        ..Options::NONE
    },
    element: |_| ElementKind::Beam,
    shear_form: Some(|_| ShearForm::Constant),
    ..BondLaw::new(
        "mppd",
        "Normal and constant shear stiffness, rotations.",
        "MPPD section 2; OMPPD eqs 54 to 57",
        densities,
        Some(densities),
    )
};

impl Law {
    /// Normal and constant shear stiffness, with rotations of the points.
    pub const MPPD: Self = Self::usual(&LAW);
}

/// Stiffness densities of every bond: k_n and k_t of [`pds`], and a chosen k_theta.
fn densities<const D: usize>(input: &LawInput<'_, D>) -> BondStiffness {
    let (non_polar, bonds) = (pds::densities(input), input.bonds);
    let rotational = parallel::values(bonds.len(), 0.0, |bond| {
        let (shear, length) = (non_polar.shear[bond], bonds.length[bond]);
        (input.rotational()).density(shear, length, bonds.horizon[bond])
    });
    BondStiffness {
        rotational,
        ..non_polar
    }
}
