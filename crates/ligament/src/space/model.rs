//! From a solid body to its discrete model: the page of [`crate::model`] in space.

use std::sync::Arc;

use ligament_model::bonds::hole::bonds_across;
use ligament_model::correction::Correction;
use ligament_model::space::SolidSystem;
use ligament_model::space::outline::{Surface, bonds_outside, spacing_inside};
use ligament_model::space::precrack::{SolidPreCrack, count_touched_bonds, cut_bonds};
use ligament_model::{
    Absence, AbsentBond, BondSet, BondStiffness, EnergyRatio, FixedFields, PointCloud,
};

use super::formulation::{self, SolidFormulation};
use super::precrack::surfaces;
use super::soundness::{forbid_overlap, require_connected, require_distinct, require_numbers};
use crate::body::Origin;
use crate::counts::{self, BondCounts};
use crate::error::SetupError;
use crate::loading;
use crate::model::{
    Discretises, Model, absent_bonds, correction_range, portion_of, precrack_share, with_cut,
};
use crate::setup::{Dim, Setup};
use crate::stage::{Finding, StageWatcher, stage};
use crate::warning;

impl Discretises<3> for Dim {
    fn model(setup: Setup<3>, watcher: &mut dyn StageWatcher) -> Result<Model<3>, SetupError> {
        Model::in_space(setup, watcher)
    }
}

impl Model<3> {
    /// Builds the model of a setup in space.
    fn in_space(setup: Setup<3>, watcher: &mut dyn StageWatcher) -> Result<Self, SetupError> {
        setup.check()?;
        let material_of_cell = loading::material_of_cell(&setup)?;
        let (cloud, outline) = stage(watcher, "points", || points(&setup, &material_of_cell))?;
        let horizons = setup.horizon.of_points(&cloud);
        let (bonds, absent) = stage(watcher, "bonds", || {
            let all = BondSet::search(&cloud, &horizons);
            inside_body(&setup, all, &cloud, outline)
        });
        require_connected(&setup, &cloud, &horizons, &bonds)?;
        watcher.found(&counts::finding(&cloud, &bonds, &absent));
        let (is_cut, touched, precrack_share) =
            stage(watcher, "pre-cracks", || precracked(&setup, &bonds, &cloud))?;
        let absent = with_cut(absent, &bonds, &is_cut);
        let Corrected {
            bonds,
            stiffness,
            correction,
            energy_ratios,
        } = stage(watcher, "correction", || {
            let formulation = SolidFormulation::new(&setup, &cloud, &horizons, &material_of_cell);
            correct(&formulation, bonds, &is_cut)
        });
        let report = correction.report.as_ref();
        watcher.found(&Finding::Correction(&setup.correction, report));
        let fixed = FixedFields {
            horizon: horizons.radius,
            precrack_share,
            energy_ratios,
            domain_factor: correction.domain_factor.clone(),
            shear_ratio: correction.shear_ratio.clone(),
            patch_residual: correction.patch_residual().to_vec(),
            no_fail: loading::no_fail(&setup, &cloud)?,
            scatter: (setup.scatter)
                .map(|it| it.factors_in_space(setup.body.positions(), &setup.body.numbering())),
            absent,
        };
        let system = stage(watcher, "rigidities", || {
            bond_system(&setup, cloud, bonds, stiffness, &correction)
        })?;
        let limits = || formulation::criteria(&setup, &system, &fixed);
        let criteria = stage(watcher, "criteria", limits)?;
        Ok(Self {
            warnings: warning::of_model(&setup, &system.cloud.spacing, report, &fixed, touched),
            correction_range: correction_range(&correction, &system.cloud),
            counts: BondCounts::new(&system.cloud, &system.bonds, &fixed.absent),
            correction: correction.report,
            setup,
            system: Arc::new(system),
            fixed,
            criteria: Arc::new(criteria),
        })
    }
}

/// The points of the body, with the index of the material of each cell (n_cells) and the part of this process in them, and the outline of a
/// mesh that bonds do not leave.
fn points(
    setup: &Setup<3>,
    material_of_cell: &[u32],
) -> Result<(PointCloud<3>, Option<Surface>), SetupError> {
    let (cloud, outline) = all_points(setup, material_of_cell)?;
    let portion = portion_of(setup, &cloud);
    Ok((PointCloud { portion, ..cloud }, outline))
}

/// The points of the body, with the index of the material of each cell (n_cells), and the outline of a mesh that bonds do not leave.
fn all_points(
    setup: &Setup<3>,
    material_of_cell: &[u32],
) -> Result<(PointCloud<3>, Option<Surface>), SetupError> {
    let body = &*setup.body;
    let cloud = body.cloud(1.0, material_of_cell, setup.materials.len());
    require_distinct(body, &cloud)?;
    match body.origin() {
        Origin::SolidMesh(mesh) if !setup.bonds_through_voids => {
            let outline = Surface::new(&mesh.cells, &cloud);
            forbid_overlap(body, &outline)?;
            let spacing = spacing_inside(&outline, &mesh.cells, &cloud);
            Ok((PointCloud { spacing, ..cloud }, Some(outline)))
        }
        _ => Ok((cloud, None)),
    }
}

/// The bonds inside the body, and those that its voids part.
fn inside_body(
    setup: &Setup<3>,
    bonds: BondSet<3>,
    cloud: &PointCloud<3>,
    outline: Option<Surface>,
) -> (BondSet<3>, Vec<AbsentBond>) {
    let crosses = match (setup.body.origin(), outline) {
        (Origin::SolidLattice(lattice), _) => bonds_across(&lattice.holes, &bonds, cloud),
        (_, Some(outline)) => bonds_outside(&outline, &bonds, cloud),
        _ => return (bonds, Vec::new()),
    };
    if !crosses.contains(&true) {
        return (bonds, Vec::new());
    }
    let keep: Vec<bool> = crosses.iter().map(|crosses| !crosses).collect();
    let absent = absent_bonds(&bonds, &crosses, Absence::Void);
    (bonds.retained(&keep), absent)
}

/// For each bond, whether a pre-crack cuts it (n_bonds), how many only touch one, and the share of its bonds that each point loses
/// (n_points).
fn precracked(
    setup: &Setup<3>,
    bonds: &BondSet<3>,
    cloud: &PointCloud<3>,
) -> Result<(Vec<bool>, usize, Vec<f64>), SetupError> {
    let surfaces: Vec<SolidPreCrack> = surfaces(setup)?;
    let is_cut = cut_bonds(&surfaces, bonds, cloud);
    let touched = count_touched_bonds(&surfaces, bonds, cloud, &is_cut);
    let share = precrack_share(cloud, bonds, &is_cut);
    Ok((is_cut, touched, share))
}

/// Points and corrected bonds with their rigidities.
fn bond_system(
    setup: &Setup<3>,
    cloud: PointCloud<3>,
    bonds: BondSet<3>,
    stiffness: BondStiffness,
    correction: &Correction,
) -> Result<SolidSystem, SetupError> {
    let element = formulation::element(&setup.law);
    let (alpha, omega) = (&correction.length_factor, &correction.domain_factor);
    let system = SolidSystem::new(cloud, bonds, element, stiffness, alpha.clone(), omega);
    require_numbers(&*setup.body, &system)?;
    Ok(system)
}

/// Bonds that pre-cracks leave, with their stiffness and correction.
struct Corrected {
    bonds: BondSet<3>,
    stiffness: BondStiffness,
    correction: Correction,
    energy_ratios: Vec<EnergyRatio>,
}

/// Gives the bonds of the whole body their stiffness and correction and then drops those that pre-cracks cut, or the other way round if the
/// setup says so.
fn correct(formulation: &SolidFormulation<'_>, bonds: BondSet<3>, is_cut: &[bool]) -> Corrected {
    let survives: Vec<bool> = is_cut.iter().map(|cut| !cut).collect();
    if formulation.cuts_first() {
        return of_bonds(formulation, bonds.retained(&survives));
    }
    let whole = of_bonds(formulation, bonds);
    if !is_cut.contains(&true) {
        return whole;
    }
    Corrected {
        bonds: whole.bonds.retained(&survives),
        stiffness: whole.stiffness.retained(&survives),
        correction: whole.correction.retained(&survives),
        energy_ratios: whole.energy_ratios,
    }
}

fn of_bonds(formulation: &SolidFormulation<'_>, bonds: BondSet<3>) -> Corrected {
    let alpha = formulation.alpha(&bonds);
    let stiffness = formulation.stiffness(&bonds, &alpha);
    let correction = formulation.correction(&bonds, &stiffness, alpha);
    let energy_ratios = formulation.energy_ratios(&bonds, &stiffness, &correction);
    Corrected {
        bonds,
        stiffness: stiffness.with_shear(&correction.shear_ratio),
        correction,
        energy_ratios,
    }
}
