//! Where on the body something acts: groups, boxes, points.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::fault::KeyFault;
use super::key_path::KeyPath;
use super::values::exactly_one;
use super::values::{Point, not_exactly_one, require};

/// Where a support or a load acts.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Place {
    /// The points of a physical group of the mesh, or of a set of the lattice.
    Group(String),
    /// The points in a rectangle: its lower left and its upper right corner.
    Box([Point; 2]),
    /// The point nearest to a position.
    At(Point),
}

/// A part of the body.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Region {
    /// The points of a physical group of the mesh, or of a set of the lattice.
    Group(String),
    /// The points in a rectangle: its lower left and its upper right corner.
    Box([Point; 2]),
}

/// The keys that say where something acts, as found.
#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(extend("oneOf" = exactly_one(&["group", "box"])))]
pub(super) struct RawRegion {
    /// The points of this physical group of the mesh, or of this set or hole of the lattice.
    group: Option<String>,
    /// The points in this rectangle, by two opposite corners `[[x, y], [x, y]]`, m.
    r#box: Option<[Point; 2]>,
}

impl RawRegion {
    /// The region of these keys at a table; none where neither is given.
    pub(super) fn optional(
        key: &KeyPath,
        group: Option<String>,
        r#box: Option<[Point; 2]>,
    ) -> Result<Option<Region>, KeyFault> {
        if group.is_none() && r#box.is_none() {
            return Ok(None);
        }
        Self { group, r#box }.check(key).map(Some)
    }

    pub(super) fn check(self, key: &KeyPath) -> Result<Region, KeyFault> {
        match (self.group, self.r#box) {
            (Some(group), None) => Ok(Region::Group(group)),
            (None, Some(corners)) => Ok(Region::Box(ordered_box(&key.child("box"), corners)?)),
            (group, corners) => {
                let keys = [("group", group.is_some()), ("box", corners.is_some())];
                Err(not_exactly_one(key, &keys))
            }
        }
    }
}

/// The place given by the three keys of which at most one may be there; `Ok(None)` if none is.
pub(super) fn place(
    key: &KeyPath,
    group: Option<String>,
    corners: Option<[Point; 2]>,
    at: Option<Point>,
) -> Result<Option<Place>, KeyFault> {
    match (group, corners, at) {
        (None, None, None) => Ok(None),
        (Some(group), None, None) => Ok(Some(Place::Group(group))),
        (None, Some(corners), None) => {
            Ok(Some(Place::Box(ordered_box(&key.child("box"), corners)?)))
        }
        (None, None, Some(point)) => Ok(Some(Place::At(point))),
        (group, corners, at) => Err(no_place(
            key,
            [group.is_some(), corners.is_some(), at.is_some()],
        )),
    }
}

/// The fault of giving none or several of the keys for a place.
pub(super) fn no_place(key: &KeyPath, given: [bool; 3]) -> KeyFault {
    not_exactly_one(
        key,
        &[("group", given[0]), ("box", given[1]), ("at", given[2])],
    )
}

/// The box at a key with its lower left corner first.
pub(super) fn ordered_box(key: &KeyPath, [a, b]: [Point; 2]) -> Result<[Point; 2], KeyFault> {
    let expected = "two opposite corners of a rectangle with a width and a height";
    require(
        a[0] != b[0] && a[1] != b[1],
        || key.clone(),
        expected,
        [a, b],
    )?;
    Ok([
        [a[0].min(b[0]), a[1].min(b[1])],
        [a[0].max(b[0]), a[1].max(b[1])],
    ])
}
