//! Square sparse matrices without symmetry, by columns.

/// A square matrix: entries by columns, rows ascending.
#[derive(Debug, Clone, PartialEq)]
pub struct GeneralMatrix {
    column_starts: Vec<usize>,
    rows: Vec<usize>,
    values: Vec<f64>,
}

impl GeneralMatrix {
    /// The matrix of order `dimension` with given entries (row, column, value); entries at the same position add up in their order.
    ///
    /// # Panics
    ///
    /// Panics if an entry lies outside the matrix.
    pub fn of_entries(dimension: usize, mut entries: Vec<(usize, usize, f64)>) -> Self {
        let inside = |&(row, column, _): &(usize, usize, f64)| row.max(column) < dimension;
        assert!(entries.iter().all(inside), "an entry lies outside");
        entries.sort_by_key(|&(row, column, _)| (column, row));
        let mut matrix = Self {
            column_starts: vec![0; dimension + 1],
            rows: Vec::new(),
            values: Vec::new(),
        };
        let mut last = None;
        for (row, column, value) in entries {
            if last == Some((row, column))
                && let Some(sum) = matrix.values.last_mut()
            {
                *sum += value;
                continue;
            }
            last = Some((row, column));
            matrix.column_starts[column + 1] += 1;
            matrix.rows.push(row);
            matrix.values.push(value);
        }
        for column in 0..dimension {
            matrix.column_starts[column + 1] += matrix.column_starts[column];
        }
        matrix
    }

    /// Number of rows and columns n.
    pub fn dimension(&self) -> usize {
        self.column_starts.len() - 1
    }

    /// Number of stored entries.
    pub fn n_entries(&self) -> usize {
        self.values.len()
    }

    /// First entry of each column, then the number of entries, shape (n + 1).
    pub fn column_starts(&self) -> &[usize] {
        &self.column_starts
    }

    /// Row of each entry, shape (n_entries).
    pub fn rows(&self) -> &[usize] {
        &self.rows
    }

    /// Value of each entry, shape (n_entries).
    pub fn values(&self) -> &[f64] {
        &self.values
    }

    /// A x for x of shape (n).
    pub fn product(&self, vector: &[f64]) -> Vec<f64> {
        let mut product = vec![0.0; self.dimension()];
        for (column, factor) in vector.iter().enumerate() {
            let entries = self.column_starts[column]..self.column_starts[column + 1];
            for (row, value) in self.rows[entries.clone()].iter().zip(&self.values[entries]) {
                product[*row] += value * factor;
            }
        }
        product
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn entries_at_one_place_add_up() {
        let entries = vec![(1, 0, 2.0), (0, 1, 3.0), (1, 0, 0.5), (1, 1, -1.0)];
        let matrix = GeneralMatrix::of_entries(2, entries);
        assert_eq!(matrix.n_entries(), 3);
        assert_eq!(matrix.product(&[1.0, 10.0]), [30.0, -7.5]);
    }
}
