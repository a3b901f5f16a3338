//! Beam-like bond (Gerstle 2007, in the form of MPPD), which is also the law of NHPD eq. 6.

use super::row::ShearForm;
use super::{
    BondLaw, BondStiffness, Calibration, Densities, Law, LawInput, Options, PaperCorrection,
    constants,
};
use crate::element::ElementKind;
use crate::material::{PoissonForm, Space};

/// Law of NHPD.
pub static NHPD: BondLaw = BondLaw {
    options: Options {
        poisson: Some(PoissonForm::Cells),
        ..Options::NONE
    },
    shear_form: Some(nhpd_form),
    correction: PaperCorrection::LengthAndDomain,
    element: |_| ElementKind::Beam,
    ..BondLaw::new(
        "nhpd",
        "Beam-like bonds with non-unified horizons: normal, shear and rotational stiffness.",
        "NHPD eq. 6",
        |it| densities(it, nhpd_form(it.space)),
        Some(|it| densities(it, nhpd_form(it.space))),
    )
};

/// Beam form of MPPD, whose integrals leave the constants 7.5 % off at nu = 0 with a horizon factor of 3.
pub static MPPD_BEAM: BondLaw = BondLaw {
    options: Options {
        calibration: Some(Calibration::Discrete),
        poisson: Some(PoissonForm::Cells),
        ..Options::NONE
    },
    element: |_| ElementKind::Beam,
    shear_form: Some(|_| ShearForm::Falling),
    ..BondLaw::new(
        "mppd-beam",
        "Micropolar bonds in the form of a beam: shear stiffness falls with the length.",
        "Gerstle 2007; OMPPD eq. 22",
        |it| densities(it, ShearForm::Falling),
        Some(|it| densities(it, ShearForm::Falling)),
    )
};

impl Law {
    /// Beam-like bonds with non-unified horizons: normal, shear and rotational stiffness.
    pub const NHPD: Self = Self::usual(&NHPD);

    /// Normal and shear stiffness in the form of a beam, with rotations: shear stiffness falls with the length.
    pub const MPPD_BEAM: Self = Self::usual(&MPPD_BEAM);
}

/// Shear form of the law of NHPD.
fn nhpd_form(space: Space) -> ShearForm {
    match space {
        Space::Plane(_) => ShearForm::Falling,
        Space::Solid => ShearForm::Constant,
    }
}

/// Stiffness densities of every bond, NHPD eq. 6, OMPPD eq. 22, in space our own:
///
/// k_n = c, k_t = 12 d / l^2 or constant by its form, k_theta = d / l, with the constants c (N/m^6) and d (N/m^4) of the
/// [table](super::constants).
///
/// The constant d is negative above the Poisson's ratio of central forces. Uniform strains are independent of k_theta, which in space
/// bending and torsion share: with k_phi = g/l for torsion the energy of a uniform curvature chi is (pi H^4/60) ((g - d)(tr^2 chi + chi :
/// chi^T) + (g + 4 d) chi : chi), and g = d leaves chi : chi alone.
fn densities<const D: usize>(input: &LawInput<'_, D>, form: ShearForm) -> BondStiffness {
    let constants = [constants::axial, constants::bending, constants::shear];
    input.isotropic_bonds(constants, |[c, d, shear], bond| {
        let (l, h) = (bond.length, bond.horizon);
        let d = d / h.powi(D as i32 - 1);
        Densities {
            axial: c / h.powi(D as i32 + 1),
            shear: match form {
                ShearForm::Constant => shear / h.powi(D as i32 + 1),
                ShearForm::Falling => 12.0 * d / l.powi(2),
            },
            rotational: d / l,
        }
    })
}
