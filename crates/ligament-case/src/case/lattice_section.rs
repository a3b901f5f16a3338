//! `[lattice]`: a body on a regular lattice.

use std::borrow::Cow;
use std::collections::BTreeMap;
use std::fmt;

use ligament_model::shape::crosses_itself;
use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde::de::{SeqAccess, Visitor};
use serde::{Deserialize, Deserializer, Serialize};

use super::fault::KeyFault;
use super::key_path::KeyPath;
use super::region::ordered_box;
use super::values::exactly_one;
use super::values::{Point, not_exactly_one, require, require_column_name, require_positive};
use super::word::Word;
use ligament_model::Plane;

/// Cells of a lattice at most.
pub const MOST_CELLS: u64 = 50_000_000;

/// Distance from the origin at most, in cells: farther out coordinates of neighbours would share too many digits.
const FARTHEST: f64 = 1e9;

/// A rectangle of equal cells, a point at the centre of each.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct LatticeSection {
    /// Number of cells along x and y.
    pub cells: [u32; 2],
    /// Sides of a cell dx, dy, m.
    pub spacing: [f64; 2],
    /// Lower left corner of the rectangle, m.
    pub corner: Point,
    /// Thickness of the body, m.
    pub thickness: f64,
    /// Plane stress or plane strain.
    pub plane: Word<Plane>,
    /// Holes.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub remove: Vec<Hole>,
    /// Named sets of cells, by their names.
    #[serde(rename = "set", skip_serializing_if = "BTreeMap::is_empty")]
    pub sets: BTreeMap<String, CellSet>,
}

impl LatticeSection {
    /// Key path of a set in the case file.
    pub fn set_key(name: &str) -> String {
        let sets = KeyPath::default().child("lattice").child("set");
        sets.child(name).to_string()
    }
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

/// A hole: cells whose centre lies in it are removed.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Hole {
    /// Name of the group that the cells at its rim are; several holes may share it.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub name: Option<String>,
    /// What it takes.
    #[serde(flatten)]
    pub shape: HoleShape,
}

/// What a hole takes.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum HoleShape {
    /// A disk.
    Circle(Circle),
    /// A rectangle: its lower left and its upper right corner.
    Rectangle([Point; 2]),
    /// A polygon by its corners.
    Polygon(Vec<Point>),
    /// Everything outside of a disk.
    Outside(Circle),
}

/// A set of cells.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum CellSet {
    /// So many rows from the bottom.
    Bottom(u32),
    /// So many rows from the top.
    Top(u32),
    /// So many columns from the left.
    Left(u32),
    /// So many columns from the right.
    Right(u32),
    /// Cells whose centre lies in a rectangle: its lower left and its upper right corner.
    Box([Point; 2]),
    /// Cells whose centre lies in a disk.
    Circle(Circle),
    /// Cells whose centre lies in a polygon.
    Polygon(Vec<Point>),
}

#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(super) struct RawLattice {
    /// Number of cells along x and y.
    #[schemars(inner(range(min = 1)))]
    cells: [u32; 2],
    /// Side of the cells, or their sides `[dx, dy]`, m.
    spacing: RawSpacing,
    /// Lower left corner of the lattice, m.
    #[schemars(extend("default" = [0.0, 0.0]))]
    corner: Option<Point>,
    /// Thickness of the body, m.
    #[schemars(extend("default" = 1.0, "exclusiveMinimum" = 0))]
    thickness: Option<f64>,
    /// Plane stress or plane strain.
    #[schemars(extend("default" = "stress"))]
    plane: Option<Word<Plane>>,
    /// Holes: cells whose centre lies in one are removed, and bonds across it.
    #[serde(default)]
    remove: Vec<RawHole>,
    /// Named sets of cells, which stand wherever a `group` does.
    #[serde(default)]
    set: BTreeMap<String, RawSet>,
}

#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(extend("oneOf" = exactly_one(&["circle", "rectangle", "polygon", "outside"])))]
struct RawHole {
    /// Makes the cells at its rim a `group`; several holes may share it.
    #[schemars(length(min = 1))]
    name: Option<String>,
    /// A disk, m.
    circle: Option<Circle>,
    /// A rectangle by two opposite corners, m.
    rectangle: Option<[Point; 2]>,
    /// A polygon by its corners, three or more, m.
    #[schemars(length(min = 3))]
    polygon: Option<Vec<Point>>,
    /// Everything outside of a disk, m.
    outside: Option<Circle>,
}

#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(extend("oneOf" = exactly_one(&["bottom", "top", "left", "right", "box", "circle", "polygon"])))]
struct RawSet {
    /// So many rows from the bottom.
    #[schemars(range(min = 1))]
    bottom: Option<u32>,
    /// So many rows from the top.
    #[schemars(range(min = 1))]
    top: Option<u32>,
    /// So many columns from the left.
    #[schemars(range(min = 1))]
    left: Option<u32>,
    /// So many columns from the right.
    #[schemars(range(min = 1))]
    right: Option<u32>,
    /// Cells whose centre lies in a rectangle, by two opposite corners, m.
    r#box: Option<[Point; 2]>,
    /// Cells whose centre lies in a disk, m.
    circle: Option<Circle>,
    /// Cells whose centre lies in a polygon, by its corners, three or more, m.
    #[schemars(length(min = 3))]
    polygon: Option<Vec<Point>>,
}

impl RawLattice {
    pub(super) fn check(self, key: &KeyPath) -> Result<LatticeSection, KeyFault> {
        let (cells, RawSpacing(spacing)) = (self.cells, self.spacing);
        let n_cells = u64::from(cells[0]) * u64::from(cells[1]);
        require(
            (1..=MOST_CELLS).contains(&n_cells),
            || key.child("cells"),
            &format!("at least 1 along x and y, and {MOST_CELLS} together at most"),
            cells,
        )?;
        let thickness = self.thickness.unwrap_or(1.0);
        let volume = spacing[0] * spacing[1] * thickness;
        require(
            spacing.iter().all(|side| *side > 0.0) && volume.is_normal(),
            || key.child("spacing"),
            "greater than 0, and of a size that gives the cells a volume",
            spacing,
        )?;
        let corner = self.corner.unwrap_or_default();
        require(
            (0..2).all(|axis| {
                corner[axis].abs() + f64::from(cells[axis]) * spacing[axis]
                    <= FARTHEST * spacing[axis]
            }),
            || key.child("corner"),
            "so near to the origin that no corner of the lattice is more than 1e9 cells away from it",
            corner,
        )?;
        let holes = self.remove.into_iter().enumerate();
        let holes = holes.map(|(index, hole)| {
            let key = key.child("remove").child(index);
            let hole = hole.check(&key)?;
            if let Some(name) = hole
                .name
                .as_ref()
                .filter(|&name| self.set.contains_key(name))
            {
                let reason = format!("`lattice.set` has a `{name}` as well: rename one of them");
                return Err(KeyFault::new(key.child("name"), reason));
            }
            Ok(hole)
        });
        let remove = holes.collect::<Result<_, _>>()?;
        let sets = self.set.into_iter().map(|(name, set)| {
            let checked = set.check(&key.child("set").child(&name), cells)?;
            Ok((name, checked))
        });
        Ok(LatticeSection {
            cells,
            spacing,
            corner,
            thickness,
            plane: self.plane.unwrap_or_default(),
            remove,
            sets: sets.collect::<Result<_, KeyFault>>()?,
        })
    }
}

impl RawHole {
    fn check(self, key: &KeyPath) -> Result<Hole, KeyFault> {
        if let Some(name) = &self.name {
            require_column_name(|| key.child("name"), name)?;
        }
        let shape = match (self.circle, self.rectangle, self.polygon, self.outside) {
            (Some(circle), None, None, None) => {
                HoleShape::Circle(circle.check(&key.child("circle"))?)
            }
            (None, Some(corners), None, None) => {
                HoleShape::Rectangle(ordered_box(&key.child("rectangle"), corners)?)
            }
            (None, None, Some(corners), None) => HoleShape::Polygon(polygon(key, corners)?),
            (None, None, None, Some(circle)) => {
                HoleShape::Outside(circle.check(&key.child("outside"))?)
            }
            (circle, rectangle, polygon, outside) => {
                let given = [
                    ("circle", circle.is_some()),
                    ("rectangle", rectangle.is_some()),
                    ("polygon", polygon.is_some()),
                    ("outside", outside.is_some()),
                ];
                return Err(not_exactly_one(key, &given));
            }
        };
        Ok(Hole {
            name: self.name,
            shape,
        })
    }
}

impl RawSet {
    /// Checks the set of a lattice of so many `cells` along x and y.
    fn check(self, key: &KeyPath, [columns, rows]: [u32; 2]) -> Result<CellSet, KeyFault> {
        let given = [
            ("bottom", self.bottom.is_some()),
            ("top", self.top.is_some()),
            ("left", self.left.is_some()),
            ("right", self.right.is_some()),
            ("box", self.r#box.is_some()),
            ("circle", self.circle.is_some()),
            ("polygon", self.polygon.is_some()),
        ];
        if given.iter().filter(|(_, is_given)| *is_given).count() != 1 {
            return Err(not_exactly_one(key, &given));
        }
        let shapes = [
            (self.r#box).map(|corners| ordered_box(&key.child("box"), corners).map(CellSet::Box)),
            (self.circle).map(|it| it.check(&key.child("circle")).map(CellSet::Circle)),
            (self.polygon).map(|corners| polygon(key, corners).map(CellSet::Polygon)),
        ];
        let side = |name: &str, count: Option<u32>, most: u32, set: fn(u32) -> CellSet| {
            count.map(|count| {
                let expected = format!("{most} or less, as the lattice has");
                require(count <= most, || key.child(name), &expected, count)?;
                Ok(set(count))
            })
        };
        let sides = [
            side("bottom", self.bottom, rows, CellSet::Bottom),
            side("top", self.top, rows, CellSet::Top),
            side("left", self.left, columns, CellSet::Left),
            side("right", self.right, columns, CellSet::Right),
        ];
        let found = shapes.into_iter().chain(sides).flatten().next();
        found.unwrap_or_else(|| Err(not_exactly_one(key, &given)))
    }
}

impl Circle {
    fn check(self, key: &KeyPath) -> Result<Self, KeyFault> {
        require_positive(key, "radius", self.radius)?;
        Ok(self)
    }
}

/// The corners of a polygon that does not cross itself.
fn polygon(key: &KeyPath, corners: Vec<Point>) -> Result<Vec<Point>, KeyFault> {
    let fits = corners.len() >= 3 && !crosses_itself(&corners);
    let expected = "three corners or more of a polygon that does not cross or touch itself";
    require(fits, || key.child("polygon"), expected, &corners)?;
    Ok(corners)
}

/// One number for both sides of a cell, or one for each.
struct RawSpacing([f64; 2]);

impl<'de> Deserialize<'de> for RawSpacing {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_any(SpacingVisitor)
    }
}

impl JsonSchema for RawSpacing {
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

struct SpacingVisitor;

impl<'de> Visitor<'de> for SpacingVisitor {
    type Value = RawSpacing;

    fn expecting(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.write_str("a number or a list of 2")
    }

    fn visit_i64<E: serde::de::Error>(self, value: i64) -> Result<RawSpacing, E> {
        self.visit_f64(value as f64)
    }

    fn visit_f64<E: serde::de::Error>(self, value: f64) -> Result<RawSpacing, E> {
        Ok(RawSpacing([value; 2]))
    }

    fn visit_seq<A: SeqAccess<'de>>(self, mut elements: A) -> Result<RawSpacing, A::Error> {
        let mut sides = Vec::new();
        while let Some(side) = elements.next_element()? {
            sides.push(side);
        }
        let length = sides.len();
        let sides = sides.try_into();
        sides
            .map(RawSpacing)
            .map_err(|_: Vec<f64>| serde::de::Error::invalid_length(length, &self))
    }
}
