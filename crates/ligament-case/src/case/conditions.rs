//! `[[support]]`: what holds the body; and the vectors of supports and loads.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::fault::KeyFault;
use super::key_path::KeyPath;
use super::region::{Place, no_place, place};
use super::values::Point;
use super::values::exactly_one;

/// Prescribed displacements; a component that is not given is free.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(extend("minProperties" = 1))]
pub struct Displacement {
    /// Along x, m.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub x: Option<f64>,
    /// Along y, m.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub y: Option<f64>,
    /// Rotation, rad, counter-clockwise.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub rotation: Option<f64>,
}

impl Displacement {
    fn components(&self) -> impl Iterator<Item = (&'static str, f64)> {
        [("x", self.x), ("y", self.y), ("rotation", self.rotation)]
            .into_iter()
            .filter_map(|(name, value)| Some((name, value?)))
    }

    pub(super) fn check(self, key: &KeyPath) -> Result<Self, KeyFault> {
        match self.components().next() {
            Some(_) => Ok(self),
            None => Err(KeyFault::new(
                key.clone(),
                "needs one of `x`, `y`, `rotation` or more",
            )),
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
}

impl Vector {
    pub(super) fn check(self, key: &KeyPath) -> Result<Self, KeyFault> {
        if self.x == 0.0 && self.y == 0.0 {
            return Err(KeyFault::new(
                key.clone(),
                "this load does nothing: neither `x` nor `y` is given a value",
            ));
        }
        Ok(self)
    }
}

/// A support: displacements held at zero.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Support {
    /// Where.
    #[serde(flatten)]
    pub place: Place,
    /// The components that are held; each is zero.
    pub displacement: Displacement,
}

#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(extend("oneOf" = exactly_one(&["group", "box", "at"])))]
pub(super) struct RawSupport {
    /// The points of this physical group of the mesh, or of this set or hole of the lattice.
    group: Option<String>,
    /// The points in this rectangle, by two opposite corners `[[x, y], [x, y]]`, m.
    r#box: Option<[Point; 2]>,
    /// The point nearest to `[x, y]`, m.
    at: Option<Point>,
    /// The components that are held, each at 0: `{ x = 0.0 }`, `{ x = 0.0, y = 0.0 }`; m, rotation in rad.
    displacement: Displacement,
}

impl RawSupport {
    pub(super) fn check(self, key: &KeyPath) -> Result<Support, KeyFault> {
        let place = place(key, self.group, self.r#box, self.at)?
            .ok_or_else(|| no_place(key, [false; 3]))?;
        let displacement = self.displacement.check(&key.child("displacement"))?;
        if let Some((name, value)) = displacement.components().find(|(_, value)| *value != 0.0) {
            let reason = format!(
                "a support holds at 0, found {value:?}: put prescribed displacements in a [[load]]"
            );
            return Err(KeyFault::new(key.child("displacement").child(name), reason));
        }
        Ok(Support {
            place,
            displacement,
        })
    }
}
