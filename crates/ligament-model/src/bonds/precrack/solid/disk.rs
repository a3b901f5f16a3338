//! Disk-shaped cracks.

use super::UnfitCrack;
use crate::bonds::precrack::Crossing;
use crate::geometry::{nearest_place, point_at};
use crate::tensor::{cross, dot, minus, norm};

/// A disk in space.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Disk {
    centre: [f64; 3],
    /// Unit normal towards the front.
    normal: [f64; 3],
    radius: f64,
}

impl Disk {
    pub(super) fn new(centre: [f64; 3], normal: [f64; 3], radius: f64) -> Result<Self, UnfitCrack> {
        let length = norm(normal);
        if !(length.is_finite() && length > 0.0) {
            return Err(UnfitCrack::NoNormal);
        }
        if radius.is_nan() || radius <= 0.0 {
            return Err(UnfitCrack::NoRadius { radius });
        }
        Ok(Self {
            centre,
            normal: normal.map(|it| it / length),
            radius,
        })
    }

    pub(super) fn moved(&self, by: impl Fn([f64; 3]) -> [f64; 3]) -> Self {
        Self {
            centre: by(self.centre),
            ..*self
        }
    }

    pub(super) fn bounds(&self) -> [[f64; 3]; 2] {
        let reach = self
            .normal
            .map(|n| self.radius * (1.0 - n * n).max(0.0).sqrt());
        [-1.0, 1.0].map(|sign| [0, 1, 2].map(|axis| self.centre[axis] + sign * reach[axis]))
    }

    /// Height over the plane of the disk, m; zero within the slack.
    fn height(&self, point: [f64; 3], slack: f64) -> f64 {
        let height = dot(self.normal, minus(point, self.centre));
        if height.abs() <= slack { 0.0 } else { height }
    }

    /// Distance from the axis at which a line crosses the plane of the disk, m; `None` where it lies in the plane.
    fn distance_of_crossing(&self, [a, b]: [[f64; 3]; 2]) -> Option<f64> {
        let [start, end] = [a, b].map(|point| dot(self.normal, minus(point, self.centre)));
        let place = start / (start - end);
        let at = minus(point_at([a, b], place), self.centre);
        place.is_finite().then(|| norm(cross(self.normal, at)))
    }

    /// Whether the ends of a bond lie on different sides of the plane; a point on the plane is in front.
    fn parts(&self, bond: [[f64; 3]; 2], slack: f64) -> bool {
        let [start, end] = bond.map(|point| self.height(point, slack) >= 0.0);
        start != end
    }

    pub(super) fn cuts(&self, bond: [[f64; 3]; 2], slack: f64) -> bool {
        let is_within = |distance| distance < self.radius - slack;
        self.parts(bond, slack) && self.distance_of_crossing(bond).is_some_and(is_within)
    }

    pub(super) fn touches(&self, bond: [[f64; 3]; 2], slack: f64) -> bool {
        let [start, end] = bond.map(|point| self.height(point, slack));
        let is_on_rim = |distance: f64| (distance - self.radius).abs() <= slack;
        start * end < 0.0 && self.distance_of_crossing(bond).is_some_and(is_on_rim)
    }

    pub(super) fn meets(&self, bond: [[f64; 3]; 2], slack: f64) -> bool {
        let reach = self.radius + slack;
        let from_axis = |point: [f64; 3]| norm(cross(self.normal, minus(point, self.centre)));
        match bond.map(|point| self.height(point, slack)) {
            [0.0, 0.0] => from_axis(point_at(bond, nearest_place(bond, self.centre))) <= reach,
            [0.0, _] => from_axis(bond[0]) <= reach,
            [_, 0.0] => from_axis(bond[1]) <= reach,
            [start, end] => {
                let is_within = |distance| distance <= reach;
                start * end < 0.0 && self.distance_of_crossing(bond).is_some_and(is_within)
            }
        }
    }

    pub(super) fn crossing(&self, bond: [[f64; 3]; 2]) -> Crossing<3> {
        let depth = |distance| 1.0 - distance / self.radius;
        let crossed = self.distance_of_crossing(bond).map(depth);
        Crossing {
            normal: self.normal,
            depth: crossed.unwrap_or(f64::NEG_INFINITY),
        }
    }
}
