//! Summary of a motion in time.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::values::Text;

/// Summary of a motion in time.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(default)]
pub struct MotionSummary {
    /// Duration of the case, s.
    pub duration: f64,
    /// Time that the motion reached, s.
    pub time: f64,
    /// Number of time steps up to there.
    pub time_steps: usize,
    /// Time step, s; of an implicit scheme the mean.
    pub time_step: f64,
    /// Largest stable step of an explicit scheme, s.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub critical_step: Option<f64>,
    /// What limits the critical step: `displacements` or `rotations`.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub limited_by: Option<Text>,
    /// Energies at the end.
    pub energies: EnergiesSummary,
}

/// Energies of a motion, J, by the names of their columns in the history.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(default)]
pub struct EnergiesSummary {
    /// Work of loads and supports.
    pub external_work: f64,
    /// Energy at time zero; of central differences below zero where forces begin suddenly, by the kinetic energy that they give in half a step.
    pub initial_energy: f64,
    /// Kinetic energy.
    pub kinetic_energy: f64,
    /// Energy stored in the bonds.
    pub stored_energy: f64,
    /// Energy released by broken bonds.
    pub released_energy: f64,
    /// Energy that damping and quiet edges took.
    pub damping_energy: f64,
    /// Energy stored in contacts.
    pub contact_energy: f64,
    /// Energy that friction took.
    pub friction_energy: f64,
}

impl EnergiesSummary {
    /// The energies with their names in words, in the order of the ledger: first what came in.
    pub fn named(&self) -> [(&'static str, f64); 8] {
        let start = match self.initial_energy < 0.0 {
            true => "before the sudden start",
            false => "at the start",
        };
        [
            ("work", self.external_work),
            (start, self.initial_energy),
            ("kinetic", self.kinetic_energy),
            ("stored", self.stored_energy),
            ("released", self.released_energy),
            ("damping", self.damping_energy),
            ("contact", self.contact_energy),
            ("friction", self.friction_energy),
        ]
    }
}
