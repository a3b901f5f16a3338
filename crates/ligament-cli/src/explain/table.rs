//! Aligned columns of text.

/// A table whose columns are as wide as their widest entry, aligned to the right.
#[derive(Debug, Clone)]
pub(super) struct Columns {
    rows: Vec<Vec<String>>,
}

impl Columns {
    pub(super) fn new(header: impl IntoIterator<Item = impl Into<String>>) -> Self {
        Self {
            rows: vec![header.into_iter().map(Into::into).collect()],
        }
    }

    pub(super) fn push(&mut self, row: Vec<String>) {
        self.rows.push(row);
    }

    /// The lines, indented by two spaces.
    pub(super) fn lines(&self) -> Vec<String> {
        let n_columns = self.rows.iter().map(Vec::len).max().unwrap_or(0);
        let width = |column: usize| {
            let entries = self.rows.iter().filter_map(|row| row.get(column));
            entries.map(|it| it.chars().count()).max().unwrap_or(0)
        };
        let widths: Vec<usize> = (0..n_columns).map(width).collect();
        let line = |row: &Vec<String>| {
            let entries = row.iter().zip(&widths);
            entries
                .map(|(entry, width)| format!("  {entry:>width$}"))
                .collect::<String>()
        };
        self.rows.iter().map(line).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn columns_are_aligned() {
        let mut table = Columns::new(["step", "s"]);
        table.push(vec!["1".to_owned(), "-0.25".to_owned()]);
        assert_eq!(table.lines(), ["  step      s", "     1  -0.25"]);
    }
}
