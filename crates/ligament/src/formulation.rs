//! The formulation that a setup chooses: law, calibration and corrections of the bonds.

use ligament_model::bonds::BondSet;
use ligament_model::correction::patch::CellForces;
use ligament_model::correction::{
    Continuum, Correction, domain, length, partial_volume, patch, surface,
};
use ligament_model::failure::crack_energies::{Components, Lattice};
use ligament_model::failure::{self, Basis, Criteria};
use ligament_model::law::{bbpd, bbpd_conical, beam, calibration, mbb_pd, mppd, orthotropic, pds};
use ligament_model::{
    BondStiffness, BondSystem, Elasticity, ElementKind, Horizons, Isotropic, Material, Plane,
    PointCloud,
};

use crate::body::Origin;
use crate::error::{Fault, Field, SetupError};
use crate::setup::{Alpha, Calibration, Form, Law, Setup, Surface};

/// Factors alpha of the bonds, shape (n_bonds).
pub fn alpha(setup: &Setup, bonds: &BondSet, cloud: &PointCloud) -> Vec<f64> {
    match setup.correction.alpha {
        Alpha::None => vec![1.0; bonds.len()],
        Alpha::PartialVolume => partial_volume::partial_volume_factors(bonds, cloud),
        Alpha::Length => length::length_factors(bonds, cloud),
    }
}

/// Stiffness densities of the bonds with factors alpha (n_bonds).
pub fn stiffness(
    setup: &Setup,
    bonds: &BondSet,
    cloud: &PointCloud,
    alpha: &[f64],
) -> BondStiffness {
    let (plane, law) = (setup.plane(), setup.law);
    let materials = setup.materials.iter();
    let elasticity: Vec<Elasticity> = materials.map(|it| it.material.elasticity).collect();
    let isotropic: Vec<Isotropic> = elasticity
        .iter()
        .filter_map(Elasticity::isotropic)
        .collect();
    let stiffness = match law {
        Law::Nhpd | Law::MppdBeam { .. } => beam::stiffness(bonds, cloud, &isotropic, plane),
        Law::Bbpd { .. } => bbpd::stiffness(bonds, cloud, &isotropic, plane),
        Law::BbpdConical { .. } => bbpd_conical::stiffness(bonds, cloud, &isotropic, plane),
        Law::Pds { .. } => pds::stiffness(bonds, cloud, &isotropic, plane),
        Law::Mppd {
            rotational_stiffness,
            ..
        } => mppd::stiffness(bonds, cloud, &isotropic, plane, rotational_stiffness),
        Law::Orthotropic {
            rotational_stiffness,
        } => orthotropic::stiffness(bonds, cloud, &elasticity, plane, rotational_stiffness),
        Law::MbbPd {
            form: Form::Rows, ..
        } => mbb_pd::rows::stiffness(bonds, cloud, &elasticity, plane),
        Law::MbbPd { .. } => mbb_pd::stiffness(bonds, cloud, &elasticity, plane),
    };
    match law.calibration() {
        Some(Calibration::Discrete) => {
            let effective: Vec<Isotropic> = (setup.materials.iter())
                .filter_map(|it| constants(&it.material, &law, plane))
                .collect();
            calibration::calibrated(stiffness, alpha, bonds, cloud, &effective, plane)
        }
        Some(Calibration::Integral) | None => stiffness,
    }
}

/// Elastic constants that a law makes of a material: Young's modulus with the Poisson's ratio of central forces where the law
/// knows no other. None for a material with axes.
pub fn constants(material: &Material, law: &Law, plane: Plane) -> Option<Isotropic> {
    let given = material.elasticity.isotropic()?;
    Some(if law.fixes_poisson() {
        bbpd::central(&given, plane)
    } else {
        given
    })
}

/// The correction with factors alpha (n_bonds), and the stiffness densities that go with it.
pub fn correction(
    setup: &Setup,
    bonds: &BondSet,
    cloud: &PointCloud,
    horizons: &Horizons,
    stiffness: BondStiffness,
    alpha: Vec<f64>,
    material_of_cell: &[u32],
) -> (Correction, BondStiffness) {
    let correction = match setup.correction.surface {
        Surface::Domain(iteration) => {
            let sweeps = iteration.sweeps(bonds.len());
            let (materials, plane) = (setup.materials(), setup.plane());
            let continuum = Continuum {
                materials: &materials,
                plane,
            };
            domain::iterate(bonds, cloud, &stiffness, alpha, continuum, sweeps)
        }
        Surface::Volume => {
            let factors = surface::surface_factors(bonds, cloud, horizons, &alpha);
            Correction::fixed(alpha, factors)
        }
        Surface::None => Correction::fixed(alpha, vec![1.0; bonds.len()]),
        Surface::Patch(settings) => {
            let forces = cell_forces(setup, cloud, material_of_cell);
            let turns_points = setup.law.element() == ElementKind::Beam;
            let patch = patch::correct(
                bonds,
                cloud,
                stiffness,
                alpha,
                &forces,
                turns_points,
                &settings,
            );
            return (patch.correction, patch.stiffness);
        }
    };
    (correction, stiffness)
}

/// Forces of uniform strains on the points, as the cells of the body with the materials of the law know them.
fn cell_forces(setup: &Setup, cloud: &PointCloud, material_of_cell: &[u32]) -> CellForces {
    let plane = setup.plane();
    let stiffness: Vec<_> = (setup.materials.iter())
        .map(
            |region| match constants(&region.material, &setup.law, plane) {
                Some(isotropic) => isotropic.plane_stiffness(plane),
                None => region.material.elasticity.plane_stiffness(plane),
            },
        )
        .collect();
    match setup.body.origin() {
        Origin::Lattice(lattice) => patch::of_lattice(lattice, cloud, material_of_cell, &stiffness),
        Origin::Mesh(_) | Origin::Points => {
            patch::of_mesh(setup.body.cells(), cloud, material_of_cell, &stiffness)
        }
    }
}

/// Failure criteria on the bonds; none in an analysis without fracture. Bonds of points marked in `no_fail` (n_points) never fail.
///
/// # Errors
///
/// If the strengths of a material leave a criterion without a limit, or its fracture energy leaves nothing after the limit.
pub fn criteria(
    setup: &Setup,
    system: &BondSystem,
    no_fail: &[bool],
) -> Result<Criteria, SetupError> {
    if !setup.analysis.is_fracture() {
        return Ok(Criteria::default());
    }
    let (materials, plane) = (setup.materials(), setup.plane());
    let spacing = (system.cloud.spacing.iter().copied()).fold(f64::INFINITY, f64::min);
    let own_rows = matches!(
        setup.law,
        Law::MbbPd {
            form: Form::Rows,
            ..
        }
    );
    let basis = Basis {
        system,
        no_fail,
        plane,
        constants: (materials.iter())
            .map(|it| constants(it, &setup.law, plane))
            .collect(),
        materials: &materials,
        lattice: Lattice {
            spacing,
            horizon: setup.horizon.at_spacing(spacing),
            thickness: system.cloud.thickness,
            components: if own_rows {
                Components::OwnRows
            } else {
                Components::All
            },
        },
    };
    failure::criteria(&setup.criteria, &basis).map_err(|(place, no_limit)| {
        Field::element("criteria", place).error(Fault::NoLimit(no_limit))
    })
}
