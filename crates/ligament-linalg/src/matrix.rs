//! Symmetric sparse matrices: the upper triangle by columns.

use std::sync::Arc;

use thiserror::Error;

/// Sparsity pattern of a symmetric matrix: the upper triangle by columns, rows ascending, diagonal always present (last).
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Pattern {
    column_starts: Vec<usize>,
    rows: Vec<usize>,
}

/// Reasons why arrays do not form a pattern.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Error)]
pub enum PatternError {
    /// Column starts do not begin at zero, do not ascend or do not end at the number of rows given.
    #[error("the column starts are not an ascending range over the entries (column {column})")]
    ColumnStarts {
        /// First column found wrong.
        column: usize,
    },
    /// A column is not strictly ascending or does not end on the diagonal.
    #[error("the rows of column {column} do not ascend strictly to the diagonal")]
    Rows {
        /// First column found wrong.
        column: usize,
    },
}

impl Pattern {
    /// A pattern from column starts (n + 1) and the row of each entry.
    pub fn new(column_starts: Vec<usize>, rows: Vec<usize>) -> Result<Self, PatternError> {
        if column_starts.first() != Some(&0) || column_starts.last() != Some(&rows.len()) {
            return Err(PatternError::ColumnStarts { column: 0 });
        }
        for (column, ends) in column_starts.windows(2).enumerate() {
            if ends[0] > ends[1] || ends[1] > rows.len() {
                return Err(PatternError::ColumnStarts { column });
            }
            let entries = &rows[ends[0]..ends[1]];
            if entries.last() != Some(&column) || entries.windows(2).any(|pair| pair[0] >= pair[1])
            {
                return Err(PatternError::Rows { column });
            }
        }
        Ok(Self {
            column_starts,
            rows,
        })
    }

    /// Number of rows and columns n.
    pub fn dimension(&self) -> usize {
        self.column_starts.len() - 1
    }

    /// Number of stored entries: the upper triangle and the diagonal.
    pub fn n_entries(&self) -> usize {
        self.rows.len()
    }

    /// First entry of each column, then the number of entries, shape (n + 1).
    pub fn column_starts(&self) -> &[usize] {
        &self.column_starts
    }

    /// Rows of a column, ascending; the last one is the diagonal.
    pub(crate) fn column(&self, column: usize) -> &[usize] {
        &self.rows[self.column_starts[column]..self.column_starts[column + 1]]
    }

    /// Row of each entry, shape (n_entries).
    pub fn rows(&self) -> &[usize] {
        &self.rows
    }
}

/// A symmetric matrix over a shared pattern.
#[derive(Debug, Clone, PartialEq)]
pub struct SymmetricMatrix {
    pattern: Arc<Pattern>,
    /// Values of the upper triangle in the order of the pattern, shape (n_entries).
    pub values: Vec<f64>,
}

impl SymmetricMatrix {
    /// The zero matrix over a pattern.
    pub fn zero(pattern: Arc<Pattern>) -> Self {
        let values = vec![0.0; pattern.n_entries()];
        Self { pattern, values }
    }

    /// The sparsity pattern.
    pub fn pattern(&self) -> &Arc<Pattern> {
        &self.pattern
    }

    /// Diagonal entry at an index.
    pub fn diagonal(&self, index: usize) -> f64 {
        self.values[self.pattern.column_starts[index + 1] - 1]
    }

    /// Adds weight g g^T, with the entries of g by row; entries outside the pattern are left out.
    pub fn add_outer(&mut self, weight: f64, entries: &[(usize, f64)]) {
        for &(column, one) in entries {
            let start = self.pattern.column_starts[column];
            let rows = &self.pattern.rows[start..self.pattern.column_starts[column + 1]];
            for &(row, other) in entries.iter().filter(|(row, _)| *row <= column) {
                if let Ok(place) = rows.binary_search(&row) {
                    self.values[start + place] += weight * one * other;
                }
            }
        }
    }

    /// Adds `factor` times a diagonal matrix, shape (n).
    pub fn add_diagonal(&mut self, factor: f64, diagonal: &[f64]) {
        let ends = &self.pattern.column_starts[1..];
        for (&end, value) in ends.iter().zip(diagonal) {
            self.values[end - 1] += factor * value;
        }
    }
}
