//! `summary.json`: the run in numbers, and the lines that a user sees at its end.

use std::io::{self, Write};

use ligament_analysis::driver::{LoadPoint, Outcome, Rows};
use ligament_analysis::equilibrium::Stability;
use ligament_analysis::stiffness::{Costs, FactorKind, Ordering, SolverChoice, Update};
use ligament_model::ElementKind;
use ligament_model::correction::CorrectionReport;
use serde::Serialize;

use crate::case::{Alpha, Calibration, CaseFile, RotationalStiffness, Surface};
use crate::formulation;
use crate::run::Model;
use crate::stages::Stage;

/// All numbers of a run.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Summary {
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
    /// Force over displacement of the first load before the first breakage, N/m.
    pub elastic_stiffness: Option<f64>,
    /// Where the first bond breaks, from the elastic solution.
    pub first_break: Option<PathPoint>,
    /// The load step, or event of the exact path, with the largest reaction.
    pub peak: Option<PathPoint>,
    /// The largest reaction before it fell by more than [`DROP`] for the first time; on the exact path as a test sees it
    /// whose displacement only rises.
    pub first_peak: Option<PathPoint>,
    /// Broken bonds at the end.
    pub broken_bonds: usize,
    /// Load steps done, or events of the exact path, with the last state.
    pub steps: usize,
    /// Whether [`steps`](Self::steps) counts events of the exact path.
    pub exact_path: bool,
    /// Why the run ended: `termination` and `termination_message`.
    #[serde(flatten)]
    pub termination: TerminationSummary,
    /// Largest |external work - stored - released energy| over the largest external work.
    pub energy_balance_error: f64,
    /// Negative eigenvalues of the intact stiffness, and how many its rotations explain, where Poisson's ratio is large.
    pub stability: Option<StabilitySummary>,
    /// The solver and its work.
    pub solver: SolverSummary,
    /// Wall time and peak memory of the stages.
    pub stages: Vec<Stage>,
    /// What the user should know.
    pub warnings: Vec<String>,
}

/// Fall of the reaction, relative to the largest so far, that ends the first rise of the load.
pub const DROP: f64 = 0.02;

/// Warnings that are shown at the end of a run; small pieces that come loose can give hundreds.
const WARNINGS_SHOWN: usize = 10;

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
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct CorrectionSummary {
    /// The factor alpha.
    pub alpha: Alpha,
    /// The correction of surfaces.
    pub surface: Surface,
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
    /// Energy ratios over the points for uniaxial x, uniaxial y, biaxial and shear strain.
    pub energy_ratios: [Spread; 4],
}

/// A point of the force-displacement curve.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct PathPoint {
    /// Displacement of the first load, m.
    pub displacement: f64,
    /// Its force, N.
    pub reaction: f64,
    /// Load factor.
    pub load_factor: f64,
}

impl From<LoadPoint> for PathPoint {
    fn from(
        LoadPoint {
            displacement,
            reaction,
            load_factor,
        }: LoadPoint,
    ) -> Self {
        Self {
            displacement,
            reaction,
            load_factor,
        }
    }
}

/// Why the run ended.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct TerminationSummary {
    /// Short name.
    #[serde(rename = "termination")]
    pub reason: &'static str,
    /// In words.
    #[serde(rename = "termination_message")]
    pub message: String,
}

/// Inertia of the intact stiffness.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
pub struct StabilitySummary {
    /// Negative eigenvalues.
    pub negative: usize,
    /// Those expected.
    pub expected: usize,
}

impl From<Stability> for StabilitySummary {
    fn from(Stability { negative, expected }: Stability) -> Self {
        Self { negative, expected }
    }
}

/// The solver and its work.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct SolverSummary {
    /// Factorisation: `llt` or `ldlt`.
    pub factorisation: &'static str,
    /// Order of elimination: `nested-dissection` or `minimum-degree`.
    pub ordering: &'static str,
    /// What happened to the factor when bonds broke: `incremental` or `refactor`.
    pub update: &'static str,
    /// Threads.
    pub threads: usize,
    /// Factorisations.
    pub factorisations: usize,
    /// Changes of a factor in place.
    pub changes: usize,
    /// Solves, those after a change included.
    pub solves: usize,
    /// Time in numbering, pattern and symbolic analysis, s.
    pub analysis_seconds: f64,
    /// Time in assembly, s.
    pub assembly_seconds: f64,
    /// Time in factorisations, s.
    pub factorisation_seconds: f64,
    /// Time in changes in place, with the forward substitution that goes along, s.
    pub change_seconds: f64,
    /// Time in the backward substitutions that follow them, s.
    pub backward_seconds: f64,
    /// Time in other solves, s.
    pub solve_seconds: f64,
    /// Time on bonds: deformations, forces, energies, criterion, s.
    pub bonds_seconds: f64,
    /// Time in the search for loose parts, s.
    pub connectivity_seconds: f64,
}

impl Summary {
    /// Collects the numbers.
    pub fn new(
        case: &CaseFile,
        model: &Model,
        outcome: &Outcome,
        notices: Vec<String>,
        stages: &[Stage],
    ) -> Self {
        let history = &outcome.history;
        let largest = |values: &mut dyn Iterator<Item = f64>| values.fold(0.0, f64::max);
        let work = largest(&mut history.iter().map(|step| step.external_work.abs()));
        let missing = largest(
            &mut history
                .iter()
                .map(|s| (s.external_work - s.stored_energy - s.released_energy).abs()),
        );
        let mut warnings = model.warnings.clone();
        warnings.extend(notices);
        Self {
            title: case.case.title.clone(),
            version: env!("CARGO_PKG_VERSION"),
            formulation: formulation_words(case, model),
            points: model.system.cloud.len(),
            bonds: model.system.bonds.len(),
            cut_bonds: model.cut_bonds,
            no_fail_points: model.no_fail_points,
            volume: model.system.cloud.volumes.iter().sum(),
            horizon: Spread::of(model.fixed.horizon.iter().copied()),
            family: family(model),
            correction: CorrectionSummary::new(case, model),
            elastic_stiffness: Some(outcome.elastic_stiffness)
                .filter(|stiffness| stiffness.is_finite()),
            first_break: outcome.first_break.map(PathPoint::from),
            peak: outcome.peak().map(PathPoint::from),
            first_peak: outcome.first_peak(DROP).map(PathPoint::from),
            broken_bonds: outcome.state.broken_bonds(),
            steps: history.len().saturating_sub(1),
            exact_path: outcome.rows == Rows::Events,
            termination: TerminationSummary {
                reason: outcome.termination.name(),
                message: outcome.termination.to_string(),
            },
            energy_balance_error: if work > 0.0 { missing / work } else { 0.0 },
            stability: outcome.stability.map(StabilitySummary::from),
            solver: SolverSummary::new(&outcome.costs, &outcome.solver),
            stages: stages.to_vec(),
            warnings,
        }
    }

    /// The lines that a user sees at the end of a run.
    pub fn write(&self, out: &mut dyn Write) -> io::Result<()> {
        writeln!(out, "{}", self.title)?;
        writeln!(out, "  {}", self.formulation)?;
        writeln!(
            out,
            "  points {}, bonds {}, volume {:.6e} m^3",
            self.points, self.bonds, self.volume
        )?;
        if let Some(stiffness) = self.elastic_stiffness {
            writeln!(out, "  elastic stiffness  {stiffness:.6e} N/m")?;
        }
        let broke = self.broken_bonds > 0;
        let of_breaking = |point: Option<PathPoint>| point.filter(|_| broke);
        for (name, point) in [
            ("first breakage", self.first_break),
            ("first peak", of_breaking(self.first_peak)),
            ("largest load", self.peak),
        ] {
            if let Some(PathPoint {
                displacement,
                reaction,
                ..
            }) = point
            {
                writeln!(out, "  {name:<18} {reaction:.6e} N at {displacement:.6e} m")?;
            }
        }
        let unit = if self.exact_path {
            "states of the exact path"
        } else {
            "load steps"
        };
        writeln!(
            out,
            "  broken bonds       {} in {} {unit}",
            self.broken_bonds, self.steps
        )?;
        writeln!(
            out,
            "  energy balance     off by {:.1e} of the work",
            self.energy_balance_error
        )?;
        writeln!(out, "  ended because      {}", self.termination.message)?;
        for warning in self.warnings.iter().take(WARNINGS_SHOWN) {
            writeln!(out, "  warning: {warning}")?;
        }
        if self.warnings.len() > WARNINGS_SHOWN {
            let more = self.warnings.len() - WARNINGS_SHOWN;
            writeln!(out, "  warning: {more} more in summary.json")?;
        }
        Ok(())
    }
}

impl Spread {
    /// Smallest, mean and largest of some values.
    pub fn of(values: impl Iterator<Item = f64> + Clone) -> Self {
        let count = values.clone().count().max(1) as f64;
        Self {
            min: values.clone().fold(f64::INFINITY, f64::min),
            mean: values.clone().sum::<f64>() / count,
            max: values.fold(f64::NEG_INFINITY, f64::max),
        }
    }
}

/// Law and corrections of the bonds, in words.
pub fn formulation_words(case: &CaseFile, model: &Model) -> String {
    let correction = correction_line(case, model.correction.as_ref());
    format!("{}; {correction}", formulation_line(case))
}

/// Numbers of bonds of the points.
pub fn family(model: &Model) -> Spread {
    let incidence = &model.system.bonds.incidence;
    Spread::of((0..incidence.n_points() as u32).map(|point| incidence.of(point).len() as f64))
}

impl CorrectionSummary {
    /// The correction of a model.
    pub fn new(case: &CaseFile, model: &Model) -> Self {
        let report = model.correction.as_ref();
        let (factor_min, factor_max) = model.correction_range;
        Self {
            alpha: case.case.correction.alpha,
            surface: case.case.correction.surface,
            sweeps: report.map(|it| it.sweeps),
            converged: report.map(|it| it.converged),
            last_change: report.map(|it| it.last_change),
            factor_min,
            factor_max,
            largest_residual: report.map(|it| it.largest_residual),
            energy_ratios: model
                .fixed
                .energy_ratios
                .each_ref()
                .map(|ratios| Spread::of(ratios.iter().copied())),
        }
    }
}

impl SolverSummary {
    /// What was chosen, and what it cost.
    pub fn new(costs: &Costs, choice: &SolverChoice) -> Self {
        Self {
            factorisation: match choice.factorisation {
                FactorKind::Llt => "llt",
                FactorKind::Ldlt => "ldlt",
            },
            ordering: match choice.ordering {
                Ordering::NestedDissection => "nested-dissection",
                Ordering::MinimumDegree => "minimum-degree",
            },
            update: match choice.update {
                Update::Incremental => "incremental",
                Update::Refactor => "refactor",
            },
            threads: rayon::current_num_threads(),
            factorisations: costs.factorisations,
            changes: costs.changes,
            solves: costs.solves,
            analysis_seconds: costs.analysis.as_secs_f64(),
            assembly_seconds: costs.assembly.as_secs_f64(),
            factorisation_seconds: costs.factorisation.as_secs_f64(),
            change_seconds: costs.change.as_secs_f64(),
            backward_seconds: costs.backward.as_secs_f64(),
            solve_seconds: costs.solve.as_secs_f64(),
            bonds_seconds: costs.bonds.as_secs_f64(),
            connectivity_seconds: costs.connectivity.as_secs_f64(),
        }
    }
}

/// The law of the bonds, in a line.
pub fn formulation_line(case: &CaseFile) -> String {
    let model = &case.case.model;
    let unknowns = match formulation::element(model.law) {
        ElementKind::Beam => "two displacements and a rotation a point",
        ElementKind::Spring => "two displacements a point",
    };
    let constants = match model.calibration {
        Some(Calibration::Discrete) => ", constants from sums over the families",
        Some(Calibration::Integral) | None => "",
    };
    let rotational = match model.rotational_stiffness {
        Some(RotationalStiffness::Decaying) => ", k_theta = k_t l (1 - l/H)/2",
        Some(RotationalStiffness::Quarter) => ", k_theta = k_t l/4",
        Some(RotationalStiffness::Beam) => ", k_theta = k_t l/12",
        Some(RotationalStiffness::None) => ", k_theta = 0",
        None => "",
    };
    format!(
        "law {}: {unknowns}{constants}{rotational}",
        model.law.word()
    )
}

/// Which corrections the bonds have, and how the iterated one went, in a line.
pub fn correction_line(case: &CaseFile, report: Option<&CorrectionReport>) -> String {
    let correction = &case.case.correction;
    let alpha = match correction.alpha {
        Alpha::None => "no factor alpha",
        Alpha::PartialVolume => "alpha by partial volume",
        Alpha::Length => "alpha by length",
    };
    let surface = match correction.surface {
        Surface::None => "no surface correction".to_owned(),
        Surface::Volume => "surface correction by volume".to_owned(),
        Surface::Domain => report.map(domain_correction).unwrap_or_default(),
    };
    format!("{alpha}, {surface}")
}

fn domain_correction(report: &CorrectionReport) -> String {
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
