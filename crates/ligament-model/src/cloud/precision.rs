//! What coordinates are worth: the lengths that count as equal.

use crate::horizon::INCLUSION_TOLERANCE;

/// Half of the last bit of the significand in single precision, over the number.
const SINGLE_PRECISION: f64 = 1.0 / (1 << 24) as f64;

/// Errors of two coordinates in the length of a bond, and of two in the nearest distance that its horizon follows, along each of two
/// axes.
const ERRORS_OF_A_LENGTH: f64 = 8.0;

/// Share of the nearest distance beyond which uncertain coordinates do not make more lengths equal: such points are no regular grid.
const LARGEST_UNCERTAINTY: f64 = 1e-3;

/// Error that coordinates of the case may have, m.
///
/// Coordinates have often been numbers of single precision on their way, and then were moved, turned or written in other units, so that their
/// digits no longer tell it: none are taken to be known better than 2^-24 of the largest. Numbers of at most nine digits, with which single
/// precision is written, are known to half of their last digit if that is more. The largest coordinate counts: files hold as many digits of it
/// as of the others.
pub(crate) fn precision_of_coordinates<const D: usize>(positions: &[[f64; D]]) -> f64 {
    let all = |condition: &dyn Fn(f64) -> bool| positions.iter().flatten().all(|&x| condition(x));
    let largest = (positions.iter().flatten()).fold(0.0, |largest: f64, x| largest.max(x.abs()));
    let of_single = SINGLE_PRECISION * largest;
    if largest == 0.0 || !all(&|x| has_digits(x, 9)) {
        return of_single;
    }
    let digits = [7, 8].into_iter().find(|&n| all(&|x| has_digits(x, n)));
    let last = largest.log10().floor() as i32 + 1 - digits.unwrap_or(9) as i32;
    of_single.max(0.5 * 10.0_f64.powi(last))
}

/// Whether a number is written with so many significant digits, up to the rounding of a change of units.
fn has_digits(x: f64, digits: usize) -> bool {
    let written: f64 = format!("{x:.*e}", digits - 1).parse().unwrap_or(f64::NAN);
    (written - x).abs() <= 4.0 * f64::EPSILON * x.abs()
}

/// Relative difference up to which lengths count as equal at a point with this distance to the nearest one (m), where coordinates may have
/// this error (m).
pub(super) fn tolerance(precision: f64, spacing: f64) -> f64 {
    INCLUSION_TOLERANCE + (ERRORS_OF_A_LENGTH * precision / spacing).min(LARGEST_UNCERTAINTY)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Spacings of a tenth at a distance of ten thousand: thirds are known fully, seven digits to a half of 1e-3, single precision to
    /// 2^-24 of it.
    #[test]
    fn coordinates_tell_their_precision() {
        let full = [[1e4 / 3.0, 0.2], [0.1, 1.0 / 3.0]];
        let of_single = 1e4 / 3.0 / 16_777_216.0;
        assert_eq!(precision_of_coordinates(&full), of_single);
        let seven = [[3333.333, 0.2], [0.1, 0.3333333]];
        assert!((precision_of_coordinates(&seven) / 0.5e-3 - 1.0).abs() < 1e-12);
        let single = full.map(|p| p.map(|x| f64::from(x as f32)));
        let expected = f64::from((1e4 / 3.0) as f32) / 16_777_216.0;
        assert_eq!(precision_of_coordinates(&single), expected);
        // In millimetres, and written with the nine digits that tell single precision.
        let scaled = seven.map(|p| p.map(|x| 1e-3 * x));
        assert!((precision_of_coordinates(&scaled) / 0.5e-6 - 1.0).abs() < 1e-12);
        let written = [[3333.33325, 0.200000003], [0.1, 0.333333343]];
        assert!((precision_of_coordinates(&written) / expected - 1.0).abs() < 1e-7);
        assert_eq!(precision_of_coordinates::<2>(&[]), 0.0);
    }
}
