//! Tables of known and computed values.

use std::fmt;

use anyhow::Context;

use super::entry::{Entry, Verdict};
use super::printed::{Difference, Tolerance};

/// Extent of the computation of the tables.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Extent {
    /// Entries of the fast subset, as in the tests.
    Fast,
    /// Full extent: all entries.
    Full,
}

/// A table of known values with their source, before the computation.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct KnownTable {
    /// Heading of the table.
    pub(super) heading: Heading,
    /// Entries of the table, in their order.
    pub(super) entries: Vec<Entry>,
}

/// The heading of a table.
#[derive(Debug, Clone, PartialEq)]
pub struct Heading {
    /// Name of the table's file.
    pub name: String,
    /// Title of the table.
    pub title: String,
    /// Source of the values.
    pub source: String,
    /// The quantity and its unit.
    pub quantity: String,
    /// Kind of the known values: `printed`, `eq. 22`, `closed form`.
    pub known: String,
    /// Reason for the tolerances.
    pub tolerance: String,
    /// Names of the labels of an entry.
    pub keys: Vec<String>,
}

/// A table with its computed values.
#[derive(Debug, Clone, PartialEq)]
pub struct Table {
    /// Heading of the table.
    pub heading: Heading,
    /// Rows of the table.
    pub rows: Vec<Row>,
}

/// An entry with its computed value and verdict.
#[derive(Debug, Clone, PartialEq)]
pub struct Row {
    /// Entry with the known value.
    pub entry: Entry,
    /// Computed value.
    pub computed: f64,
    /// Verdict on the computed value.
    pub verdict: Verdict,
}

/// Labels of an entry, by their keys.
#[derive(Debug, Clone, Copy)]
pub struct Labels<'a> {
    keys: &'a [String],
    labels: &'a [String],
}

/// Error of a label that an experiment needs.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub(super) enum LabelError {
    /// The table has no such key.
    #[error("no key `{key}`; keys: {}", keys.join(", "))]
    NoKey {
        /// Requested key.
        key: String,
        /// The keys of the table.
        keys: Vec<String>,
    },
    /// The label is not a number.
    #[error("`{label}` of key `{key}` is neither a number nor a fraction such as 1/3")]
    NotANumber {
        /// Key without the label.
        key: String,
        /// Label that the key does not have.
        label: String,
    },
}

impl KnownTable {
    /// Computes the entries of the table, or of its fast subset, and judges them.
    pub(super) fn judge(
        &self,
        extent: Extent,
        mut compute: impl FnMut(Labels<'_>) -> anyhow::Result<f64>,
    ) -> anyhow::Result<Table> {
        let mut rows = Vec::new();
        for entry in (self.entries.iter()).filter(|entry| entry.is_fast || extent == Extent::Full) {
            let labels = Labels::new(&self.heading.keys, &entry.labels);
            let computed =
                compute(labels).with_context(|| format!("{}, {labels}", self.heading.name))?;
            rows.push(Row {
                computed,
                verdict: entry.verdict(computed),
                entry: entry.clone(),
            });
        }
        Ok(Table {
            heading: self.heading.clone(),
            rows,
        })
    }
}

impl Heading {
    /// Whether the known values are from a paper: printed, fitted or stated there.
    pub(super) fn is_of_a_paper(&self) -> bool {
        ["printed", "stated", "statement", "eq. 22"].contains(&&*self.known)
    }
}

impl Table {
    /// Computed values over the numbers of a key, from the rows with all the labels of `of` (`law=pds, of=lattice`; empty for all rows),
    /// shape (n, 2).
    pub(super) fn computed(&self, x: &str, of: &str) -> Result<Vec<[f64; 2]>, LabelError> {
        self.points(x, of, |row| row.computed)
    }

    /// Known values over the numbers of a key, from the rows with the labels of `of` as in [`Table::computed`], shape (n, 2).
    pub(super) fn known(&self, x: &str, of: &str) -> Result<Vec<[f64; 2]>, LabelError> {
        self.points(x, of, |row| row.entry.known.value())
    }

    fn points(
        &self,
        x: &str,
        of: &str,
        y: impl Fn(&Row) -> f64,
    ) -> Result<Vec<[f64; 2]>, LabelError> {
        let mut points = Vec::new();
        for row in &self.rows {
            let labels = self.labels(row);
            if labels.contain_labels(of)? {
                points.push([labels.number(x)?, y(row)]);
            }
        }
        Ok(points)
    }

    /// Computed minus known value of a row: an amount in a table with absolute tolerances or where the known value is 0, otherwise a share
    /// of the known value.
    pub(super) fn difference(&self, row: &Row) -> Difference {
        let is_amount = |row: &Row| {
            matches!(
                row.entry.allowed,
                Tolerance::Absolute(_) | Tolerance::Between(..)
            )
        };
        let known = row.entry.known.value();
        let amount = row.computed - known;
        if known == 0.0 || self.rows.iter().any(is_amount) {
            Difference::Amount(amount)
        } else {
            Difference::Share(amount / known.abs())
        }
    }

    /// The labels of a row.
    pub fn labels<'a>(&'a self, row: &'a Row) -> Labels<'a> {
        Labels::new(&self.heading.keys, &row.entry.labels)
    }
}

impl<'a> Labels<'a> {
    /// Labels by the keys of their table.
    pub(super) fn new(keys: &'a [String], labels: &'a [String]) -> Self {
        Self { keys, labels }
    }

    /// Whether all labels in a text such as `law=pds, of=lattice` are among these; true for an empty text.
    pub(super) fn contain_labels(&self, of: &str) -> Result<bool, LabelError> {
        let mut belongs = true;
        for (key, label) in of.split(", ").filter_map(|it| it.split_once('=')) {
            belongs &= self.text(key)? == label;
        }
        Ok(belongs)
    }

    /// The label of a key.
    pub(super) fn text(&self, key: &str) -> Result<&'a str, LabelError> {
        let place = self.keys.iter().position(|name| name == key);
        let label = place.and_then(|place| self.labels.get(place));
        label.map(String::as_str).ok_or_else(|| LabelError::NoKey {
            key: key.to_owned(),
            keys: self.keys.to_vec(),
        })
    }

    /// The label of a key as a number; `1/3` is one.
    pub(super) fn number(&self, key: &str) -> Result<f64, LabelError> {
        number(key, self.text(key)?)
    }

    /// Keys with their labels.
    pub(super) fn pairs(&self) -> impl Iterator<Item = (&'a String, &'a String)> + use<'a> {
        self.keys.iter().zip(self.labels)
    }
}

/// The label of a key as a number; `1/3` is one.
pub(super) fn number(key: &str, label: &str) -> Result<f64, LabelError> {
    let number = match label.split_once('/') {
        None => label.parse().ok(),
        Some((above, below)) => above
            .parse()
            .ok()
            .zip(below.parse().ok())
            .map(|(above, below): (f64, f64)| above / below),
    };
    number.ok_or_else(|| LabelError::NotANumber {
        key: key.to_owned(),
        label: label.to_owned(),
    })
}

impl fmt::Display for Labels<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (index, (key, label)) in self.keys.iter().zip(self.labels).enumerate() {
            let comma = if index > 0 { ", " } else { "" };
            write!(f, "{comma}{key} {label}")?;
        }
        Ok(())
    }
}
