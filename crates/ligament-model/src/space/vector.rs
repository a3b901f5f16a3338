//! Products of vectors in space.

/// a . b.
#[inline(always)]
pub(super) fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// a x b.
#[inline(always)]
pub(super) fn cross(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [
        a[1] * b[2] - a[2] * b[1],
        a[2] * b[0] - a[0] * b[2],
        a[0] * b[1] - a[1] * b[0],
    ]
}

/// a - b.
#[inline(always)]
pub(super) fn minus(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

/// The length of a vector.
#[inline(always)]
pub(super) fn norm(a: [f64; 3]) -> f64 {
    dot(a, a).sqrt()
}

/// Two unit vectors at right angles to a unit vector n and to each other, right-handed with it: n x t_1 = t_2. The first comes from
/// the axis to which n is least inclined, the first of equals.
pub(super) fn tangents(n: [f64; 3]) -> [[f64; 3]; 2] {
    let mut least = 0;
    for axis in 1..3 {
        if n[axis].abs() < n[least].abs() {
            least = axis;
        }
    }
    let mut first = n.map(|component| -n[least] * component);
    first[least] += 1.0;
    let size = dot(first, first).sqrt();
    let first = first.map(|component| component / size);
    [first, cross(n, first)]
}
