//! Tables of numbers in CSV files.

use std::path::Path;

/// A CSV file with a header line.
#[derive(Debug)]
pub struct Table {
    header: Vec<String>,
    rows: Vec<Vec<String>>,
}

impl Table {
    /// Reads a file; no cell of it is quoted.
    pub fn read(path: &Path) -> Self {
        let text = std::fs::read_to_string(path)
            .unwrap_or_else(|error| panic!("{}: {error}", path.display()));
        let cells = |line: &str| line.split(',').map(str::to_owned).collect::<Vec<_>>();
        let mut lines = text.lines();
        let header = cells(lines.next().unwrap());
        let rows: Vec<Vec<String>> = lines.map(cells).collect();
        assert!(!rows.is_empty(), "{} has no rows", path.display());
        assert!(rows.iter().all(|row| row.len() == header.len()));
        Self { header, rows }
    }

    /// A table of `tests/reference`.
    pub fn reference(name: &str) -> Self {
        Self::read(&crate::repository().join("tests/reference").join(name))
    }

    /// Number of rows.
    pub fn len(&self) -> usize {
        self.rows.len()
    }

    /// Whether there is no row.
    pub fn is_empty(&self) -> bool {
        self.rows.is_empty()
    }

    /// The cell in a row, as text.
    pub fn text(&self, row: usize, column: &str) -> &str {
        let place = self.header.iter().position(|name| name == column);
        &self.rows[row][place.unwrap_or_else(|| panic!("no column {column}"))]
    }

    /// The cell in a row, as a floating-point number.
    pub fn number(&self, row: usize, column: &str) -> f64 {
        self.text(row, column).parse().unwrap()
    }

    /// The cell in a row, as a whole number.
    pub fn count(&self, row: usize, column: &str) -> usize {
        self.text(row, column).parse().unwrap()
    }

    /// A whole column of numbers.
    pub fn column(&self, column: &str) -> Vec<f64> {
        (0..self.len())
            .map(|row| self.number(row, column))
            .collect()
    }

    /// The row with this text in a column.
    pub fn row_where(&self, column: &str, text: &str) -> usize {
        (0..self.len())
            .find(|&row| self.text(row, column) == text)
            .unwrap()
    }
}
