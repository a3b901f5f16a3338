//! The micropolar law with a constant shear stiffness (MPPD section 2); in space its rotational stiffness is that of bending and torsion.

use rayon::prelude::*;

use super::rotational::RotationalStiffness;
use super::{BondLaw, BondStiffness, Calibration, Law, Options, ShearForm, everywhere, pds};
use crate::bonds::BondSet;
use crate::cloud::PointCloud;
use crate::element::ElementKind;
use crate::material::{Isotropic, Space};

/// The law.
pub const LAW: BondLaw = BondLaw {
    options: Options {
        calibration: Some(Calibration::Integral),
        rotational_stiffness: Some(RotationalStiffness::Decaying),
        ..Options::NONE
    },
    element: |_| ElementKind::Beam,
    shear_form: Some(|_| ShearForm::Constant),
    ..BondLaw::new(
        "mppd",
        "Normal and constant shear stiffness, rotations.",
        "MPPD section 2; OMPPD eqs 54 to 57",
        everywhere!(it => stiffness(it.bonds, it.cloud, &it.isotropic(), it.space, it.rotational())),
    )
};

impl Law {
    /// Normal and constant shear stiffness, with rotations of the points.
    pub const MPPD: Self = Self::usual(&LAW);
}

/// Stiffness densities of every bond: k_n and k_t of [`pds`], and a chosen k_theta.
pub fn stiffness<const D: usize>(
    bonds: &BondSet<D>,
    cloud: &PointCloud<D>,
    materials: &[Isotropic],
    space: Space,
    rotational: RotationalStiffness,
) -> BondStiffness {
    let non_polar = pds::stiffness(bonds, cloud, materials, space);
    let rotational = (&non_polar.shear, &bonds.length, &bonds.horizon)
        .into_par_iter()
        .map(|(&shear, &length, &horizon)| rotational.density(shear, length, horizon))
        .collect();
    BondStiffness {
        rotational,
        ..non_polar
    }
}
