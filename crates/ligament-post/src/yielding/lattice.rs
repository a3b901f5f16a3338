//! Families of a square lattice.

use std::f64::consts::PI;

use ligament_model::horizon::INCLUSION_TOLERANCE;

/// Number of bonds of a point with a horizon of `ratio` m spacings: offsets (i, j) with 0 < i^2 + j^2 <= m^2.
pub fn family_size(ratio: f64) -> usize {
    offsets(ratio).count()
}

/// Directions of the bonds for a horizon of `ratio` m spacings, each once and without its opposite, ascending from 0
/// to below pi: angles to a row of the lattice, rad. Empty below m = 1.
pub fn directions(ratio: f64) -> Vec<f64> {
    let is_first = |&[i, j]: &[i64; 2]| greatest_common_divisor(i.abs(), j.abs()) == 1;
    let is_upper = |&[i, j]: &[i64; 2]| j > 0 || (j == 0 && i > 0);
    let mut angles: Vec<f64> = offsets(ratio)
        .filter(|offset| is_first(offset) && is_upper(offset))
        .map(|[i, j]| (j as f64).atan2(i as f64))
        .collect();
    angles.sort_by(f64::total_cmp);
    angles
}

/// The ratio m, among those at which the family grows, whose family size is nearest to `size`; the smaller one of two equally near ones.
pub fn ratio_of_size(size: f64) -> f64 {
    // A family has about pi m^2 bonds.
    let largest = (size.max(0.0) / PI).sqrt().ceil() as i64 + 2;
    let squares = (1..=largest * largest)
        .filter(|square| (0..=largest).any(|i| (0..=largest).any(|j| i * i + j * j == *square)));
    let distance = |ratio: f64| (family_size(ratio) as f64 - size).abs();
    squares
        .map(|square| (square as f64).sqrt())
        .min_by(|a, b| distance(*a).total_cmp(&distance(*b)))
        .unwrap_or(1.0)
}

/// Largest angle between any axis and the bond nearest to it, of families with bonds at `directions` (ascending, from
/// 0 to below pi, rad): half of the largest gap. A bond and its opposite are one. Pi/2 for less than two directions.
pub fn worst_misalignment(directions: &[f64]) -> f64 {
    let wrapped = directions.iter().skip(1).copied();
    let next = wrapped.chain(directions.first().map(|first| first + PI));
    let gaps = directions.iter().zip(next).map(|(from, to)| to - from);
    0.5 * gaps.reduce(f64::max).unwrap_or(PI)
}

/// Offsets of the neighbours, in spacings.
fn offsets(ratio: f64) -> impl Iterator<Item = [i64; 2]> {
    let reach = (ratio * (1.0 + INCLUSION_TOLERANCE)).floor() as i64;
    let square = (ratio * (1.0 + INCLUSION_TOLERANCE)).powi(2);
    (-reach..=reach)
        .flat_map(move |i| (-reach..=reach).map(move |j| [i, j]))
        .filter(move |&[i, j]| [i, j] != [0, 0] && (i * i + j * j) as f64 <= square)
}

fn greatest_common_divisor(a: i64, b: i64) -> i64 {
    if b == 0 {
        a
    } else {
        greatest_common_divisor(b, a % b)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Sizes as MPPD Fig. 25 has them, and misalignments from an independent calculation, printed to 4 decimals.
    #[test]
    fn sizes_and_misalignments_of_the_paper() {
        for (ratio, size, misalignment) in [
            (2.0, 12, 22.5),
            (3.0, 28, 13.2825),
            (3.2, 36, 9.2175),
            (4.0, 48, 9.2175),
            (5.0, 80, 7.0181),
        ] {
            assert_eq!(family_size(ratio), size, "{ratio}");
            let found = worst_misalignment(&directions(ratio)).to_degrees();
            assert!((found - misalignment).abs() < 5e-5, "{ratio}: {found}");
        }
        assert_eq!(directions(0.5), Vec::<f64>::new());
    }

    #[test]
    fn directions_are_there_once() {
        // Rows, diagonals and knight's moves.
        let degrees: Vec<f64> = directions(3.0)
            .iter()
            .map(|angle| angle.to_degrees())
            .collect();
        let knight = 0.5f64.atan().to_degrees();
        let quarter = [0.0, knight, 45.0, 90.0 - knight];
        let expected = quarter
            .iter()
            .chain(&quarter)
            .zip([0.0; 4].into_iter().chain([90.0; 4]));
        assert_eq!(degrees.len(), 8);
        for (found, (angle, turn)) in degrees.iter().zip(expected) {
            assert!((found - angle - turn).abs() < 1e-12, "{found}");
        }
    }

    #[test]
    fn ratios_of_sizes() {
        assert_eq!(ratio_of_size(12.0), 2.0);
        assert_eq!(ratio_of_size(28.3), 3.0);
        assert_eq!(
            ratio_of_size(26.0),
            8f64.sqrt(),
            "24 and 28 are equally near"
        );
        assert_eq!(ratio_of_size(0.0), 1.0);
    }
}
