//! Harmonics of a direction, with the sum of squares 1: turned axes mix the harmonics of one order by a rotation.

const ROOT_3: f64 = 1.732_050_807_568_877_2;
const ROOT_15: f64 = 3.872_983_346_207_417;
/// sqrt(3/8) and sqrt(5/8).
const ROOT_3_8: f64 = 0.612_372_435_695_794_5;
const ROOT_5_8: f64 = 0.790_569_415_042_094_8;

/// Number of the harmonics of an order: 2 in the plane, 2 k + 1 in space.
pub(super) const fn count(dimension: usize, order: usize) -> usize {
    if dimension == 2 { 2 } else { 2 * order + 1 }
}

/// Harmonics of the second order of a unit vector. In the plane, with its angle theta, these are (-sin 2 theta, cos 2 theta), followed by
/// zeros.
#[inline(always)]
pub(super) fn second<const D: usize>(n: [f64; D]) -> [f64; 5] {
    let (x, y) = (n[0], n[1]);
    if D == 2 {
        return [-2.0 * x * y, x * x - y * y, 0.0, 0.0, 0.0];
    }
    let z = n[2];
    [
        0.5 * (3.0 * z * z - 1.0),
        ROOT_3 * x * z,
        ROOT_3 * y * z,
        0.5 * ROOT_3 * (x * x - y * y),
        ROOT_3 * x * y,
    ]
}

/// Harmonics of the third order of a unit vector. In the plane these are (cos 3 theta, sin 3 theta), followed by zeros.
#[inline(always)]
pub(super) fn third<const D: usize>(n: [f64; D]) -> [f64; 7] {
    let (x, y) = (n[0], n[1]);
    if D == 2 {
        let (x2, y2) = (x * x - y * y, 2.0 * x * y);
        return [x * x2 - y * y2, y * x2 + x * y2, 0.0, 0.0, 0.0, 0.0, 0.0];
    }
    let z = n[2];
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

/// Harmonics of the third order in space of a symmetric tensor S_ijk, by its components: for n_i n_j n_k these are the harmonics of the unit vector n.
pub(super) fn third_of_tensor(s: impl Fn([usize; 3]) -> f64) -> [f64; 7] {
    let [x, y, z] = [0, 1, 2];
    [
        s([z, z, z]) - 1.5 * (s([x, x, z]) + s([y, y, z])),
        ROOT_3_8 * (4.0 * s([x, z, z]) - s([x, x, x]) - s([x, y, y])),
        ROOT_3_8 * (4.0 * s([y, z, z]) - s([x, x, y]) - s([y, y, y])),
        0.5 * ROOT_15 * (s([x, x, z]) - s([y, y, z])),
        ROOT_15 * s([x, y, z]),
        ROOT_5_8 * (s([x, x, x]) - 3.0 * s([x, y, y])),
        ROOT_5_8 * (3.0 * s([x, x, y]) - s([y, y, y])),
    ]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn harmonics_of_a_direction_have_the_sum_of_squares_one() {
        let n = [2.0 / 7.0, -3.0 / 7.0, 6.0 / 7.0];
        let (second, third) = (second(n), third(n));
        let of_tensor = third_of_tensor(|axes| axes.map(|axis| n[axis]).iter().product());
        let sum = |waves: &[f64]| waves.iter().map(|it| it * it).sum::<f64>();
        assert!((sum(&second) - 1.0).abs() < 1e-15 && (sum(&third) - 1.0).abs() < 1e-15);
        for (one, other) in third.iter().zip(of_tensor) {
            assert!((one - other).abs() < 1e-15, "{third:?} {of_tensor:?}");
        }
    }
}
