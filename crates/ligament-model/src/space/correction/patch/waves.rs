//! Harmonics of a direction, with the sum of squares 1: turned axes mix those of one order by a rotation.

const ROOT_3: f64 = 1.732_050_807_568_877_2;
const ROOT_15: f64 = 3.872_983_346_207_417;
/// sqrt(3/8) and sqrt(5/8).
const ROOT_3_8: f64 = 0.612_372_435_695_794_5;
const ROOT_5_8: f64 = 0.790_569_415_042_094_8;

/// The harmonics of the second order of a unit vector.
#[inline(always)]
pub(super) fn second([x, y, z]: [f64; 3]) -> [f64; 5] {
    [
        0.5 * (3.0 * z * z - 1.0),
        ROOT_3 * x * z,
        ROOT_3 * y * z,
        0.5 * ROOT_3 * (x * x - y * y),
        ROOT_3 * x * y,
    ]
}

/// The harmonics of the third order of a unit vector.
#[inline(always)]
pub(super) fn third([x, y, z]: [f64; 3]) -> [f64; 7] {
    let (xx, yy, zz) = (x * x, y * y, z * z);
    let belt = ROOT_3_8 * (5.0 * zz - 1.0);
    [
        0.5 * z * (5.0 * zz - 3.0),
        belt * x,
        belt * y,
        0.5 * ROOT_15 * z * (xx - yy),
        ROOT_15 * x * y * z,
        ROOT_5_8 * x * (xx - 3.0 * yy),
        ROOT_5_8 * y * (3.0 * xx - yy),
    ]
}
