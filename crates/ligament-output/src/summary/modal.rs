//! Summary of an analysis of natural modes.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::values::{Text, number};
use super::{ModelSummary, Provenance, SolverSummary, StabilitySummary, Stage, is_false};

/// Summary of a modal analysis. Keys that an earlier version did not write have their default.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(default)]
pub struct ModalSummary {
    /// Summary of the model.
    #[serde(flatten)]
    pub model: ModelSummary,
    /// Mass of the body, kg.
    pub mass: f64,
    /// Centre of mass, m.
    pub centre_of_mass: Vec<f64>,
    /// Mass free to move along the axes, kg, and inertia about the centre of mass, kg m^2; for a solid about each axis through it.
    pub moving: Vec<f64>,
    /// Treatment of the rotations of the points: `inertia` or `massless`.
    pub rotations: Text,
    /// Number of rigid motions that supports and connectivity leave free.
    pub rigid_motions: usize,
    /// Whether a count of the eigenvalues confirmed that no mode below the highest is missing.
    pub complete: Option<bool>,
    /// The modes, lowest first.
    pub modes: Vec<ModeSummary>,
    /// Shares of all modes together in the mass free to move along the axes, and in its inertia.
    pub effective_shares: Vec<f64>,
    /// Whether the model is unstable, and the case does not allow that: the modes are not to be trusted.
    #[serde(skip_serializing_if = "is_false")]
    pub unstable: bool,
    /// Numbers of negative eigenvalues of the stiffness, found and expected from the rotations, where Poisson's ratio is large.
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

/// Summary of a mode.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct ModeSummary {
    /// Number, from 1.
    pub mode: usize,
    /// `rigid` or `elastic`.
    pub kind: Text,
    /// Frequency, Hz.
    #[serde(deserialize_with = "number")]
    pub frequency: f64,
    /// Largest |K phi - omega^2 M phi| over the sum of the forces at a point.
    #[serde(deserialize_with = "number")]
    pub residual: f64,
    /// Shares of the mode's effective masses along the axes, and inertia, in the total mass and inertia free to move.
    pub effective_shares: Vec<f64>,
}
