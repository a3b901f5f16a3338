//! Quantiles of samples.

/// Quantile of values in ascending order, shape (n), for a probability between 0 and 1; none without values.
///
/// The values are at the probabilities (i - 1)/(n - 1), with straight lines between them (definition 7 of Hyndman and Fan 1996).
pub fn quantile(ascending: &[f64], probability: f64) -> Option<f64> {
    let last = ascending.len().checked_sub(1)?;
    let place = probability.clamp(0.0, 1.0) * last as f64;
    let below = (place.floor() as usize).min(last);
    let above = (below + 1).min(last);
    let share = place - below as f64;
    Some((1.0 - share) * ascending[below] + share * ascending[above])
}

#[cfg(test)]
#[allow(clippy::unwrap_used, reason = "a failed unwrap fails the test")]
mod tests {
    use super::*;

    /// Quartiles of 1, 2, 4, 8 by hand: the places 0.75, 1.5 and 2.25.
    #[test]
    fn quartiles_lie_between_the_values() {
        let values = [1.0, 2.0, 4.0, 8.0];
        let found = [0.0, 0.25, 0.5, 0.75, 1.0].map(|it| quantile(&values, it));
        assert_eq!(found, [1.0, 1.75, 3.0, 5.0, 8.0].map(Some));
        assert_eq!(quantile(&[], 0.5), None);
        assert_eq!(quantile(&[3.0], 0.9), Some(3.0));
    }
}
