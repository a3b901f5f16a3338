//! Precision of coordinates: lengths that count as equal.

use crate::horizon::INCLUSION_TOLERANCE;

/// Half of the last bit of the significand in single precision, relative to the number.
const SINGLE_PRECISION: f64 = 1.0 / (1 << 24) as f64;

/// Number of coordinate errors in a comparison of a bond length with its horizon: two in the length and two in the nearest distance that the
/// horizon follows, along each of two axes.
const ERRORS_OF_A_LENGTH: f64 = 8.0;

/// Fraction of the nearest distance beyond which uncertain coordinates do not make more lengths equal: such points are no regular grid.
const LARGEST_UNCERTAINTY: f64 = 1e-3;

/// Uncertainty of the coordinates of the case, m.
///
/// Coordinates have often been stored in single precision, and then moved, turned or written in other units, so that their digits no longer
/// show it: none are taken to be known better than 2^-24 of the size of the body, wherever it lies. Their digits may show a larger
/// uncertainty.
/// their digits.
pub(crate) fn precision_of_coordinates<const D: usize>(positions: &[[f64; D]]) -> f64 {
    (SINGLE_PRECISION * size(positions)).max(precision_of_digits(positions))
}

/// Twice the largest distance of a position from their mean, m: the same for a turned or mirrored body.
fn size<const D: usize>(positions: &[[f64; D]]) -> f64 {
    let sum = |axis: usize| positions.iter().map(|position| position[axis]).sum::<f64>();
    let mean: [f64; D] = std::array::from_fn(|axis| sum(axis) / positions.len() as f64);
    let squares = positions.iter().map(|position| {
        let offsets = position.iter().zip(mean).map(|(x, middle)| x - middle);
        offsets.map(|offset| offset * offset).sum::<f64>()
    });
    2.0 * squares.fold(0.0, f64::max).sqrt()
}

/// Uncertainty of coordinates as shown by their digits, m.
///
/// Numbers of at most nine digits, as single precision is written, are known to half of their last digit, or to single precision (2^-24) if
/// that is less; and so are numbers that are all exact in single precision. The largest coordinate counts: files have as many digits of it
/// as of the others. Zero for numbers with more digits.
fn precision_of_digits<const D: usize>(positions: &[[f64; D]]) -> f64 {
    let all = |condition: &dyn Fn(f64) -> bool| positions.iter().flatten().all(|&x| condition(x));
    let largest = (positions.iter().flatten()).fold(0.0, |largest: f64, x| largest.max(x.abs()));
    let of_single = SINGLE_PRECISION * largest;
    if all(&|x| f64::from(x as f32) == x) {
        return of_single;
    }
    if largest == 0.0 || !all(&|x| has_digits(x, 9)) {
        return 0.0;
    }
    let digits = [7, 8].into_iter().find(|&n| all(&|x| has_digits(x, n)));
    let last = largest.log10().floor() as i32 + 1 - digits.unwrap_or(9) as i32;
    of_single.max(0.5 * 10.0_f64.powi(last))
}

/// Whether a number has at most `digits` significant digits, up to the rounding of a change of units.
fn has_digits(x: f64, digits: usize) -> bool {
    let written: f64 = format!("{x:.*e}", digits - 1).parse().unwrap_or(f64::NAN);
    (written - x).abs() <= 4.0 * f64::EPSILON * x.abs()
}

/// Relative difference up to which lengths count as equal at a point, from the uncertainty of the coordinates (m) and the distance to the
/// nearest point (m).
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
        assert_eq!(precision_of_digits(&full), 0.0);
        let seven = [[3333.333, 0.2], [0.1, 0.3333333]];
        assert!((precision_of_digits(&seven) / 0.5e-3 - 1.0).abs() < 1e-12);
        let single = full.map(|p| p.map(|x| f64::from(x as f32)));
        let expected = f64::from((1e4 / 3.0) as f32) / 16_777_216.0;
        assert_eq!(precision_of_digits(&single), expected);
        // In millimetres, and written with the nine digits that tell single precision.
        let scaled = seven.map(|p| p.map(|x| 1e-3 * x));
        assert!((precision_of_digits(&scaled) / 0.5e-6 - 1.0).abs() < 1e-12);
        let written = [[3333.33325, 0.200000003], [0.1, 0.333333343]];
        assert!((precision_of_digits(&written) / expected - 1.0).abs() < 1e-7);
        assert_eq!(precision_of_digits::<2>(&[]), 0.0);
    }

    /// A square with sides of three, wherever it lies: its diagonal is its size.
    #[test]
    fn a_body_is_known_to_single_precision_of_its_size() {
        let thirds =
            [[0.0, 0.0], [3.0, 0.0], [3.0, 3.0], [0.0, 3.0]].map(|p| p.map(|x| x + 1e4 / 3.0));
        let expected = 18.0_f64.sqrt() / 16_777_216.0;
        assert!((precision_of_coordinates(&thirds) / expected - 1.0).abs() < 1e-9);
        assert_eq!(precision_of_coordinates::<2>(&[]), 0.0);
    }
}
