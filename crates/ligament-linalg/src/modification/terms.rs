//! Terms on their way up the elimination tree, and their rows in the current panel.

use std::ops::Range;

/// Number of terms applied together, small enough for their part of a panel to stay in the cache.
pub(super) const TERMS_AT_ONCE: usize = 32;

/// Terms c w w^T on their way up the elimination tree, with the rows of w in the current panel.
#[derive(Default)]
pub(super) struct Terms {
    /// Remaining weight c of each term.
    weights: Vec<f64>,
    /// Terms that are not zero in the columns of the panel.
    active: Vec<usize>,
    /// Weights of the active terms.
    active_weights: Vec<f64>,
    /// Rows of the panel for the active terms, one term after another, shape (active, height).
    rows: Vec<f64>,
    height: usize,
}

impl Terms {
    /// Starts with the weights of new terms.
    pub(super) fn start(&mut self, weights: impl Iterator<Item = f64>) {
        self.weights.clear();
        self.weights.extend(weights);
    }

    /// Reads the rows of the terms in a panel; returns false if all terms are zero in its columns.
    pub(super) fn gather(
        &mut self,
        columns: Range<usize>,
        below: &[usize],
        terms_in_progress: &mut [f64],
    ) -> bool {
        let n_terms = self.weights.len();
        self.active.clear();
        let in_columns =
            &terms_in_progress[TERMS_AT_ONCE * columns.start..TERMS_AT_ONCE * columns.end];
        self.active.extend((0..n_terms).filter(|&term| {
            in_columns
                .chunks_exact(TERMS_AT_ONCE)
                .any(|row| row[term] != 0.0)
        }));
        let active = self.active.iter();
        self.active_weights.clear();
        self.active_weights
            .extend(active.map(|&term| self.weights[term]));
        self.height = columns.len() + below.len();
        self.rows.clear();
        self.rows.resize(self.active.len() * self.height, 0.0);
        for (local, row) in columns.clone().chain(below.iter().copied()).enumerate() {
            let values = &terms_in_progress[TERMS_AT_ONCE * row..][..n_terms];
            for (place, &term) in self.active.iter().enumerate() {
                self.rows[place * self.height + local] = values[term];
            }
        }
        terms_in_progress[TERMS_AT_ONCE * columns.start..TERMS_AT_ONCE * columns.end].fill(0.0);
        !self.active.is_empty()
    }

    /// Weights of the active terms, and the rows of each of them in the panel.
    pub(super) fn in_panel(&mut self) -> (&mut [f64], Vec<&mut [f64]>) {
        let rows = self.rows.chunks_exact_mut(self.height).collect();
        (&mut self.active_weights, rows)
    }

    /// Writes the updated weights, and the terms at the rows below the panel.
    pub(super) fn scatter(
        &mut self,
        columns: Range<usize>,
        below: &[usize],
        terms_in_progress: &mut [f64],
    ) {
        for (&term, &weight) in self.active.iter().zip(&self.active_weights) {
            self.weights[term] = weight;
        }
        for (local, &row) in below.iter().enumerate() {
            let values = &mut terms_in_progress[TERMS_AT_ONCE * row..][..TERMS_AT_ONCE];
            for (place, &term) in self.active.iter().enumerate() {
                values[term] = self.rows[place * self.height + columns.len() + local];
            }
        }
    }
}
