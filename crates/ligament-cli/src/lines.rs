//! Lines of reports: names with values, and aligned columns.

use std::fmt::Display;
use std::io::{self, Write};

use ligament_output::columns::aligned;

/// Writes a line with a name in a column of a width, and its value.
///
/// # Errors
///
/// If `out` cannot be written to.
pub(crate) fn entry(
    out: &mut dyn Write,
    width: usize,
    name: &str,
    value: impl Display,
) -> io::Result<()> {
    writeln!(out, "  {name:<width$} {value}")
}

/// A table whose columns are as wide as their widest entry, aligned to the right.
#[derive(Debug, Clone)]
pub(crate) struct Columns {
    rows: Vec<Vec<String>>,
}

impl Columns {
    pub(crate) fn new(header: impl IntoIterator<Item = impl Into<String>>) -> Self {
        Self {
            rows: vec![header.into_iter().map(Into::into).collect()],
        }
    }

    pub(crate) fn push(&mut self, row: Vec<String>) {
        self.rows.push(row);
    }

    /// Writes the lines, indented by two spaces.
    ///
    /// # Errors
    ///
    /// If `out` cannot be written to.
    pub(crate) fn write(&self, out: &mut dyn Write) -> io::Result<()> {
        for line in aligned(&self.rows, 0) {
            writeln!(out, "  {line}")?;
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn columns_are_aligned() {
        let mut table = Columns::new(["step", "s"]);
        table.push(vec!["1".to_owned(), "-0.25".to_owned()]);
        let mut out = Vec::new();
        table.write(&mut out).unwrap();
        assert_eq!(out, b"  step      s\n     1  -0.25\n");
    }
}
