//! Positions and directions of a case: two coordinates in the plane, three in space.

use std::borrow::Cow;

use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde::{Deserialize, Serialize, Serializer};

use super::fault::KeyFault;
use super::key_path::KeyPath;
use ligament::setup::Position;

/// Coordinates along x and y, and in space along z.
#[derive(Debug, Clone, Copy, PartialEq, Deserialize)]
#[serde(try_from = "Vec<f64>")]
pub struct Coordinates {
    along: [f64; 3],
    count: usize,
}

impl Coordinates {
    /// The coordinates, shape (2) or (3).
    pub fn as_slice(&self) -> &[f64] {
        &self.along[..self.count]
    }

    /// Coordinates of a position in some dimensions.
    pub(super) fn in_dimensions(along: Position, dimensions: usize) -> Self {
        Self {
            along,
            count: dimensions,
        }
    }

    /// The coordinates for a body in some dimensions, padded with zeros; `key` is their key.
    pub(super) fn for_body(&self, key: &KeyPath, dimensions: usize) -> Result<Position, KeyFault> {
        if self.count == dimensions {
            return Ok(self.along);
        }
        let body = match dimensions {
            2 => "a body in the plane takes two coordinates, [x, y]",
            _ => "a solid takes three coordinates, [x, y, z]",
        };
        let reason = format!("{body}, found {:?}", self.as_slice());
        Err(KeyFault::new(key.clone(), reason))
    }
}

impl<const D: usize> From<[f64; D]> for Coordinates {
    /// Converts two or three coordinates.
    fn from(coordinates: [f64; D]) -> Self {
        let along = |axis: usize| coordinates.get(axis).copied().unwrap_or(0.0);
        Self {
            along: std::array::from_fn(along),
            count: D,
        }
    }
}

impl TryFrom<Vec<f64>> for Coordinates {
    type Error = String;

    fn try_from(coordinates: Vec<f64>) -> Result<Self, String> {
        match coordinates[..] {
            [x, y] => Ok([x, y].into()),
            [x, y, z] => Ok([x, y, z].into()),
            _ => Err(format!(
                "must be [x, y], or [x, y, z] in a solid, found {coordinates:?}"
            )),
        }
    }
}

impl Serialize for Coordinates {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        self.as_slice().serialize(serializer)
    }
}

impl JsonSchema for Coordinates {
    fn inline_schema() -> bool {
        true
    }

    fn schema_name() -> Cow<'static, str> {
        "Coordinates".into()
    }

    fn json_schema(_: &mut SchemaGenerator) -> Schema {
        json_schema!({ "type": "array", "items": { "type": "number" }, "minItems": 2, "maxItems": 3 })
    }
}
