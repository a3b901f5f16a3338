//! All stored samples of an ensemble, in an order that does not depend on who computed them, and the statistics of their loads.

use std::cmp::Reverse;
use std::collections::BTreeSet;

use ligament_post::statistics::WeibullFit;

use super::identity::Identity;
use super::part::{Counts, StoredSamples};
use super::row::Row;

/// Probabilities of the quantiles of curves.
pub(super) const PROBABILITIES: [f64; 5] = [0.05, 0.25, 0.5, 0.75, 0.95];

/// Number of standard deviations about the mean that contain 90 % of a normal distribution.
pub(super) const NINETY_PERCENT: f64 = 1.644_853_626_951_472_7;

/// Samples of an ensemble.
#[derive(Debug, Default)]
pub(super) struct CollectedSamples {
    /// The samples, by their numbers.
    pub(super) rows: Vec<Row>,
    /// Known loads of the samples at each displacement of the grid, ascending.
    pub(super) loads: Vec<Vec<f64>>,
    pub(super) counts: Counts,
}

impl CollectedSamples {
    /// The samples of parts. A part whose samples are all in other parts is left out: it is a copy, or a shard of the samples of another
    /// folder.
    ///
    /// # Errors
    ///
    /// If parts share a sample and each has others, so that counts at the points would count it twice.
    pub(super) fn from_parts(
        mut parts: Vec<StoredSamples>,
        identity: &Identity,
    ) -> anyhow::Result<Self> {
        parts.sort_by_key(|it| Reverse(it.rows.len()));
        let mut all = Self::default();
        let mut seen = BTreeSet::new();
        for part in parts {
            let (twice, once): (Vec<u64>, Vec<u64>) = (part.rows.iter())
                .map(|row| row.sample)
                .partition(|it| seen.contains(it));
            match (twice.first(), once.is_empty()) {
                (_, true) => continue,
                (Some(sample), false) => anyhow::bail!(
                    "sample {sample} of {} is in another part too, and each has others: collect folders whose shards do not overlap",
                    part.path.display()
                ),
                (None, false) => {}
            }
            seen.extend(once);
            all.counts.add(&part.counts);
            all.rows.extend(part.rows);
        }
        all.rows.sort_by_key(|it| it.sample);
        let ascending = |displacement| {
            let known = all.rows.iter().filter_map(|it| it.load(displacement));
            let mut loads: Vec<f64> = known.collect();
            loads.sort_by(f64::total_cmp);
            loads
        };
        all.loads = (0..identity.grid.n).map(ascending).collect();
        Ok(all)
    }

    /// Shares of the samples in which fracture begins at each point, and in which it is damaged, shape (n_points).
    pub(super) fn shares(&self) -> [Vec<f64>; 2] {
        let n = self.rows.len().max(1) as f64;
        let counts = &self.counts;
        [&counts.first_break, &counts.damaged]
            .map(|it| it.iter().map(|it| *it as f64 / n).collect())
    }
}

/// Loads of the samples with their statistics.
pub(super) struct Strengths {
    /// Name in tables.
    pub(super) name: &'static str,
    /// Name in words.
    pub(super) words: &'static str,
    /// Loads in the order of the samples that have one.
    pub(super) loads: Vec<f64>,
    /// Fitted distribution; none where the loads have none.
    pub(super) fit: Option<WeibullFit>,
}

impl Strengths {
    /// The loads of the samples that have one, in the column `NAME_load`.
    fn new(name: &'static str, words: &'static str, collected: &CollectedSamples) -> Self {
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
pub(super) fn strengths(collected: &CollectedSamples) -> [Strengths; 3] {
    [
        Strengths::new("first", "first breakage", collected),
        Strengths::new("first_peak", "first peak", collected),
        Strengths::new("peak", "peak", collected),
    ]
}
