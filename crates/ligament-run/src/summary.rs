//! `summary.json`: the run in numbers, and the lines that a user sees at its end.

mod modal;
mod model;
mod places;
mod solver;

use std::collections::BTreeMap;
use std::io::{self, Write};

use ligament_analysis::balanced::Stability;
use ligament_analysis::driver::{LoadPoint, Outcome, Rows};
use ligament_analysis::first_bonds::FirstBonds;
use ligament_analysis::history::StepRecord;
use ligament_analysis::{ProportionalLoading, Termination};
use ligament_output::quantity::{between, quantity};
use serde::Serialize;
use serde::ser::{SerializeMap, Serializer};

use crate::end::{End, UP_TO_THERE};
use crate::provenance::Provenance;
use crate::stages::Stage;
use ligament::Model;
use ligament::units::Units;
use ligament_case::case::CaseFile;

pub use modal::{ModalSummary, ModeSummary};
pub use model::{
    CorrectionSummary, ModelSummary, ScatterSummary, Spread, correction_line, family,
    formulation_line, heading,
};
use places::resultants_at_peak;
pub use places::{BondEvent, Resultant};
pub use solver::SolverSummary;

/// All numbers of a run.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Summary {
    /// The model.
    #[serde(flatten)]
    pub model: ModelSummary,
    /// Smallest, mean and largest change of the temperature of the points at load factor 1, where it changes, K.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub temperature_change: Option<Spread>,
    /// Units of the displacement and the force of the first load, or of the temperature where it is the load.
    #[serde(serialize_with = "write_units")]
    pub units: Units,
    /// Force over displacement of the first load before the first breakage.
    pub elastic_stiffness: Option<f64>,
    /// Where the first bond breaks, or begins to soften, as the elastic solution foretells.
    pub first_break: Option<PathPoint>,
    /// The first bond that began to soften; only of bonds that do.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub first_softened_bond: Option<BondEvent>,
    /// The first bond that broke.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub first_broken_bond: Option<BondEvent>,
    /// The load step, or event of the exact path, with the largest reaction.
    pub peak: Option<PathPoint>,
    /// What each group with supports or loads exerts on the body there, by its name in the history.
    pub reactions_at_peak: BTreeMap<String, Resultant>,
    /// The largest reaction before it fell by more than [`DROP`] for the first time; on the exact path as a test sees it
    /// whose displacement only rises.
    pub first_peak: Option<PathPoint>,
    /// Broken bonds at the end.
    pub broken_bonds: usize,
    /// Unbroken bonds at the end whose force had begun to fall; only of bonds that soften.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub softened_bonds: Option<usize>,
    /// Load steps done, or events of the exact path, with the last state.
    pub steps: usize,
    /// Whether [`steps`](Self::steps) counts events of the exact path.
    pub exact_path: bool,
    /// Why the run ended, as a short name.
    pub termination: &'static str,
    /// Why the run ended, in words.
    pub termination_message: String,
    /// Set where no state under load is at rest: there is nothing but the unloaded body but those of the unloaded body.
    #[serde(skip_serializing_if = "is_false")]
    pub without_equilibrium: bool,
    /// Set where the last state is not at rest: its bonds would go on breaking, or no equilibrium follows.
    #[serde(skip_serializing_if = "is_false")]
    pub last_state_not_at_rest: bool,
    /// Largest |external work - stored - released energy| over the largest external work.
    pub energy_balance_error: f64,
    /// Faces of cracks that passed through each other farthest, where they did so farther than results bear.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub overlap: Option<OverlapSummary>,
    /// Negative eigenvalues of the intact stiffness, and how many its rotations explain, where Poisson's ratio is large.
    pub stability: Option<StabilitySummary>,
    /// The solver and its work.
    pub solver: SolverSummary,
    /// What the results came from.
    pub provenance: Provenance,
    /// Wall time and peak memory of the stages.
    pub stages: Vec<Stage>,
    /// What the user should know.
    pub warnings: Vec<String>,
}

/// Fall of the reaction, relative to the largest so far, that ends the first rise of the load.
pub const DROP: f64 = 0.02;

/// Warnings that are shown at the end of a run; small pieces that come loose can give hundreds.
const WARNINGS_SHOWN: usize = 10;

/// Largest load over that of the first breakage which is rounding.
const ROUNDING: f64 = 1e-9;

/// A point of the force-displacement curve.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct PathPoint {
    /// Displacement of the first load.
    pub displacement: f64,
    /// Force of the first load.
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

/// Writes the units of displacement and force; that of their quotient follows.
fn write_units<S: Serializer>(units: &Units, serializer: S) -> Result<S::Ok, S::Error> {
    let mut map = serializer.serialize_map(Some(2))?;
    map.serialize_entry("displacement", units.displacement)?;
    map.serialize_entry("force", units.force)?;
    map.end()
}

/// Faces of cracks that passed through each other.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct OverlapSummary {
    /// How far, m.
    pub depth: f64,
    /// Load step, or event.
    pub step: usize,
    /// The nodes or cells on either side, and where they are.
    pub between: [String; 2],
}

/// Inertia of the intact stiffness.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
pub struct StabilitySummary {
    /// Negative eigenvalues.
    pub negative: usize,
    /// Negative eigenvalues that are expected.
    pub expected: usize,
}

impl From<Stability> for StabilitySummary {
    fn from(Stability { negative, expected }: Stability) -> Self {
        Self { negative, expected }
    }
}

fn is_false(value: &bool) -> bool {
    !value
}

/// Why a run ended, in words, with points by their tags and places.
pub(crate) fn ending(outcome: &Outcome, model: &Model) -> String {
    let body = model.body();
    outcome.termination.words(&|point| body.place(point))
}

/// Smallest, mean and largest change of the temperature of the points at load factor 1, K.
pub fn temperature_change(boundary: &ProportionalLoading) -> Option<Spread> {
    let changes = &boundary.temperature_change;
    (!changes.is_empty()).then(|| Spread::over(changes.iter().copied()))
}

/// Facts of a run beside its model and its outcome.
#[derive(Debug, Clone)]
pub struct Noted {
    /// Origin of the results.
    pub provenance: Provenance,
    /// Notices of the run in words.
    pub notices: Vec<String>,
    /// First bonds that gave way.
    pub first: FirstBonds,
    /// Stages of the run with their times.
    pub stages: Vec<Stage>,
}

impl Summary {
    /// Collects the numbers.
    pub fn new(
        case: &CaseFile,
        model: &Model,
        boundary: &ProportionalLoading,
        outcome: &Outcome,
        noted: Noted,
    ) -> Self {
        let history = &outcome.history;
        let without_equilibrium = outcome.is_without_equilibrium();
        let loaded = |point: Option<LoadPoint>| {
            let point = point.filter(|_| !without_equilibrium);
            point.map(PathPoint::from)
        };
        let largest = |values: &mut dyn Iterator<Item = f64>| values.fold(0.0, f64::max);
        let scale = |step: &StepRecord| step.external_work.abs().max(step.energy_floor);
        let work = largest(&mut history.iter().map(scale));
        let missing = largest(&mut history.iter().map(|step| step.missing_energy().abs()));
        let is_cut_short = !without_equilibrium
            && matches!(outcome.termination, Termination::NoEquilibrium { .. });
        let of_end = is_cut_short.then(|| UP_TO_THERE.to_owned());
        Self {
            model: ModelSummary::new(case, model),
            temperature_change: temperature_change(boundary),
            units: model.setup.units(),
            elastic_stiffness: Some(outcome.elastic_stiffness)
                .filter(|stiffness| stiffness.is_finite()),
            first_break: outcome.first_break.map(PathPoint::from),
            first_softened_bond: noted.first.softened.map(|it| BondEvent::new(model, &it)),
            first_broken_bond: noted.first.broken.map(|it| BondEvent::new(model, &it)),
            peak: loaded(outcome.peak()),
            reactions_at_peak: resultants_at_peak(boundary, model.system.layout(), outcome),
            first_peak: loaded(outcome.first_peak(DROP)),
            broken_bonds: outcome.broken_bonds,
            softened_bonds: (model.criteria.soften()).then_some(outcome.softened_bonds),
            steps: history.len().saturating_sub(1),
            exact_path: outcome.rows == Rows::Events,
            termination: outcome.termination.name(),
            termination_message: ending(outcome, model),
            without_equilibrium,
            last_state_not_at_rest: history.last().is_some_and(|last| !last.at_rest),
            energy_balance_error: if work > 0.0 { missing / work } else { 0.0 },
            overlap: outcome.overlap.map(|it| OverlapSummary {
                depth: it.depth,
                step: it.step,
                between: (model.body().numbering().ordered(it.ends))
                    .map(|end| model.body().place(end)),
            }),
            stability: outcome.stability.map(StabilitySummary::from),
            solver: SolverSummary::new(&outcome.costs, &outcome.solver),
            provenance: noted.provenance,
            stages: noted.stages,
            warnings: (model.warnings.iter().map(ToString::to_string))
                .chain(noted.notices.into_iter().chain(of_end))
                .collect(),
        }
    }

    /// How the run ended.
    pub fn end(&self) -> End {
        let is_not_at_rest = self.last_state_not_at_rest;
        End::from_termination(self.termination, self.without_equilibrium, is_not_at_rest)
    }

    /// Whether the run was stopped by its user.
    pub fn is_stopped(&self) -> bool {
        self.end() == End::Stopped
    }

    /// The lines that a user sees at the end of a run.
    pub fn write(&self, out: &mut dyn Write) -> io::Result<()> {
        writeln!(out, "{}", heading(&self.model.title))?;
        writeln!(out, "  {}", self.model.formulation)?;
        writeln!(
            out,
            "  points {}, bonds {}, volume {}",
            self.model.points,
            self.model.bonds,
            quantity(self.model.volume, "m^3")
        )?;
        self.write_loads(out)?;
        self.write_first_bonds(out)?;
        let unit = if self.exact_path {
            "states of the exact path"
        } else {
            "load steps"
        };
        let softened = (self.softened_bonds).map_or(String::new(), |it| {
            format!(", and {it} more that softened,")
        });
        writeln!(
            out,
            "  broken bonds       {}{softened} in {} {unit}",
            self.broken_bonds, self.steps
        )?;
        writeln!(
            out,
            "  energy balance     off by {:.1e} of the work",
            self.energy_balance_error
        )?;
        writeln!(out, "  ended because      {}", self.termination_message)?;
        if self.without_equilibrium {
            let none = "no state under load is in equilibrium: there are no results";
            writeln!(out, "  NO EQUILIBRIUM     {none}")?;
        } else if self.end() == End::NoEquilibrium {
            writeln!(out, "  NO EQUILIBRIUM     {UP_TO_THERE}")?;
        } else if self.last_state_not_at_rest {
            let last =
                "the last state is no answer: its bonds were still breaking when the run ended";
            writeln!(out, "  NOT AT REST        {last}")?;
        }
        for warning in self.warnings.iter().take(WARNINGS_SHOWN) {
            writeln!(out, "  warning: {warning}")?;
        }
        if self.warnings.len() > WARNINGS_SHOWN {
            let more = self.warnings.len() - WARNINGS_SHOWN;
            writeln!(out, "  warning: {more} more in summary.json")?;
        }
        Ok(())
    }

    /// Whether the load that was to break the first bond is more than the body ever carried, beyond all rounding: no state under load held.
    fn has_no_equilibrium_under_load(&self) -> bool {
        let event = self.first_softened_bond.as_ref();
        let event = event.or(self.first_broken_bond.as_ref());
        // Stages foretell no breakage, but the elastic answer of their first step is that of its first event.
        let in_first_step = event.filter(|it| it.step == 1).map(|it| it.reaction);
        let foreseen = self.first_break.map(|it| it.reaction).or(in_first_step);
        let foreseen = foreseen.map_or(0.0, f64::abs);
        let held = self.peak.map_or(0.0, |it| it.reaction.abs());
        held <= ROUNDING * foreseen && foreseen > 0.0
    }

    /// The lines of where the body gave way first.
    fn write_first_bonds(&self, out: &mut dyn Write) -> io::Result<()> {
        for (name, bond) in [
            ("first softened", &self.first_softened_bond),
            ("first broken", &self.first_broken_bond),
        ] {
            if let Some(bond) = bond {
                writeln!(out, "  {name:<18} {bond}")?;
            }
        }
        Ok(())
    }

    /// The lines of the temperature, the stiffness and the loads that stand out.
    fn write_loads(&self, out: &mut dyn Write) -> io::Result<()> {
        let Units {
            displacement: along,
            force,
            stiffness: per_displacement,
        } = self.units;
        if let Some(Spread { min, mean, max }) = self.temperature_change {
            writeln!(
                out,
                "  temperature change {}, mean {}",
                between([min, max], "K"),
                quantity(mean, "K")
            )?;
        }
        if let Some(stiffness) = self.elastic_stiffness {
            let stiffness = quantity(stiffness, per_displacement);
            writeln!(out, "  elastic stiffness  {stiffness}")?;
        }
        let broke = self.broken_bonds > 0 || self.softened_bonds.is_some_and(|it| it > 0);
        let of_breaking = |point: Option<PathPoint>| point.filter(|_| broke);
        let onset = match self.softened_bonds {
            Some(_) => "first softening",
            None => "first breakage",
        };
        if broke && !self.without_equilibrium && self.has_no_equilibrium_under_load() {
            writeln!(
                out,
                "  largest load       none: the body broke in the first load step"
            )?;
            return Ok(());
        }
        for (name, point) in [
            (onset, self.first_break),
            ("first peak", of_breaking(self.first_peak)),
            ("largest load", self.peak),
        ] {
            if let Some(PathPoint {
                displacement,
                reaction,
                ..
            }) = point
            {
                let (load, at) = (quantity(reaction, force), quantity(displacement, along));
                writeln!(out, "  {name:<18} {load} at {at}")?;
            }
        }
        Ok(())
    }
}
