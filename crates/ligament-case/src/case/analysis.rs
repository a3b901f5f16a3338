//! `analysis`, `[modal]`, `[solver]` and `[output]`: the kind of analysis, the solution of its equations, and what a run writes.

use super::fault::KeyFault;
use super::key_path::KeyPath;
use super::values::{Form, require};
use super::word::Word;
use ligament::setup;
use ligament_analysis::modal::{ModalSettings, Rotations};
use ligament_analysis::solver::{FactorKind, Method, Ordering, SolverSettings, Update};
use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde::de::IgnoredAny;
use serde::{Deserialize, Deserializer, Serialize};

/// Largest number of modes: each needs three vectors of the search in memory.
pub const MOST_MODES: usize = 1000;

/// What is computed.
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

/// Natural modes that are wanted.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Modal {
    /// Number of modes, rigid ones included, lowest first.
    #[schemars(range(min = 1, max = MOST_MODES))]
    pub modes: usize,
    /// Inertia of the rotations of the points.
    pub rotations: Word<Option<Rotations>>,
    /// Residual of the search, relative to 1/omega^2.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub tolerance: f64,
}

impl Default for Modal {
    fn default() -> Self {
        let ModalSettings {
            modes,
            rotations,
            tolerance,
        } = setup::modal();
        Self {
            modes,
            rotations: Word(rotations),
            tolerance,
        }
    }
}

impl Modal {
    pub(super) fn setup(&self) -> ModalSettings {
        ModalSettings {
            modes: self.modes,
            rotations: self.rotations.0,
            tolerance: self.tolerance,
        }
    }
}

/// Largest number of threads: with thousands, waking them takes longer than the work.
pub const MOST_THREADS: u32 = 1024;

/// How the equations are solved. The results are the same up to rounding.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Solver {
    /// How the equations are solved: with a factor of the matrix or without a matrix.
    #[serde(skip_serializing_if = "is_open")]
    pub method: Word<Option<Method>>,
    /// Force that the iteration leaves out of balance after a breakage, relative to the forces that may act at a point: 1e-8. Bonds that
    /// are nearer to each other than a hundred times this, relatively, break together.
    #[schemars(range(min = 1e-10, max = 1e-3))]
    pub tolerance: Option<f64>,
    /// The factorisation of the stiffness.
    pub factorisation: Word<Option<FactorKind>>,
    /// The order of elimination.
    pub ordering: Word<Option<Ordering>>,
    /// What happens to the factor when bonds break.
    pub update: Word<Option<Update>>,
    /// Broken bonds between two factors that are made anew.
    #[schemars(range(min = 1))]
    pub rebuild_every: Option<usize>,
    /// Threads; without it one for each processor. Results do not depend on it.
    #[schemars(range(min = 1, max = MOST_THREADS))]
    pub threads: Option<u32>,
    /// Memory that a run may take, GB; without it what the machine has left. A run that would take more is refused; where the method is
    /// open, bodies in the plane whose factor does not fit are solved without a matrix.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub memory: Option<f64>,
}

impl Solver {
    pub(super) fn setup(&self, allows_unstable: bool) -> SolverSettings {
        let default = SolverSettings::default();
        SolverSettings {
            method: self.method.0,
            tolerance: self.tolerance.unwrap_or(default.tolerance),
            factorisation: self.factorisation.0,
            ordering: self.ordering.0,
            update: self.update.0,
            rebuild_every: self.rebuild_every.unwrap_or(default.rebuild_every),
            allows_unstable,
            ..default
        }
    }
}

fn is_open(method: &Word<Option<Method>>) -> bool {
    method.0.is_none()
}

/// Reads a table, or the word `auto`.
pub(super) fn read_solver<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Solver, D::Error> {
    let expected = "\"auto\" or a table";
    match Form::<IgnoredAny, Solver>::read(deserializer, expected)? {
        Form::Table(solver) => Ok(solver),
        Form::Word(word) if word == "auto" => Ok(Solver::default()),
        other => Err(other.misfit(expected)),
    }
}

pub(super) fn solver_schema(generator: &mut SchemaGenerator) -> Schema {
    let keys = generator.subschema_for::<Solver>();
    json_schema!({ "anyOf": [{ "const": "auto", "description": "All of it is chosen." }, keys] })
}

/// What a run writes.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Output {
    /// Load steps or rows of a motion (default 10) or events of the exact path (100) between two field files; 0: the first and the last state alone.
    pub fields_every: Option<u32>,
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
    /// What the material carries, by its law, with principal values and the direction of the largest.
    Material,
    /// The law of the material for the strain of the bonds that neither broke nor soften, with principal values.
    Effective,
    /// The mean of the force dyads of a point's bonds.
    Virial,
    /// The force through small planes at the point.
    Traction,
}

impl Default for Output {
    fn default() -> Self {
        Self {
            fields_every: None,
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
