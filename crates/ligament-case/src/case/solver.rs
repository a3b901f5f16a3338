//! `[solver]`: how the equations are solved. Nothing needs to be said: `solver = "auto"` is the default.

use std::borrow::Cow;
use std::fmt;

use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde::de::value::MapAccessDeserializer;
use serde::de::{MapAccess, Unexpected, Visitor};
use serde::{Deserialize, Deserializer, Serialize};

use super::word::Word;
use ligament_analysis::solver::{FactorKind, Ordering, Update};

/// Threads at most: with thousands of them waking up takes the time of the work, and the program seems to hang.
pub const MOST_THREADS: u32 = 1024;

/// How the equations are solved. The results are the same up to rounding.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize)]
pub struct Solver {
    /// The factorisation of the stiffness.
    pub factorisation: Word<Option<FactorKind>>,
    /// The order of elimination.
    pub ordering: Word<Option<Ordering>>,
    /// What happens to the factor when bonds break.
    pub update: Word<Option<Update>>,
    /// Bonds broken between two factors that are made anew, counted from the start of the run.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub rebuild_every: Option<u32>,
    /// Threads; none given: as many as the machine has, or as `RAYON_NUM_THREADS` says. The results have the same bits for
    /// any number.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub threads: Option<u32>,
}

/// Keys of the section.
#[derive(Default, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
struct Keys {
    /// The factorisation of the stiffness.
    factorisation: Word<Option<FactorKind>>,
    /// The order of elimination.
    ordering: Word<Option<Ordering>>,
    /// What happens to the factor when bonds break.
    update: Word<Option<Update>>,
    /// Broken bonds between two factors that are made anew.
    #[schemars(range(min = 1))]
    rebuild_every: Option<u32>,
    /// Threads; without it one for each processor. Results do not depend on it.
    #[schemars(range(min = 1, max = MOST_THREADS))]
    threads: Option<u32>,
}

/// A table, or the word `auto`.
#[derive(Default)]
pub(super) struct RawSolver(Keys);

impl RawSolver {
    pub(super) fn complete(self) -> Solver {
        let Keys {
            factorisation,
            ordering,
            update,
            rebuild_every,
            threads,
        } = self.0;
        Solver {
            factorisation,
            ordering,
            update,
            rebuild_every,
            threads,
        }
    }
}

impl<'de> Deserialize<'de> for RawSolver {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_any(SolverVisitor)
    }
}

impl JsonSchema for RawSolver {
    fn schema_name() -> Cow<'static, str> {
        "Solver".into()
    }

    fn json_schema(generator: &mut SchemaGenerator) -> Schema {
        let keys = generator.subschema_for::<Keys>();
        json_schema!({ "anyOf": [{ "const": "auto", "description": "All of it is chosen." }, keys] })
    }
}

struct SolverVisitor;

impl<'de> Visitor<'de> for SolverVisitor {
    type Value = RawSolver;

    fn expecting(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.write_str("\"auto\" or a table")
    }

    fn visit_str<E: serde::de::Error>(self, value: &str) -> Result<RawSolver, E> {
        if value == "auto" {
            return Ok(RawSolver::default());
        }
        Err(E::invalid_value(Unexpected::Str(value), &self))
    }

    fn visit_map<M: MapAccess<'de>>(self, keys: M) -> Result<RawSolver, M::Error> {
        Keys::deserialize(MapAccessDeserializer::new(keys)).map(RawSolver)
    }
}
