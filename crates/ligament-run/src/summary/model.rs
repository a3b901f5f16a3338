//! The discrete model in numbers and words, whatever is then done with it.

use ligament_model::ElementKind;
use ligament_model::correction::{CorrectionReport, DomainReport};
use ligament_model::scatter::Scattered;
use serde::Serialize;

use ligament::Model;
use ligament::setup::{Alpha, Calibration, Correction, Form, Setup, Surface};
use ligament_case::case::{CaseFile, Word};
use ligament_model::law::rotational::{RotationalScale, RotationalStiffness};
use ligament_model::material::Space;

/// The numbers of a model.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct ModelSummary {
    /// Title of the case.
    pub title: String,
    /// Version of the program.
    pub version: &'static str,
    /// Law and corrections of the bonds, in words.
    pub formulation: String,
    /// Number of points.
    pub points: usize,
    /// Number of bonds, without those that pre-cracks cut.
    pub bonds: usize,
    /// Number of bonds that pre-cracks cut.
    pub cut_bonds: usize,
    /// Number of points whose bonds never break.
    pub no_fail_points: usize,
    /// Sum of the points' volumes, m^3.
    pub volume: f64,
    /// Smallest, mean and largest horizon, m.
    pub horizon: Spread,
    /// Smallest, mean and largest number of bonds of a point.
    pub family: Spread,
    /// The corrections of the bonds.
    pub correction: CorrectionSummary,
    /// What varies at random, where anything does.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub scatter: Option<ScatterSummary>,
}

/// A property that varies at random.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct ScatterSummary {
    /// The property.
    pub of: Word<Scattered>,
    /// Seed of the random numbers.
    pub seed: u64,
    /// Factors of the points.
    pub factor: Spread,
    /// Standard deviation of the factors of the points over their mean.
    pub deviation: f64,
}

/// Range and mean of a quantity.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Spread {
    /// Smallest.
    pub min: f64,
    /// Mean.
    pub mean: f64,
    /// Largest.
    pub max: f64,
}

/// The corrections, and how the domain correction went if it is the one.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct CorrectionSummary {
    /// The factor alpha.
    pub alpha: Word<Alpha>,
    /// The correction of surfaces.
    pub surface: Word<Surface>,
    /// Sweeps.
    pub sweeps: Option<usize>,
    /// Whether it converged.
    pub converged: Option<bool>,
    /// Sum over the bonds of |change of Omega| in the last sweep.
    pub last_change: Option<f64>,
    /// Smallest Omega.
    pub factor_min: f64,
    /// Largest Omega.
    pub factor_max: f64,
    /// Largest |energy ratio - 1| of a point under uniaxial strain along x or y.
    pub largest_residual: Option<f64>,
    /// Newton steps of the patch correction.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub newton_steps: Option<usize>,
    /// Root mean square of what the patch correction leaves of its equations.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub left: Option<f64>,
    /// Energy ratios over the points: in the plane for uniaxial x, uniaxial y, biaxial and shear strain.
    pub energy_ratios: Vec<Spread>,
}

/// The first line about a case: its title.
pub fn heading(title: &str) -> &str {
    if title.is_empty() {
        "untitled case"
    } else {
        title
    }
}

impl ModelSummary {
    /// Collects the numbers.
    pub fn new(case: &CaseFile, model: &Model) -> Self {
        Self {
            title: case.case.title.clone(),
            version: env!("CARGO_PKG_VERSION"),
            formulation: formulation_words(model),
            points: model.system.n_points(),
            bonds: model.counts.bonds,
            cut_bonds: model.cut_bonds(),
            no_fail_points: model.no_fail_points(),
            volume: model.system.volumes().iter().sum(),
            horizon: Spread::over(model.fixed.horizon.iter().copied()),
            family: family(model),
            correction: CorrectionSummary::new(model),
            scatter: ScatterSummary::new(model),
        }
    }
}

impl ScatterSummary {
    /// What varies at random in a model.
    pub fn new(model: &Model) -> Option<Self> {
        let factors = &model.fixed.scatter.as_ref()?.at_points;
        let scatter = model.setup.scatter?;
        let factor = Spread::over(factors.iter().copied());
        let squares = factors.iter().map(|it| (it - factor.mean).powi(2));
        let variance = squares.sum::<f64>() / factors.len().max(1) as f64;
        Some(Self {
            of: Word(scatter.of),
            seed: scatter.seed,
            factor,
            deviation: variance.sqrt() / factor.mean,
        })
    }
}

impl Spread {
    /// Smallest, mean and largest of some values.
    pub fn over(values: impl Iterator<Item = f64> + Clone) -> Self {
        let count = values.clone().count().max(1) as f64;
        Self {
            min: values.clone().fold(f64::INFINITY, f64::min),
            mean: values.clone().sum::<f64>() / count,
            max: values.fold(f64::NEG_INFINITY, f64::max),
        }
    }
}

/// Law and corrections of the bonds, in words.
fn formulation_words(model: &Model) -> String {
    let correction = correction_line(&model.setup.correction, model.correction.as_ref());
    format!("{}; {correction}", formulation_line(&model.setup))
}

/// Numbers of bonds of the points.
pub fn family(model: &Model) -> Spread {
    let [min, max] = model.counts.of_points.map(|it| it as f64);
    Spread {
        min,
        mean: (2 * model.counts.bonds) as f64 / model.system.n_points().max(1) as f64,
        max,
    }
}

impl CorrectionSummary {
    /// The correction of a model.
    pub fn new(model: &Model) -> Self {
        let report = model.correction.as_ref();
        let domain = report.and_then(CorrectionReport::domain);
        let patch = report.and_then(CorrectionReport::patch);
        let (factor_min, factor_max) = model.correction_range;
        Self {
            alpha: Word(model.setup.correction.alpha),
            surface: Word(model.setup.correction.surface),
            sweeps: domain.map(|it| it.sweeps),
            converged: domain.map(|it| it.converged),
            last_change: domain.map(|it| it.last_change),
            factor_min,
            factor_max,
            largest_residual: domain.map(|it| it.largest_residual),
            newton_steps: patch.map(|it| it.steps),
            left: patch.map(|it| it.left),
            energy_ratios: (model.fixed.energy_ratios.iter())
                .map(|it| Spread::over(it.at_points.iter().copied()))
                .collect(),
        }
    }
}

/// The law of the bonds, in a line.
pub fn formulation_line(setup: &Setup) -> String {
    let is_solid = setup.space() == Space::Solid;
    let (name, options) = (setup.law.name(), setup.law.options);
    let unknowns = match setup.law.element() {
        ElementKind::Beam if is_solid => "three displacements and three rotations a point",
        ElementKind::Spring if is_solid => "three displacements a point",
        ElementKind::Beam => "two displacements and a rotation a point",
        ElementKind::Spring => "two displacements a point",
        ElementKind::Imaginary => {
            "two displacements a point, the strains of a rectangle around each bond"
        }
        ElementKind::TrueStrain => {
            "two displacements a point, the true strains of a rectangle around each bond"
        }
        ElementKind::Pairwise => {
            "two displacements a point, the strains of a rectangle around each bond, the printed forces on its ends"
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
        "law {name}{}: {unknowns}{constants}{rotational}{scale}",
        match options.form {
            Some(Form::Rows) => " (rows)",
            Some(Form::Pairwise) => " (pairwise)",
            Some(Form::Full) | None => "",
        }
    )
}

/// Line on the corrections of the bonds, and on how the iterated one went.
pub fn correction_line(correction: &Correction, report: Option<&CorrectionReport>) -> String {
    let alpha = match correction.alpha {
        Alpha::None => "no factor alpha",
        Alpha::PartialVolume => "alpha by partial volume",
        Alpha::Length => "alpha by length",
    };
    let surface = match correction.surface {
        Surface::None => "no surface correction".to_owned(),
        Surface::Volume => "surface correction by volume".to_owned(),
        Surface::Domain(_) | Surface::Patch(_) => match report {
            Some(CorrectionReport::Domain(report)) => domain_correction(report),
            Some(CorrectionReport::Patch(report)) => format!(
                "patch correction in {} Newton steps, uniform strains are equilibria to {:.1e}",
                report.steps, report.left
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
        "domain correction {verdict} in {} sweeps, energies right to {:.1e}",
        report.sweeps, report.largest_residual
    )
}
