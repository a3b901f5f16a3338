//! Shapes in space.

use super::Region;
use crate::geometry::distance_to;
use crate::tensor::{dot, minus, norm};

/// A closed region of space.
#[derive(Debug, Clone, PartialEq)]
pub enum SolidShape {
    /// A ball.
    Sphere {
        /// Centre, m.
        centre: [f64; 3],
        /// Radius, m.
        radius: f64,
    },
    /// Exterior of a ball.
    OutsideSphere {
        /// Centre of the ball, m.
        centre: [f64; 3],
        /// Radius of the ball, m.
        radius: f64,
    },
    /// A cylinder with flat ends.
    Cylinder {
        /// Middles of the two ends, m.
        ends: [[f64; 3]; 2],
        /// Radius, m.
        radius: f64,
    },
    /// Exterior of an infinite cylinder.
    OutsideCylinder {
        /// Two points of the axis, m.
        axis: [[f64; 3]; 2],
        /// Radius, m.
        radius: f64,
    },
    /// A box with its sides along the axes.
    Box {
        /// Corner of the lowest coordinates, m.
        lower: [f64; 3],
        /// Corner of the highest coordinates, m.
        upper: [f64; 3],
    },
}

impl Region<3> for SolidShape {
    fn moved(&self, by: [f64; 3]) -> Self {
        let moved = |p: &[f64; 3]| [p[0] + by[0], p[1] + by[1], p[2] + by[2]];
        match self {
            Self::Sphere { centre, radius } => Self::Sphere {
                centre: moved(centre),
                radius: *radius,
            },
            Self::OutsideSphere { centre, radius } => Self::OutsideSphere {
                centre: moved(centre),
                radius: *radius,
            },
            Self::Cylinder { ends, radius } => Self::Cylinder {
                ends: ends.each_ref().map(moved),
                radius: *radius,
            },
            Self::OutsideCylinder { axis, radius } => Self::OutsideCylinder {
                axis: axis.each_ref().map(moved),
                radius: *radius,
            },
            Self::Box { lower, upper } => Self::Box {
                lower: moved(lower),
                upper: moved(upper),
            },
        }
    }

    fn contains(&self, point: [f64; 3], slack: f64) -> bool {
        match self {
            Self::Sphere { centre, radius } => norm(minus(point, *centre)) <= radius + slack,
            Self::OutsideSphere { centre, radius } => norm(minus(point, *centre)) >= radius - slack,
            Self::Cylinder { ends, radius } => {
                let (along, across) = in_cylinder(*ends, minus(point, ends[0]));
                let height = norm(minus(ends[1], ends[0]));
                norm(across) <= radius + slack && -slack <= along && along <= height + slack
            }
            Self::OutsideCylinder { axis, radius } => {
                let (_, across) = in_cylinder(*axis, minus(point, axis[0]));
                norm(across) >= radius - slack
            }
            Self::Box { lower, upper } => (0..3).all(|axis| {
                lower[axis] - slack <= point[axis] && point[axis] <= upper[axis] + slack
            }),
        }
    }

    fn is_crossed_by(&self, a: [f64; 3], b: [f64; 3], slack: f64) -> bool {
        let way = minus(b, a);
        match self {
            Self::Sphere { centre, radius } => distance_to([a, b], *centre) < radius - slack,
            // Balls and cylinders are convex: a line between two points in them stays in them.
            Self::OutsideSphere { centre, radius } => {
                let is_out = |p| norm(minus(p, *centre)) > radius + slack;
                is_out(a) || is_out(b)
            }
            Self::OutsideCylinder { axis, radius } => {
                let is_out = |p| norm(in_cylinder(*axis, minus(p, axis[0])).1) > radius + slack;
                is_out(a) || is_out(b)
            }
            Self::Cylinder { ends, radius } => {
                let (start, across) = in_cylinder(*ends, minus(a, ends[0]));
                let (rise, drift) = in_cylinder(*ends, way);
                let height = norm(minus(ends[1], ends[0]));
                let between = between([slack, height - slack], start, rise);
                is_open(within_radius(across, drift, radius - slack), between)
            }
            Self::Box { lower, upper } => {
                let sides = (0..3).map(|axis| {
                    let bounds = [lower[axis] + slack, upper[axis] - slack];
                    between(bounds, a[axis], way[axis])
                });
                let meet = |[a, b]: [f64; 2], [c, d]: [f64; 2]| [a.max(c), b.min(d)];
                is_open(sides.fold([0.0, 1.0], meet), [0.0, 1.0])
            }
        }
    }
}

impl SolidShape {
    /// The box between two opposite corners.
    pub fn between([a, b]: [[f64; 3]; 2]) -> Self {
        Self::Box {
            lower: [0, 1, 2].map(|axis| a[axis].min(b[axis])),
            upper: [0, 1, 2].map(|axis| a[axis].max(b[axis])),
        }
    }
}

/// Interval of a path from `start` (0) to `start + way` (1), both across the axis of a cylinder, that is nearer to the axis than a radius;
/// empty where the first value is not below the second.
fn within_radius(start: [f64; 3], way: [f64; 3], radius: f64) -> [f64; 2] {
    let square = dot(way, way);
    if square == 0.0 {
        let is_in = norm(start) < radius;
        return if is_in { [0.0, 1.0] } else { [1.0, 0.0] };
    }
    let nearest = -dot(start, way) / square;
    let foot = [0, 1, 2].map(|axis| start[axis] + nearest * way[axis]);
    let half = radius * radius - dot(foot, foot);
    if radius <= 0.0 || half <= 0.0 {
        return [1.0, 0.0];
    }
    let half = (half / square).sqrt();
    [nearest - half, nearest + half]
}

/// Interval of a path in which a coordinate lies between two bounds.
fn between([lower, upper]: [f64; 2], start: f64, way: f64) -> [f64; 2] {
    if way == 0.0 {
        let is_in = lower < start && start < upper;
        return if is_in { [0.0, 1.0] } else { [1.0, 0.0] };
    }
    let places = [(lower - start) / way, (upper - start) / way];
    [
        places[0].min(places[1]).max(0.0),
        places[0].max(places[1]).min(1.0),
    ]
}

/// Whether two intervals within 0 to 1 have more in common than one value.
fn is_open([a, b]: [f64; 2], [c, d]: [f64; 2]) -> bool {
    a.max(c).max(0.0) < b.min(d).min(1.0)
}

/// Component of a vector along an axis, m, and the part orthogonal to it.
fn in_cylinder([start, end]: [[f64; 3]; 2], vector: [f64; 3]) -> (f64, [f64; 3]) {
    let axis = minus(end, start);
    let unit = axis.map(|it| it / norm(axis));
    let along = dot(vector, unit);
    (along, [0, 1, 2].map(|k| vector[k] - along * unit[k]))
}
