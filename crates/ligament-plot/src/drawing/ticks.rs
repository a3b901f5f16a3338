//! Round numbers along an axis.

use crate::picture::units::text_with_decimals_of;

/// Range of an axis: all finite values and a twentieth more at each end; `None` without values.
pub(crate) fn range(values: impl Iterator<Item = f64>) -> Option<[f64; 2]> {
    let finite = values.filter(|value| value.is_finite());
    let [low, high] = finite.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], value| {
        [low.min(value), high.max(value)]
    });
    // A curve that is level, or a single point, needs some room as well.
    let size = low.abs().max(high.abs());
    let least = if size > 0.0 { 1e-3 * size } else { 1.0 };
    let room = 0.05 * (high - low).max(least);
    (low <= high).then_some([low - room, high + room])
}

/// The least product of a factor (1 to 5, ascending) and a power of ten that is not below a number.
pub(crate) fn round_number_above(least: f64, factors: &[f64]) -> f64 {
    let power = 10f64.powf(least.log10().floor());
    let reaches = |step: &f64| *step >= least * (1.0 - 1e-9);
    let mut steps = factors.iter().map(|factor| factor * power);
    steps.find(reaches).unwrap_or(10.0 * power)
}

/// Multiples of 1, 2 or 5 times a power of ten between two numbers, each with its text, in at most `most` intervals; none if the numbers
/// are no range.
pub(crate) fn ticks([low, high]: [f64; 2], most: f64) -> Vec<(f64, String)> {
    let least = (high - low) / most;
    if !(least > 0.0 && least.is_finite()) {
        return Vec::new();
    }
    let step = round_number_above(least, &[1.0, 2.0, 5.0]);
    let within = 1e-6 * step;
    let first = ((low - within) / step).ceil() as i64;
    let last = ((high + within) / step).floor() as i64;
    let tick = |place: i64| {
        let value = place as f64 * step;
        (value, text_with_decimals_of(value, step))
    };
    (first..=last).map(tick).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ticks_are_round_and_within_the_range() {
        let words = |low, high| {
            let all = ticks([low, high], 6.0).into_iter();
            all.map(|it| it.1).collect::<Vec<_>>()
        };
        assert_eq!(words(0.0, 500.0), ["0", "100", "200", "300", "400", "500"]);
        assert_eq!(words(-50.0, 50.0), ["-40", "-20", "0", "20", "40"]);
        assert_eq!(words(0.0, 2.0), ["0.0", "0.5", "1.0", "1.5", "2.0"]);
        assert!(ticks([1.0, 1.0], 6.0).is_empty());
    }

    #[test]
    fn labels_of_an_axis_differ_and_zero_has_no_sign() {
        let words = |range| {
            let all = ticks(range, 8.0).into_iter();
            all.map(|it| it.1).collect::<Vec<_>>()
        };
        assert_eq!(words([-0.5, 0.4])[2], "0.0");
        assert_eq!(words([0.0, 5000.0])[1], "1000");
        assert_eq!(words([0.2, 0.3])[1], "0.22");
    }

    /// A range around one large number is no wider than its rounding: its ends stay apart.
    #[test]
    fn a_level_curve_has_a_range() {
        let [low, high] = range([5.0, 5.0].into_iter()).unwrap();
        assert!(low < 5.0 && high > 5.0);
        assert_eq!(range([f64::NAN].into_iter()), None);
    }
}
