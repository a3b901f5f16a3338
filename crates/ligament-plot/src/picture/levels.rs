//! The levels between the bands of a contour plot, and which of them are labelled.

use crate::drawing::ticks::round_number_above;

/// Largest number of bands of a scale that the program chooses.
const MOST_BANDS: f64 = 20.0;

/// Largest number of labels on the colour bar.
const MOST_LABELS: usize = 8;

/// Spread of a field, relative to its size, below which it counts as constant: rounding has no contours.
const CONSTANT: f64 = 1e-9;

/// Rule by which a scale is chosen.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(super) struct Rule {
    /// Number of bands; `None` for steps of round numbers.
    pub(super) bands: Option<usize>,
    /// First and last level; `None` for the levels of the field.
    pub(super) range: Option<[f64; 2]>,
    /// Whether zero is in the middle.
    pub(super) centred: bool,
}

/// Ascending levels, two or more: bands lie between them.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Levels {
    /// Levels of the scale, ascending.
    pub(super) bounds: Vec<f64>,
    /// Indices of the levels with labels, ascending.
    pub(super) labelled: Vec<usize>,
}

impl Levels {
    /// Levels for values from `least` to `largest`.
    pub(super) fn new([least, largest]: [f64; 2], rule: Rule) -> Self {
        let [low, high] = rule
            .range
            .unwrap_or_else(|| span([least, largest], rule.centred));
        if let Some(bands) = rule.bands {
            return Self::with_equal_bands([low, high], bands);
        }
        let step = round_step((high - low) / MOST_BANDS);
        let is_multiple = |it: f64| (it / step - (it / step).round()).abs() < 1e-6;
        let [first, last] = match rule.range {
            None => [(low / step).floor(), (high / step).ceil()],
            // A range whose ends are multiples up to rounding is kept.
            Some(_) if is_multiple(low) && is_multiple(high) => {
                [low, high].map(|it| (it / step).round())
            }
            Some(_) => return Self::with_equal_bands([low, high], 16),
        };
        let count = (last - first) as usize;
        let bounds: Vec<f64> = (0..=count).map(|it| (first + it as f64) * step).collect();
        let label_step = round_step((last - first) * step / MOST_LABELS as f64);
        let every = (label_step / step).round().max(1.0);
        let is_labelled = |&place: &usize| (first + place as f64).rem_euclid(every) == 0.0;
        let labelled = (0..=count).filter(is_labelled).collect();
        Self { bounds, labelled }
    }

    fn with_equal_bands([low, high]: [f64; 2], bands: usize) -> Self {
        let at = |it: usize| low + (high - low) * it as f64 / bands as f64;
        let few = bands.div_ceil(MOST_LABELS);
        let every = (few..=bands)
            .find(|it| bands.is_multiple_of(*it))
            .unwrap_or(bands);
        let every = if bands / every < 3 { few } else { every };
        Self {
            bounds: (0..=bands).map(at).collect(),
            labelled: (0..=bands).step_by(every).collect(),
        }
    }

    /// Number of bands.
    pub(super) fn n_bands(&self) -> usize {
        self.bounds.len() - 1
    }

    /// First and last level.
    pub(super) fn range(&self) -> [f64; 2] {
        [self.bounds[0], self.bounds[self.n_bands()]]
    }

    /// The band of a value; values beyond the levels are in the first or the last one.
    pub(super) fn band(&self, value: f64) -> usize {
        let inner = &self.bounds[1..self.n_bands()];
        inner.partition_point(|level| *level <= value)
    }
}

/// Whether a field has values of both signs that are not negligible.
pub(super) fn has_both_signs([least, largest]: [f64; 2]) -> bool {
    let small = 0.02 * least.abs().max(largest.abs());
    least < -small && largest > small
}

fn span([least, largest]: [f64; 2], centred: bool) -> [f64; 2] {
    let size = least.abs().max(largest.abs());
    if size == 0.0 {
        return [0.0, 1.0];
    }
    if centred {
        return [-size, size];
    }
    if largest - least <= CONSTANT * size {
        return [least.min(0.0), largest.max(0.0)];
    }
    [least, largest]
}

/// The least of 1, 2, 2.5 and 5 times a power of ten that is not below a number.
fn round_step(least: f64) -> f64 {
    round_number_above(least, &[1.0, 2.0, 2.5, 5.0])
}

#[cfg(test)]
mod tests {
    use super::*;

    fn rule(bands: Option<usize>, range: Option<[f64; 2]>, centred: bool) -> Rule {
        Rule {
            bands,
            range,
            centred,
        }
    }

    #[test]
    fn a_scale_of_its_own_has_round_levels() {
        let levels = Levels::new([0.0, 0.83], Rule::default());
        assert_eq!(levels.n_bands(), 17);
        assert!(
            levels
                .bounds
                .iter()
                .enumerate()
                .all(|(k, it)| (it - 0.05 * k as f64).abs() < 1e-12)
        );
        let labels: Vec<f64> = levels
            .labelled
            .iter()
            .map(|&it| levels.bounds[it])
            .collect();
        assert!(
            (labels[1] - 0.2).abs() < 1e-12 && labels.len() == 5,
            "{labels:?}"
        );
        assert_eq!(
            [-1.0, 0.0, 0.049, 0.5, 7.0].map(|it| levels.band(it)),
            [0, 0, 0, 10, 16]
        );
    }

    #[test]
    fn zero_is_in_the_middle_of_a_centred_scale() {
        let levels = Levels::new([-3.0, 7.0], rule(None, None, true));
        let [low, high] = levels.range();
        assert_eq!(low, -high);
        assert!(levels.bounds.contains(&0.0) && high >= 7.0);
    }

    #[test]
    fn a_given_range_and_number_are_kept() {
        let levels = Levels::new([0.0, 9.0], rule(Some(6), Some([1.0, 4.0]), false));
        assert_eq!(levels.bounds, [1.0, 1.5, 2.0, 2.5, 3.0, 3.5, 4.0]);
        let odd = Levels::new([0.0, 9.0], rule(None, Some([0.0, 0.37e-3]), false));
        assert_eq!(odd.range(), [0.0, 0.37e-3]);
        let even = Levels::new([0.0, 9.0], rule(None, Some([0.0, 0.4]), false));
        assert_eq!(even.n_bands(), 20);
    }

    #[test]
    fn a_constant_field_has_a_scale_from_zero() {
        assert_eq!(Levels::new([0.0, 0.0], Rule::default()).range(), [0.0, 1.0]);
        assert_eq!(
            Levels::new([5.0, 5.0 + 1e-12], Rule::default()).range()[0],
            0.0
        );
        let below = Levels::new([-5.0, -5.0], Rule::default()).range();
        assert_eq!(below, [-5.0, 0.0]);
    }
}
