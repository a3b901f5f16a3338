//! Numbers of entries by verdict.

use std::fmt;
use std::iter::Sum;

use super::entry::Verdict;
use super::experiment::Findings;

/// Numbers of entries by verdict, in the order of [`Verdict::ALL`].
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Tally([usize; Verdict::ALL.len()]);

impl Tally {
    /// Counts the verdicts of an experiment.
    pub fn from_findings(findings: &Findings) -> Self {
        let rows = findings.tables.iter().flat_map(|table| &table.rows);
        Self::from_verdicts(rows.map(|row| row.verdict))
    }

    /// Counts verdicts.
    pub(super) fn from_verdicts(verdicts: impl Iterator<Item = Verdict> + Clone) -> Self {
        Self(Verdict::ALL.map(|verdict| verdicts.clone().filter(|it| *it == verdict).count()))
    }

    /// Number of entries with a verdict.
    pub fn count(&self, verdict: Verdict) -> usize {
        let place = Verdict::ALL.iter().position(|it| *it == verdict);
        place.map_or(0, |place| self.0[place])
    }

    /// The counts in the order of [`Verdict::ALL`].
    pub fn counts(&self) -> [usize; Verdict::ALL.len()] {
        self.0
    }

    /// Number of all entries.
    pub fn entries(&self) -> usize {
        self.0.iter().sum()
    }
}

impl From<[usize; Verdict::ALL.len()]> for Tally {
    /// Counts in the order of [`Verdict::ALL`].
    fn from(counts: [usize; Verdict::ALL.len()]) -> Self {
        Self(counts)
    }
}

impl Sum for Tally {
    fn sum<I: Iterator<Item = Self>>(tallies: I) -> Self {
        tallies.fold(Self::default(), |sum, tally| {
            Self(std::array::from_fn(|place| sum.0[place] + tally.0[place]))
        })
    }
}

impl fmt::Display for Tally {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{} entries:", self.entries())?;
        let counted = Verdict::ALL
            .iter()
            .zip(self.0)
            .filter(|(_, count)| *count > 0);
        for (place, (verdict, count)) in counted.enumerate() {
            let comma = if place > 0 { "," } else { "" };
            write!(f, "{comma} {count} {}", verdict.words())?;
        }
        Ok(())
    }
}
