//! Couples: a number in the plane, a vector in space.

use std::borrow::Cow;
use std::fmt;

use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde::de::value::MapAccessDeserializer;
use serde::de::{MapAccess, Visitor};
use serde::{Deserialize, Deserializer, Serialize};

use super::conditions::Vector;
use super::fault::KeyFault;
use super::key_path::KeyPath;
use ligament::setup;

/// A couple.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[serde(untagged)]
pub enum Couple {
    /// A couple in the plane, counter-clockwise.
    InPlane(f64),
    /// A couple about the axes of space, right-handed.
    About(Vector),
}

impl Couple {
    pub(super) fn for_body(
        &self,
        key: &KeyPath,
        dimensions: usize,
    ) -> Result<setup::Couple, KeyFault> {
        match (*self, dimensions) {
            (Self::InPlane(value), 2) => Ok(value.into()),
            (Self::About(vector), 3) => Ok(setup::Couple {
                about: vector.for_body(key, dimensions)?,
            }),
            (Self::InPlane(_), _) => {
                let reason = "a couple in a solid turns about an axis: give a vector, { z = 1.0 }";
                Err(KeyFault::new(key.clone(), reason))
            }
            (Self::About(_), _) => {
                let reason = "a couple in the plane turns about z: give a number";
                Err(KeyFault::new(key.clone(), reason))
            }
        }
    }
}

impl<'de> Deserialize<'de> for Couple {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_any(CoupleVisitor)
    }
}

struct CoupleVisitor;

impl<'de> Visitor<'de> for CoupleVisitor {
    type Value = Couple;

    fn expecting(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.write_str("a number, or a table of `x`, `y` and `z` in a solid")
    }

    fn visit_i64<E>(self, value: i64) -> Result<Couple, E> {
        Ok(Couple::InPlane(value as f64))
    }

    fn visit_f64<E>(self, value: f64) -> Result<Couple, E> {
        Ok(Couple::InPlane(value))
    }

    fn visit_map<A: MapAccess<'de>>(self, map: A) -> Result<Couple, A::Error> {
        Vector::deserialize(MapAccessDeserializer::new(map)).map(Couple::About)
    }
}

impl JsonSchema for Couple {
    fn inline_schema() -> bool {
        true
    }

    fn schema_name() -> Cow<'static, str> {
        "Couple".into()
    }

    fn json_schema(generator: &mut SchemaGenerator) -> Schema {
        let vector = generator.subschema_for::<Vector>();
        json_schema!({ "anyOf": [{ "type": "number" }, vector] })
    }
}
