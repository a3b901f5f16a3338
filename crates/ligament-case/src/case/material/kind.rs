//! The kinds of materials, each with keys of its own, and the schema of them all.

use schemars::{Schema, json_schema};
use serde_json::{Map, Value, json};

use super::super::document::Node;
use super::super::fault::{Fault, KeyFault};
use super::super::key_path::KeyPath;
use super::super::values::RANGE;

/// Beyond this, in 1/K, a coefficient of expansion was given in other units.
const LARGEST_EXPANSION: f64 = 0.01;

/// A kind of material by the keys that not all kinds have.
pub(super) struct Kind {
    /// Keys that it must have.
    needed: &'static [&'static str],
    /// Keys that it may have and that, like those, only this kind has.
    optional: &'static [&'static str],
    /// Coefficients of expansion along axes that it may have.
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
    /// The kind of a table, which a key that no other kind has tells.
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

    /// Keys of the other kinds that are none of this one.
    fn foreign(&self) -> impl Iterator<Item = &'static str> {
        let all = [&ISOTROPIC, &ORTHOTROPIC, &ANISOTROPIC].into_iter();
        let all = all.flat_map(|kind| kind.telling().chain(kind.expansion.iter().copied()));
        let is_own =
            |key: &&str| self.telling().any(|own| own == *key) || self.expansion.contains(key);
        all.filter(move |key| !is_own(key))
    }

    /// The fault of a key that tables of this kind do not have; `valid` are the keys of all kinds.
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

    /// What the schema says of this kind: keys that must be there, and keys that must not.
    fn schema(&self) -> Value {
        let foreign: Map<String, Value> = (self.foreign())
            .map(|key| (key.to_owned(), false.into()))
            .collect();
        json!({ "required": self.needed, "properties": foreign })
    }
}

/// One material, or a table for each of several. The kinds of tables are one, so that an editor offers all keys; the keys
/// that tell the kind to the reader then tell which of the others must be there and which must not.
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

/// The range of a coefficient of expansion in the schema: what lies beyond is a slip of the unit.
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
