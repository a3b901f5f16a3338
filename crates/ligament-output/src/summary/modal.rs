//! An analysis of natural modes in numbers.

use serde::{Deserialize, Serialize};

use super::{ModelSummary, Provenance, SolverSummary, StabilitySummary, Stage, Text, number};

/// All numbers of a modal analysis. Keys that an earlier version did not write have their default.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
#[serde(default)]
pub struct ModalSummary {
    /// The model.
    #[serde(flatten)]
    pub model: ModelSummary,
    /// Mass of the body, kg.
    pub mass: f64,
    /// Centre of the mass, m.
    pub centre_of_mass: Vec<f64>,
    /// Mass that can move along the axes, kg, and inertia about the centre, kg m^2; of a solid about each axis through it.
    pub moving: Vec<f64>,
    /// What becomes of the rotations of the points: `inertia` or `massless`.
    pub rotations: Text,
    /// Rigid motions that supports and connectivity leave.
    pub rigid_motions: usize,
    /// Whether a count of the eigenvalues confirmed that no mode below the highest is missing.
    pub complete: Option<bool>,
    /// The modes, lowest first.
    pub modes: Vec<ModeSummary>,
    /// Share of the modes together in the mass that can move along the axes, and in its inertia.
    pub effective_shares: Vec<f64>,
    /// Negative eigenvalues of the stiffness, and how many its rotations explain, where Poisson's ratio is large.
    pub stability: Option<StabilitySummary>,
    /// The solver and its work.
    pub solver: SolverSummary,
    /// Origin of the results; none of an early version.
    pub provenance: Option<Provenance>,
    /// Wall time and peak memory of the stages.
    pub stages: Vec<Stage>,
    /// What the user should know.
    pub warnings: Vec<String>,
}

/// A mode in numbers.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct ModeSummary {
    /// Number, from 1.
    pub mode: usize,
    /// `rigid` or `elastic`.
    pub kind: Text,
    /// Frequency, Hz.
    #[serde(deserialize_with = "number")]
    pub frequency: f64,
    /// Largest |K phi - omega^2 M phi| over the forces that meet at a point.
    #[serde(deserialize_with = "number")]
    pub residual: f64,
    /// Shares of its effective masses along the axes and of its inertia in what can move.
    pub effective_shares: Vec<f64>,
}
