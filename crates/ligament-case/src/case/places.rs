//! Positions, directions, vectors and parts of the body: two coordinates in the plane, three in space.

use super::fault::KeyFault;
use super::key_path::KeyPath;
use super::values::{Form, Point, each, exactly_one, one_of};
use ligament::near_growth::Growth;
use ligament::setup::{self, Place, Position};
use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde::de::IgnoredAny;
use serde::{Deserialize, Deserializer, Serialize, Serializer};
use std::borrow::Cow;

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
    /// Component along x, in the unit of the vector.
    #[serde(default)]
    pub x: f64,
    /// Component along y, in the unit of the vector.
    #[serde(default)]
    pub y: f64,
    /// Component along z of a solid, in the unit of the vector.
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
            other => Err(other.wrong_form_error(expected)),
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

/// A rectangle: its lower left and its upper right corner, m.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(try_from = "[Point; 2]")]
pub struct Rectangle(pub [Point; 2]);

impl TryFrom<[Point; 2]> for Rectangle {
    type Error = String;

    fn try_from([a, b]: [Point; 2]) -> Result<Self, String> {
        if a[0] == b[0] || a[1] == b[1] {
            let expected = "two opposite corners of a rectangle with a width and a height";
            return Err(format!("must be {expected}, found {:?}", [a, b]));
        }
        Ok(Self([
            [a[0].min(b[0]), a[1].min(b[1])],
            [a[0].max(b[0]), a[1].max(b[1])],
        ]))
    }
}

/// A rectangle, or in space a box: its lowest and its highest corner, m.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(try_from = "[Coordinates; 2]")]
pub struct Corners(pub [Coordinates; 2]);

impl Corners {
    pub(super) fn positions(&self) -> [Position; 2] {
        self.0.map(|it| it.position())
    }
}

impl<const D: usize> From<[[f64; D]; 2]> for Corners {
    fn from(corners: [[f64; D]; 2]) -> Self {
        Self(corners.map(Coordinates::from))
    }
}

impl TryFrom<[Coordinates; 2]> for Corners {
    type Error = String;

    fn try_from([a, b]: [Coordinates; 2]) -> Result<Self, String> {
        match (a.as_slice(), b.as_slice()) {
            (&[ax, ay], &[bx, by]) => {
                let Rectangle(corners) = Rectangle::try_from([[ax, ay], [bx, by]])?;
                Ok(corners.into())
            }
            (a @ &[ax, ay, az], b @ &[bx, by, bz]) => {
                if a.iter().zip(b).any(|(a, b)| a == b) {
                    let expected =
                        "two opposite corners of a box with a width, a depth and a height";
                    return Err(format!("must be {expected}, found {:?}", [a, b]));
                }
                let corners = [
                    [ax.min(bx), ay.min(by), az.min(bz)],
                    [ax.max(bx), ay.max(by), az.max(bz)],
                ];
                Ok(corners.into())
            }
            (a, b) => Err(format!(
                "must be two corners with two coordinates each, or three in a solid, found {a:?} and {b:?}"
            )),
        }
    }
}

/// A part of the body.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(extend("oneOf" = exactly_one(&["group", "box"])))]
pub struct Region {
    /// The points of this physical group of the mesh, or of this set or hole of the lattice.
    pub group: Option<String>,
    /// The points in this rectangle, by two opposite corners `[[x, y], [x, y]]`, in a solid in this box, m.
    pub r#box: Option<Corners>,
}

impl Region {
    pub(super) fn place(&self, key: &KeyPath) -> Result<Place, KeyFault> {
        place(key, self.group.as_ref(), self.r#box, None)
    }
}

/// The far field of a meshed body, where linear finite elements take the place of bonds.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct FarField {
    /// Parts of the body that keep their bonds: the cells with all corners in one of them.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub near: Vec<Region>,
    /// Share of the strength of a material, up to 1, that the largest principal stress of elements may reach (under pressure the smallest one over
    /// `compressive_strength`). Where a run meets a larger stress, bonds take the place of the elements around it, and the run begins anew. Without
    /// it the near field stays as it is.
    pub strength_share: Option<f64>,
}

impl FarField {
    /// Adds the places of a growth to the near field.
    pub(super) fn grow(&mut self, growth: &Growth) {
        let corners = growth.places.iter().filter_map(|it| match it {
            Place::Box(corners) => {
                Some(corners.map(|it| Coordinates::in_dimensions(it, growth.dimensions)))
            }
            Place::Everywhere | Place::Group(_) | Place::At(_) => None,
        });
        self.near.extend(corners.map(|it| Region {
            group: None,
            r#box: Some(Corners(it)),
        }));
    }

    pub(super) fn setup(&self, key: &KeyPath) -> Result<setup::FarField, KeyFault> {
        Ok(setup::FarField {
            near: each(&key.child("near"), &self.near, Region::place)?,
            strength_share: self.strength_share,
        })
    }
}

/// The place that a table names, which must be exactly one.
pub(super) fn place(
    key: &KeyPath,
    group: Option<&String>,
    corners: Option<Corners>,
    at: Option<Coordinates>,
) -> Result<Place, KeyFault> {
    let places = [
        ("group", group.cloned().map(Place::Group)),
        ("box", corners.map(|it| Place::Box(it.positions()))),
        ("at", at.map(|it| Place::At(it.position()))),
    ];
    one_of(key, places)
}

/// The place that a table names, at most one; without any the whole body.
pub(super) fn place_or_everywhere(
    key: &KeyPath,
    group: Option<&String>,
    corners: Option<Corners>,
    at: Option<Coordinates>,
) -> Result<Place, KeyFault> {
    match (group, corners, at) {
        (None, None, None) => Ok(Place::Everywhere),
        _ => place(key, group, corners, at),
    }
}
