//! Affine maps of positions: motions, reflections and local coordinate systems.

/// A point or vector in space, m.
pub(super) type Vector = [f64; 3];

/// Affine map of positions.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Frame {
    /// Images of the three axes.
    axes: [Vector; 3],
    /// Image of the origin, m.
    origin: Vector,
}

impl Frame {
    /// Image of a position, m.
    pub(super) fn apply(&self, at: Vector) -> Vector {
        add(self.origin, self.turned(at))
    }

    fn turned(&self, at: Vector) -> Vector {
        let [x, y, z] = self.axes;
        add(add(scaled(x, at[0]), scaled(y, at[1])), scaled(z, at[2]))
    }

    pub(super) fn translation(by: Vector) -> Self {
        Self {
            axes: UNIT,
            origin: by,
        }
    }

    /// Map that applies this one first and then another one.
    pub(super) fn then(&self, next: &Self) -> Self {
        Self {
            axes: self.axes.map(|axis| next.turned(axis)),
            origin: next.apply(self.origin),
        }
    }

    /// Linear map given by the images of the axes, about a fixed point.
    fn about(axes: [Vector; 3], fixed: Vector) -> Self {
        let linear = Self {
            axes,
            origin: [0.0; 3],
        };
        Self {
            axes,
            origin: difference(fixed, linear.apply(fixed)),
        }
    }

    /// Rotation by an angle (degrees) about the line from one point to another; `None` if these coincide.
    pub(super) fn rotation(from: Vector, to: Vector, degrees: f64) -> Option<Self> {
        let u = unit(difference(to, from))?;
        let (sin, cos) = sin_cos(degrees);
        // Rodrigues' formula for each axis.
        let image = |axis: Vector| {
            let along = scaled(u, (1.0 - cos) * dot(u, axis));
            add(add(scaled(axis, cos), scaled(cross(u, axis), sin)), along)
        };
        Some(Self::about(UNIT.map(image), from))
    }

    /// Reflection at a point.
    pub(super) fn point_reflection(at: Vector) -> Self {
        Self::about(UNIT.map(|axis| scaled(axis, -1.0)), at)
    }

    /// Reflection at the line through two points: a rotation by half a turn.
    pub(super) fn line_reflection(a: Vector, b: Vector) -> Option<Self> {
        Self::rotation(a, b, 180.0)
    }

    /// Reflection at the plane through three points; `None` if these lie on a line.
    pub(super) fn mirror(a: Vector, b: Vector, c: Vector) -> Option<Self> {
        let normal = unit(cross(difference(b, a), difference(c, a)))?;
        let image = |axis: Vector| add(axis, scaled(normal, -2.0 * dot(normal, axis)));
        Some(Self::about(UNIT.map(image), a))
    }

    /// Local system with an origin, a point on its first axis, and a point in the plane of its first two axes; without the latter the
    /// third axis is the global one.
    pub(super) fn local_system(a: Vector, b: Vector, c: Option<Vector>) -> Option<Self> {
        let along = difference(b, a);
        let (first, third) = match c {
            Some(c) => (unit(along)?, unit(cross(along, difference(c, a)))?),
            None => (unit([along[0], along[1], 0.0])?, UNIT[2]),
        };
        Some(Self {
            axes: [first, cross(third, first), third],
            origin: a,
        })
    }
}

const UNIT: [Vector; 3] = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];

pub(super) fn add(a: Vector, b: Vector) -> Vector {
    [a[0] + b[0], a[1] + b[1], a[2] + b[2]]
}

pub(super) fn difference(a: Vector, b: Vector) -> Vector {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

pub(super) fn scaled(a: Vector, factor: f64) -> Vector {
    a.map(|it| factor * it)
}

pub(super) fn dot(a: Vector, b: Vector) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

pub(super) fn cross(a: Vector, b: Vector) -> Vector {
    [
        a[1] * b[2] - a[2] * b[1],
        a[2] * b[0] - a[0] * b[2],
        a[0] * b[1] - a[1] * b[0],
    ]
}

pub(super) fn length(a: Vector) -> f64 {
    dot(a, a).sqrt()
}

pub(super) fn unit(a: Vector) -> Option<Vector> {
    let length = length(a);
    (length > 0.0).then(|| scaled(a, 1.0 / length))
}

/// Sine and cosine of an angle in degrees, exact for right angles.
pub(super) fn sin_cos(degrees: f64) -> (f64, f64) {
    match degrees.rem_euclid(360.0) {
        0.0 => (0.0, 1.0),
        90.0 => (1.0, 0.0),
        180.0 => (0.0, -1.0),
        270.0 => (-1.0, 0.0),
        other => other.to_radians().sin_cos(),
    }
}

/// Position of cylindrical coordinates: radius (m), angle (degrees) and height (m).
pub(super) fn of_cylindrical([radius, angle, height]: Vector) -> Vector {
    let (sin, cos) = sin_cos(angle);
    [radius * cos, radius * sin, height]
}

/// Position of spherical coordinates: radius (m), angle around the polar axis and angle above the plane of the equator (degrees).
pub(super) fn of_spherical([radius, around, above]: Vector) -> Vector {
    let (sin, cos) = sin_cos(above);
    of_cylindrical([radius * cos, around, radius * sin])
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Rounding of a few products of numbers below 10.
    const TOLERANCE: f64 = 1e-14;

    fn assert_near(found: Vector, expected: Vector) {
        assert!(
            length(difference(found, expected)) < TOLERANCE,
            "{found:?} {expected:?}"
        );
    }

    #[test]
    fn motions_and_reflections_move_points_as_by_hand() {
        let quarter = Frame::rotation([1.0, 0.0, 0.0], [1.0, 0.0, 3.0], 90.0).unwrap();
        assert_eq!(quarter.apply([2.0, 0.0, 5.0]), [1.0, 1.0, 5.0]);
        let first = Frame::translation([1.0, 0.0, 0.0]);
        assert_eq!(first.then(&quarter).apply([1.0, 0.0, 0.0]), [1.0, 1.0, 0.0]);
        let third = Frame::rotation([0.0; 3], [1.0, 1.0, 1.0], 120.0).unwrap();
        assert_near(third.apply([1.0, 2.0, 3.0]), [3.0, 1.0, 2.0]);
        let point = Frame::point_reflection([1.0, 1.0, 0.0]);
        assert_eq!(point.apply([0.0, 3.0, 1.0]), [2.0, -1.0, -1.0]);
        let line = Frame::line_reflection([0.0; 3], [0.0, 2.0, 0.0]).unwrap();
        assert_near(line.apply([1.0, 3.0, 2.0]), [-1.0, 3.0, -2.0]);
        let mirror = Frame::mirror([2.0, 0.0, 0.0], [2.0, 1.0, 0.0], [2.0, 0.0, 1.0]).unwrap();
        assert_near(mirror.apply([0.5, 7.0, 1.0]), [3.5, 7.0, 1.0]);
        assert_eq!(Frame::rotation([1.0; 3], [1.0; 3], 10.0), None);
    }

    #[test]
    fn local_coordinates_are_taken_to_global_ones() {
        let projected = Frame::local_system([1.0, 0.0, 2.0], [1.0, 4.0, 9.0], None).unwrap();
        assert_eq!(projected.apply([1.0, 2.0, 3.0]), [-1.0, 1.0, 5.0]);
        let a = [0.0, 0.0, 1.0];
        let tilted = Frame::local_system(a, [0.0, 0.0, 3.0], Some([5.0, 0.0, 8.0])).unwrap();
        assert_near(tilted.apply([1.0, 2.0, 3.0]), [2.0, 3.0, 2.0]);
        assert_eq!(of_cylindrical([2.0, 90.0, 1.0]), [0.0, 2.0, 1.0]);
        assert_near(of_spherical([2.0, 90.0, 30.0]), [0.0, 3.0_f64.sqrt(), 1.0]);
        let sum = add(scaled([1.0, 2.0, 2.0], 2.0), [0.0, 0.0, 1.0]);
        assert_eq!(sum, [2.0, 4.0, 5.0]);
    }
}
