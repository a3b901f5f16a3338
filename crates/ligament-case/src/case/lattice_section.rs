//! `[lattice]`: a body on a regular lattice.

use std::borrow::Cow;
use std::collections::BTreeMap;

use ligament_model::shape::crosses_itself;
use ligament_model::{Plane, Shape};
use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde::de::Error;
use serde::{Deserialize, Deserializer, Serialize};

use super::lattice_keys::{Grid, Shapes, Sides};
use super::region::Rectangle;
use super::values::{Form, Point, exactly_one, metre};

/// A rectangle of equal cells, a point at the centre of each.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct LatticeSection {
    /// Number of cells along x and y.
    #[schemars(inner(range(min = 1)))]
    pub cells: [u32; 2],
    /// Side of the cells, or their sides `[dx, dy]`, m.
    #[schemars(extend("x-unit" = "m"))]
    pub spacing: Spacing,
    /// Lower left corner of the lattice, m.
    #[serde(default)]
    #[schemars(extend("x-unit" = "m"))]
    pub corner: Point,
    /// Thickness of the body, m.
    #[schemars(extend("exclusiveMinimum" = 0, "default" = 1.0, "x-unit" = "m"))]
    pub thickness: Option<f64>,
    /// Plane stress or plane strain.
    #[serde(default)]
    pub plane: Plane,
    /// Holes: cells whose centre lies in one are removed, and bonds across it.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub remove: Vec<Hole>,
    /// Named sets of cells, which stand wherever a `group` does.
    #[serde(rename = "set", default, skip_serializing_if = "BTreeMap::is_empty")]
    pub sets: BTreeMap<String, CellSet>,
}

/// A hole: cells whose centre lies in it are removed.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(extend("oneOf" = exactly_one(&["circle", "rectangle", "polygon", "outside"])))]
pub struct Hole {
    /// Makes the cells at its rim a `group`; several holes may share it.
    #[schemars(length(min = 1))]
    pub name: Option<String>,
    /// A disk, m.
    pub circle: Option<Circle>,
    /// A rectangle by two opposite corners, m.
    #[schemars(extend("x-unit" = "m"))]
    pub rectangle: Option<Rectangle>,
    /// A polygon by its corners, three or more, m.
    #[schemars(length(min = 3), extend("x-unit" = "m"))]
    pub polygon: Option<Polygon>,
    /// Everything outside of a disk, m.
    pub outside: Option<Circle>,
}

/// A set of cells.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(extend("oneOf" = exactly_one(&["bottom", "top", "left", "right", "box", "circle", "polygon"])))]
pub struct CellSet {
    /// So many rows from the bottom.
    #[schemars(range(min = 1))]
    pub bottom: Option<u32>,
    /// So many rows from the top.
    #[schemars(range(min = 1))]
    pub top: Option<u32>,
    /// So many columns from the left.
    #[schemars(range(min = 1))]
    pub left: Option<u32>,
    /// So many columns from the right.
    #[schemars(range(min = 1))]
    pub right: Option<u32>,
    /// Cells whose centre lies in a rectangle, by two opposite corners, m.
    #[schemars(extend("x-unit" = "m"))]
    pub r#box: Option<Rectangle>,
    /// Cells whose centre lies in a disk, m.
    pub circle: Option<Circle>,
    /// Cells whose centre lies in a polygon, by its corners, three or more, m.
    #[schemars(length(min = 3), extend("x-unit" = "m"))]
    pub polygon: Option<Polygon>,
}

/// A disk.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Circle {
    /// Centre, m.
    #[schemars(extend("x-unit" = "m"))]
    pub centre: Point,
    /// Radius, m.
    #[schemars(extend("exclusiveMinimum" = 0, "x-unit" = "m"))]
    pub radius: f64,
}

/// A polygon that does not cross itself, by its corners, m.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(try_from = "Vec<Point>")]
pub struct Polygon(pub Vec<Point>);

/// Sides of a cell dx, dy, m: one number for both, or one for each.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Spacing(pub [f64; 2]);

impl LatticeSection {
    /// What the section says of the lattice.
    pub(crate) fn grid(&self) -> Grid<2, Shape> {
        let holes = self.remove.iter();
        let sets = self.sets.iter();
        Grid {
            section: "lattice",
            axes: "x and y",
            cells: self.cells,
            spacing: self.spacing.0,
            corner: self.corner,
            thickness: self.thickness.unwrap_or_else(metre),
            holes: holes.map(|it| (it.name.clone(), it.shapes())).collect(),
            sets: sets
                .map(|(name, it)| (name.clone(), (it.sides(), it.shapes())))
                .collect(),
        }
    }
}

impl Hole {
    fn shapes(&self) -> Shapes<Shape> {
        let outside = self
            .outside
            .map(|Circle { centre, radius }| Shape::Outside { centre, radius });
        vec![
            ("circle", self.circle.map(Shape::from)),
            ("rectangle", self.rectangle.map(Shape::from)),
            ("polygon", self.polygon.clone().map(Shape::from)),
            ("outside", outside),
        ]
    }
}

impl CellSet {
    fn sides(&self) -> Sides<2> {
        vec![
            ("bottom", self.bottom, [0, -1]),
            ("top", self.top, [0, 1]),
            ("left", self.left, [-1, 0]),
            ("right", self.right, [1, 0]),
        ]
    }

    fn shapes(&self) -> Shapes<Shape> {
        vec![
            ("box", self.r#box.map(Shape::from)),
            ("circle", self.circle.map(Shape::from)),
            ("polygon", self.polygon.clone().map(Shape::from)),
        ]
    }
}

impl From<Rectangle> for Shape {
    fn from(rectangle: Rectangle) -> Self {
        Self::rectangle(rectangle.0)
    }
}

impl From<Circle> for Shape {
    fn from(Circle { centre, radius }: Circle) -> Self {
        Self::Circle { centre, radius }
    }
}

impl From<Polygon> for Shape {
    fn from(polygon: Polygon) -> Self {
        Self::Polygon(polygon.0)
    }
}

impl TryFrom<Vec<Point>> for Polygon {
    type Error = String;

    fn try_from(corners: Vec<Point>) -> Result<Self, String> {
        if corners.len() < 3 || crosses_itself(&corners) {
            let expected = "three corners or more of a polygon that does not cross or touch itself";
            return Err(format!("must be {expected}, found {corners:?}"));
        }
        Ok(Self(corners))
    }
}

impl<'de> Deserialize<'de> for Spacing {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let expected = "a number or a list of 2";
        match Form::<f64>::read(deserializer, expected)? {
            Form::Number(side, _) => Ok(Self([side; 2])),
            Form::List(sides) => match sides.as_slice() {
                &[dx, dy] => Ok(Self([dx, dy])),
                sides => Err(D::Error::invalid_length(sides.len(), &expected)),
            },
            other => Err(other.misfit(expected)),
        }
    }
}

impl JsonSchema for Spacing {
    fn schema_name() -> Cow<'static, str> {
        "Spacing".into()
    }

    fn json_schema(_: &mut SchemaGenerator) -> Schema {
        json_schema!({
            "anyOf": [
                { "description": "Side of the square cells, m.", "type": "number", "exclusiveMinimum": 0 },
                {
                    "description": "Sides of the cells along x and y, m.",
                    "type": "array", "items": { "type": "number", "exclusiveMinimum": 0 }, "minItems": 2, "maxItems": 2,
                },
            ]
        })
    }
}
