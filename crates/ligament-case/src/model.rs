//! The method, first page: from a mesh or a lattice to the discrete model. The second is [`crate::run`].

use std::sync::Arc;

use ligament_model::bonds::hole::bonds_across;
use ligament_model::bonds::precrack::{count_touched_bonds, cut_bonds};
use ligament_model::correction::{Continuum, Correction, CorrectionReport, energy_ratios};
use ligament_model::failure::Criteria;
use ligament_model::{BondSet, BondStiffness, BondSystem, Horizons, PointCloud};
use ligament_output::results::{Absence, AbsentBond, FixedFields};

use crate::body::{self, Body};
use crate::case::{CaseError, CaseFile, CorrectionDomain};
use crate::failure;
use crate::formulation;
use crate::progress::Progress;
use crate::resolve;
use crate::stages::Stages;
use crate::summary;
use crate::warnings;

/// The discrete model of a case: all that comes before the first equation.
#[derive(Debug)]
pub struct Model {
    /// The body.
    pub body: Box<dyn Body>,
    /// Points and corrected bonds.
    pub system: Arc<BondSystem>,
    /// Fields that a run does not change.
    pub fixed: FixedFields,
    /// How the domain correction went, where there was one.
    pub correction: Option<CorrectionReport>,
    /// Smallest and largest Omega.
    pub correction_range: (f64, f64),
    /// When its bonds fail.
    pub criteria: Arc<Criteria>,
    /// Number of pairs of points that would be bonded but for a hole between them.
    pub across_holes: usize,
    /// Number of bonds that pre-cracks cut.
    pub cut_bonds: usize,
    /// Number of points whose bonds never break.
    pub no_fail_points: usize,
    /// What the user should know.
    pub warnings: Vec<String>,
}

/// Mesh or lattice in, bond system out.
pub fn build_model(
    case: &CaseFile,
    stages: &mut Stages,
    progress: &Progress,
) -> anyhow::Result<Model> {
    let body = body::of_case(case, stages)?;
    model_of(case, body, stages, progress)
}

/// A body in, bond system out.
pub fn model_of(
    case: &CaseFile,
    body: Box<dyn Body>,
    stages: &mut Stages,
    progress: &Progress,
) -> anyhow::Result<Model> {
    let material_of_cell = resolve::material_of_cell(case, &*body)?;
    let thickness = case.case.body.thickness();
    let cloud = stages.time("points", || {
        body.cloud(thickness, &material_of_cell, case.case.materials.len())
    });
    let horizons = resolve::horizons(case, &cloud);
    let (bonds, mut absent) = stages.time("bonds", || {
        around_holes(BondSet::search(&cloud, &horizons), &*body, &cloud)
    });
    let across_holes = absent.len();
    require_neighbours(case, &*body, &bonds)?;
    progress.stage(&format!("{} points, {} bonds", cloud.len(), bonds.len()));
    let precracks = resolve::precracks(case);
    let (is_cut, touched, precrack_share) = stages.time("pre-cracks", || {
        let is_cut = cut_bonds(&precracks, &bonds, &cloud);
        let touched = count_touched_bonds(&precracks, &bonds, &cloud, &is_cut);
        let precrack_share = precrack_share(&bonds, &is_cut);
        (is_cut, touched, precrack_share)
    });
    absent.extend(absent_bonds(&bonds, &is_cut, Absence::PreCrack));
    absent.sort_unstable_by_key(|it| it.ends);
    let corrected = stages.time("correction", || {
        correct(case, &cloud, &horizons, bonds, &is_cut)
    });
    let Corrected {
        bonds,
        stiffness,
        correction,
        energy_ratios,
    } = corrected;
    let report = correction.report;
    progress.stage(&summary::correction_line(case, report.as_ref()));

    let no_fail = resolve::no_fail(case, &*body, &cloud)?;
    let correction_range = correction.domain_factor_range();
    let fixed = FixedFields {
        horizon: horizons.radius,
        precrack_share,
        energy_ratios,
        domain_factor: correction.domain_factor,
        no_fail,
        absent,
    };
    let (alpha, omega) = (correction.length_factor, &fixed.domain_factor);
    let system = stages.time("rigidities", || {
        let element = formulation::element(&case.case.model);
        BondSystem::new(cloud, bonds, element, stiffness, alpha, omega)
    });
    let criteria = stages.time("criteria", || {
        failure::criteria(case, &system, &fixed.no_fail)
    })?;
    Ok(Model {
        warnings: warnings::of_model(
            case,
            &*body,
            &system.cloud.spacing,
            report.as_ref(),
            &fixed,
            touched,
        ),
        correction: report,
        correction_range,
        across_holes,
        cut_bonds: is_cut.iter().filter(|cut| **cut).count(),
        no_fail_points: fixed.no_fail.iter().filter(|marked| **marked).count(),
        body,
        system: Arc::new(system),
        fixed,
        criteria: Arc::new(criteria),
    })
}

/// The bonds without those across holes of the body, and those.
fn around_holes(bonds: BondSet, body: &dyn Body, cloud: &PointCloud) -> (BondSet, Vec<AbsentBond>) {
    if body.holes().is_empty() {
        return (bonds, Vec::new());
    }
    let crosses = bonds_across(body.holes(), &bonds, cloud);
    let keep: Vec<bool> = crosses.iter().map(|crosses| !crosses).collect();
    let absent = absent_bonds(&bonds, &crosses, Absence::Hole);
    (bonds.retained(&keep), absent)
}

/// The bonds for which `is_absent` (n_bonds) is true, as what is none.
fn absent_bonds(bonds: &BondSet, is_absent: &[bool], absence: Absence) -> Vec<AbsentBond> {
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

/// The error of points that have no neighbour at all: no correction gives them a stiffness.
fn require_neighbours(case: &CaseFile, body: &dyn Body, bonds: &BondSet) -> Result<(), CaseError> {
    let lone = bonds.lone_points();
    let Some(&first) = lone.first() else {
        return Ok(());
    };
    let reason = format!(
        "{} of {} points have no neighbour in their horizon (the first is {}): they need a larger horizon, or must go",
        lone.len(),
        bonds.incidence.n_points(),
        body.place(first)
    );
    Err(case.error("model", reason))
}

/// Bonds that pre-cracks leave, with their stiffness and correction.
struct Corrected {
    bonds: BondSet,
    stiffness: BondStiffness,
    correction: Correction,
    energy_ratios: [Vec<f64>; 4],
}

/// Gives the bonds of the whole body their stiffness and correction and then drops those that pre-cracks cut, or the other
/// way round if the case says so.
fn correct(
    case: &CaseFile,
    cloud: &PointCloud,
    horizons: &Horizons,
    bonds: BondSet,
    is_cut: &[bool],
) -> Corrected {
    let survives: Vec<bool> = is_cut.iter().map(|cut| !cut).collect();
    let any_is_cut = is_cut.contains(&true);
    let cut_first = case.case.correction.domain == CorrectionDomain::Cracked;
    let bonds = if cut_first && any_is_cut {
        bonds.retained(&survives)
    } else {
        bonds
    };
    let alpha = formulation::alpha(case, &bonds, cloud);
    let stiffness = formulation::stiffness(case, &bonds, cloud, &alpha);
    let correction = formulation::correction(case, &bonds, cloud, horizons, &stiffness, alpha);
    let (materials, plane) = (resolve::materials(case), resolve::plane(case));
    let continuum = Continuum {
        materials: &materials,
        plane,
    };
    let energy_ratios = energy_ratios(&bonds, cloud, &stiffness, &correction, continuum);
    let corrected = Corrected {
        bonds,
        stiffness,
        correction,
        energy_ratios,
    };
    if cut_first || !any_is_cut {
        return corrected;
    }
    Corrected {
        bonds: corrected.bonds.retained(&survives),
        stiffness: corrected.stiffness.retained(&survives),
        correction: corrected.correction.retained(&survives),
        energy_ratios: corrected.energy_ratios,
    }
}

/// Share of the bonds of each point that pre-cracks cut, by number, shape (n_points).
fn precrack_share(bonds: &BondSet, is_cut: &[bool]) -> Vec<f64> {
    let n_points = bonds.incidence.n_points();
    if !is_cut.contains(&true) {
        return vec![0.0; n_points];
    }
    (0..n_points as u32)
        .map(|point| {
            let family = bonds.incidence.at(point);
            let cut = family.iter().filter(|bond| is_cut[**bond as usize]).count();
            cut as f64 / family.len().max(1) as f64
        })
        .collect()
}
