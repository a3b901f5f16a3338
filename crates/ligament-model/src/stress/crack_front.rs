//! Fronts of cracks with the rings around them: the tip of a line in the plane, a straight line or a circle in space.

use std::f64::consts::PI;

use crate::tensor::{dot, minus};

/// Distance from the surface of a crack over that from its front up to which a point is on the surface.
const ON_SURFACE: f64 = 1e-9;

/// Part of a ring that may lie outside of the body.
const OUTSIDE: f64 = 0.03;

/// A place on the front of a crack with the ring around it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CrackFront {
    /// Place in the coordinates of the cloud, m.
    pub place: [f64; 3],
    /// Unit vectors there: the direction in which the crack would grow, the normal of the crack, and the tangent of the front, right-handed.
    pub axes: [[f64; 3]; 3],
    /// Radius of the circle around the crack, m; infinite for a straight front.
    pub radius: f64,
    /// Side of points on the crack: 1 that of the normal, -1 the other one.
    pub side: f64,
    /// Radii of the ring, between which the weight falls from 1 to 0, m.
    pub radii: [f64; 2],
    /// Distance along the front over which the weight falls from 1 to 0, m; infinite in the plane and for a whole circle.
    pub reach: f64,
    /// Integral of the weight along the front, m; the thickness in the plane.
    pub length: f64,
}

/// A position seen from the front of a crack.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct SeenFromFront {
    /// Axes of the front at its place nearest to the position.
    pub(super) axes: [[f64; 3]; 3],
    /// Distance from the front, m.
    pub(super) distance: f64,
    /// Angle from -pi to pi: 0 ahead of the front, and of the sign of their side for points on the crack.
    pub(super) angle: f64,
    /// 1/rho with the distance rho from the axis of a circular front, 1/m; 0 for a straight one.
    pub(super) curvature: f64,
    /// Weight q.
    pub(super) weight: f64,
    /// Gradient of the weight, 1/m.
    pub(super) gradient: [f64; 3],
}

/// Weight (1 + cos(pi (x - a)/(b - a)))/2 between a and b, 1 before and 0 beyond, and its derivative.
fn falling(x: f64, [a, b]: [f64; 2]) -> [f64; 2] {
    let angle = PI * ((x - a) / (b - a)).clamp(0.0, 1.0);
    [0.5 * (1.0 + angle.cos()), -0.5 * PI / (b - a) * angle.sin()]
}

impl CrackFront {
    /// A position in the coordinates of the cloud (m), seen from the front.
    pub(super) fn sees(&self, position: [f64; 3]) -> SeenFromFront {
        let ([along, across, arc], axes, curvature) = self.coordinates(position);
        let distance = along.hypot(across);
        let [fall, slope] = falling(distance, self.radii);
        let [window, window_slope] = falling(arc.abs(), [0.0, self.reach]);
        // The length along a circular front at the distance rho from its axis is rho/R times that of the front.
        let stretched = match curvature {
            0.0 => 1.0,
            _ => self.radius * curvature,
        };
        let local = [
            window * slope * along / distance,
            window * slope * across / distance,
            fall * window_slope.copysign(-arc) * stretched,
        ];
        SeenFromFront {
            axes,
            distance,
            angle: self.angle(along, across),
            curvature,
            weight: fall * window,
            gradient: combined(axes, local),
        }
    }

    /// Coordinates of a position along the axes of the nearest place of the front, the third one the length of the front up to there, m;
    /// these axes, and the curvature 1/rho.
    fn coordinates(&self, position: [f64; 3]) -> ([f64; 3], [[f64; 3]; 3], f64) {
        let from_place = minus(position, self.place);
        let [along, across, tangential] = self.axes.map(|axis| dot(axis, from_place));
        if self.radius.is_infinite() {
            return ([along, across, tangential], self.axes, 0.0);
        }
        let outwards = self.radius + along;
        let rho = outwards.hypot(tangential);
        let (cosine, sine) = (outwards / rho, tangential / rho);
        let axes = [
            combined(self.axes, [cosine, 0.0, sine]),
            self.axes[1],
            combined(self.axes, [-sine, 0.0, cosine]),
        ];
        let arc = self.radius * tangential.atan2(outwards);
        ([rho - self.radius, across, arc], axes, 1.0 / rho)
    }

    fn angle(&self, along: f64, across: f64) -> f64 {
        if across.abs() <= ON_SURFACE * along.abs() {
            return if along > 0.0 { 0.0 } else { self.side * PI };
        }
        across.atan2(along)
    }

    /// Whether the weight at a position in the coordinates of the cloud (m) is not zero.
    pub fn reaches(&self, position: [f64; 3]) -> bool {
        self.sees(position).weight > 0.0
    }

    /// Place of the front nearest to a position in the coordinates of the cloud, m.
    pub fn nearest_place(&self, position: [f64; 3]) -> [f64; 3] {
        let ([along, across, _], axes, _) = self.coordinates(position);
        minus(position, combined(axes, [along, across, 0.0]))
    }

    /// Whether the integral of the weight over the points of a body, over the length of the front (m^2), is the one over the whole ring.
    pub fn is_filled(&self, area: f64) -> bool {
        let [inner, outer] = self.radii;
        let width = outer - inner;
        let whole = 0.5 * (inner * inner + outer * outer) - 2.0 * (width / PI).powi(2);
        area >= (1.0 - OUTSIDE) * PI * whole
    }
}

/// The sum of unit vectors with factors.
pub(super) fn combined(axes: [[f64; 3]; 3], factors: [f64; 3]) -> [f64; 3] {
    std::array::from_fn(|it| (0..3).map(|axis| factors[axis] * axes[axis][it]).sum())
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A point on the crack belongs to the side that its line gives it, whatever rounding makes of it.
    #[test]
    fn points_on_the_crack_have_a_side() {
        let angle = |side, place| {
            let front = CrackFront {
                place: [0.0; 3],
                axes: [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]],
                radius: f64::INFINITY,
                side,
                radii: [1.0, 2.0],
                reach: f64::INFINITY,
                length: 1.0,
            };
            front.sees(place).angle
        };
        for across in [-1e-13, 0.0, 1e-13] {
            assert_eq!(angle(1.0, [-1.0, across, 0.0]), PI);
            assert_eq!(angle(-1.0, [-1.0, across, 0.0]), -PI);
            assert_eq!(angle(1.0, [1.0, across, 0.0]), 0.0);
        }
    }
}
