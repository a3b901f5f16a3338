//! CSV tables (RFC 4180 quoting) of scalars over the steps.

pub mod read;

use std::fmt::Write as _;
use std::fs::File;
use std::hash::Hasher;
use std::io::{Seek, SeekFrom, Write as _};
use std::path::PathBuf;

use twox_hash::XxHash64;

use crate::Error;
use crate::file_digest::{FileDigest, digest_of_beginning};
use crate::folder::refuse_link;

/// One entry of a row.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Value<'a> {
    /// A signed integer.
    Integer(i64),
    /// A count, such as a number of bonds.
    Count(u64),
    /// A number, printed with the fewest digits that are read back exactly; `nan`, `inf` and `-inf` as words.
    Float(f64),
    /// A text, quoted where needed.
    Text(&'a str),
    /// A missing value, written as an empty field.
    Missing,
}

impl From<i64> for Value<'_> {
    fn from(value: i64) -> Self {
        Self::Integer(value)
    }
}

impl From<u32> for Value<'_> {
    fn from(value: u32) -> Self {
        Self::Count(u64::from(value))
    }
}

impl From<u64> for Value<'_> {
    fn from(value: u64) -> Self {
        Self::Count(value)
    }
}

impl From<usize> for Value<'_> {
    fn from(value: usize) -> Self {
        Self::Count(value as u64)
    }
}

impl From<f64> for Value<'_> {
    fn from(value: f64) -> Self {
        Self::Float(value)
    }
}

impl<'a> From<&'a str> for Value<'a> {
    fn from(value: &'a str) -> Self {
        Self::Text(value)
    }
}

/// A CSV file with a fixed header that grows by whole rows.
///
/// Each row is passed to the operating system before [`Table::append`] returns, so the table of a running or failed job is readable. Rows
/// end in a line feed. Python's `float`, NumPy and current pandas read the numbers back exactly; older versions of pandas need
/// `float_precision="round_trip"`.
#[derive(Debug)]
pub struct Table {
    path: PathBuf,
    file: File,
    n_columns: usize,
    /// Digest of all bytes so far.
    digest: XxHash64,
}

impl Table {
    /// Creates the file, replacing an existing one, and writes the header.
    ///
    /// # Errors
    ///
    /// If the path is a link, whose target may be any file, or the file cannot be written.
    pub fn create(path: impl Into<PathBuf>, columns: &[&str]) -> Result<Self, Error> {
        let path = path.into();
        refuse_link(&path)?;
        let file = File::create(&path).map_err(Error::system("write", &path))?;
        let mut table = Self {
            path,
            file,
            n_columns: columns.len(),
            digest: XxHash64::with_seed(0),
        };
        let header: Vec<Value<'_>> = columns.iter().copied().map(Value::from).collect();
        table.append(&header)?;
        Ok(table)
    }

    /// Creates the file as [`Table::create`] does, with the columns of a header such as `step,load`.
    pub fn with_header(path: impl Into<PathBuf>, header: &str) -> Result<Self, Error> {
        Self::create(path, &header.split(',').collect::<Vec<_>>())
    }

    /// Opens an existing table and truncates it to `length` bytes, after which rows are appended.
    ///
    /// # Errors
    ///
    /// If the file does not exist, is shorter, or cannot be written.
    pub fn open_truncated(
        path: impl Into<PathBuf>,
        n_columns: usize,
        length: u64,
    ) -> Result<Self, Error> {
        let path = path.into();
        let open = || {
            let mut file = File::options().write(true).open(&path)?;
            file.set_len(length)?;
            file.seek(SeekFrom::End(0))?;
            let (digest, _) = digest_of_beginning(&path, length)?;
            Ok((file, digest))
        };
        let (file, digest) = open().map_err(Error::system("write", &path))?;
        Ok(Self {
            path,
            file,
            n_columns,
            digest,
        })
    }

    /// Syncs the table to disk and returns its length and digest.
    ///
    /// # Errors
    ///
    /// If the file cannot be synced, or its length read.
    pub fn sync(&self) -> Result<FileDigest, Error> {
        let sync = self.file.sync_data().and_then(|()| self.file.metadata());
        let metadata = sync.map_err(Error::system("write", &self.path))?;
        Ok(FileDigest {
            length: metadata.len(),
            digest: self.digest.finish(),
        })
    }

    /// Appends one row, one value per column of the header.
    pub fn append(&mut self, row: &[Value<'_>]) -> Result<(), Error> {
        let (found, expected) = (row.len(), self.n_columns);
        if found != expected {
            let path = self.path.clone();
            let reason = format!(
                "a row has {found} values, expected {expected}, one per column of the header"
            );
            return Err(Error::Refused { path, reason });
        }
        // The file is not buffered: the row needs one write and no flush.
        let line = line(row);
        let written = self.file.write_all(line.as_bytes());
        self.digest.write(line.as_bytes());
        written.map_err(Error::system("write", &self.path))
    }
}

/// A row as text, ending in a line feed, for tables that are replaced as a whole.
pub fn line(row: &[Value<'_>]) -> String {
    let mut line = String::new();
    for (column, value) in row.iter().enumerate() {
        if column > 0 {
            line.push(',');
        }
        push_value(&mut line, *value);
    }
    line.push('\n');
    line
}

fn push_value(line: &mut String, value: Value<'_>) {
    // Writing to a string cannot fail.
    let _ = match value {
        Value::Integer(integer) => write!(line, "{integer}"),
        Value::Count(count) => write!(line, "{count}"),
        Value::Float(number) if number.is_nan() => write!(line, "nan"),
        Value::Float(number) => write!(line, "{number:?}"),
        Value::Text(text) => {
            push_text(line, text);
            Ok(())
        }
        Value::Missing => Ok(()),
    };
}

fn push_text(line: &mut String, text: &str) {
    // An empty text is quoted as well: as the only value of a row it would be a blank line, which readers skip.
    if !text.is_empty() && !text.contains([',', '"', '\n', '\r']) {
        line.push_str(text);
        return;
    }
    line.push('"');
    line.push_str(&text.replace('"', "\"\""));
    line.push('"');
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;
    use std::fs;

    fn printed(value: Value<'_>) -> String {
        let mut line = String::new();
        push_value(&mut line, value);
        line
    }

    #[test]
    fn values_are_printed_as_readers_expect() {
        let cases: [(Value<'_>, &str); 12] = [
            (0.0.into(), "0.0"),
            ((-0.0).into(), "-0.0"),
            (1e-7.into(), "1e-7"),
            ((0.1 + 0.2).into(), "0.30000000000000004"),
            (f64::NAN.into(), "nan"),
            (f64::INFINITY.into(), "inf"),
            (f64::NEG_INFINITY.into(), "-inf"),
            (i64::MIN.into(), "-9223372036854775808"),
            (u64::MAX.into(), "18446744073709551615"),
            ("a \"b\", c".into(), "\"a \"\"b\"\", c\""),
            ("".into(), "\"\""),
            (Value::Missing, ""),
        ];
        for (value, expected) in cases {
            assert_eq!(printed(value), expected);
        }
    }

    #[test]
    fn each_row_is_in_the_file_at_once() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("history.csv");
        let mut table = Table::create(&path, &["step", "displacement", "status"]).unwrap();
        assert_eq!(
            fs::read_to_string(&path).unwrap(),
            "step,displacement,status\n"
        );
        table
            .append(&[0_usize.into(), 0.25.into(), "converged".into()])
            .unwrap();
        let text = fs::read_to_string(&path).unwrap();
        assert_eq!(text, "step,displacement,status\n0,0.25,converged\n");
    }

    #[test]
    fn a_row_of_the_wrong_length_is_refused_and_not_written() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("history.csv");
        let mut table = Table::create(&path, &["step", "displacement"]).unwrap();
        let error = table.append(&[1_u32.into()]).unwrap_err();
        let message = error.to_string();
        assert!(message.ends_with("a row has 1 values, expected 2, one per column of the header"));
        assert_eq!(fs::read_to_string(&path).unwrap(), "step,displacement\n");
    }

    #[test]
    fn a_missing_folder_is_an_error_with_the_path() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("missing/history.csv");
        let error = Table::create(&path, &["step"]).unwrap_err();
        assert!(matches!(error, Error::System { path: p, .. } if p == path));
    }
}
