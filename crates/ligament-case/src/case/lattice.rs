//! `[lattice]` and `[solid_lattice]`: a body on a regular lattice in the plane, and in space.

use std::borrow::Cow;
use std::collections::BTreeMap;

use ligament::body::{self, BodyOnLattice, Cells, LatticeError, LatticeShape};
use ligament_model::shape::{SolidShape, crosses_itself};
use ligament_model::{Plane, Shape};
use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde::de::Error;
use serde::{Deserialize, Deserializer, Serialize};

use super::fault::KeyFault;
use super::key_path::KeyPath;
use super::places::Rectangle;
use super::values::{Form, Point, each, exactly_one, metre};
use super::values::{one_of, require, require_column_name};

/// Largest number of cells of a lattice.
pub const MOST_CELLS: u64 = 50_000_000;

/// Largest distance from the origin, in cells: beyond it coordinates of neighbours would share too many digits.
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
    #[schemars(extend("exclusiveMinimum" = 0, "default" = 1.0))]
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
    /// Name of the `group` of the cells at its rim; several holes may share it.
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
    /// Number of rows from the bottom.
    #[schemars(range(min = 1))]
    pub bottom: Option<u32>,
    /// Number of rows from the top.
    #[schemars(range(min = 1))]
    pub top: Option<u32>,
    /// Number of columns from the left.
    #[schemars(range(min = 1))]
    pub left: Option<u32>,
    /// Number of columns from the right.
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

/// A box of equal cells, a point at the centre of each.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct SolidLatticeSection {
    /// Number of cells along x, y and z.
    #[schemars(inner(range(min = 1)))]
    pub cells: [u32; 3],
    /// Sides of the cells `[dx, dy, dz]`, m.
    pub spacing: [f64; 3],
    /// Corner of the box with the lowest coordinates, m.
    #[serde(default)]
    pub corner: [f64; 3],
    /// Holes: cells whose centre lies in one are removed, and bonds across it.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub remove: Vec<SolidHoleKeys>,
    /// Named sets of cells, which stand wherever a `group` does.
    #[serde(rename = "set", default, skip_serializing_if = "BTreeMap::is_empty")]
    pub sets: BTreeMap<String, SolidCellSetKeys>,
}

/// A hole: cells whose centre lies in it are removed.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(extend("oneOf" = exactly_one(&["sphere", "cylinder", "box", "outside_sphere", "outside_cylinder"])))]
pub struct SolidHoleKeys {
    /// Name of the `group` of the cells at its surface; several holes may share it.
    #[schemars(length(min = 1))]
    pub name: Option<String>,
    /// A ball, m.
    pub sphere: Option<Sphere>,
    /// A cylinder with flat ends, m.
    pub cylinder: Option<Cylinder>,
    /// A box by two opposite corners `[[x, y, z], [x, y, z]]`, m.
    pub r#box: Option<[[f64; 3]; 2]>,
    /// Everything outside of a ball, m.
    pub outside_sphere: Option<Sphere>,
    /// Everything outside of an infinite cylinder, m.
    pub outside_cylinder: Option<Cylinder>,
}

/// A set of cells.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(extend("oneOf" = exactly_one(&["left", "right", "front", "back", "bottom", "top", "box", "sphere", "cylinder"])))]
pub struct SolidCellSetKeys {
    /// Number of layers from the lowest x.
    #[schemars(range(min = 1))]
    pub left: Option<u32>,
    /// Number of layers from the highest x.
    #[schemars(range(min = 1))]
    pub right: Option<u32>,
    /// Number of layers from the lowest y.
    #[schemars(range(min = 1))]
    pub front: Option<u32>,
    /// Number of layers from the highest y.
    #[schemars(range(min = 1))]
    pub back: Option<u32>,
    /// Number of layers from the lowest z.
    #[schemars(range(min = 1))]
    pub bottom: Option<u32>,
    /// Number of layers from the highest z.
    #[schemars(range(min = 1))]
    pub top: Option<u32>,
    /// Cells whose centre lies in a box, by two opposite corners, m.
    pub r#box: Option<[[f64; 3]; 2]>,
    /// Cells whose centre lies in a ball, m.
    pub sphere: Option<Sphere>,
    /// Cells whose centre lies in a cylinder, m.
    pub cylinder: Option<Cylinder>,
}

/// A ball.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Sphere {
    /// Centre, m.
    pub centre: [f64; 3],
    /// Radius, m.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub radius: f64,
}

/// A cylinder.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Cylinder {
    /// Middles of its two ends, m.
    pub ends: [[f64; 3]; 2],
    /// Radius, m.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub radius: f64,
}

impl LatticeSection {
    /// The lattice of the section.
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
            sets: sets.map(|(name, it)| (name.clone(), it.cells())).collect(),
        }
    }
}

impl SolidLatticeSection {
    /// The lattice of the section.
    pub(crate) fn grid(&self) -> Grid<3, SolidShape> {
        let holes = self.remove.iter();
        let sets = self.sets.iter();
        Grid {
            section: "solid_lattice",
            axes: "each axis",
            cells: self.cells,
            spacing: self.spacing,
            corner: self.corner,
            thickness: 1.0,
            holes: holes.map(|it| (it.name.clone(), it.shapes())).collect(),
            sets: sets.map(|(name, it)| (name.clone(), it.cells())).collect(),
        }
    }
}

/// Values by alternative keys, exactly one of them given.
type Choices<T> = Vec<(&'static str, Option<T>)>;

impl Hole {
    fn shapes(&self) -> Choices<Shape> {
        vec![
            ("circle", self.circle.map(Circle::inside)),
            ("rectangle", self.rectangle.map(Shape::from)),
            ("polygon", self.polygon.clone().map(Shape::from)),
            ("outside", self.outside.map(Circle::outside)),
        ]
    }
}

impl CellSet {
    fn cells(&self) -> Choices<Cells<2, Shape>> {
        let inside = |shape: Option<Shape>| shape.map(Cells::Inside);
        vec![
            ("bottom", self.bottom.map(Cells::bottom)),
            ("top", self.top.map(Cells::top)),
            ("left", self.left.map(Cells::left)),
            ("right", self.right.map(Cells::right)),
            ("box", inside(self.r#box.map(Shape::from))),
            ("circle", inside(self.circle.map(Circle::inside))),
            ("polygon", inside(self.polygon.clone().map(Shape::from))),
        ]
    }
}

impl SolidHoleKeys {
    fn shapes(&self) -> Choices<SolidShape> {
        vec![
            ("sphere", self.sphere.map(Sphere::inside)),
            ("cylinder", self.cylinder.map(Cylinder::inside)),
            ("box", self.r#box.map(SolidShape::between)),
            ("outside_sphere", self.outside_sphere.map(Sphere::outside)),
            (
                "outside_cylinder",
                self.outside_cylinder.map(Cylinder::outside),
            ),
        ]
    }
}

impl SolidCellSetKeys {
    fn cells(&self) -> Choices<Cells<3, SolidShape>> {
        let side = |layers: Option<u32>, normal| layers.map(|it| Cells::AtSide(normal, it));
        let inside = |shape: Option<SolidShape>| shape.map(Cells::Inside);
        vec![
            ("left", side(self.left, [-1, 0, 0])),
            ("right", side(self.right, [1, 0, 0])),
            ("front", side(self.front, [0, -1, 0])),
            ("back", side(self.back, [0, 1, 0])),
            ("bottom", side(self.bottom, [0, 0, -1])),
            ("top", side(self.top, [0, 0, 1])),
            ("box", inside(self.r#box.map(SolidShape::between))),
            ("sphere", inside(self.sphere.map(Sphere::inside))),
            ("cylinder", inside(self.cylinder.map(Cylinder::inside))),
        ]
    }
}

/// Content of a section for a lattice in D dimensions.
pub(crate) struct Grid<const D: usize, S> {
    /// Key of the section.
    section: &'static str,
    /// Text for the axes: "x and y".
    axes: &'static str,
    /// Number of cells along the axes.
    cells: [u32; D],
    /// Sides of the cells, m.
    spacing: [f64; D],
    /// Corner with the lowest coordinates, m.
    corner: [f64; D],
    /// Thickness of a body in the plane, m; 1 for a solid.
    thickness: f64,
    /// Holes, each with the name of the group of the cells at its rim.
    holes: Vec<(Option<String>, Choices<S>)>,
    /// Sets of cells by their names.
    sets: BTreeMap<String, Choices<Cells<D, S>>>,
}

impl<const D: usize, S: LatticeShape<D>> Grid<D, S> {
    /// The body of the section.
    ///
    /// # Errors
    ///
    /// If a key is out of range, or no cell remains of the lattice, of a set or of the rim of a hole.
    pub(crate) fn body(self) -> Result<BodyOnLattice<D, S>, KeyFault> {
        let section = self.key();
        let (holes, sets) = (self.holes()?, self.sets()?);
        let body = BodyOnLattice::new(self.cells, self.spacing, self.corner, &holes, &sets);
        body.map_err(|error| {
            let key = match &error {
                LatticeError::NothingLeft { .. } => section.child("remove"),
                LatticeError::EmptySet { name } => section.child("set").child(name),
                LatticeError::NoRim { hole } => section.child("remove").child(*hole),
            };
            KeyFault::new(key, error.to_string())
        })
    }

    /// A substitute for the body of the section: one of its cells.
    ///
    /// # Errors
    ///
    /// If a key is out of range.
    pub(crate) fn substitute_body(self) -> Result<BodyOnLattice<D, S>, KeyFault> {
        self.holes()?;
        self.sets()?;
        let (spacing, corner) = (self.spacing, self.corner);
        let cell = BodyOnLattice::new([1; D], spacing, corner, &[], &BTreeMap::new());
        cell.map_err(|error| KeyFault::new(self.key(), error.to_string()))
    }

    fn key(&self) -> KeyPath {
        KeyPath::default().child(self.section)
    }

    fn holes(&self) -> Result<Vec<body::Hole<S>>, KeyFault> {
        self.check_size()?;
        each(&self.key().child("remove"), &self.holes, |hole, key| {
            let (name, shapes) = hole.clone();
            if let Some(name) = &name {
                let key = key.child("name");
                require_column_name(|| key.clone(), name)?;
                if self.sets.contains_key(name) {
                    let section = self.section;
                    let reason =
                        format!("`{section}.set` has a `{name}` as well: rename one of them");
                    return Err(KeyFault::new(key, reason));
                }
            }
            let shape = one_of(key, shapes)?;
            Ok(body::Hole { name, shape })
        })
    }

    fn sets(&self) -> Result<BTreeMap<String, Cells<D, S>>, KeyFault> {
        let sets = self.sets.iter().map(|(set, choices)| {
            let key = self.key().child("set").child(set);
            for (name, cells) in choices {
                if let Some(Cells::AtSide(normal, layers)) = cells {
                    let across = normal.iter().position(|it| *it != 0).unwrap_or(0);
                    let most = self.cells[across];
                    let expected = format!("{most} or less, as the lattice has");
                    require(*layers <= most, || key.child(name), &expected, layers)?;
                }
            }
            Ok((set.clone(), one_of(&key, choices.clone())?))
        });
        sets.collect()
    }

    fn check_size(&self) -> Result<(), KeyFault> {
        let (cells, spacing, corner) = (self.cells, self.spacing, self.corner);
        let along = cells.iter().map(|&it| u64::from(it));
        let n_cells = along.fold(1_u64, u64::saturating_mul);
        let axes = self.axes;
        require(
            (1..=MOST_CELLS).contains(&n_cells),
            || self.key().child("cells"),
            &format!("at least 1 along {axes}, and {MOST_CELLS} together at most"),
            cells,
        )?;
        let volume = spacing.iter().product::<f64>() * self.thickness;
        require(
            spacing.iter().all(|side| *side > 0.0) && volume.is_normal(),
            || self.key().child("spacing"),
            "greater than 0, and of a size that gives the cells a volume",
            spacing,
        )?;
        let is_near = |axis: usize| {
            corner[axis].abs() + f64::from(cells[axis]) * spacing[axis] <= FARTHEST * spacing[axis]
        };
        require(
            (0..D).all(is_near),
            || self.key().child("corner"),
            "so near to the origin that no corner of the lattice is more than 1e9 cells away from it",
            corner,
        )
    }
}

impl Circle {
    fn inside(self) -> Shape {
        let Self { centre, radius } = self;
        Shape::Circle { centre, radius }
    }

    fn outside(self) -> Shape {
        let Self { centre, radius } = self;
        Shape::Outside { centre, radius }
    }
}

impl Sphere {
    fn inside(self) -> SolidShape {
        let Self { centre, radius } = self;
        SolidShape::Sphere { centre, radius }
    }

    fn outside(self) -> SolidShape {
        let Self { centre, radius } = self;
        SolidShape::OutsideSphere { centre, radius }
    }
}

impl Cylinder {
    fn inside(self) -> SolidShape {
        let Self { ends, radius } = self;
        SolidShape::Cylinder { ends, radius }
    }

    fn outside(self) -> SolidShape {
        let Self { ends: axis, radius } = self;
        SolidShape::OutsideCylinder { axis, radius }
    }
}

impl From<Rectangle> for Shape {
    fn from(rectangle: Rectangle) -> Self {
        Self::rectangle(rectangle.0)
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
            other => Err(other.wrong_form_error(expected)),
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
