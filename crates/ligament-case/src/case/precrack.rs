//! `[[precrack]]`: cracks and slots that are there from the start.

use std::f64::consts::{FRAC_1_SQRT_2, FRAC_PI_4};

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::fault::{Fault, KeyFault};
use super::key_path::KeyPath;
use super::values::exactly_one;
use super::values::{Point, not_exactly_one, require};
use super::word::Word;
use ligament_model::bonds::precrack::Ends;

/// Angles closer than this to a multiple of 45 degrees are one, rad: pi written with ten digits means pi, and points on an
/// axis lie on a crack along it.
const SAME_ANGLE: f64 = 1e-9;

/// A crack that is there from the start.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Precrack {
    /// Where it runs, as it was given.
    #[serde(flatten)]
    pub line: CrackLine,
    /// Whether it cuts bonds that only touch it.
    pub ends: Word<Ends>,
}

/// Where a pre-crack runs.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(untagged)]
pub enum CrackLine {
    /// From corner to corner.
    Polyline {
        /// Corners of the polyline, two or more, m.
        points: Vec<Point>,
    },
    /// A straight line.
    Straight {
        /// Middle of the crack, m.
        centre: Point,
        /// From end to end, m.
        length: f64,
        /// From the x axis to it, counter-clockwise, rad.
        angle: f64,
    },
}

impl Precrack {
    /// Corners of the polyline, two or more, m.
    pub fn points(&self) -> Vec<Point> {
        match &self.line {
            CrackLine::Polyline { points } => points.clone(),
            CrackLine::Straight {
                centre,
                length,
                angle,
            } => straight(*centre, *length, *angle).to_vec(),
        }
    }
}

/// The ends of a straight line.
fn straight([x, y]: Point, length: f64, angle: f64) -> [Point; 2] {
    let [along_x, along_y] = direction(angle).map(|component| 0.5 * length * component);
    [[x - along_x, y - along_y], [x + along_x, y + along_y]]
}

/// The unit vector at an angle from the x axis; along an axis or halfway between two it is exact.
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

#[derive(Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(extend("oneOf" = exactly_one(&["points", "centre"])))]
#[schemars(extend("dependencies" = { "centre": ["length", "angle"], "length": ["centre", "angle"], "angle": ["centre", "length"] }))]
pub(super) struct RawPrecrack {
    /// Corners of the polyline, two or more `[x, y]`, m.
    #[schemars(length(min = 2))]
    points: Option<Vec<Point>>,
    /// Middle of a straight crack, m; with `length` and `angle` in the place of `points`.
    centre: Option<Point>,
    /// From end to end of a straight crack, m.
    #[schemars(extend("exclusiveMinimum" = 0))]
    length: Option<f64>,
    /// From the x axis to a straight crack, counter-clockwise, rad.
    angle: Option<f64>,
    /// Whether bonds that only touch the crack are cut.
    #[serde(default)]
    ends: Word<Ends>,
}

impl RawPrecrack {
    pub(super) fn check(self, key: &KeyPath) -> Result<Precrack, KeyFault> {
        let straight = [
            ("centre", self.centre.is_some()),
            ("length", self.length.is_some()),
            ("angle", self.angle.is_some()),
        ];
        let first = straight.into_iter().find(|(_, given)| *given);
        let line = match (self.points, first) {
            (Some(points), None) => polyline(key, points)?,
            (None, Some(_)) => checked_straight(key, (self.centre, self.length, self.angle))?,
            (None, None) => {
                return Err(not_exactly_one(
                    key,
                    &[("points", false), ("centre", false)],
                ));
            }
            (Some(_), Some((name, _))) => {
                let fault = Fault::NotWith {
                    key: name,
                    setting: "`points`".to_owned(),
                    reason: "a pre-crack has the corners of a polyline, or `centre`, `length` and `angle` of a straight line",
                };
                return Err(KeyFault::new(key.child(name), fault));
            }
        };
        Ok(Precrack {
            line,
            ends: self.ends,
        })
    }
}

fn polyline(key: &KeyPath, points: Vec<Point>) -> Result<CrackLine, KeyFault> {
    let key = key.child("points");
    require(
        points.len() >= 2,
        || key.clone(),
        "two points or more",
        &points,
    )?;
    for (index, pair) in points.windows(2).enumerate() {
        let expected = "another point than the one before it";
        require(
            pair[0] != pair[1],
            || key.child(index + 1),
            expected,
            pair[1],
        )?;
    }
    Ok(CrackLine::Polyline { points })
}

fn checked_straight(
    key: &KeyPath,
    (centre, length, angle): (Option<Point>, Option<f64>, Option<f64>),
) -> Result<CrackLine, KeyFault> {
    let missing = |name: &str| {
        let key = key.child(name);
        let fault = Fault::MissingKey {
            key: name.to_owned(),
            table: key.parent().table_title(),
            unit: None,
        };
        KeyFault::new(key, fault)
    };
    let centre = centre.ok_or_else(|| missing("centre"))?;
    let length = length.ok_or_else(|| missing("length"))?;
    let angle = angle.ok_or_else(|| missing("angle"))?;
    let [start, end] = straight(centre, length, angle);
    require(
        start != end,
        || key.child("length"),
        "so large that the ends differ in the digits of their coordinates",
        length,
    )?;
    Ok(CrackLine::Straight {
        centre,
        length,
        angle,
    })
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
