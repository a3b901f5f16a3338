//! `[[precrack]]`: initial cracks and slots.

use std::f64::consts::{FRAC_1_SQRT_2, FRAC_PI_4};

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::fault::KeyFault;
use super::key_path::KeyPath;
use super::places::Coordinates;
use super::values::{Point, exactly_one, first_given, missing_key};
use super::values::{not_exactly_one, one_of, refuse, require};
use ligament::setup::{CrackShape, PreCrack};
use ligament_model::bonds::precrack::Ends;

/// Distance within which an angle counts as a multiple of 45 degrees, rad: pi with ten digits means pi, and points on an axis lie on a
/// crack along it.
const SAME_ANGLE: f64 = 1e-9;

/// A crack that is there from the start.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(extend("oneOf" = exactly_one(&["points", "centre", "group"])))]
#[schemars(extend("dependencies" = { "length": ["centre", "angle"], "angle": ["centre", "length"], "normal": ["centre", "radius"], "radius": ["centre", "normal"] }))]
pub struct Precrack {
    /// Corners of the polyline, two or more `[x, y]`, m; in a solid of a plane polygon, three or more `[x, y, z]`.
    #[schemars(length(min = 2))]
    pub points: Option<Vec<Coordinates>>,
    /// Middle of a straight crack, m; with `length` and `angle` in the place of `points`. In a solid the middle of a disk, with `normal` and
    /// `radius`.
    pub centre: Option<Coordinates>,
    /// Length of a straight crack, m.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub length: Option<f64>,
    /// Angle from the x axis to a straight crack, counter-clockwise, rad.
    pub angle: Option<f64>,
    /// Normal of a disk in a solid.
    pub normal: Option<Coordinates>,
    /// Radius of a disk in a solid, m.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub radius: Option<f64>,
    /// The faces of this physical surface of a solid mesh, or the edges of this physical curve of a mesh in the plane.
    pub group: Option<String>,
    /// Whether bonds that only touch the crack are cut.
    #[serde(default)]
    pub ends: Ends,
}

impl Precrack {
    /// The pre-crack of a body in some dimensions.
    pub(super) fn setup(&self, key: &KeyPath, dimensions: usize) -> Result<PreCrack, KeyFault> {
        Ok(PreCrack {
            shape: match dimensions {
                2 => self.line(key)?,
                _ => self.surface(key)?,
            },
            ends: self.ends,
        })
    }

    fn line(&self, key: &KeyPath) -> Result<CrackShape, KeyFault> {
        let of_solids = ["normal", "radius"];
        let reason = "only pre-cracks of solids, which are surfaces, have it";
        refuse(key, self, &of_solids, "a body in the plane", reason)?;
        let straight = ["centre", "length", "angle"];
        let reason = "a pre-crack has the corners of a polyline, or `centre`, `length` and `angle` of a straight line, or a group of curves";
        if let Some(group) = &self.group {
            refuse(key, self, &["points"], "`group`", reason)?;
            refuse(key, self, &straight, "`group`", reason)?;
            return Ok(CrackShape::Group(group.clone()));
        }
        Ok(CrackShape::Line(match &self.points {
            Some(points) => {
                refuse(key, self, &straight, "`points`", reason)?;
                points.iter().map(Coordinates::in_plane).collect()
            }
            None if first_given(self, &straight).is_some() => self.ends_of_line(key)?.to_vec(),
            None => {
                let keys = [("points", false), ("centre", false), ("group", false)];
                return Err(not_exactly_one(key, &keys));
            }
        }))
    }

    fn surface(&self, key: &KeyPath) -> Result<CrackShape, KeyFault> {
        let reason = "only pre-cracks in the plane, which are lines, have it";
        refuse(key, self, &["length", "angle"], "a solid", reason)?;
        let points = self.points.as_ref().map(|points| {
            let corners = points.iter().map(Coordinates::position);
            Ok(CrackShape::Polygon(corners.collect()))
        });
        let disk = self.centre.map(|centre| {
            let normal = self.normal.ok_or_else(|| missing_key(key, "normal"))?;
            Ok(CrackShape::Disk {
                centre: centre.position(),
                normal: normal.position(),
                radius: self.radius.ok_or_else(|| missing_key(key, "radius"))?,
            })
        });
        let group = self.group.clone().map(|it| Ok(CrackShape::Group(it)));
        one_of(
            key,
            [("points", points), ("centre", disk), ("group", group)],
        )?
    }

    fn ends_of_line(&self, key: &KeyPath) -> Result<[Point; 2], KeyFault> {
        let centre = self.centre.ok_or_else(|| missing_key(key, "centre"))?;
        let length = self.length.ok_or_else(|| missing_key(key, "length"))?;
        let angle = self.angle.ok_or_else(|| missing_key(key, "angle"))?;
        let ends = straight(centre.in_plane(), length, angle);
        require(
            ends[0] != ends[1],
            || key.child("length"),
            "so large that the ends differ in the digits of their coordinates",
            length,
        )?;
        Ok(ends)
    }
}

/// The ends of a straight line.
fn straight([x, y]: Point, length: f64, angle: f64) -> [Point; 2] {
    let [along_x, along_y] = direction(angle).map(|component| 0.5 * length * component);
    [[x - along_x, y - along_y], [x + along_x, y + along_y]]
}

/// The unit vector at an angle from the x axis, exact at multiples of 45 degrees.
fn direction(angle: f64) -> [f64; 2] {
    const HALF: f64 = FRAC_1_SQRT_2;
    const EIGHTHS: [[f64; 2]; 8] = [
        [1.0, 0.0],
        [HALF, HALF],
        [0.0, 1.0],
        [-HALF, HALF],
        [-1.0, 0.0],
        [-HALF, -HALF],
        [0.0, -1.0],
        [HALF, -HALF],
    ];
    let eighths = (angle / FRAC_PI_4).round();
    if (angle - eighths * FRAC_PI_4).abs() > SAME_ANGLE {
        return [angle.cos(), angle.sin()];
    }
    EIGHTHS[eighths.rem_euclid(8.0) as usize]
}

#[cfg(test)]
mod tests {
    use std::f64::consts::PI;

    use super::*;

    fn rounded(value: f64, digits: i32) -> f64 {
        (value * 10_f64.powi(digits)).round() / 10_f64.powi(digits)
    }

    /// On an axis and halfway between two a direction is exact, for angles of all sizes and for pi with ten digits.
    #[test]
    fn eighths_of_a_turn_are_exact() {
        assert_eq!(direction(0.0), [1.0, 0.0]);
        for angle in [PI / 2.0, rounded(PI / 2.0, 10), 2.5 * PI, -1.5 * PI] {
            assert_eq!(direction(angle), [0.0, 1.0], "{angle}");
        }
        assert_eq!(direction(-PI / 4.0), [FRAC_1_SQRT_2, -FRAC_1_SQRT_2]);
        assert_eq!(direction(5.0 * PI / 4.0), [-FRAC_1_SQRT_2; 2]);
        assert_eq!(straight([0.1, 0.2], 0.03, PI), [[0.115, 0.2], [0.085, 0.2]]);
    }

    /// Any other angle is taken as it is, also 1.5708, which is 3.7e-6 more than a quarter turn.
    #[test]
    fn other_angles_are_not_rounded() {
        let given = rounded(PI / 2.0, 4);
        assert_eq!(direction(given), [given.cos(), given.sin()]);
        let [x, y] = direction(PI / 6.0);
        assert!((x - 0.75_f64.sqrt()).abs() < 1e-15 && (y - 0.5).abs() < 1e-15);
    }
}
