//! `[[support]]`: what holds the body; and the vectors of supports and loads.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::fault::KeyFault;
use super::key_path::KeyPath;
use super::region::{Rectangle, place};
use super::values::{Point, exactly_one};
use ligament::setup;

/// Prescribed displacements; a component that is not given is free.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(extend("minProperties" = 1))]
pub struct Displacement {
    /// Along x, m.
    pub x: Option<f64>,
    /// Along y, m.
    pub y: Option<f64>,
    /// Rotation, rad, counter-clockwise.
    pub rotation: Option<f64>,
}

/// A vector; a component that is not given is zero.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(extend("minProperties" = 1))]
pub struct Vector {
    /// Along x, in the unit of the force.
    #[serde(default)]
    pub x: f64,
    /// Along y, in the unit of the force.
    #[serde(default)]
    pub y: f64,
}

/// Stiffness of springs to the ground in total over the points, shared out as a force is; a component that is not given has none.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(extend("minProperties" = 1))]
pub struct SpringStiffness {
    /// Along x, N/m.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub x: Option<f64>,
    /// Along y, N/m.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub y: Option<f64>,
    /// Against rotations of the points, in N m/rad.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub rotation: Option<f64>,
    /// Along the `normal` of the support, N/m.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub normal: Option<f64>,
}

/// A support: displacements held at zero, or resisted by springs.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(extend("oneOf" = exactly_one(&["group", "box", "at"])))]
pub struct Support {
    /// The points of this physical group of the mesh, or of this set or hole of the lattice.
    pub group: Option<String>,
    /// The points in this rectangle, by two opposite corners `[[x, y], [x, y]]`, m.
    pub r#box: Option<Rectangle>,
    /// The point nearest to `[x, y]`, m.
    pub at: Option<Point>,
    /// The components that are held, each at 0: `{ x = 0.0 }`, `{ x = 0.0, y = 0.0 }`; m, rotation in rad.
    pub displacement: Option<Displacement>,
    /// An inclined roller: the direction along which the points are held while they are free across it, `[1.0, 1.0]` is at 45 degrees.
    pub normal: Option<Point>,
    /// Springs to the ground in the place of what holds, in total over the points.
    pub stiffness: Option<SpringStiffness>,
}

impl Support {
    pub(super) fn setup(&self, key: &KeyPath) -> Result<setup::Support, KeyFault> {
        let nothing = Displacement {
            x: None,
            y: None,
            rotation: None,
        };
        let Displacement { x, y, rotation } = self.displacement.unwrap_or(nothing);
        for (name, value) in [("x", x), ("y", y), ("rotation", rotation)] {
            if let Some(value) = value.filter(|it| *it != 0.0) {
                let reason = format!(
                    "a support holds at 0, found {value:?}: put prescribed displacements in a [[load]]"
                );
                return Err(KeyFault::new(key.child("displacement").child(name), reason));
            }
        }
        Ok(setup::Support {
            place: place(key, self.group.as_ref(), self.r#box, self.at)?,
            x: x.is_some(),
            y: y.is_some(),
            rotation: rotation.is_some(),
            normal: self.normal,
            stiffness: (self.stiffness).map_or_else(Default::default, |it| {
                setup::SpringStiffness {
                    x: it.x,
                    y: it.y,
                    rotation: it.rotation,
                    normal: it.normal,
                }
            }),
        })
    }
}
