//! Rigid shapes with their signed distance and outward normal.

use super::touch::Vector;
use crate::tensor::{cross, dot, minus, norm};

/// A rigid shape in D dimensions, in the coordinates of its body.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum RigidShape<const D: usize> {
    /// A circle in the plane, a sphere in space.
    Ball {
        /// Centre, m.
        centre: [f64; D],
        /// Radius, m.
        radius: f64,
    },
    /// A half-plane or a half-space.
    Wall {
        /// A point of its surface, m.
        point: [f64; D],
        /// Outward unit normal.
        normal: [f64; D],
    },
    /// A rectangle or a box with sides along the axes.
    Box {
        /// Corner of the lowest coordinates, m.
        lower: [f64; D],
        /// Corner of the highest coordinates, m.
        upper: [f64; D],
    },
}

impl<const D: usize> RigidShape<D> {
    /// Signed distance of a position from the surface of the shape, negative inside, m, and the outward unit normal at the nearest place of
    /// the surface; of equally near places the one along the first axis, above.
    pub fn distance(&self, position: [f64; D]) -> (f64, [f64; D]) {
        match *self {
            Self::Ball { centre, radius } => {
                let way = minus(position, centre);
                let length = norm(way);
                (length - radius, direction(way, length, 0))
            }
            Self::Wall { point, normal } => (dot(minus(position, point), normal), normal),
            Self::Box { lower, upper } => {
                let beyond: [f64; D] = std::array::from_fn(|axis| {
                    let x = position[axis];
                    x - x.clamp(lower[axis], upper[axis])
                });
                let length = norm(beyond);
                if length > 0.0 {
                    return (length, direction(beyond, length, 0));
                }
                let sides = (0..D).flat_map(|axis| {
                    let above = (upper[axis] - position[axis], axis, 1.0);
                    [above, (position[axis] - lower[axis], axis, -1.0)]
                });
                let nearer = |one: (f64, usize, f64), it: (f64, usize, f64)| {
                    if it.0 < one.0 { it } else { one }
                };
                let (depth, axis, sign) = sides.fold((f64::INFINITY, 0, 1.0), nearer);
                (-depth, direction([0.0; D], 0.0, axis).map(|it| sign * it))
            }
        }
    }

    /// The shape moved by a vector, m.
    #[must_use]
    pub fn moved(&self, by: [f64; D]) -> Self {
        let moved = |it: [f64; D]| std::array::from_fn(|axis| it[axis] + by[axis]);
        match *self {
            Self::Ball { centre, radius } => Self::Ball {
                centre: moved(centre),
                radius,
            },
            Self::Wall { point, normal } => Self::Wall {
                point: moved(point),
                normal,
            },
            Self::Box { lower, upper } => Self::Box {
                lower: moved(lower),
                upper: moved(upper),
            },
        }
    }

    /// Square of the largest distance of its surface from its middle, m^2; infinite for a wall.
    pub(super) fn reach(&self) -> f64 {
        match *self {
            Self::Ball { radius, .. } => radius * radius,
            Self::Wall { .. } => f64::INFINITY,
            Self::Box { lower, upper } => {
                let half = minus(upper, lower).map(|it| 0.5 * it);
                dot(half, half)
            }
        }
    }

    /// Largest depth in the shape, m; infinite in a wall.
    pub(super) fn half_width(&self) -> f64 {
        match *self {
            Self::Ball { radius, .. } => radius,
            Self::Wall { .. } => f64::INFINITY,
            Self::Box { lower, upper } => {
                let widths = minus(upper, lower);
                0.5 * widths.into_iter().fold(f64::INFINITY, f64::min)
            }
        }
    }

    /// Largest absolute coordinate of the shape, for a ball plus the radius, m: it determines the rounding of distances.
    pub(super) fn coordinate(&self) -> f64 {
        let largest = |position: [f64; D]| position.into_iter().fold(0.0, largest_size);
        match *self {
            Self::Ball { centre, radius } => largest(centre) + radius,
            Self::Wall { point, .. } => largest(point),
            Self::Box { lower, upper } => largest(lower).max(largest(upper)),
        }
    }

    /// Middle of the shape, of a wall its given point, m.
    pub fn middle(&self) -> [f64; D] {
        match *self {
            Self::Ball { centre, .. } => centre,
            Self::Wall { point, .. } => point,
            Self::Box { lower, upper } => {
                std::array::from_fn(|axis| 0.5 * (lower[axis] + upper[axis]))
            }
        }
    }
}

/// The larger one of a size and of the size of a value.
pub(super) fn largest_size(size: f64, value: f64) -> f64 {
    size.max(value.abs())
}

/// Unit vector along a vector of a given length; along an axis where the length is zero.
fn direction<const D: usize>(way: [f64; D], length: f64, axis: usize) -> [f64; D] {
    if length > 0.0 {
        return way.map(|it| it / length);
    }
    std::array::from_fn(|it| if it == axis { 1.0 } else { 0.0 })
}

/// A vector rotated by angles about the axes: exactly in the plane, to the first order in space.
pub(super) fn rotated<const D: usize>(way: [f64; D], by: Vector) -> [f64; D] {
    if by == [0.0; 3] {
        return way;
    }
    if let [x, y] = way.as_slice() {
        let (sine, cosine) = by[2].sin_cos();
        let turned = [cosine * x - sine * y, sine * x + cosine * y];
        return std::array::from_fn(|axis| turned[axis]);
    }
    let added = cross(by, in_space(way));
    std::array::from_fn(|axis| way[axis] + added[axis])
}

/// A vector with three components, the third zero in the plane.
pub(super) fn in_space<const D: usize>(vector: [f64; D]) -> Vector {
    std::array::from_fn(|axis| vector.get(axis).copied().unwrap_or(0.0))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// 3-4-5 triangles and positions on axes, whose distances have no rounding.
    #[test]
    fn distances_and_normals_are_exact() {
        let ball = RigidShape::Ball {
            centre: [1.0, 0.0],
            radius: 2.0,
        };
        assert_eq!(ball.distance([4.0, 4.0]), (3.0, [0.6, 0.8]));
        assert_eq!(ball.distance([1.0, -0.5]), (-1.5, [0.0, -1.0]));
        assert_eq!(ball.distance([1.0, 0.0]), (-2.0, [1.0, 0.0]));
        let wall = RigidShape::Wall {
            point: [0.0, 0.0, 1.0],
            normal: [0.0, 0.6, 0.8],
        };
        let (distance, normal) = wall.distance([7.0, 3.0, 5.0]);
        assert!((distance - 5.0).abs() < 1e-15 && normal == [0.0, 0.6, 0.8]);
        let block = RigidShape::Box {
            lower: [0.0; 3],
            upper: [4.0, 2.0, 1.0],
        };
        assert_eq!(block.distance([7.0, 6.0, 0.5]), (5.0, [0.6, 0.8, 0.0]));
        assert_eq!(block.distance([3.0, 1.0, -2.0]), (2.0, [0.0, 0.0, -1.0]));
        assert_eq!(block.distance([2.0, 1.0, 0.25]), (-0.25, [0.0, 0.0, -1.0]));
        assert_eq!(block.distance([3.875, 1.0, 0.5]), (-0.125, [1.0, 0.0, 0.0]));
        let moved = block.moved([1.0, 0.0, 0.0]);
        assert_eq!(moved.distance([0.5, 1.0, 0.5]).0, 0.5);
    }

    /// The normal is the gradient of the distance, by central differences of 1e-6: their error is some 1e-10, except at edges of the medial
    /// surface, which these positions avoid.
    #[test]
    fn normals_are_gradients_of_the_distance() {
        let shapes = [
            RigidShape::Ball {
                centre: [0.1, -0.2, 0.3],
                radius: 0.7,
            },
            RigidShape::Box {
                lower: [-0.5, -0.4, -0.3],
                upper: [0.6, 0.7, 0.8],
            },
        ];
        for shape in shapes {
            for position in [[0.5, 0.1, 0.2], [1.0, 0.9, 0.0], [-0.9, -0.8, 1.2]] {
                let (_, normal) = shape.distance(position);
                for axis in 0..3 {
                    let at = |sign: f64| {
                        let mut near = position;
                        near[axis] += sign * 1e-6;
                        shape.distance(near).0
                    };
                    let slope = (at(1.0) - at(-1.0)) / 2e-6;
                    assert!(
                        (slope - normal[axis]).abs() < 1e-8,
                        "{shape:?} {position:?}"
                    );
                }
            }
        }
    }
}
