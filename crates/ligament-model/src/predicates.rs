//! Exact predicates: the side of a line in the plane, or of a plane in space, on which a point lies.

use robust::{Coord, Coord3D, orient2d, orient3d};

use crate::geometry::{bounding_box, boxes_meet};
use crate::tensor::{minus, norm};

/// Area of the parallelogram of b - a and c - a, with the exact sign: positive where c lies on the left, seen from a to b.
pub(crate) fn left(a: [f64; 2], b: [f64; 2], c: [f64; 2]) -> f64 {
    let coord = |[x, y]: [f64; 2]| Coord { x, y };
    orient2d(coord(a), coord(b), coord(c))
}

/// Sign of [`left`], or zero: the product of two small areas may underflow.
pub(crate) fn orientation(a: [f64; 2], b: [f64; 2], c: [f64; 2]) -> f64 {
    let area = left(a, b, c);
    if area == 0.0 { 0.0 } else { area.signum() }
}

/// The [`orientation`] of c; zero where the nearer to a of b and c lies within `slack` (m) of the line to the other.
pub(crate) fn side_of_line([a, b]: [[f64; 2]; 2], c: [f64; 2], slack: f64) -> f64 {
    let reach = norm(minus(b, a)).max(norm(minus(c, a)));
    if left(a, b, c).abs() <= slack * reach {
        0.0
    } else {
        orientation(a, b, c)
    }
}

/// Whether two segments of the plane cross at a point that is an end of neither, and not within `slack` (m) of one.
pub(crate) fn crosses(one: [[f64; 2]; 2], other: [[f64; 2]; 2], slack: f64) -> bool {
    let parts = |line: [[f64; 2]; 2], ends: [[f64; 2]; 2]| {
        let [start, end] = ends.map(|end| side_of_line(line, end, slack));
        start * end < 0.0
    };
    parts(one, other) && parts(other, one)
}

/// Whether two segments of the plane have a point in common.
pub(crate) fn meet([p, q]: [[f64; 2]; 2], [r, s]: [[f64; 2]; 2]) -> bool {
    boxes_meet(bounding_box([p, q]), bounding_box([r, s]))
        && orientation(p, q, r) * orientation(p, q, s) <= 0.0
        && orientation(r, s, p) * orientation(r, s, q) <= 0.0
}

/// Volume of the parallelepiped of b - a, c - a and x - a, with the exact sign: positive where x lies on the side from which a, b and c are
/// counter-clockwise.
pub(crate) fn above(a: [f64; 3], b: [f64; 3], c: [f64; 3], x: [f64; 3]) -> f64 {
    let coord = |[x, y, z]: [f64; 3]| Coord3D { x, y, z };
    -orient3d(coord(a), coord(b), coord(c), coord(x))
}

/// Relative error of a determinant of differences, as a fraction of the sum of the absolute values of its terms (J. R. Shewchuk, Adaptive
/// precision floating-point arithmetic and fast robust geometric predicates, 1997).
const ERROR: f64 = 7.8e-16;

/// Exact sign of [`above`]; zero where the volume is at most `least`.
pub(crate) fn side_of_plane([a, b, c]: [[f64; 3]; 3], x: [f64; 3], least: f64) -> i8 {
    let (u, v, w) = (minus(b, a), minus(c, a), minus(x, a));
    let terms = [0, 1, 2].map(|k| {
        let (one, other) = ((k + 1) % 3, (k + 2) % 3);
        [u[one] * v[other] * w[k], -u[other] * v[one] * w[k]]
    });
    let terms = terms.as_flattened();
    let estimate: f64 = terms.iter().sum();
    let error = ERROR * terms.iter().map(|term| term.abs()).sum::<f64>();
    // Along a flat side all volumes nearly vanish: the exact computation of their signs would be wasted.
    if estimate.abs() + error <= least {
        return 0;
    }
    let volume = above(a, b, c, x);
    if volume.abs() <= least {
        0
    } else if volume > 0.0 {
        1
    } else {
        -1
    }
}
