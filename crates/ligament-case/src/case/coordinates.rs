//! Positions, directions, vectors and couples of a case: two coordinates in the plane, three in space.

use std::borrow::Cow;

use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde::de::IgnoredAny;
use serde::{Deserialize, Deserializer, Serialize, Serializer};

use super::values::{Form, Point};
use ligament::setup::{self, Position};

/// Coordinates along x and y, and in space along z.
#[derive(Debug, Clone, Copy, PartialEq, Deserialize)]
#[serde(try_from = "Vec<f64>")]
pub struct Coordinates {
    along: Position,
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

    /// The position, with a z coordinate of zero in the plane.
    pub(super) fn position(&self) -> Position {
        self.along
    }

    /// The position in the plane.
    pub(super) fn in_plane(&self) -> Point {
        let [x, y, _] = self.along;
        [x, y]
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

/// A vector; a component that is not given is zero.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(extend("minProperties" = 1))]
pub struct Vector {
    /// Along x, in the unit of the force.
    #[serde(default)]
    pub x: f64,
    /// Along y, in the unit of the force.
    #[serde(default)]
    pub y: f64,
    /// Along z of a solid, in the unit of the force.
    pub z: Option<f64>,
}

impl Vector {
    pub(super) fn position(self) -> Position {
        [self.x, self.y, self.z.unwrap_or(0.0)]
    }
}

/// A couple.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[serde(untagged)]
pub enum Couple {
    /// A couple in the plane, counter-clockwise.
    InPlane(f64),
    /// A couple about the axes of space, right-handed.
    About(Vector),
}

impl From<Couple> for setup::Couple {
    fn from(couple: Couple) -> Self {
        match couple {
            Couple::InPlane(value) => value.into(),
            Couple::About(vector) => Self {
                about: vector.position(),
            },
        }
    }
}

impl<'de> Deserialize<'de> for Couple {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let expected = "a number, or a table of `x`, `y` and `z` in a solid";
        match Form::<IgnoredAny, Vector>::read(deserializer, expected)? {
            Form::Number(value, _) => Ok(Self::InPlane(value)),
            Form::Table(vector) => Ok(Self::About(vector)),
            other => Err(other.misfit(expected)),
        }
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
