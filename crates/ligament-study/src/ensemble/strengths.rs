//! Loads of the samples with their statistics.

use ligament_post::statistics::WeibullFit;

use super::collected::Collected;

/// Probabilities of the quantiles of curves.
pub(super) const PROBABILITIES: [f64; 5] = [0.05, 0.25, 0.5, 0.75, 0.95];

/// Standard deviations of a normal number between which 90 % lie.
pub(super) const NINETY_PERCENT: f64 = 1.644_853_626_951_472_7;

/// Loads of the samples with their statistics.
pub(super) struct Strengths {
    /// Name in tables.
    pub(super) name: &'static str,
    /// Name in words.
    pub(super) words: &'static str,
    /// Loads in the order of the samples that have one.
    pub(super) loads: Vec<f64>,
    /// Fitted distribution; none where there is none.
    pub(super) fit: Option<WeibullFit>,
}

impl Strengths {
    /// The loads of the samples that have one, in the column `NAME_load`.
    fn new(name: &'static str, words: &'static str, collected: &Collected) -> Self {
        let column = format!("{name}_load");
        let loads = collected.rows.iter().filter_map(|row| row.number(&column));
        let loads: Vec<f64> = loads.collect();
        Self {
            name,
            words,
            fit: WeibullFit::through(&loads).ok(),
            loads,
        }
    }

    /// Mean of the loads, and their standard deviation over the mean; sums are in the order of the samples.
    pub(super) fn moments(&self) -> Option<[f64; 2]> {
        let n = self.loads.len();
        if n < 2 {
            return None;
        }
        let mean = self.loads.iter().sum::<f64>() / n as f64;
        let squares = self.loads.iter().map(|it| (it - mean).powi(2));
        let variance = squares.sum::<f64>() / (n - 1) as f64;
        Some([mean, variance.sqrt() / mean])
    }
}

/// Loads at the first breakage, the first peak and the peak.
pub(super) fn strengths(collected: &Collected) -> [Strengths; 3] {
    [
        Strengths::new("first", "first breakage", collected),
        Strengths::new("first_peak", "first peak", collected),
        Strengths::new("peak", "peak", collected),
    ]
}
