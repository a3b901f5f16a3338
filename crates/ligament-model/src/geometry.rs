//! Segments and boxes in D dimensions.

use crate::tensor::{dot, minus, norm};

/// Lowest and highest corner of the box around some positions, with sides along the axes; infinite and minus infinite without positions.
pub(crate) fn bounding_box<const D: usize>(
    positions: impl IntoIterator<Item = [f64; D]>,
) -> [[f64; D]; 2] {
    let (mut lower, mut upper) = ([f64::INFINITY; D], [f64::NEG_INFINITY; D]);
    for position in positions {
        for (axis, x) in position.into_iter().enumerate() {
            lower[axis] = lower[axis].min(x);
            upper[axis] = upper[axis].max(x);
        }
    }
    [lower, upper]
}

/// Whether two boxes, each given by its lowest and its highest corner, have a point in common.
pub(crate) fn boxes_meet<const D: usize>(one: [[f64; D]; 2], other: [[f64; D]; 2]) -> bool {
    (0..D).all(|axis| one[0][axis] <= other[1][axis] && other[0][axis] <= one[1][axis])
}

/// The point of a segment at a parameter: 0 at its first end, 1 at its second.
pub fn point_at<const D: usize>([a, b]: [[f64; D]; 2], place: f64) -> [f64; D] {
    std::array::from_fn(|axis| a[axis] + place * (b[axis] - a[axis]))
}

/// Parameter of the point of a segment nearest to a point: 0 at its first end, 1 at its second.
pub fn nearest_place<const D: usize>([a, b]: [[f64; D]; 2], point: [f64; D]) -> f64 {
    let way = minus(b, a);
    let square = dot(way, way);
    if square == 0.0 {
        return 0.0;
    }
    (dot(minus(point, a), way) / square).clamp(0.0, 1.0)
}

/// Distance of a point from a segment, m.
pub fn distance_to<const D: usize>(segment: [[f64; D]; 2], point: [f64; D]) -> f64 {
    norm(minus(
        point_at(segment, nearest_place(segment, point)),
        point,
    ))
}

/// Whether a point lies on the line between two others and at neither of them, judged by its parameter along the line.
pub(crate) fn is_between<const D: usize>(point: [f64; D], [start, end]: [[f64; D]; 2]) -> bool {
    dot(minus(point, start), minus(end, start)) > 0.0
        && dot(minus(point, end), minus(start, end)) > 0.0
}

/// Two coordinates of a point of a plane in space: those in which an area with this normal is widest, right-handed about the normal or its
/// opposite.
pub(crate) fn flattened(point: [f64; 3], normal: [f64; 3]) -> [f64; 2] {
    let [x, y, z] = normal.map(f64::abs);
    if x >= y && x >= z {
        [point[1], point[2]]
    } else if y >= z {
        [point[2], point[0]]
    } else {
        [point[0], point[1]]
    }
}

/// Edges of a triangle, in order around it.
pub(crate) fn edges_of<T: Copy>([a, b, c]: [T; 3]) -> [[T; 2]; 3] {
    [[a, b], [b, c], [c, a]]
}

/// Ends of an edge, the smaller number first.
pub(crate) fn ascending([a, b]: [u32; 2]) -> [u32; 2] {
    [a.min(b), a.max(b)]
}
