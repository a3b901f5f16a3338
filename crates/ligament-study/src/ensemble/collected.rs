//! All stored samples of an ensemble, in an order that does not depend on who computed them.

use std::collections::BTreeSet;

use super::identity::Identity;
use super::part::{Counts, Stored};
use super::row::Row;

/// Samples of an ensemble.
#[derive(Debug, Default)]
pub(super) struct Collected {
    /// The samples, by their numbers.
    pub(super) rows: Vec<Row>,
    /// Known loads of the samples at each displacement of the grid, ascending.
    pub(super) loads: Vec<Vec<f64>>,
    pub(super) counts: Counts,
}

impl Collected {
    /// The samples of parts. A part whose samples are all in others is left out: a copy, or a shard of what another folder has.
    ///
    /// # Errors
    ///
    /// If parts share a sample and each has others, so that counts at the points would count it twice.
    pub(super) fn of_parts(mut parts: Vec<Stored>, identity: &Identity) -> anyhow::Result<Self> {
        parts.sort_by_key(|it| std::cmp::Reverse(it.rows.len()));
        let mut all = Self {
            loads: vec![Vec::new(); identity.grid.n],
            ..Self::default()
        };
        let mut seen = BTreeSet::new();
        for part in parts {
            let twice = part.rows.iter().filter(|it| seen.contains(&it.sample));
            let n_twice = twice.clone().count();
            if n_twice == part.rows.len() {
                continue;
            }
            if let Some(row) = twice.clone().next() {
                anyhow::bail!(
                    "sample {} of {} is in another part too, and each has others: collect folders whose shards do not overlap",
                    row.sample,
                    part.path.display()
                );
            }
            seen.extend(part.rows.iter().map(|it| it.sample));
            all.counts.add(&part.counts);
            for loads in &part.loads {
                for (of_all, load) in all.loads.iter_mut().zip(loads) {
                    of_all.extend(load);
                }
            }
            all.rows.extend(part.rows);
        }
        all.rows.sort_by_key(|it| it.sample);
        all.loads
            .iter_mut()
            .for_each(|it| it.sort_by(f64::total_cmp));
        Ok(all)
    }

    /// Positive loads of the samples that have one, in their order.
    pub(super) fn strengths(&self, load: fn(&Row) -> Option<f64>) -> Vec<f64> {
        self.rows.iter().filter_map(load).collect()
    }

    /// Shares of the samples in which fracture begins at each point, and in which it is damaged, shape (n_points).
    pub(super) fn shares(&self) -> [Vec<f64>; 2] {
        let n = self.rows.len().max(1) as f64;
        let counts = &self.counts;
        [&counts.first_break, &counts.damaged]
            .map(|it| it.iter().map(|it| *it as f64 / n).collect())
    }
}
