//! The formulation that a case chooses: law, calibration and corrections of the bonds.

use ligament_model::bonds::BondSet;
use ligament_model::correction::{Continuum, Correction, domain, length, partial_volume, surface};
use ligament_model::law::rotational::RotationalStiffness;
use ligament_model::law::{bbpd, bbpd_conical, beam, calibration, mbb_pd, mppd, orthotropic, pds};
use ligament_model::{BondStiffness, Elasticity, ElementKind, Horizons, Isotropic, PointCloud};

use crate::case::{self, Alpha, Calibration, CaseFile, Form, Law, ModelSection, Strains, Surface};
use crate::resolve;

/// Kinematics of the bonds of a model.
pub fn element(model: &ModelSection) -> ElementKind {
    match model.law {
        Law::Nhpd | Law::Mppd | Law::MppdBeam | Law::Orthotropic => ElementKind::Beam,
        Law::Bbpd | Law::BbpdConical | Law::Pds => ElementKind::Spring,
        Law::MbbPd => match (model.form, model.strains) {
            (Some(Form::Pairwise), _) => ElementKind::Pairwise,
            (_, Some(Strains::True)) => ElementKind::TrueStrain,
            _ => ElementKind::Imaginary,
        },
    }
}

/// Factors alpha of the bonds, shape (n_bonds).
pub fn alpha(case: &CaseFile, bonds: &BondSet, cloud: &PointCloud) -> Vec<f64> {
    match case.case.correction.alpha {
        Alpha::None => vec![1.0; bonds.len()],
        Alpha::PartialVolume => partial_volume::partial_volume_factors(bonds, cloud),
        Alpha::Length => length::length_factors(bonds, cloud),
    }
}

/// Stiffness densities of the bonds with factors alpha (n_bonds).
pub fn stiffness(
    case: &CaseFile,
    bonds: &BondSet,
    cloud: &PointCloud,
    alpha: &[f64],
) -> BondStiffness {
    let plane = resolve::plane(case);
    let elasticity: Vec<Elasticity> = resolve::materials(case)
        .iter()
        .map(|material| material.elasticity)
        .collect();
    let isotropic: Vec<Isotropic> = elasticity
        .iter()
        .filter_map(Elasticity::isotropic)
        .collect();
    let rotational = rotational_stiffness(case);
    let stiffness = match case.case.model.law {
        Law::Nhpd | Law::MppdBeam => beam::stiffness(bonds, cloud, &isotropic, plane),
        Law::Bbpd => bbpd::stiffness(bonds, cloud, &isotropic, plane),
        Law::BbpdConical => bbpd_conical::stiffness(bonds, cloud, &isotropic, plane),
        Law::Pds => pds::stiffness(bonds, cloud, &isotropic, plane),
        Law::Mppd => mppd::stiffness(bonds, cloud, &isotropic, plane, rotational),
        Law::Orthotropic => orthotropic::stiffness(bonds, cloud, &elasticity, plane, rotational),
        Law::MbbPd => match case.case.model.form {
            Some(Form::Rows) => mbb_pd::rows::stiffness(bonds, cloud, &elasticity, plane),
            _ => mbb_pd::stiffness(bonds, cloud, &elasticity, plane),
        },
    };
    match case.case.model.calibration {
        Some(Calibration::Discrete) => {
            let effective: Vec<Isotropic> = if case.case.model.law.fixes_poisson() {
                isotropic
                    .iter()
                    .map(|it| bbpd::central(it, plane))
                    .collect()
            } else {
                isotropic
            };
            calibration::calibrated(stiffness, alpha, bonds, cloud, &effective, plane)
        }
        Some(Calibration::Integral) | None => stiffness,
    }
}

/// The correction with factors alpha (n_bonds).
pub fn correction(
    case: &CaseFile,
    bonds: &BondSet,
    cloud: &PointCloud,
    horizons: &Horizons,
    stiffness: &BondStiffness,
    alpha: Vec<f64>,
) -> Correction {
    match (
        case.case.correction.surface,
        &case.case.correction.iteration,
    ) {
        (Surface::Domain, Some(iteration)) => {
            let sweeps = resolve::sweeps(iteration, bonds.len());
            let (materials, plane) = (resolve::materials(case), resolve::plane(case));
            let continuum = Continuum {
                materials: &materials,
                plane,
            };
            domain::iterate(bonds, cloud, stiffness, alpha, continuum, sweeps)
        }
        (Surface::Volume, _) => {
            let factors = surface::surface_factors(bonds, cloud, horizons, &alpha);
            Correction::fixed(alpha, factors)
        }
        (Surface::None | Surface::Domain, _) => Correction::fixed(alpha, vec![1.0; bonds.len()]),
    }
}

/// What the case leaves to the law is not used by it.
fn rotational_stiffness(case: &CaseFile) -> RotationalStiffness {
    match case.case.model.rotational_stiffness {
        Some(case::RotationalStiffness::Decaying) => RotationalStiffness::Decaying,
        Some(case::RotationalStiffness::Quarter) => RotationalStiffness::Quarter,
        Some(case::RotationalStiffness::Beam) => RotationalStiffness::Beam,
        Some(case::RotationalStiffness::None) | None => RotationalStiffness::Zero,
    }
}
