//! `[[support]]` and `[[initial_velocity]]`: supports of the body, its velocities at time zero, and the vectors of both and of loads.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::coordinates::Coordinates;
use super::fault::KeyFault;
use super::key_path::KeyPath;
use super::region::{Corners, place, place_or_everywhere};
use super::values::exactly_one;
use ligament::setup::{self, Displacement, Position, SpringStiffness};

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
        let given = self.displacement.unwrap_or_default();
        let moved = given.components().find(|(_, value)| *value != 0.0);
        if let Some((component, value)) = moved {
            let reason = format!(
                "a support holds at 0, found {value:?}: put prescribed displacements in a [[load]]"
            );
            let key = key.child("displacement").child(component.name());
            return Err(KeyFault::new(key, reason));
        }
        let normal = self
            .normal
            .map(|it| it.for_body(&key.child("normal"), dimensions));
        Ok(setup::Support {
            place: place(key, dimensions, self.group.as_ref(), self.r#box, self.at)?,
            held: given.components().map(|(component, _)| component).collect(),
            normal: normal.transpose()?,
            stiffness: self.stiffness.unwrap_or_default(),
        })
    }
}

/// A velocity at time zero. Where several reach, the last of them holds.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct InitialVelocity {
    /// The points of this physical group of the mesh, or of this set or hole of the lattice; without a place the whole body moves.
    pub group: Option<String>,
    /// The points in this rectangle, by two opposite corners `[[x, y], [x, y]]`, in a solid in this box, m.
    #[schemars(extend("x-unit" = "m"))]
    pub r#box: Option<Corners>,
    /// The point nearest to `[x, y]`, in a solid to `[x, y, z]`, m.
    #[schemars(extend("x-unit" = "m"))]
    pub at: Option<Coordinates>,
    /// The velocity, m/s.
    #[schemars(extend("x-unit" = "m/s"))]
    pub velocity: Vector,
}

impl InitialVelocity {
    pub(super) fn setup(
        &self,
        key: &KeyPath,
        dimensions: usize,
    ) -> Result<setup::InitialVelocity, KeyFault> {
        let group = self.group.as_ref();
        Ok(setup::InitialVelocity {
            place: place_or_everywhere(key, dimensions, group, self.r#box, self.at)?,
            velocity: self.velocity.for_body(&key.child("velocity"), dimensions)?,
        })
    }
}
