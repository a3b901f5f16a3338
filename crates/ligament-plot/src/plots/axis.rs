//! Numbers along an axis: its range, its steps, its labels.

/// What an axis shows: all finite values and a twentieth more at each end; `None` without values.
pub(super) fn range(values: impl Iterator<Item = f64>) -> Option<[f64; 2]> {
    let finite = values.filter(|value| value.is_finite());
    let [low, high] = finite.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], value| {
        [low.min(value), high.max(value)]
    });
    // A curve that is level, or a single point, needs some room as well.
    let room = 0.05 * (high - low).max(1e-3 * low.abs().max(high.abs()).max(f64::MIN_POSITIVE));
    (low <= high).then_some([low - room, high + room])
}

/// The least product of a factor (1 to 5, ascending) and a power of ten that is not below a number.
pub(crate) fn rounded_up(least: f64, factors: &[f64]) -> f64 {
    let power = 10f64.powf(least.log10().floor());
    let reaches = |step: &f64| *step >= least * (1.0 - 1e-9);
    let mut steps = factors.iter().map(|factor| factor * power);
    steps.find(reaches).unwrap_or(10.0 * power)
}

/// Decimals that tell the labels of an axis apart.
pub(super) fn decimals([low, high]: [f64; 2]) -> usize {
    let digits = (8.0 / (high - low)).log10().ceil();
    digits.clamp(0.0, 9.0) as usize
}

/// A label of an axis, without the sign of a rounded zero.
pub(super) fn tick(value: f64, decimals: usize) -> String {
    let unit = 10f64.powi(decimals as i32);
    format!("{:.decimals$}", (value * unit).round() / unit + 0.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn labels_of_an_axis_differ_and_zero_has_no_sign() {
        assert_eq!(tick(-1e-9, decimals([-0.5, 0.4])), "0.0");
        assert_eq!(tick(1250.0, decimals([0.0, 5000.0])), "1250");
        assert_eq!(tick(0.25, decimals([0.2, 0.3])), "0.25");
    }
}
