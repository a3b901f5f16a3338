//! On which side points of space lie.

use robust::{Coord3D, orient3d};

use crate::tensor::minus;

/// The volume of the parallelepiped of b - a, c - a and x - a, with the right sign: positive where x lies on the side from which a, b
/// and c stand counter-clockwise.
pub(super) fn above(a: [f64; 3], b: [f64; 3], c: [f64; 3], x: [f64; 3]) -> f64 {
    let coord = |p: [f64; 3]| Coord3D {
        x: p[0],
        y: p[1],
        z: p[2],
    };
    -orient3d(coord(a), coord(b), coord(c), coord(x))
}

/// Relative error of a determinant of differences, of the sum of the sizes of its terms (J. R. Shewchuk, Adaptive precision
/// floating-point arithmetic and fast robust geometric predicates, 1997).
const ERROR: f64 = 7.8e-16;

/// The sign of [`above`], which is exact; zero where the volume is no more than `least`.
pub(super) fn side([a, b, c]: [[f64; 3]; 3], x: [f64; 3], least: f64) -> i8 {
    let (u, v, w) = (minus(b, a), minus(c, a), minus(x, a));
    let terms = [0, 1, 2].map(|k| {
        let (one, other) = ((k + 1) % 3, (k + 2) % 3);
        [u[one] * v[other] * w[k], -u[other] * v[one] * w[k]]
    });
    let terms = terms.as_flattened();
    let estimate: f64 = terms.iter().sum();
    let error = ERROR * terms.iter().map(|term| term.abs()).sum::<f64>();
    // Along a flat side all volumes are next to nothing: their exact digits would be sought in vain.
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
