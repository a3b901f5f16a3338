//! `[solver]`: solution of the equations, by default `solver = "auto"`.

use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde::de::IgnoredAny;
use serde::{Deserialize, Deserializer, Serialize};

use super::values::Form;
use super::word::Word;
use ligament_analysis::solver::{FactorKind, Method, Ordering, SolverSettings, Update};

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
pub(super) fn read<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Solver, D::Error> {
    let expected = "\"auto\" or a table";
    match Form::<IgnoredAny, Solver>::read(deserializer, expected)? {
        Form::Table(solver) => Ok(solver),
        Form::Word(word) if word == "auto" => Ok(Solver::default()),
        other => Err(other.misfit(expected)),
    }
}

pub(super) fn schema(generator: &mut SchemaGenerator) -> Schema {
    let keys = generator.subschema_for::<Solver>();
    json_schema!({ "anyOf": [{ "const": "auto", "description": "All of it is chosen." }, keys] })
}
