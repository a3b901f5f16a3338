//! Where on the body something acts: groups, boxes, points.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::fault::KeyFault;
use super::key_path::KeyPath;
use super::values::{Point, exactly_one, one_of};
use ligament::setup::Place;

/// A rectangle: its lower left and its upper right corner, m.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(try_from = "[Point; 2]")]
pub struct Rectangle(pub [Point; 2]);

impl TryFrom<[Point; 2]> for Rectangle {
    type Error = String;

    fn try_from([a, b]: [Point; 2]) -> Result<Self, String> {
        if a[0] == b[0] || a[1] == b[1] {
            let expected = "two opposite corners of a rectangle with a width and a height";
            return Err(format!("must be {expected}, found {:?}", [a, b]));
        }
        Ok(Self([
            [a[0].min(b[0]), a[1].min(b[1])],
            [a[0].max(b[0]), a[1].max(b[1])],
        ]))
    }
}

/// A part of the body.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(extend("oneOf" = exactly_one(&["group", "box"])))]
pub struct Region {
    /// The points of this physical group of the mesh, or of this set or hole of the lattice.
    pub group: Option<String>,
    /// The points in this rectangle, by two opposite corners `[[x, y], [x, y]]`, m.
    pub r#box: Option<Rectangle>,
}

impl Region {
    pub(super) fn place(&self, key: &KeyPath) -> Result<Place, KeyFault> {
        let group = self.group.clone().map(Place::Group);
        let corners = self.r#box.map(|it| Place::Box(it.0));
        one_of(key, [("group", group), ("box", corners)])
    }
}

/// The place of a table that must have one.
pub(super) fn place(
    key: &KeyPath,
    group: Option<&String>,
    corners: Option<Rectangle>,
    at: Option<Point>,
) -> Result<Place, KeyFault> {
    let group = group.cloned().map(Place::Group);
    let corners = corners.map(|it| Place::Box(it.0));
    let at = at.map(Place::At);
    one_of(key, [("group", group), ("box", corners), ("at", at)])
}
