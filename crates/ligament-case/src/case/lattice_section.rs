//! `[lattice]`: a body on a regular lattice.

use std::borrow::Cow;
use std::collections::BTreeMap;

use ligament::body;
use ligament_model::shape::crosses_itself;
use ligament_model::{Plane, Shape};
use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde::de::Error;
use serde::{Deserialize, Deserializer, Serialize};

use super::fault::KeyFault;
use super::key_path::KeyPath;
use super::region::Rectangle;
use super::values::{Numbers, Point, exactly_one, metre, numbers, one_of};
use super::values::{require, require_column_name};
use super::word::Word;

/// Cells of a lattice at most.
pub const MOST_CELLS: u64 = 50_000_000;

/// Distance from the origin at most, in cells: farther out coordinates of neighbours would share too many digits.
const FARTHEST: f64 = 1e9;

/// A rectangle of equal cells, a point at the centre of each.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct LatticeSection {
    /// Number of cells along x and y.
    #[schemars(inner(range(min = 1)))]
    pub cells: [u32; 2],
    /// Side of the cells, or their sides `[dx, dy]`, m.
    pub spacing: Spacing,
    /// Lower left corner of the lattice, m.
    #[serde(default)]
    pub corner: Point,
    /// Thickness of the body, m.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(extend("exclusiveMinimum" = 0, "default" = 1.0))]
    pub thickness: Option<f64>,
    /// Plane stress or plane strain.
    #[serde(default)]
    pub plane: Word<Plane>,
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
    pub rectangle: Option<Rectangle>,
    /// A polygon by its corners, three or more, m.
    #[schemars(length(min = 3))]
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
    pub r#box: Option<Rectangle>,
    /// Cells whose centre lies in a disk, m.
    pub circle: Option<Circle>,
    /// Cells whose centre lies in a polygon, by its corners, three or more, m.
    #[schemars(length(min = 3))]
    pub polygon: Option<Polygon>,
}

/// A disk.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Circle {
    /// Centre, m.
    pub centre: Point,
    /// Radius, m.
    #[schemars(extend("exclusiveMinimum" = 0))]
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
    /// The key path of a set.
    pub(crate) fn set_key(name: &str) -> String {
        let sets = KeyPath::default().child("lattice").child("set");
        sets.child(name).to_string()
    }

    /// Holes and sets of the lattice.
    pub(crate) fn parts(
        &self,
        key: &KeyPath,
    ) -> Result<(Vec<body::Hole>, BTreeMap<String, body::CellSet>), KeyFault> {
        self.check_size(key)?;
        let holes = self.remove.iter().enumerate().map(|(index, hole)| {
            let key = key.child("remove").child(index);
            if let Some(name) = &hole.name {
                require_column_name(|| key.child("name"), name)?;
                if self.sets.contains_key(name) {
                    let reason =
                        format!("`lattice.set` has a `{name}` as well: rename one of them");
                    return Err(KeyFault::new(key.child("name"), reason));
                }
            }
            Ok(body::Hole {
                name: hole.name.clone(),
                shape: hole.shape(&key)?,
            })
        });
        let holes = holes.collect::<Result<_, _>>()?;
        let sets = self.sets.iter().map(|(name, set)| {
            let cells = set.cells(&key.child("set").child(name), self.cells)?;
            Ok((name.clone(), cells))
        });
        Ok((holes, sets.collect::<Result<_, _>>()?))
    }

    fn check_size(&self, key: &KeyPath) -> Result<(), KeyFault> {
        let (cells, Spacing(spacing), corner) = (self.cells, self.spacing, self.corner);
        let n_cells = u64::from(cells[0]) * u64::from(cells[1]);
        require(
            (1..=MOST_CELLS).contains(&n_cells),
            || key.child("cells"),
            &format!("at least 1 along x and y, and {MOST_CELLS} together at most"),
            cells,
        )?;
        let volume = spacing[0] * spacing[1] * self.thickness.unwrap_or_else(metre);
        require(
            spacing.iter().all(|side| *side > 0.0) && volume.is_normal(),
            || key.child("spacing"),
            "greater than 0, and of a size that gives the cells a volume",
            spacing,
        )?;
        let is_near = |axis: usize| {
            corner[axis].abs() + f64::from(cells[axis]) * spacing[axis] <= FARTHEST * spacing[axis]
        };
        require(
            (0..2).all(is_near),
            || key.child("corner"),
            "so near to the origin that no corner of the lattice is more than 1e9 cells away from it",
            corner,
        )
    }
}

impl Hole {
    fn shape(&self, key: &KeyPath) -> Result<Shape, KeyFault> {
        let outside = self
            .outside
            .map(|Circle { centre, radius }| Shape::Outside { centre, radius });
        let shapes = [
            ("circle", self.circle.map(Shape::from)),
            ("rectangle", self.rectangle.map(Shape::from)),
            ("polygon", self.polygon.clone().map(Shape::from)),
            ("outside", outside),
        ];
        one_of(key, shapes)
    }
}

impl CellSet {
    /// The cells of the set in a lattice of so many along x and y.
    fn cells(&self, key: &KeyPath, [columns, rows]: [u32; 2]) -> Result<body::CellSet, KeyFault> {
        for (name, count, most) in [
            ("bottom", self.bottom, rows),
            ("top", self.top, rows),
            ("left", self.left, columns),
            ("right", self.right, columns),
        ] {
            let (count, expected) = (
                count.unwrap_or(1),
                format!("{most} or less, as the lattice has"),
            );
            require(count <= most, || key.child(name), &expected, count)?;
        }
        let inside = |shape: Option<Shape>| shape.map(body::CellSet::Inside);
        let sets = [
            ("bottom", self.bottom.map(body::CellSet::bottom)),
            ("top", self.top.map(body::CellSet::top)),
            ("left", self.left.map(body::CellSet::left)),
            ("right", self.right.map(body::CellSet::right)),
            ("box", inside(self.r#box.map(Shape::from))),
            ("circle", inside(self.circle.map(Shape::from))),
            ("polygon", inside(self.polygon.clone().map(Shape::from))),
        ];
        one_of(key, sets)
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
        match numbers(deserializer, expected)? {
            Numbers::Integer(side) => Ok(Self([side as f64; 2])),
            Numbers::Float(side) => Ok(Self([side; 2])),
            Numbers::List(sides) => match sides.as_slice() {
                &[dx, dy] => Ok(Self([dx, dy])),
                sides => Err(D::Error::invalid_length(sides.len(), &expected)),
            },
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
