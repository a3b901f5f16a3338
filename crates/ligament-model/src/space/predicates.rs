//! On which side points of space lie.

use robust::{Coord3D, orient3d};

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

/// The sign of [`above`], which is exact; zero where the volume is no more than `least`.
pub(super) fn side([a, b, c]: [[f64; 3]; 3], x: [f64; 3], least: f64) -> i8 {
    let volume = above(a, b, c, x);
    if volume.abs() <= least {
        0
    } else if volume > 0.0 {
        1
    } else {
        -1
    }
}
