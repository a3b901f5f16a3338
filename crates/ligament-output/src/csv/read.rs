//! Reads CSV tables back.

use std::path::{Path, PathBuf};
use std::str::FromStr;

use ::csv::ReaderBuilder;
pub use ::csv::StringRecord;

use crate::{Error, read_text};

/// A table in memory, all values as texts.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct CsvTable {
    path: PathBuf,
    columns: Vec<String>,
    rows: Vec<StringRecord>,
}

impl CsvTable {
    /// Reads a table. A last row without a line feed, which a run is just writing, is left out.
    ///
    /// # Errors
    ///
    /// If the file cannot be read, or a row has not as many values as there are columns.
    pub fn read(path: impl Into<PathBuf>) -> Result<Self, Error> {
        let path = path.into();
        Self::parse(&path, &read_text(&path)?)
    }

    /// Parses the text of a table; `path` is the path of its file, for messages.
    ///
    /// # Errors
    ///
    /// If a row has not as many values as there are columns.
    pub fn parse(path: impl Into<PathBuf>, text: &str) -> Result<Self, Error> {
        let path = path.into();
        let mut records = records(text).into_iter();
        let header = records.next().unwrap_or_default();
        let columns: Vec<String> = header.iter().map(str::to_owned).collect();
        let rows: Vec<StringRecord> = records.collect();
        if let Some(place) = rows.iter().position(|row| row.len() != columns.len()) {
            return Err(Error::Unreadable {
                reason: format!(
                    "row {} has {} values, the header has {}",
                    place + 1,
                    rows[place].len(),
                    columns.len()
                ),
                path,
            });
        }
        Ok(Self {
            path,
            columns,
            rows,
        })
    }

    /// The path of the file.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// Names of the columns.
    pub fn columns(&self) -> &[String] {
        &self.columns
    }

    /// The texts of a column; None where there is no such column.
    pub fn texts(&self, column: &str) -> Option<impl Iterator<Item = &str>> {
        let place = self.columns.iter().position(|name| name == column)?;
        Some(self.rows.iter().map(move |row| &row[place]))
    }

    /// The results of a function for each row.
    ///
    /// # Errors
    ///
    /// If the function fails for a row.
    pub fn rows<T>(&self, read: impl Fn(Row<'_>) -> Result<T, Error>) -> Result<Vec<T>, Error> {
        let row = |number| Row {
            sheet: self,
            number,
        };
        (0..self.rows.len()).map(|it| read(row(it))).collect()
    }

    /// The values of a column, parsed.
    ///
    /// # Errors
    ///
    /// If there is no such column, or something else in it.
    pub fn values<T: FromStr>(&self, column: &str) -> Result<Vec<T>, Error> {
        self.place(column)?;
        self.rows(|row| row.value(column))
    }

    /// The numbers of several columns, row by row.
    ///
    /// # Errors
    ///
    /// If there is no such column, or something else in it.
    pub fn numbers<const N: usize>(&self, columns: [&str; N]) -> Result<Vec<[f64; N]>, Error> {
        let mut rows = vec![[0.0; N]; self.rows.len()];
        for (place, column) in columns.into_iter().enumerate() {
            for (row, value) in rows.iter_mut().zip(self.values(column)?) {
                row[place] = value;
            }
        }
        Ok(rows)
    }

    fn place(&self, column: &str) -> Result<usize, Error> {
        let place = self.columns.iter().position(|name| name == column);
        place.ok_or_else(|| self.malformed(format!("it has no column `{column}`")))
    }

    fn malformed(&self, reason: String) -> Error {
        let path = self.path.clone();
        Error::Unreadable { path, reason }
    }
}

/// A row of a table.
#[derive(Debug, Clone, Copy)]
pub struct Row<'a> {
    sheet: &'a CsvTable,
    /// Number of the row, from 0.
    number: usize,
}

impl Row<'_> {
    /// The texts of the row.
    pub fn cells(&self) -> &StringRecord {
        &self.sheet.rows[self.number]
    }

    /// The value in a column, parsed.
    ///
    /// # Errors
    ///
    /// If there is no such column, or something else in it.
    pub fn value<T: FromStr>(&self, column: &str) -> Result<T, Error> {
        let text = self.text(column)?;
        text.parse().map_err(|_| self.no_value(column, text))
    }

    /// The number in a column, which is finite.
    ///
    /// # Errors
    ///
    /// If there is no such column or number.
    pub fn number(&self, column: &str) -> Result<f64, Error> {
        let text = self.text(column)?;
        let value = text.parse().ok().filter(|value: &f64| value.is_finite());
        value.ok_or_else(|| self.no_value(column, text))
    }

    fn text(&self, column: &str) -> Result<&str, Error> {
        Ok(&self.cells()[self.sheet.place(column)?])
    }

    fn no_value(&self, column: &str, text: &str) -> Error {
        let row = self.number + 1;
        let reason = format!("`{text}` in column `{column}`, row {row}, is no value");
        self.sheet.malformed(reason)
    }
}

/// The records of a text, up to the last line feed; values in quotes may hold commas, quotes (doubled) and line feeds.
pub fn records(text: &str) -> Vec<StringRecord> {
    let finished = text.rfind('\n').map_or("", |end| &text[..=end]);
    let mut format = ReaderBuilder::new();
    let format = format.has_headers(false).flexible(true);
    let reader = format.from_reader(finished.as_bytes());
    // Text in memory, in records of any length, is read without errors.
    let mut records: Vec<StringRecord> = reader.into_records().map_while(Result::ok).collect();
    let is_cut_in_quotes = finished.matches('"').count() % 2 == 1;
    if is_cut_in_quotes {
        records.pop();
    }
    records
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;
    use crate::csv::Table;
    use proptest::prelude::*;
    use std::fs;

    proptest! {
        #[test]
        fn tables_read_back(rows in proptest::collection::vec((any::<String>(), any::<f64>(), any::<i64>()), 0..8)) {
            let folder = tempfile::tempdir().unwrap();
            let path = folder.path().join("table.csv");
            let mut table = Table::create(&path, &["a, \"text\"", "number", "count"]).unwrap();
            for (text, number, count) in &rows {
                table.append(&[text.as_str().into(), (*number).into(), (*count).into()]).unwrap();
            }
            let sheet = CsvTable::read(&path).unwrap();
            let texts: Vec<&str> = sheet.texts("a, \"text\"").unwrap().collect();
            prop_assert_eq!(texts, rows.iter().map(|row| row.0.as_str()).collect::<Vec<_>>());
            let numbers: Vec<f64> = sheet.values("number").unwrap();
            let same = |(read, row): (&f64, &(String, f64, i64))| {
                read.to_bits() == row.1.to_bits() || (read.is_nan() && row.1.is_nan())
            };
            prop_assert!(numbers.iter().zip(&rows).all(same));
            let counts: Vec<i64> = sheet.values("count").unwrap();
            prop_assert_eq!(counts, rows.iter().map(|row| row.2).collect::<Vec<_>>());
        }
    }

    fn read(text: &str) -> Result<CsvTable, Error> {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("table.csv");
        fs::write(&path, text).unwrap();
        CsvTable::read(path)
    }

    #[test]
    fn a_row_that_is_not_finished_is_left_out() {
        for rest in ["2,0.", "2,\"0.\n", "2,\"0.\n1"] {
            let sheet = read(&format!("step,load\n1,0.5\n{rest}")).unwrap();
            assert_eq!(sheet.values::<f64>("load").unwrap(), [0.5], "{rest}");
        }
    }

    #[test]
    fn what_is_no_table_is_refused_with_its_place() {
        let message = |text: &str| read(text).unwrap_err().to_string();
        assert!(message("step,load\n1,2\n3\n").ends_with("row 2 has 1 values, the header has 2"));
        let sheet = read("step,load\n1,x\n").unwrap();
        let message = sheet.values::<f64>("load").unwrap_err().to_string();
        assert!(message.ends_with("`x` in column `load`, row 1, is no value"));
        let numbers = read("step,load\n1,nan\n")
            .unwrap()
            .rows(|row| row.number("load"));
        let message = numbers.unwrap_err().to_string();
        assert!(message.ends_with("`nan` in column `load`, row 1, is no value"));
        let message = sheet.values::<f64>("force").unwrap_err().to_string();
        assert!(message.ends_with("it has no column `force`"));
    }
}
