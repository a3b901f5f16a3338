//! The method, first page: from a mesh or a lattice to the discrete model. The second is [`crate::run`].

use std::sync::Arc;

use ligament_analysis::ranks::Together;
use ligament_mesh::Mesh;
use ligament_model::bonds::hole::bonds_across;
use ligament_model::bonds::outline::{PlaneOutline, bonds_outside, spacing_inside};
use ligament_model::bonds::parts::{LatticeCells, PlaneCells};
use ligament_model::bonds::precrack::{PreCrack, count_touched_bonds, cut_bonds};
use ligament_model::contact::Faces;
use ligament_model::correction::patch::CellForces;
use ligament_model::correction::{Correction, CorrectionReport};
use ligament_model::failure::Criteria;
use ligament_model::material::Stiffness;
use ligament_model::portion::{Exchange, Portion};
use ligament_model::{
    Absence, AbsentBond, BondSet, BondStiffness, BondSystem, EnergyRatio, FixedFields, PointCloud,
    System,
};

use crate::body::{Body, Origin};
use crate::counts::{self, BondCounts};
use crate::error::SetupError;
use crate::faces;
use crate::formulation::{self, Formulation};
use crate::loading;
use crate::plausibility;
use crate::setup::{Analysis, CorrectionDomain, Dim, Dimension, Law, Setup};
use crate::soundness::{
    forbid_overlap, require_connected, require_distinct, require_factors, require_numbers,
};
use crate::stage::{Finding, StageWatcher, stage};
use crate::warning::{self, Warning};

/// The discrete model in the plane, or for D = 3 in space: all that comes before the first equation.
#[derive(Debug)]
pub struct Model<const D: usize = 2>
where
    Dim: Dimension<D>,
{
    /// Setup that the model was built from.
    pub setup: Setup<D>,
    /// Points and corrected bonds.
    pub system: Arc<dyn System<D>>,
    /// Fields that an analysis does not change.
    pub fixed: FixedFields,
    /// Report on the domain correction, where there was one.
    pub correction: Option<CorrectionReport>,
    /// Smallest and largest Omega.
    pub correction_range: (f64, f64),
    /// Numbers of bonds.
    pub counts: BondCounts,
    /// Failure criteria of the bonds.
    pub criteria: Arc<Criteria>,
    /// What the user should know.
    pub warnings: Vec<Warning>,
}

impl<const D: usize> Model<D>
where
    Dim: Dimension<D>,
{
    /// Builds the model of a setup, on the threads of the caller; where its solver has several processes, they share the bonds out.
    ///
    /// # Errors
    ///
    /// If a field of the setup is wrong.
    pub fn build(setup: Setup<D>, watcher: &mut dyn StageWatcher) -> Result<Self, SetupError>
    where
        Dim: Discretises<D>,
    {
        Dim::model(setup, watcher)
    }
}

/// The processes that share the bonds of a setup out; none where each has all of them. Elements that lean on bonds beside them, faces that
/// close and natural modes ask for the whole body.
pub fn sharing<const D: usize>(setup: &Setup<D>) -> Option<&'static dyn Exchange>
where
    Dim: Dimension<D>,
{
    let Together(ranks) = setup.solver.ranks?;
    let needs_all = setup.closing
        || matches!(setup.law, Law::MbbPd { .. })
        || matches!(setup.analysis, Analysis::Modal(_));
    (!needs_all).then_some(ranks)
}

/// The part of this process in the points of a setup that several share out; none where it has all of them.
pub(crate) fn portion_of<const D: usize>(setup: &Setup<D>, cloud: &PointCloud<D>) -> Option<Portion>
where
    Dim: Dimension<D>,
{
    sharing(setup).map(|exchange| cloud.portion_of(exchange))
}

/// What makes models in D dimensions.
pub trait Discretises<const D: usize>
where
    Dim: Dimension<D>,
{
    /// Builds the model of a setup, of whose points this process has a part or all of them.
    ///
    /// # Errors
    ///
    /// If a field of the setup is wrong.
    fn model(setup: Setup<D>, watcher: &mut dyn StageWatcher) -> Result<Model<D>, SetupError>;

    /// Forces of uniform strains on the points of a cloud, as the cells of the body know them, with the constants that the law makes of
    /// those of each cell's material (n_cells).
    fn cell_forces(
        setup: &Setup<D>,
        cloud: &PointCloud<D>,
        material_of_cell: &[u32],
    ) -> CellForces<D>;

    /// Stiffness of each material with the constants that the law makes of its own (n_materials), Pa.
    fn stiffness(setup: &Setup<D>) -> Vec<Stiffness>;
}

impl Discretises<2> for Dim {
    fn model(setup: Setup, watcher: &mut dyn StageWatcher) -> Result<Model, SetupError> {
        Model::in_plane(setup, watcher)
    }

    fn cell_forces(setup: &Setup, cloud: &PointCloud, material_of_cell: &[u32]) -> CellForces {
        formulation::cell_forces(setup, cloud, material_of_cell)
    }

    fn stiffness(setup: &Setup) -> Vec<Stiffness> {
        formulation::stiffness(setup)
    }
}

impl Model {
    /// Builds the model of a setup in the plane.
    fn in_plane(setup: Setup, watcher: &mut dyn StageWatcher) -> Result<Self, SetupError> {
        setup.check()?;
        let material_of_cell = loading::material_of_cell(&setup)?;
        let cloud = stage(watcher, "points", || points(&setup, &material_of_cell))?;
        let horizons = setup.horizon.of_points(&cloud);
        let (bonds, absent) = stage(watcher, "bonds", || {
            let all = BondSet::search(&cloud, &horizons);
            let (bonds, absent) = inside_body(&setup, all, &cloud);
            (composed(&setup, bonds, &cloud, &material_of_cell), absent)
        });
        require_connected(&setup, &cloud, &horizons, &bonds)?;
        watcher.found(&counts::finding(&cloud, &bonds, &absent));
        let crossed = stage(watcher, "pre-cracks", || {
            precracked(&setup.precracks, &bonds, &cloud)
        });
        let absent = with_cut(absent, &bonds, &crossed.is_cut);
        let Corrected {
            bonds,
            stiffness,
            correction,
            energy_ratios,
            faces,
        } = stage(watcher, "correction", || {
            let formulation = Formulation::new(&setup, &cloud, &horizons, &material_of_cell);
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
            bond_system(&setup, cloud, bonds, stiffness, &correction, faces)
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

impl<const D: usize> Model<D>
where
    Dim: Dimension<D>,
{
    /// Number of pairs of points that would be bonded but for a void of the body between them.
    pub fn across_voids(&self) -> usize {
        self.counts.across_voids
    }

    /// Number of bonds that pre-cracks cut.
    pub fn cut_bonds(&self) -> usize {
        self.counts.cut
    }

    /// Number of points whose bonds never break.
    pub fn no_fail_points(&self) -> usize {
        self.fixed.no_fail.iter().filter(|marked| **marked).count()
    }

    /// The body.
    pub fn body(&self) -> &dyn Body<D> {
        &*self.setup.body
    }
}

/// The points of the body, with the index of the material of each cell (n_cells), and the part of this process in them.
fn points(setup: &Setup, material_of_cell: &[u32]) -> Result<PointCloud, SetupError> {
    let cloud = all_points(setup, material_of_cell)?;
    let portion = portion_of(setup, &cloud);
    Ok(PointCloud { portion, ..cloud })
}

/// The points of the body, with the index of the material of each cell (n_cells).
fn all_points(setup: &Setup, material_of_cell: &[u32]) -> Result<PointCloud, SetupError> {
    let n_materials = setup.materials.len();
    let (body, thickness) = (&setup.body, setup.thickness());
    let cloud = body.cloud(thickness, material_of_cell, n_materials);
    require_distinct(&**body, &cloud)?;
    forbid_overlap(&**body, &cloud)?;
    if setup.bonds_through_voids || body.cells().is_empty() {
        return Ok(cloud);
    }
    let outline = PlaneOutline::of_cells(body.cells(), &cloud);
    Ok(PointCloud {
        spacing: spacing_inside(&outline, body.cells(), &cloud),
        ..cloud
    })
}

/// What pre-cracks do to the bonds of a body.
pub(crate) struct Precracked {
    /// Whether a pre-crack cuts each bond, shape (n_bonds).
    pub(crate) is_cut: Vec<bool>,
    /// Number of the bonds that only touch an end of one.
    pub(crate) touched: usize,
    /// Indices of the pre-cracks that cut no bond.
    pub(crate) idle: Vec<usize>,
    /// Share of its bonds that each point loses, shape (n_points).
    pub(crate) share: Vec<f64>,
}

impl Precracked {
    /// What some pre-cracks do, with the bonds that they and each of them `cut` (n_bonds), and the number of those that they only touch.
    pub(crate) fn new<C, const D: usize>(
        cracks: &[C],
        (cloud, bonds): (&PointCloud<D>, &BondSet<D>),
        cut: impl Fn(&[C]) -> Vec<bool>,
        touched: impl Fn(&[bool]) -> usize,
    ) -> Self {
        let is_cut = cut(cracks);
        let count = |is_cut: &[bool]| cloud.total(is_cut.iter().filter(|it| **it).count());
        let is_idle = |index: &usize| match cracks {
            [_] => count(&is_cut) == 0,
            _ => count(&cut(&cracks[*index..=*index])) == 0,
        };
        Self {
            idle: (0..cracks.len()).filter(is_idle).collect(),
            touched: touched(&is_cut),
            share: precrack_share(cloud, bonds, &is_cut),
            is_cut,
        }
    }
}

/// What the pre-cracks of a body in the plane do to its bonds.
fn precracked(precracks: &[PreCrack], bonds: &BondSet, cloud: &PointCloud) -> Precracked {
    let cut = |cracks: &[PreCrack]| cut_bonds(cracks, bonds, cloud);
    let touched = |is_cut: &[bool]| count_touched_bonds(precracks, bonds, cloud, is_cut);
    Precracked::new(precracks, (cloud, bonds), cut, touched)
}

/// Points and corrected bonds with the rigidities of their elements.
fn bond_system(
    setup: &Setup,
    cloud: PointCloud,
    bonds: BondSet,
    stiffness: BondStiffness,
    correction: &Correction,
    faces: Faces,
) -> Result<BondSystem, SetupError> {
    let element = setup.law.element();
    let (alpha, omega) = (&correction.length_factor, &correction.domain_factor);
    let factors = (omega.as_slice(), stiffness.axial.as_slice());
    require_factors(&*setup.body, &cloud, factors, &bonds.ends)?;
    let system = BondSystem::new(cloud, bonds, element, stiffness, alpha.clone(), omega);
    require_numbers(&*setup.body, &system)?;
    Ok(system.with_faces(faces))
}

/// The bonds, followed through the cells of a body of several materials.
fn composed(setup: &Setup, bonds: BondSet, cloud: &PointCloud, materials: &[u32]) -> BondSet {
    match (setup.body.origin(), cloud.lattice_cell) {
        (Origin::Mesh(Mesh { cells, .. }), _) => {
            let cells = PlaneCells {
                cells,
                cloud,
                materials,
            };
            bonds.through(&cells, cloud)
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
fn inside_body(setup: &Setup, bonds: BondSet, cloud: &PointCloud) -> (BondSet, Vec<AbsentBond>) {
    let (holes, cells) = (setup.body.holes(), setup.body.cells());
    let crosses = if !holes.is_empty() {
        bonds_across(holes, &bonds, cloud)
    } else if setup.bonds_through_voids || cells.is_empty() {
        return (bonds, Vec::new());
    } else {
        bonds_outside(&PlaneOutline::of_cells(cells, cloud), &bonds, cloud)
    };
    if !crosses.contains(&true) {
        return (bonds, Vec::new());
    }
    let keep: Vec<bool> = crosses.iter().map(|crosses| !crosses).collect();
    let absent = absent_bonds(&bonds, &crosses, Absence::Void);
    (bonds.retained(&keep), absent)
}

/// Pairs that are no bonds, and those that pre-cracks cut (n_bonds), in the order of their ends.
pub(crate) fn with_cut<const D: usize>(
    mut absent: Vec<AbsentBond>,
    bonds: &BondSet<D>,
    is_cut: &[bool],
) -> Vec<AbsentBond> {
    absent.extend(absent_bonds(bonds, is_cut, Absence::PreCrack));
    absent.sort_unstable_by_key(|it| it.ends);
    absent
}

/// The bonds for which `is_absent` (n_bonds) is true, as what is none.
pub(crate) fn absent_bonds<const D: usize>(
    bonds: &BondSet<D>,
    is_absent: &[bool],
    absence: Absence,
) -> Vec<AbsentBond> {
    (bonds.ends.iter().zip(&bonds.horizon))
        .zip(is_absent)
        .filter(|(_, is_absent)| **is_absent)
        .map(|((&ends, &horizon), _)| AbsentBond {
            ends,
            horizon,
            absence,
        })
        .collect()
}

/// Bonds that pre-cracks leave, with their stiffness and correction.
struct Corrected {
    bonds: BondSet,
    stiffness: BondStiffness,
    correction: Correction,
    energy_ratios: Vec<EnergyRatio>,
    faces: Faces,
}

/// Gives the bonds of the whole body their stiffness and correction and then drops those that pre-cracks cut, or the other
/// way round if the setup says so.
fn correct(formulation: &Formulation<'_>, bonds: BondSet, is_cut: &[bool]) -> Corrected {
    let Formulation { setup, cloud, .. } = *formulation;
    let survives: Vec<bool> = is_cut.iter().map(|cut| !cut).collect();
    let any_is_cut = is_cut.contains(&true);
    let cut_first = setup.correction.domain == CorrectionDomain::Cracked;
    let numbered = bonds.ends.iter().zip(is_cut);
    let cut: Vec<[u32; 2]> = (numbered.filter(|(_, is_cut)| **is_cut))
        .map(|(ends, _)| *ends)
        .collect();
    let corrected = of_bonds(
        formulation,
        if cut_first && any_is_cut {
            bonds.retained(&survives)
        } else {
            bonds
        },
    );
    if cut_first || !any_is_cut {
        let faces = faces::faces(setup, cloud, &corrected.bonds, &cut, None);
        return Corrected { faces, ..corrected };
    }
    let rigidities = setup.closing.then(|| {
        let (bonds, stiffness) = (&corrected.bonds, &corrected.stiffness);
        faces::rigidities(formulation, bonds, stiffness, &corrected.correction, is_cut)
    });
    let bonds = corrected.bonds.retained(&survives);
    Corrected {
        faces: faces::faces(setup, cloud, &bonds, &cut, rigidities.as_ref()),
        bonds,
        stiffness: corrected.stiffness.retained(&survives),
        correction: corrected.correction.retained(&survives),
        energy_ratios: corrected.energy_ratios,
    }
}

/// Some bonds with their stiffness and correction, and no faces.
fn of_bonds(formulation: &Formulation<'_>, bonds: BondSet) -> Corrected {
    let alpha = formulation.alpha(&bonds);
    let stiffness = formulation.stiffness(&bonds, &alpha);
    let correction = formulation.correction(&bonds, &stiffness, alpha);
    let stiffness = stiffness.with_shear(&correction.shear_ratio);
    Corrected {
        energy_ratios: formulation.energy_ratios(&bonds, &stiffness, &correction),
        bonds,
        stiffness,
        correction,
        faces: Faces::default(),
    }
}

/// Share of the bonds of each point that pre-cracks cut, by number, shape (n_points).
fn precrack_share<const D: usize>(
    cloud: &PointCloud<D>,
    bonds: &BondSet<D>,
    is_cut: &[bool],
) -> Vec<f64> {
    let n_cut = is_cut.iter().filter(|is_cut| **is_cut).count();
    if cloud.total(n_cut) == 0 {
        return vec![0.0; cloud.len()];
    }
    let shares = cloud.over_families(|point| {
        let family = bonds.incidence.at(point);
        let cut = family.iter().filter(|bond| is_cut[**bond as usize]).count();
        [cut as f64 / family.len().max(1) as f64]
    });
    shares.into_iter().map(|[share]| share).collect()
}

/// What a correction leaves in the fields of a model, with the points where bonds never fail (n_points); the other fields are empty.
pub(crate) fn of_correction(correction: &Correction, no_fail: Vec<bool>) -> FixedFields {
    FixedFields {
        horizon: Vec::new(),
        precrack_share: Vec::new(),
        energy_ratios: Vec::new(),
        domain_factor: correction.domain_factor.clone(),
        shear_ratio: correction.shear_ratio.clone(),
        patch_residual: correction.patch_residual().to_vec(),
        no_fail,
        scatter: None,
        absent: Vec::new(),
    }
}

/// What the user should know of a model, with the pre-cracks that cut no bond and the number of the bonds that they only touch.
pub(crate) fn warnings<const D: usize>(
    (setup, cloud): (&Setup<D>, &PointCloud<D>),
    report: Option<&CorrectionReport>,
    fixed: &FixedFields,
    criteria: &Criteria,
    (idle, touched): (Vec<usize>, usize),
) -> Vec<Warning>
where
    Dim: Dimension<D>,
{
    let implausible = plausibility::of_model(setup, cloud, criteria, idle).into_iter();
    let of_model = warning::of_model(setup, &cloud.spacing, report, fixed, touched);
    implausible
        .map(Warning::Implausible)
        .chain(of_model)
        .collect()
}

/// Smallest and largest Omega of the bonds of a body.
pub(crate) fn correction_range<const D: usize>(
    correction: &Correction,
    cloud: &PointCloud<D>,
) -> (f64, f64) {
    let (smallest, largest) = correction.domain_factor_range();
    (-cloud.largest(-smallest), cloud.largest(largest))
}
