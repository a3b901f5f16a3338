//! The discrete model in summaries and reports, for all analyses.

use ligament_model::correction::{CorrectionReport, DomainReport};
use ligament_model::{ElementKind, Isotropic, Plane};
use ligament_output::summary::{CorrectionSummary, ModelSummary, ScatterSummary, Spread};

use ligament::Model;
use ligament::setup::{
    Alpha, Analysis, Calibration, Correction, Form, PoissonForm, Setup, Surface,
};
use ligament_case::case::{CaseFile, Word, word_of};
use ligament_model::law::rotational::{RotationalScale, RotationalStiffness};
use ligament_model::material::Space;
use ligament_model::scatter::{Factors, seed_at};
use ligament_model::subdomain::Subdomain;

/// First line of the report on a case: its title.
pub fn heading(title: &str) -> &str {
    if title.is_empty() {
        "untitled case"
    } else {
        title
    }
}

/// Statistics of the points of a model for the summary.
#[derive(Debug, Clone)]
pub struct PointStatistics {
    no_fail_points: usize,
    volume: f64,
    horizon: Spread,
    energy_ratios: Vec<Spread>,
    scatter: Vec<ScatterSummary>,
}

impl PointStatistics {
    /// Sums and extremes over the points of all processes; collective.
    pub fn new(model: &Model) -> Self {
        let subdomain = &model.system.subdomain;
        let owned = || subdomain.owned().map(|point| point as usize);
        let (volumes, no_fail) = (&model.system.volumes, &model.fixed.no_fail);
        let spread = |values: &[f64]| Spread::over_points(subdomain, values);
        let ratios = model.fixed.energy_ratios.iter();
        Self {
            no_fail_points: subdomain.count(owned().filter(|&it| no_fail[it]).count()),
            volume: subdomain.sum(owned().map(|it| volumes[it]).sum()),
            horizon: spread(&model.fixed.horizon),
            energy_ratios: ratios.map(|it| spread(&it.at_points)).collect(),
            scatter: scatter(model),
        }
    }
}

/// Summary of a model.
pub(super) fn model_summary(
    case: &CaseFile,
    model: &Model,
    of_points: PointStatistics,
) -> ModelSummary {
    ModelSummary {
        title: case.case.title.clone(),
        version: env!("CARGO_PKG_VERSION").into(),
        analysis: analysis_words(&model.setup),
        formulation: formulation_words(model),
        points: model.system.subdomain.n_all(),
        bonds: model.counts.bonds,
        cut_bonds: model.cut_bonds(),
        far_points: model.counts.far_points,
        no_fail_points: of_points.no_fail_points,
        volume: of_points.volume,
        horizon: of_points.horizon,
        family: family(model),
        correction: correction(model, of_points.energy_ratios),
        scatter: scatter_summary(of_points.scatter),
    }
}

/// Summary of the first property that varies, which holds the summaries of the others; `None` where no property varies.
fn scatter_summary(all: Vec<ScatterSummary>) -> Option<ScatterSummary> {
    let mut all = all.into_iter();
    let first = all.next()?;
    Some(ScatterSummary {
        beside: all.collect(),
        ..first
    })
}

/// Summary of each property of a model that varies at random; collective.
pub fn scatter(model: &Model) -> Vec<ScatterSummary> {
    let factors = model.fixed.scatter.iter().enumerate();
    let seed = |place| seed_at(&model.setup.scatter, place);
    let subdomain = &model.system.subdomain;
    factors
        .map(|(place, it)| scatter_of(subdomain, it, seed(place)))
        .collect()
}

fn scatter_of(
    subdomain: &Subdomain,
    Factors { of, at_points }: &Factors,
    seed: u64,
) -> ScatterSummary {
    let factor = Spread::over_points(subdomain, at_points);
    let owned = subdomain.owned().map(|point| at_points[point as usize]);
    let squares = owned.map(|it| (it - factor.mean).powi(2));
    let variance = subdomain.sum(squares.sum()) / subdomain.n_all().max(1) as f64;
    ScatterSummary {
        of: word_of(of).into(),
        seed,
        factor,
        deviation: variance.sqrt() / factor.mean,
        beside: Vec::new(),
    }
}

/// Description of the computed quantity and the space.
pub fn analysis_words(setup: &Setup) -> String {
    let breaks = !setup.criteria.is_empty();
    let what = match &setup.analysis {
        Analysis::Stepped(_) => match setup.n_steps() {
            Some(1) => "growth of cracks in one load step".to_owned(),
            Some(steps) => format!("growth of cracks in {steps} load steps"),
            None => "growth of cracks in load steps".to_owned(),
        },
        Analysis::Event(_) => {
            "growth of cracks on the exact path, from breakage to breakage".to_owned()
        }
        Analysis::Elastic { .. } => "elastic deformation, without breakage".to_owned(),
        Analysis::Modal(_) => "natural frequencies and modes, without breakage".to_owned(),
        Analysis::Motion(_) if breaks => "growth of cracks in a motion".to_owned(),
        Analysis::Motion(_) => "elastic motion, without breakage".to_owned(),
    };
    let space = match setup.space() {
        Space::Plane(Plane::Stress) => "plane stress",
        Space::Plane(Plane::Strain) => "plane strain",
        Space::Solid => "a solid",
    };
    format!("{what}; {space}")
}

/// Description of the law and the corrections of the bonds.
fn formulation_words(model: &Model) -> String {
    let correction = correction_line(&model.setup.correction, model.correction.as_ref());
    format!("{}; {correction}", formulation_line(&model.setup))
}

/// Smallest, mean and largest number of bonds of a point.
pub fn family(model: &Model) -> Spread {
    let [min, max] = model.counts.of_points.map(|it| it as f64);
    let n_points = model.system.subdomain.n_all() - model.counts.far_points;
    Spread {
        min,
        mean: (2 * model.counts.bonds) as f64 / n_points.max(1) as f64,
        max,
    }
}

/// Summary of the correction of a model.
fn correction(model: &Model, energy_ratios: Vec<Spread>) -> CorrectionSummary {
    let report = model.correction.as_ref();
    let domain = report.and_then(CorrectionReport::domain);
    let patch = report.and_then(CorrectionReport::patch);
    let (factor_min, factor_max) = model.correction_range;
    CorrectionSummary {
        alpha: word_of(&model.setup.correction.alpha).into(),
        surface: word_of(&Word(model.setup.correction.surface)).into(),
        sweeps: domain.map(|it| it.sweeps),
        converged: domain.map(|it| it.converged),
        last_change: domain.map(|it| it.last_change),
        factor_min,
        factor_max,
        largest_residual: domain.map(|it| it.largest_residual),
        newton_steps: patch.map(|it| it.steps),
        left: patch.map(|it| it.left),
        energy_ratios,
    }
}

/// One-line description of the law of the bonds.
pub fn formulation_line(setup: &Setup) -> String {
    let is_solid = setup.space() == Space::Solid;
    let (name, options) = (setup.law.name(), setup.law.options);
    let regions = setup.materials.iter();
    let splits = regions.map(|it| setup.law.split(&it.material, setup.space()));
    let are_split = || splits.clone().all(|it| it.is_some_and(|it| it.is_split()));
    let unknowns = match setup.law.element() {
        ElementKind::Beam if is_solid && are_split() => "three displacements per point",
        ElementKind::Beam if are_split() => "two displacements per point",
        ElementKind::Beam if is_solid => "three displacements and three rotations per point",
        ElementKind::Spring if is_solid => "three displacements per point",
        ElementKind::Beam => "two displacements and a rotation per point",
        ElementKind::Spring => "two displacements per point",
        ElementKind::Imaginary => {
            "two displacements per point, the strains of a rectangle around each bond"
        }
        ElementKind::TrueStrain => {
            "two displacements per point, the true strains of a rectangle around each bond"
        }
        ElementKind::Pairwise => {
            "two displacements per point, the strains of a rectangle around each bond, the printed forces on its ends"
        }
    };
    let constants = match options.calibration {
        Some(Calibration::Discrete) => ", constants from sums over the families",
        Some(Calibration::Integral) | None => "",
    };
    let rotational = match options.rotational_stiffness {
        Some(RotationalStiffness::Decaying) => ", k_theta = k_t l (1 - l/H)/2",
        Some(RotationalStiffness::Quarter) => ", k_theta = k_t l/4",
        Some(RotationalStiffness::Beam) => ", k_theta = k_t l/12",
        Some(RotationalStiffness::Zero) => ", k_theta = 0",
        None => "",
    };
    let scale = match setup.rotational_scale {
        RotationalScale::Factor(1.0) => String::new(),
        RotationalScale::Factor(factor) => format!(", k_theta {factor} times that"),
        RotationalScale::CosseratLength(length) => {
            format!(", k_theta in proportion for a Cosserat length of {length:.4e} m")
        }
    };
    format!(
        "law {name}{}: {unknowns}{constants}{rotational}{scale}{}",
        match options.form {
            Some(Form::Rows) => " (rows)",
            Some(Form::Pairwise) => " (pairwise)",
            Some(Form::Full) | None => "",
        },
        poisson_words(setup)
    )
}

/// What carries the Poisson's ratio of a setup where that is above the ratio of central forces; empty elsewhere.
fn poisson_words(setup: &Setup) -> String {
    let limit = Isotropic::central_force_poisson(setup.space());
    if setup.moduli_of_cells().is_some() {
        return format!("; cells carry the volumetric stiffness above Poisson's ratio {limit:.4}");
    }
    let mut materials = setup.materials.iter();
    let is_above = materials
        .any(|it| (it.material.elasticity.isotropic()).is_some_and(|it| it.poisson > limit));
    match setup.law.options.poisson {
        Some(PoissonForm::Bonds) if is_above => {
            "; bonds with a negative shear stiffness carry Poisson's ratio".to_owned()
        }
        _ => String::new(),
    }
}

/// One-line description of the corrections of the bonds, and of the convergence of the iterated correction.
pub fn correction_line(correction: &Correction, report: Option<&CorrectionReport>) -> String {
    let alpha = match correction.alpha {
        Alpha::None => "no length factor",
        Alpha::PartialVolume => "length factor by partial volume",
        Alpha::Length => "length factor by length",
    };
    let surface = match correction.surface {
        Surface::None => "surface correction: none".to_owned(),
        Surface::Volume => "surface correction: volume".to_owned(),
        Surface::Domain(_) | Surface::Patch(_) => match report {
            Some(CorrectionReport::Domain(report)) => domain_correction(report),
            Some(CorrectionReport::Patch(report)) => format!(
                "surface correction: patch (patch-test error {:.1e})",
                report.left
            ),
            None => String::new(),
        },
    };
    format!("{alpha}, {surface}")
}

fn domain_correction(report: &DomainReport) -> String {
    let verdict = if report.converged {
        "converged"
    } else {
        "NOT converged"
    };
    format!(
        "surface correction: domain ({verdict} in {} sweeps, energy error {:.1e})",
        report.sweeps, report.largest_residual
    )
}
