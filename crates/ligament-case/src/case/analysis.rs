//! `analysis`, `solver = "auto"` and `[output]`: the kind of analysis, the solution of its equations, and what a run writes.

use super::fault::KeyFault;
use super::key_path::KeyPath;
use super::values::{Form, require};
use ligament_analysis::SolverSettings;
use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde::de::IgnoredAny;
use serde::{Deserialize, Deserializer, Serialize};

/// Kind of analysis.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum Analysis {
    /// One linear elastic solution at load factor 1.
    Static,
    /// The breaking of bonds under rising loads.
    Fracture,
    /// Natural frequencies and modes.
    Modal,
    /// A motion in time, in which bonds break where `[fracture]` has criteria.
    Motion,
}

/// Reads a table, or the word `auto`.
pub(super) fn read_solver<'de, D: Deserializer<'de>>(
    deserializer: D,
) -> Result<SolverSettings, D::Error> {
    let expected = "\"auto\" or a table";
    match Form::<IgnoredAny, SolverSettings>::read(deserializer, expected)? {
        Form::Table(solver) => Ok(solver),
        Form::Word(word) if word == "auto" => Ok(SolverSettings::default()),
        other => Err(other.wrong_form_error(expected)),
    }
}

pub(super) fn solver_schema(generator: &mut SchemaGenerator) -> Schema {
    let keys = generator.subschema_for::<SolverSettings>();
    json_schema!({ "anyOf": [{ "const": "auto", "description": "All of it is chosen." }, keys] })
}

/// Files that a run writes.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Output {
    /// Load steps or rows of a motion (default 10) or events of the exact path (100) between two field files; 0: the first and the last state alone.
    pub fields_every: Option<u32>,
    /// Largest number of states between the breakages of a load step with field files of their own, evenly spread over its breakages: the growth of a
    /// crack that runs within one step.
    #[serde(skip_serializing_if = "is_zero")]
    #[schemars(extend("default" = 0))]
    pub during_breakage: u32,
    /// Whether the bonds are written as lines with each field file.
    pub bonds: bool,
    /// Whether `model.vtu` is written, which `ligament explain` reads.
    pub model: bool,
    /// Time between two checkpoints, from which `ligament resume` goes on, s; without it half a minute, and so long that they take
    /// a fiftieth of the time. 0: only when the run is stopped.
    #[schemars(range(min = 0))]
    pub checkpoint_every: Option<f64>,
    /// Whether a picture of the last state, with its damage or displacement, and one of the curve of force over displacement are drawn
    /// at the end.
    #[serde(skip_serializing_if = "std::ops::Not::not")]
    #[schemars(extend("default" = false))]
    pub picture: bool,
    /// Stresses at the points in the field files.
    #[schemars(extend("uniqueItems" = true))]
    pub stress: Vec<StressField>,
}

/// A reading of the stress at the points.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum StressField {
    /// The stress that the material carries, by its law, with principal values and the direction of the largest.
    Material,
    /// The law of the material for the strain of the bonds that neither broke nor soften, with principal values.
    Effective,
    /// The mean of the force dyads of a point's bonds.
    Virial,
    /// The force through small planes at the point.
    Traction,
}

fn is_zero(number: &u32) -> bool {
    *number == 0
}

impl Default for Output {
    fn default() -> Self {
        Self {
            fields_every: None,
            during_breakage: 0,
            bonds: false,
            model: true,
            checkpoint_every: None,
            picture: false,
            stress: Vec::new(),
        }
    }
}

impl Output {
    /// Fills in missing keys.
    pub(super) fn complete(
        &mut self,
        key: &KeyPath,
        is_on_exact_path: bool,
    ) -> Result<(), KeyFault> {
        // An event breaks one or two bonds, a load step at the peak hundreds.
        let default = if is_on_exact_path { 100 } else { 10 };
        self.fields_every.get_or_insert(default);
        let is_repeated =
            |(place, field): (usize, &StressField)| self.stress[..place].contains(field);
        let once = !self.stress.iter().enumerate().any(is_repeated);
        let key = || key.child("stress");
        require(once, key, "each stress once", &self.stress)
    }
}
