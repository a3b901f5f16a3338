//! `[[support]]` and `[[load]]`: what holds the body and what acts on it.

use serde::{Deserialize, Serialize};

use super::fault::KeyFault;
use super::key_path::KeyPath;
use super::region::{Place, no_place, place};
use super::values::{Point, not_exactly_one, require_column_name};

/// Prescribed displacements; a component that is not given is free.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
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

    fn check(self, key: &KeyPath) -> Result<Self, KeyFault> {
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
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Vector {
    /// Along x.
    #[serde(default)]
    pub x: f64,
    /// Along y.
    #[serde(default)]
    pub y: f64,
}

impl Vector {
    fn check(self, key: &KeyPath) -> Result<Self, KeyFault> {
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

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct RawSupport {
    group: Option<String>,
    r#box: Option<[Point; 2]>,
    at: Option<Point>,
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

/// A load, given as it is at load factor 1.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Load {
    /// Name, unique among the loads.
    pub name: String,
    /// Where; none only for a body force on the whole body.
    #[serde(flatten)]
    pub place: Option<Place>,
    /// What acts.
    #[serde(flatten)]
    pub action: Action,
}

/// What a load does.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Action {
    /// Prescribed displacements, m and rad.
    Displacement(Displacement),
    /// A force in total over the points, N.
    Force(Vector),
    /// A force along a curve group, N/m.
    ForcePerLength(Vector),
    /// A force in the volume, N/m^3.
    BodyForce(Vector),
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct RawLoad {
    name: Option<String>,
    group: Option<String>,
    r#box: Option<[Point; 2]>,
    at: Option<Point>,
    displacement: Option<Displacement>,
    force: Option<Vector>,
    force_per_length: Option<Vector>,
    body_force: Option<Vector>,
}

impl RawLoad {
    /// Checks the load; `number` counts from 1 and names a load that has neither name nor group.
    pub(super) fn check(self, key: &KeyPath, number: usize) -> Result<Load, KeyFault> {
        let action = self.action(key)?;
        let name = self.name.clone().or_else(|| self.group.clone());
        let name = name.unwrap_or_else(|| format!("load-{number}"));
        let named_by = if self.name.is_some() { "name" } else { "group" };
        require_column_name(|| key.child(named_by), &name)?;
        let place = place(key, self.group, self.r#box, self.at)?;
        check_place(key, place.as_ref(), &action)?;
        Ok(Load {
            name,
            place,
            action,
        })
    }

    fn action(&self, key: &KeyPath) -> Result<Action, KeyFault> {
        match (
            self.displacement,
            self.force,
            self.force_per_length,
            self.body_force,
        ) {
            (Some(value), None, None, None) => Ok(Action::Displacement(
                value.check(&key.child("displacement"))?,
            )),
            (None, Some(value), None, None) => Ok(Action::Force(value.check(&key.child("force"))?)),
            (None, None, Some(value), None) => Ok(Action::ForcePerLength(
                value.check(&key.child("force_per_length"))?,
            )),
            (None, None, None, Some(value)) => {
                Ok(Action::BodyForce(value.check(&key.child("body_force"))?))
            }
            (displacement, force, per_length, body) => Err(not_exactly_one(
                key,
                &[
                    ("displacement", displacement.is_some()),
                    ("force", force.is_some()),
                    ("force_per_length", per_length.is_some()),
                    ("body_force", body.is_some()),
                ],
            )),
        }
    }
}

/// A force per length needs the length of a group; only a body force may act on everything.
fn check_place(key: &KeyPath, place: Option<&Place>, action: &Action) -> Result<(), KeyFault> {
    match (action, place) {
        (Action::BodyForce(_), Some(Place::At(_))) => {
            let reason =
                "a body force acts on a volume: give `group`, `box`, or neither for the whole body";
            Err(KeyFault::new(key.child("at"), reason))
        }
        (Action::BodyForce(_), _) | (Action::ForcePerLength(_), Some(Place::Group(_))) => Ok(()),
        (Action::ForcePerLength(_), _) => {
            let reason = "acts along the curve of a `group`, so the load needs one";
            Err(KeyFault::new(key.child("force_per_length"), reason))
        }
        (_, None) => Err(no_place(key, [false; 3])),
        (_, Some(_)) => Ok(()),
    }
}
