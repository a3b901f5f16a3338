//! The formulation that a setup chooses in space: law, calibration and corrections of the bonds.

use ligament_model::bonds::BondSet;
use ligament_model::correction::length;
use ligament_model::law::rotational::{self, RotationalScale};
use ligament_model::space::SolidElement;
use ligament_model::space::law::{ShearForm, bbpd, calibration, mppd, nhpd, pds};
use ligament_model::{BondStiffness, ElementKind, Isotropic, PointCloud};

use crate::setup::{Alpha, Calibration, Law, Setup};

/// Kinematics of the bonds of a law.
pub(super) fn element(law: &Law) -> SolidElement {
    match law.element() {
        ElementKind::Beam => SolidElement::Beam,
        _ => SolidElement::Spring,
    }
}

/// Form of the shear stiffness of a law whose points turn; none of others.
pub(super) fn shear_form(law: &Law) -> Option<ShearForm> {
    match law {
        Law::MppdBeam { .. } => Some(ShearForm::Falling),
        Law::Nhpd | Law::Mppd { .. } => Some(ShearForm::Constant),
        _ => None,
    }
}

/// Elastic constants that the law makes of those of each material, shape (n_materials).
pub(super) fn constants(setup: &Setup<3>) -> Vec<Isotropic> {
    let given = setup.materials.iter();
    let given = given.filter_map(|it| it.material.elasticity.isotropic());
    given
        .map(|it| match setup.law.fixes_poisson() {
            true => bbpd::central(&it),
            false => it,
        })
        .collect()
}

/// Factors alpha of the bonds, shape (n_bonds).
pub(super) fn alpha(setup: &Setup<3>, cloud: &PointCloud<3>, bonds: &BondSet<3>) -> Vec<f64> {
    match setup.correction.alpha {
        Alpha::Length => length::length_factors(bonds, cloud),
        Alpha::None | Alpha::PartialVolume => vec![1.0; bonds.len()],
    }
}

/// Stiffness densities of the bonds with factors alpha (n_bonds).
pub(super) fn stiffness(
    setup: &Setup<3>,
    cloud: &PointCloud<3>,
    bonds: &BondSet<3>,
    alpha: &[f64],
) -> BondStiffness {
    let materials = constants(setup);
    let stiffness = match setup.law {
        Law::Bbpd { .. } => bbpd::stiffness(bonds, cloud, &materials),
        Law::Pds { .. } => pds::stiffness(bonds, cloud, &materials),
        Law::Mppd {
            rotational_stiffness,
            ..
        } => mppd::stiffness(bonds, cloud, &materials, rotational_stiffness),
        Law::MppdBeam { .. } => nhpd::stiffness(bonds, cloud, &materials, ShearForm::Falling),
        _ => nhpd::stiffness(bonds, cloud, &materials, ShearForm::Constant),
    };
    let stiffness = match setup.law.calibration() {
        Some(Calibration::Discrete) => {
            calibration::calibrated(stiffness, alpha, bonds, cloud, &materials)
        }
        Some(Calibration::Integral) | None => stiffness,
    };
    match setup.rotational_scale {
        RotationalScale::Factor(factor) => rotational::scaled(stiffness, factor),
        RotationalScale::CosseratLength(_) => stiffness,
    }
}
