//! `summary.json` of a run, or of an analysis of natural modes; writers and readers share these types.

mod end;
mod modal;
mod model;
mod motion;
mod provenance;
mod solver;
mod values;

use std::collections::BTreeMap;
use std::path::Path;

use ligament_analysis::balanced::Stability;
use ligament_analysis::driver::LoadPoint;
use schemars::JsonSchema;
use schemars::generate::SchemaSettings;
use serde::de::DeserializeOwned;
use serde::{Deserialize, Serialize};
use serde_json::Value;
use values::number;

use crate::Error;
use crate::atomic::read_json;
use crate::folder::ResultFolder;
use crate::quantity::{place, quantity};
use crate::results::passes::RefinementSummary;

pub use end::{INCOMPLETE_RUN_NOTE, verdict};
pub use modal::{ModalSummary, ModeSummary};
pub use model::{CorrectionSummary, ModelSummary, ScatterSummary, Spread};
pub use motion::{EnergiesSummary, MotionSummary};
pub use provenance::{Build, Identity, Input, Provenance, Stage};

pub use solver::{FactorSummary, IterationSummary, SolverSummary};
pub use values::Text;

/// Name of the file.
pub const SUMMARY_FILE: &str = "summary.json";

/// Summary of a run. Keys that an earlier version did not write have their default.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(default)]
pub struct Summary {
    /// Summary of the model.
    #[serde(flatten)]
    pub model: ModelSummary,
    /// Smallest, mean and largest change of the points' temperature at load factor 1, K; none without a change.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub temperature_change: Option<Spread>,
    /// Units of the displacement and the force of the first load, or of the temperature where it is the load.
    pub units: UnitsSummary,
    /// Force over displacement of the first load before the first breakage.
    pub elastic_stiffness: Option<f64>,
    /// First breakage or softening, predicted by the elastic solution.
    pub first_break: Option<PathPoint>,
    /// First bond that began to soften; only where bonds soften.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub first_softened_bond: Option<BondEvent>,
    /// First bond that broke.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub first_broken_bond: Option<BondEvent>,
    /// Load step, or event of the exact path, with the largest reaction.
    pub peak: Option<PathPoint>,
    /// Forces that each group with supports or loads exerts on the body at the peak, by its name in the history.
    pub reactions_at_peak: BTreeMap<String, Resultant>,
    /// Largest reaction before its first decrease by more than a fixed share; on the exact path as in a test with increasing displacement.
    pub first_peak: Option<PathPoint>,
    /// Values of the probes in the last state, by their names.
    #[serde(skip_serializing_if = "BTreeMap::is_empty")]
    pub probes_at_end: BTreeMap<String, f64>,
    /// Number of broken bonds at the end.
    pub broken_bonds: usize,
    /// Number of unbroken softening bonds at the end; only where bonds soften.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub softened_bonds: Option<usize>,
    /// Number of load steps, events of the exact path, or rows of a motion, including the last state.
    pub steps: usize,
    /// Whether [`steps`](Self::steps) counts events of the exact path.
    pub exact_path: bool,
    /// Time, steps and energies of a motion in time, of which each load factor is a time in s; none in statics.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub motion: Option<MotionSummary>,
    /// Reason of the run's end, as a short name.
    pub termination: Text,
    /// Reason of the run's end, as a message.
    pub termination_message: String,
    /// Whether no state under load is in equilibrium without pending breakages: only the unloaded body is a result.
    #[serde(skip_serializing_if = "is_false")]
    pub without_equilibrium: bool,
    /// Whether breakage continues in the last state, or no equilibrium follows it.
    #[serde(skip_serializing_if = "is_false")]
    pub last_state_not_at_rest: bool,
    /// Largest |external work - stored - released energy| over the largest external work, dimensionless. In a motion all energies of its
    /// ledger count, and the energy at time zero counts as work.
    #[serde(deserialize_with = "number")]
    pub energy_balance_error: f64,
    /// Energies, crack area, residual and ties of a run in statics.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub certificate: Option<CertificateSummary>,
    /// Passes of a refinement.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub refinement: Option<RefinementSummary>,
    /// Deepest overlap of crack faces, where it exceeds a tolerance.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub overlap: Option<OverlapSummary>,
    /// Numbers of negative eigenvalues of the intact stiffness, found and expected from the rotations, where Poisson's ratio is large.
    pub stability: Option<StabilitySummary>,
    /// The solver and its work.
    pub solver: SolverSummary,
    /// Origin of the results; none from an early version.
    pub provenance: Option<Provenance>,
    /// Wall time and peak memory of the stages.
    pub stages: Vec<Stage>,
    /// Warnings for the user.
    pub warnings: Vec<String>,
}

/// Units of the force-displacement curve.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(default)]
pub struct UnitsSummary {
    /// Unit of the displacement.
    pub displacement: Text,
    /// Unit of the force.
    pub force: Text,
}

impl UnitsSummary {
    /// Unit of a stiffness, force over displacement.
    pub fn stiffness(&self) -> String {
        let Self {
            displacement,
            force,
        } = self;
        match force.split_once('/') {
            Some((work, per)) if per == displacement => format!("{work}/{per}^2"),
            _ => format!("{force}/{displacement}"),
        }
    }
}

impl Default for UnitsSummary {
    fn default() -> Self {
        Self {
            displacement: "m".into(),
            force: "N".into(),
        }
    }
}

/// A point of the force-displacement curve.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct PathPoint {
    /// Displacement of the first load.
    #[serde(deserialize_with = "number")]
    pub displacement: f64,
    /// Force of the first load.
    #[serde(deserialize_with = "number")]
    pub reaction: f64,
    /// Load factor.
    #[serde(deserialize_with = "number")]
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

/// A bond that broke or began to soften before all others.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct BondEvent {
    /// Tags of the ends of the bond.
    pub ends: [u64; 2],
    /// Midpoint of the bond, m.
    pub place: Vec<f64>,
    /// Load step or event.
    pub step: usize,
    /// Load factor.
    #[serde(deserialize_with = "number")]
    pub load_factor: f64,
    /// Displacement of the first load.
    #[serde(deserialize_with = "number")]
    pub displacement: f64,
    /// Force of the first load.
    #[serde(deserialize_with = "number")]
    pub reaction: f64,
    /// Name of the criterion.
    pub criterion: String,
    /// Kind of the tags, `node` or `cell`. The file does not have it: of an event that was read it is `point`.
    #[serde(skip, default = "point")]
    pub tagged: &'static str,
}

/// Kind of the tags of an event that was read.
fn point() -> &'static str {
    "point"
}

impl BondEvent {
    /// When it happened: in a step, or at a time of a motion.
    pub fn when(&self, in_time: bool) -> String {
        match in_time {
            true => format!("after {}", quantity(self.load_factor, "s")),
            false => format!("in step {}", self.step),
        }
    }

    /// The bond in words, with the place, [when](Self::when) it happened and by which criterion.
    pub fn words(&self, in_time: bool) -> String {
        let [a, b] = self.ends;
        let (tagged, criterion) = (self.tagged, &self.criterion);
        let (place, when) = (place(&self.place), self.when(in_time));
        format!("{tagged}s {a} and {b} at {place}, {when}, by {criterion}")
    }
}

/// Resultant of the forces that a group with supports or loads exerts on the body, by names: `force_x` and `force_y`, N, and `moment`, the
/// sum of the moments on its points, N m; in space `force_x` to `force_z` and `moment_x` to `moment_z`.
pub type Resultant = BTreeMap<Text, f64>;

/// Overlap of crack faces.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct OverlapSummary {
    /// Depth of the overlap, m.
    pub depth: f64,
    /// Load step, or event.
    pub step: usize,
    /// Descriptions of the nodes or cells on either side, with positions.
    pub between: [String; 2],
}

/// Inertia of the intact stiffness.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
pub struct StabilitySummary {
    /// Number of negative eigenvalues.
    pub negative: usize,
    /// Expected number of negative eigenvalues.
    pub expected: usize,
}

impl From<Stability> for StabilitySummary {
    fn from(Stability { negative, expected }: Stability) -> Self {
        Self { negative, expected }
    }
}

/// Reads the summary in a folder, a [`Summary`] or a [`ModalSummary`]; `None` where the run has not ended.
///
/// # Errors
///
/// If the file cannot be read, or is not a summary.
pub fn read<S: DeserializeOwned>(folder: &Path) -> Result<Option<S>, Error> {
    let path = folder.join(SUMMARY_FILE);
    if !path.is_file() {
        return Ok(None);
    }
    read_json(&path).map(Some)
}

/// The JSON schema of a [`Summary`] or a [`ModalSummary`] as it is written.
pub fn schema<S: JsonSchema>() -> Value {
    let settings = SchemaSettings::default().with(|it| it.inline_subschemas = true);
    let generator = settings.for_serialize().into_generator();
    generator.into_root_schema_for::<S>().to_value()
}

/// Writes a summary into the folder of its results.
///
/// # Errors
///
/// If the file cannot be written.
pub fn write<S: Serialize>(folder: &ResultFolder, summary: &S) -> Result<(), Error> {
    let text = serde_json::to_string_pretty(summary).map_err(|error| Error::Refused {
        path: folder.file(SUMMARY_FILE),
        reason: error.to_string(),
    })?;
    folder.write(SUMMARY_FILE, &(text + "\n"))
}

fn is_false(value: &bool) -> bool {
    !value
}

/// Certificate of a run in statics.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(default)]
pub struct CertificateSummary {
    /// Number of the last state at rest, which all values describe.
    pub step: usize,
    /// Number of bonds broken up to there.
    pub broken_bonds: usize,
    /// Work of supports and loads, J.
    pub work: f64,
    /// Energy stored in the bonds, J.
    pub stored: f64,
    /// Energy that breakages took out of the body, J: what bonds dissipated, and what would have become motion.
    pub released: f64,
    /// Energy that the laws of the bonds dissipated, J.
    pub dissipated: f64,
    /// Area of the cracks, m^2, of bonds that broke or have less than a tenth of their force left; none without cracks, of a divided
    /// body, and of one with more points than are traced in a moment.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub crack_area: Option<f64>,
    /// Dissipated energy over the area of the cracks, J/m^2.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub dissipated_per_area: Option<f64>,
    /// Fracture energy that the case gives, J/m^2; none where materials differ, and where no criterion has one.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub fracture_energy: Option<f64>,
    /// Horizon over the smallest ligament: ahead of the tip of a pre-crack, or across the thinnest section. Peaks of bodies that soften are
    /// too high where it is above 0.15. None without criteria, and where the ligament is not known.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub horizon_over_ligament: Option<f64>,
    /// Largest residual of the states that were found, unbalanced force over the forces that meet at a point; none where no iteration was
    /// needed.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub largest_residual: Option<f64>,
    /// Number of breakages that had the same utilisation as the one before, so that the numbers in the file decided their order.
    pub ties: usize,
}

impl CertificateSummary {
    /// Dissipated energy per area over the fracture energy, where there are both.
    pub fn spent_ratio(&self) -> Option<f64> {
        let both = self.dissipated_per_area.zip(self.fracture_energy);
        both.map(|(spent, given)| spent / given)
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;

    /// A summary of an early version, without provenance and stages; its reaction, null, is NaN.
    const EARLY: &str = r#"{
        "title": "plate", "points": 40, "bonds": 200,
        "horizon": { "min": 0.003, "mean": 0.003, "max": 0.003 },
        "first_peak": { "displacement": 1e-5, "reaction": null, "load_factor": 0.5 },
        "first_broken_bond": { "ends": [3, 7], "place": [0.1, 0.2], "step": 2, "load_factor": 0.4, "displacement": 1e-5,
            "reaction": 5.0, "criterion": "tension" },
        "solver": { "method": "direct", "factorisation": "llt", "ordering": "nested-dissection", "update": "incremental" },
        "termination": "collapsed", "broken_bonds": 12, "key_of_another_version": true
    }"#;

    #[test]
    fn what_is_read_is_what_was_written() {
        let early: Summary = serde_json::from_str(EARLY).unwrap();
        assert_eq!((early.model.points, early.broken_bonds), (40, 12));
        assert!(early.first_peak.unwrap().reaction.is_nan());
        assert_eq!(early.units.stiffness(), "N/m");
        assert!(early.provenance.is_none() && early.solver.iteration.is_none());
        assert_eq!(early.solver.factor.as_ref().unwrap().update, "incremental");
        let bond = early.first_broken_bond.as_ref().unwrap().words(false);
        assert!(bond.starts_with("points 3 and 7 at "), "{bond}");

        let folder = tempfile::tempdir().unwrap();
        let results = ResultFolder::create(folder.path().join("out"), false).unwrap();
        assert!(read::<Summary>(results.path()).unwrap().is_none());
        let stage = Stage {
            name: "solution".into(),
            seconds: 0.25,
            peak_bytes: Some(1 << 20),
        };
        let whole = Summary {
            first_peak: early.peak,
            stages: vec![stage],
            ..early
        };
        write(&results, &whole).unwrap();
        assert_eq!(read(results.path()).unwrap(), Some(whole));
    }

    #[test]
    fn a_stiffness_has_the_unit_of_force_over_displacement() {
        let unit = |displacement: &'static str, force: &'static str| {
            let units = UnitsSummary {
                displacement: displacement.into(),
                force: force.into(),
            };
            units.stiffness()
        };
        assert_eq!(unit("rad", "N m"), "N m/rad");
        assert_eq!(unit("m^3", "Pa"), "Pa/m^3");
        assert_eq!(unit("K", "J/K"), "J/K^2");
    }
}
