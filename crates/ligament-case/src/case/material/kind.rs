//! The kinds of materials, each with keys of its own, and their common schema.

use schemars::{Schema, json_schema};
use serde_json::{Map, Value, json};

use super::super::document::Node;
use super::super::fault::{Fault, KeyFault};
use super::super::key_path::KeyPath;
use super::super::values::RANGE;

/// Largest plausible coefficient of expansion, 1/K; a larger one is probably in other units.
const LARGEST_EXPANSION: f64 = 0.01;

/// A kind of material, by the keys that not all kinds have.
pub(super) struct Kind {
    /// Required keys of this kind only.
    needed: &'static [&'static str],
    /// Optional keys of this kind only.
    optional: &'static [&'static str],
    /// Optional coefficients of expansion along axes.
    expansion: &'static [&'static str],
}

static ISOTROPIC: Kind = Kind {
    needed: &["young", "poisson"],
    optional: &[],
    expansion: &[],
};

static ORTHOTROPIC: Kind = Kind {
    needed: &["young_1", "young_2", "poisson_12", "shear_modulus"],
    optional: &["angle", "young_3", "poisson_13", "poisson_23"],
    expansion: &[
        "thermal_expansion_1",
        "thermal_expansion_2",
        "thermal_expansion_3",
    ],
};

static ANISOTROPIC: Kind = Kind {
    needed: &["c11", "c12", "c16", "c22", "c26", "c66"],
    optional: &[],
    expansion: &["thermal_expansion_1", "thermal_expansion_2"],
};

impl Kind {
    /// The kind of a table, determined by a key that only this kind has.
    pub(super) fn of_table(table: &Node) -> &'static Self {
        let tells = |kind: &&Self| kind.telling().any(|key| table.get(key).is_some());
        let mut with_axes = [&ANISOTROPIC, &ORTHOTROPIC].into_iter();
        with_axes.find(tells).unwrap_or(&ISOTROPIC)
    }

    pub(super) fn has_angle(&self) -> bool {
        self.optional.contains(&"angle")
    }

    fn telling(&self) -> impl Iterator<Item = &'static str> {
        self.needed.iter().chain(self.optional).copied()
    }

    /// Keys of other kinds that this kind does not have.
    fn foreign(&self) -> impl Iterator<Item = &'static str> {
        let all = [&ISOTROPIC, &ORTHOTROPIC, &ANISOTROPIC].into_iter();
        let all = all.flat_map(|kind| kind.telling().chain(kind.expansion.iter().copied()));
        let is_own =
            |key: &&str| self.telling().any(|own| own == *key) || self.expansion.contains(key);
        all.filter(move |key| !is_own(key))
    }

    /// Refuses keys that tables of this kind do not have; `valid` are the keys of all kinds.
    pub(super) fn refuse_others(
        &self,
        table: &Node,
        key: &KeyPath,
        mut valid: Map<String, Value>,
    ) -> Result<(), KeyFault> {
        for foreign in self.foreign() {
            valid.shift_remove(foreign);
        }
        let entries = table.entries();
        let Some(unknown) = entries.iter().find(|it| !valid.contains_key(&it.key)) else {
            return Ok(());
        };
        let fault = Fault::UnknownKey {
            key: unknown.key.clone(),
            table: key.table_title(),
            valid: valid.into_iter().map(|(key, _)| key).collect(),
        };
        Err(KeyFault::new(key.child(&unknown.key), fault))
    }

    /// Schema of this kind: required and excluded keys.
    fn schema(&self) -> Value {
        let foreign: Map<String, Value> = (self.foreign())
            .map(|key| (key.to_owned(), false.into()))
            .collect();
        json!({ "required": self.needed, "properties": foreign })
    }
}

/// Schema of one material, or of a table for each of several. All kinds share one table, so that an editor offers all keys; the keys that
/// determine the kind then determine which other keys are required or excluded.
pub(super) fn schema(mut keys: Map<String, Value>) -> Schema {
    let tells = |kind: &Kind| has_one_of(kind.telling());
    let named = json!({
        "description": "The material of a group.",
        "type": "object",
        "properties": keys,
        "additionalProperties": false,
        "required": ["group"],
        "if": tells(&ANISOTROPIC),
        "then": ANISOTROPIC.schema(),
        "else": { "if": tells(&ORTHOTROPIC), "then": ORTHOTROPIC.schema(), "else": ISOTROPIC.schema() },
    });
    keys.shift_remove("group");
    let names: Vec<&str> = keys.keys().map(String::as_str).collect();
    let mut one = json!({ "propertyNames": { "enum": names } });
    for keyword in ["if", "then", "else"] {
        one[keyword] = named[keyword].clone();
    }
    json_schema!({
        "type": "object",
        "minProperties": 1,
        "if": has_one_of(names.into_iter()),
        "then": one,
        "properties": keys,
        "additionalProperties": named,
    })
}

fn has_one_of<'a>(keys: impl Iterator<Item = &'a str>) -> Value {
    let each = keys.map(|key| json!({ "required": [key] }));
    json!({ "anyOf": each.collect::<Value>() })
}

/// Adds the range of a coefficient of expansion to the schema, beyond which the unit is probably wrong.
pub(super) fn expansion_range(schema: &mut Schema) {
    for (keyword, value) in [
        ("exclusiveMinimum", (-LARGEST_EXPANSION).into()),
        ("exclusiveMaximum", LARGEST_EXPANSION.into()),
        (
            RANGE,
            "between -0.01 and 0.01 (1/K; steel has about 12e-6)".into(),
        ),
    ] {
        schema.insert(keyword.to_owned(), value);
    }
}
