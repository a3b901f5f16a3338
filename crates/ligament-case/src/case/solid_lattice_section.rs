//! `[solid_lattice]`: a body on a regular lattice in space.

use std::collections::BTreeMap;

use ligament::body::{SolidCellSet, SolidHole};
use ligament_model::shape::SolidShape;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::fault::KeyFault;
use super::key_path::KeyPath;
use super::lattice_section::MOST_CELLS;
use super::values::{exactly_one, one_of, require, require_column_name};

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
    /// Makes the cells at its surface a `group`; several holes may share it.
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

impl SolidLatticeSection {
    /// The key path of a set.
    pub(crate) fn set_key(name: &str) -> String {
        let sets = KeyPath::default().child("solid_lattice").child("set");
        sets.child(name).to_string()
    }

    /// Holes and sets of the box.
    pub(crate) fn parts(
        &self,
        key: &KeyPath,
    ) -> Result<(Vec<SolidHole>, BTreeMap<String, SolidCellSet>), KeyFault> {
        self.check_size(key)?;
        let holes = self.remove.iter().enumerate().map(|(index, hole)| {
            let key = key.child("remove").child(index);
            if let Some(name) = &hole.name {
                require_column_name(|| key.child("name"), name)?;
                if self.sets.contains_key(name) {
                    let reason =
                        format!("`solid_lattice.set` has a `{name}` as well: rename one of them");
                    return Err(KeyFault::new(key.child("name"), reason));
                }
            }
            Ok(SolidHole {
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
        let n_cells = self.cells.iter().map(|&it| u64::from(it));
        let n_cells = n_cells.fold(1_u64, u64::saturating_mul);
        require(
            (1..=MOST_CELLS).contains(&n_cells),
            || key.child("cells"),
            &format!("at least 1 along each axis, and {MOST_CELLS} together at most"),
            self.cells,
        )?;
        let volume: f64 = self.spacing.iter().product();
        require(
            self.spacing.iter().all(|side| *side > 0.0) && volume.is_normal(),
            || key.child("spacing"),
            "greater than 0, and of a size that gives the cells a volume",
            self.spacing,
        )
    }
}

impl SolidHoleKeys {
    fn shape(&self, key: &KeyPath) -> Result<SolidShape, KeyFault> {
        let outside_sphere = self
            .outside_sphere
            .map(|Sphere { centre, radius }| SolidShape::OutsideSphere { centre, radius });
        let outside_cylinder = self
            .outside_cylinder
            .map(|Cylinder { ends, radius }| SolidShape::OutsideCylinder { axis: ends, radius });
        let shapes = [
            ("sphere", self.sphere.map(SolidShape::from)),
            ("cylinder", self.cylinder.map(SolidShape::from)),
            ("box", self.r#box.map(SolidShape::between)),
            ("outside_sphere", outside_sphere),
            ("outside_cylinder", outside_cylinder),
        ];
        one_of(key, shapes)
    }
}

impl SolidCellSetKeys {
    /// The cells of the set in a box of so many along the axes.
    fn cells(&self, key: &KeyPath, size: [u32; 3]) -> Result<SolidCellSet, KeyFault> {
        let sides = [
            ("left", self.left, [-1, 0, 0]),
            ("right", self.right, [1, 0, 0]),
            ("front", self.front, [0, -1, 0]),
            ("back", self.back, [0, 1, 0]),
            ("bottom", self.bottom, [0, 0, -1]),
            ("top", self.top, [0, 0, 1]),
        ];
        for (name, layers, normal) in sides {
            let across = normal.iter().position(|it| *it != 0).unwrap_or(0);
            let (most, layers) = (size[across], layers.unwrap_or(1));
            let expected = format!("{most} or less, as the lattice has");
            require(layers <= most, || key.child(name), &expected, layers)?;
        }
        let [left, right, front, back, bottom, top] = sides.map(|(name, layers, normal)| {
            (name, layers.map(|it| SolidCellSet::AtSide(normal, it)))
        });
        let inside = |shape: Option<SolidShape>| shape.map(SolidCellSet::Inside);
        let sets = [
            left,
            right,
            front,
            back,
            bottom,
            top,
            ("box", inside(self.r#box.map(SolidShape::between))),
            ("sphere", inside(self.sphere.map(SolidShape::from))),
            ("cylinder", inside(self.cylinder.map(SolidShape::from))),
        ];
        one_of(key, sets)
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
