//! From a solid body to its discrete model: the page of [`crate::model`] in space.

use std::sync::Arc;

use ligament_model::bonds::hole::bonds_across;
use ligament_model::bonds::outline::{SolidOutline, bonds_outside, spacing_inside};
use ligament_model::bonds::parts::{LatticeCells, Tetrahedra};
use ligament_model::bonds::precrack::{SolidPreCrack, count_touched_bonds, cut_bonds};
use ligament_model::correction::Correction;
use ligament_model::correction::patch::CellForces;
use ligament_model::material::Stiffness;
use ligament_model::{
    Absence, AbsentBond, BondSet, BondStiffness, BondSystem, EnergyRatio, FixedFields, PointCloud,
};

use super::formulation::{self, SolidFormulation};
use super::precrack::surfaces;
use super::soundness::{forbid_overlap, require_connected, require_distinct};
use crate::body::Origin;
use crate::counts::{self, BondCounts};
use crate::error::SetupError;
use crate::loading;
use crate::model::{
    Discretises, Model, Precracked, absent_bonds, correction_range, of_correction, portion_of,
    warnings, with_cut,
};
use crate::setup::{Dim, Setup};
use crate::soundness::{require_factors, require_numbers};
use crate::stage::{Finding, StageWatcher, stage};

impl Discretises<3> for Dim {
    fn model(setup: Setup<3>, watcher: &mut dyn StageWatcher) -> Result<Model<3>, SetupError> {
        Model::in_space(setup, watcher)
    }

    fn cell_forces(
        setup: &Setup<3>,
        cloud: &PointCloud<3>,
        material_of_cell: &[u32],
    ) -> CellForces<3> {
        formulation::cell_forces(setup, cloud, material_of_cell)
    }

    fn stiffness(setup: &Setup<3>) -> Vec<Stiffness> {
        formulation::stiffness(setup)
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
            let (bonds, absent) = inside_body(&setup, all, &cloud, outline);
            (composed(&setup, bonds, &cloud, &material_of_cell), absent)
        });
        require_connected(&setup, &cloud, &horizons, &bonds)?;
        watcher.found(&counts::finding(&cloud, &bonds, &absent));
        let crossed = stage(watcher, "pre-cracks", || precracked(&setup, &bonds, &cloud))?;
        let absent = with_cut(absent, &bonds, &crossed.is_cut);
        let Corrected {
            bonds,
            stiffness,
            correction,
            energy_ratios,
        } = stage(watcher, "correction", || {
            let formulation = SolidFormulation::new(&setup, &cloud, &horizons, &material_of_cell);
            correct(&formulation, bonds, &crossed.is_cut)
        });
        let report = correction.report.as_ref();
        watcher.found(&Finding::Correction(&setup.correction, report));
        let scatter =
            (setup.scatter).map(|it| it.factors(setup.body.positions(), &setup.body.numbering()));
        let fixed = FixedFields {
            horizon: horizons.radius,
            precrack_share: crossed.share,
            energy_ratios,
            scatter,
            absent,
            ..of_correction(&correction, loading::no_fail(&setup, &cloud)?)
        };
        let system = stage(watcher, "rigidities", || {
            bond_system(&setup, cloud, bonds, stiffness, &correction)
        })?;
        let limits = || formulation::criteria(&setup, &system, &fixed);
        let criteria = stage(watcher, "criteria", limits)?;
        let of_cracks = (crossed.idle, crossed.touched);
        let of_body = (&setup, &system.cloud);
        Ok(Self {
            warnings: warnings(of_body, report, &fixed, &criteria, of_cracks),
            correction_range: correction_range(&correction, &system.cloud),
            counts: BondCounts::new(&system.cloud, &system.bonds, &fixed.absent),
            correction: correction.report,
            setup,
            system: system.with_elements(),
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
) -> Result<(PointCloud<3>, Option<SolidOutline>), SetupError> {
    let (cloud, outline) = all_points(setup, material_of_cell)?;
    let portion = portion_of(setup, &cloud);
    Ok((PointCloud { portion, ..cloud }, outline))
}

/// The points of the body, with the index of the material of each cell (n_cells), and the outline of a mesh that bonds do not leave.
fn all_points(
    setup: &Setup<3>,
    material_of_cell: &[u32],
) -> Result<(PointCloud<3>, Option<SolidOutline>), SetupError> {
    let body = &*setup.body;
    let cloud = body.cloud(1.0, material_of_cell, setup.materials.len());
    require_distinct(body, &cloud)?;
    match body.origin() {
        Origin::SolidMesh(mesh) if !setup.bonds_through_voids => {
            let outline = SolidOutline::of_cells(&mesh.cells, &cloud);
            forbid_overlap(body, &outline)?;
            let spacing = spacing_inside(&outline, &mesh.cells, &cloud);
            Ok((PointCloud { spacing, ..cloud }, Some(outline)))
        }
        _ => Ok((cloud, None)),
    }
}

/// The bonds, followed through the cells of a body of several materials.
fn composed(
    setup: &Setup<3>,
    bonds: BondSet<3>,
    cloud: &PointCloud<3>,
    materials: &[u32],
) -> BondSet<3> {
    if cloud.n_materials == 1 {
        return bonds;
    }
    match (setup.body.origin(), cloud.lattice_cell) {
        (Origin::SolidMesh(mesh), _) => {
            bonds.through(&Tetrahedra::new(&mesh.cells, cloud, materials), cloud)
        }
        (_, Some(size)) => bonds.through(
            &LatticeCells {
                cloud,
                size,
                materials,
            },
            cloud,
        ),
        _ => bonds,
    }
}

/// The bonds inside the body, and those that its voids part.
fn inside_body(
    setup: &Setup<3>,
    bonds: BondSet<3>,
    cloud: &PointCloud<3>,
    outline: Option<SolidOutline>,
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

/// What the pre-cracks of a solid do to its bonds.
fn precracked(
    setup: &Setup<3>,
    bonds: &BondSet<3>,
    cloud: &PointCloud<3>,
) -> Result<Precracked, SetupError> {
    let surfaces: Vec<SolidPreCrack> = surfaces(&*setup.body, &setup.precracks)?;
    let cut = |cracks: &[SolidPreCrack]| cut_bonds(cracks, bonds, cloud);
    let touched = |is_cut: &[bool]| count_touched_bonds(&surfaces, bonds, cloud, is_cut);
    Ok(Precracked::new(&surfaces, (cloud, bonds), cut, touched))
}

/// Points and corrected bonds with their rigidities.
fn bond_system(
    setup: &Setup<3>,
    cloud: PointCloud<3>,
    bonds: BondSet<3>,
    stiffness: BondStiffness,
    correction: &Correction,
) -> Result<BondSystem<3>, SetupError> {
    let element = setup.law.element();
    let (alpha, omega) = (&correction.length_factor, &correction.domain_factor);
    let factors = (omega.as_slice(), stiffness.axial.as_slice());
    require_factors(&*setup.body, &cloud, factors, &bonds.ends)?;
    let system = BondSystem::new(cloud, bonds, element, stiffness, alpha.clone(), omega);
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
    let stiffness = stiffness.with_shear(&correction.shear_ratio);
    Corrected {
        energy_ratios: formulation.energy_ratios(&bonds, &stiffness, &correction),
        bonds,
        stiffness,
        correction,
    }
}
