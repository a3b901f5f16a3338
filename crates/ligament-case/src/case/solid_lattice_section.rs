//! `[solid_lattice]`: a body on a regular lattice in space.

use std::collections::BTreeMap;

use ligament_model::shape::SolidShape;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::lattice_keys::{Grid, Shapes, Sides};
use super::values::exactly_one;

/// A box of equal cells, a point at the centre of each.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct SolidLatticeSection {
    /// Number of cells along x, y and z.
    #[schemars(inner(range(min = 1)))]
    pub cells: [u32; 3],
    /// Sides of the cells `[dx, dy, dz]`, m.
    #[schemars(extend("x-unit" = "m"))]
    pub spacing: [f64; 3],
    /// Corner of the box with the lowest coordinates, m.
    #[serde(default)]
    #[schemars(extend("x-unit" = "m"))]
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
    /// Makes the cells at its surface a `group`; several holes may share it.
    #[schemars(length(min = 1))]
    pub name: Option<String>,
    /// A ball, m.
    pub sphere: Option<Sphere>,
    /// A cylinder with flat ends, m.
    pub cylinder: Option<Cylinder>,
    /// A box by two opposite corners `[[x, y, z], [x, y, z]]`, m.
    #[schemars(extend("x-unit" = "m"))]
    pub r#box: Option<[[f64; 3]; 2]>,
    /// Everything outside of a ball, m.
    pub outside_sphere: Option<Sphere>,
    /// Everything outside of a cylinder that goes on beyond its ends, m.
    pub outside_cylinder: Option<Cylinder>,
}

/// A set of cells.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(extend("oneOf" = exactly_one(&["left", "right", "front", "back", "bottom", "top", "box", "sphere", "cylinder"])))]
pub struct SolidCellSetKeys {
    /// So many layers from the lowest x.
    #[schemars(range(min = 1))]
    pub left: Option<u32>,
    /// So many layers from the highest x.
    #[schemars(range(min = 1))]
    pub right: Option<u32>,
    /// So many layers from the lowest y.
    #[schemars(range(min = 1))]
    pub front: Option<u32>,
    /// So many layers from the highest y.
    #[schemars(range(min = 1))]
    pub back: Option<u32>,
    /// So many layers from the lowest z.
    #[schemars(range(min = 1))]
    pub bottom: Option<u32>,
    /// So many layers from the highest z.
    #[schemars(range(min = 1))]
    pub top: Option<u32>,
    /// Cells whose centre lies in a box, by two opposite corners, m.
    #[schemars(extend("x-unit" = "m"))]
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
    #[schemars(extend("x-unit" = "m"))]
    pub centre: [f64; 3],
    /// Radius, m.
    #[schemars(extend("exclusiveMinimum" = 0, "x-unit" = "m"))]
    pub radius: f64,
}

/// A cylinder.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Cylinder {
    /// Middles of its two ends, m.
    #[schemars(extend("x-unit" = "m"))]
    pub ends: [[f64; 3]; 2],
    /// Radius, m.
    #[schemars(extend("exclusiveMinimum" = 0, "x-unit" = "m"))]
    pub radius: f64,
}

impl SolidLatticeSection {
    /// What the section says of the lattice.
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
            sets: sets
                .map(|(name, it)| (name.clone(), (it.sides(), it.shapes())))
                .collect(),
        }
    }
}

impl SolidHoleKeys {
    fn shapes(&self) -> Shapes<SolidShape> {
        let outside_sphere = self
            .outside_sphere
            .map(|Sphere { centre, radius }| SolidShape::OutsideSphere { centre, radius });
        let outside_cylinder = self
            .outside_cylinder
            .map(|Cylinder { ends, radius }| SolidShape::OutsideCylinder { axis: ends, radius });
        vec![
            ("sphere", self.sphere.map(SolidShape::from)),
            ("cylinder", self.cylinder.map(SolidShape::from)),
            ("box", self.r#box.map(SolidShape::between)),
            ("outside_sphere", outside_sphere),
            ("outside_cylinder", outside_cylinder),
        ]
    }
}

impl SolidCellSetKeys {
    fn sides(&self) -> Sides<3> {
        vec![
            ("left", self.left, [-1, 0, 0]),
            ("right", self.right, [1, 0, 0]),
            ("front", self.front, [0, -1, 0]),
            ("back", self.back, [0, 1, 0]),
            ("bottom", self.bottom, [0, 0, -1]),
            ("top", self.top, [0, 0, 1]),
        ]
    }

    fn shapes(&self) -> Shapes<SolidShape> {
        vec![
            ("box", self.r#box.map(SolidShape::between)),
            ("sphere", self.sphere.map(SolidShape::from)),
            ("cylinder", self.cylinder.map(SolidShape::from)),
        ]
    }
}

impl From<Sphere> for SolidShape {
    fn from(Sphere { centre, radius }: Sphere) -> Self {
        Self::Sphere { centre, radius }
    }
}

impl From<Cylinder> for SolidShape {
    fn from(Cylinder { ends, radius }: Cylinder) -> Self {
        Self::Cylinder { ends, radius }
    }
}
