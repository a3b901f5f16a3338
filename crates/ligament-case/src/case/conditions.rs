//! `[[support]]`: supports of the body; and the vectors of supports and loads.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::coordinates::Coordinates;
use super::fault::KeyFault;
use super::key_path::KeyPath;
use super::region::{Corners, place};
use super::values::exactly_one;
use ligament::setup::{self, Position};

/// Prescribed displacements; a component that is not given is free.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(extend("minProperties" = 1))]
pub struct Displacement {
    /// Along x, m.
    #[schemars(extend("x-unit" = "m"))]
    pub x: Option<f64>,
    /// Along y, m.
    #[schemars(extend("x-unit" = "m"))]
    pub y: Option<f64>,
    /// Rotation in the plane, rad, counter-clockwise.
    #[schemars(extend("x-unit" = "rad"))]
    pub rotation: Option<f64>,
    /// Along z of a solid, m.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(extend("x-unit" = "m"))]
    pub z: Option<f64>,
    /// Rotation about x in a solid, rad, right-handed.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(extend("x-unit" = "rad"))]
    pub rotation_x: Option<f64>,
    /// Rotation about y in a solid, rad, right-handed.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(extend("x-unit" = "rad"))]
    pub rotation_y: Option<f64>,
    /// Rotation about z in a solid, rad, right-handed.
    #[serde(skip_serializing_if = "Option::is_none")]
    #[schemars(extend("x-unit" = "rad"))]
    pub rotation_z: Option<f64>,
}

impl Displacement {
    pub(super) fn setup(&self) -> setup::Displacement {
        setup::Displacement {
            x: self.x,
            y: self.y,
            rotation: self.rotation,
            z: self.z,
            rotation_x: self.rotation_x,
            rotation_y: self.rotation_y,
            rotation_z: self.rotation_z,
        }
    }
}

/// Prescribed velocities or accelerations; a component that is not given is free.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(extend("minProperties" = 1))]
pub struct Rate {
    /// Along x.
    pub x: Option<f64>,
    /// Along y.
    pub y: Option<f64>,
    /// Of the rotation in the plane, counter-clockwise, with rad in the place of m.
    pub rotation: Option<f64>,
    /// Along z of a solid.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub z: Option<f64>,
    /// Of the rotation about x in a solid, right-handed.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub rotation_x: Option<f64>,
    /// Of the rotation about y in a solid, right-handed.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub rotation_y: Option<f64>,
    /// Of the rotation about z in a solid, right-handed.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub rotation_z: Option<f64>,
}

impl Rate {
    pub(super) fn setup(&self) -> setup::Displacement {
        setup::Displacement {
            x: self.x,
            y: self.y,
            rotation: self.rotation,
            z: self.z,
            rotation_x: self.rotation_x,
            rotation_y: self.rotation_y,
            rotation_z: self.rotation_z,
        }
    }
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
    /// Along z of a solid, in the unit of the force.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub z: Option<f64>,
}

impl Vector {
    pub(super) fn for_body(&self, key: &KeyPath, dimensions: usize) -> Result<Position, KeyFault> {
        if dimensions < 3 && self.z.is_some() {
            let reason = "a body in the plane has no z";
            return Err(KeyFault::new(key.child("z"), reason));
        }
        Ok([self.x, self.y, self.z.unwrap_or(0.0)])
    }
}

/// Stiffness of springs to the ground in total over the points, shared out as a force is; a component that is not given has none.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(extend("minProperties" = 1))]
pub struct SpringStiffness {
    /// Along x, N/m.
    #[schemars(extend("exclusiveMinimum" = 0, "x-unit" = "N/m"))]
    pub x: Option<f64>,
    /// Along y, N/m.
    #[schemars(extend("exclusiveMinimum" = 0, "x-unit" = "N/m"))]
    pub y: Option<f64>,
    /// Against rotations of the points, in N m/rad.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub rotation: Option<f64>,
    /// Along z of a solid, N/m.
    #[schemars(extend("exclusiveMinimum" = 0, "x-unit" = "N/m"))]
    #[serde(skip_serializing_if = "Option::is_none")]
    pub z: Option<f64>,
    /// Along the `normal` of the support, N/m.
    #[schemars(extend("exclusiveMinimum" = 0, "x-unit" = "N/m"))]
    pub normal: Option<f64>,
}

/// A support: displacements held at zero, or resisted by springs.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(extend("oneOf" = exactly_one(&["group", "box", "at"])))]
pub struct Support {
    /// The points of this physical group of the mesh, or of this set or hole of the lattice.
    pub group: Option<String>,
    /// The points in this rectangle, by two opposite corners `[[x, y], [x, y]]`, in a solid in this box, m.
    #[schemars(extend("x-unit" = "m"))]
    pub r#box: Option<Corners>,
    /// The point nearest to `[x, y]`, in a solid to `[x, y, z]`, m.
    #[schemars(extend("x-unit" = "m"))]
    pub at: Option<Coordinates>,
    /// The components that are held, each at 0: `{ x = 0.0 }`, `{ x = 0.0, y = 0.0 }`; m, rotation in rad.
    pub displacement: Option<Displacement>,
    /// An inclined roller: the direction along which the points are held while they are free across it, `[1.0, 1.0]` is at 45 degrees.
    pub normal: Option<Coordinates>,
    /// Springs to the ground in the place of what holds, in total over the points.
    pub stiffness: Option<SpringStiffness>,
}

impl Support {
    pub(super) fn setup(
        &self,
        key: &KeyPath,
        dimensions: usize,
    ) -> Result<setup::Support, KeyFault> {
        let given = self.displacement.unwrap_or_default().setup();
        let moved = given.components().find(|(_, value)| *value != 0.0);
        if let Some((component, value)) = moved {
            let reason = format!(
                "a support holds at 0, found {value:?}: put prescribed displacements in a [[load]]"
            );
            let key = key.child("displacement").child(component.name());
            return Err(KeyFault::new(key, reason));
        }
        let stiffness = |it: SpringStiffness| setup::SpringStiffness {
            components: setup::Displacement {
                x: it.x,
                y: it.y,
                rotation: it.rotation,
                z: it.z,
                ..setup::Displacement::default()
            },
            normal: it.normal,
        };
        let normal = self
            .normal
            .map(|it| it.for_body(&key.child("normal"), dimensions));
        Ok(setup::Support {
            place: place(key, dimensions, self.group.as_ref(), self.r#box, self.at)?,
            held: given.components().map(|(component, _)| component).collect(),
            normal: normal.transpose()?,
            stiffness: self.stiffness.map(stiffness).unwrap_or_default(),
        })
    }
}
