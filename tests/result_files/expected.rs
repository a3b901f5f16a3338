//! What the program has in memory, in a plain form: raw little-endian numbers, and a list of what they are.
//!
//! A line of `expected.tsv` has, between tabs, the file, the part (`points`, `cells`, `point`, `cell` or `column`), the name, the
//! type (`f8`, `f4`, `i8`, `text`), the names of the components between commas, where the numbers begin in `expected.bin` (bytes)
//! and how many there are; of a column of text the texts themselves stand at the end instead, between vertical bars.

use std::fmt::Write as _;
use std::path::Path;

/// The content of result files as it should be.
#[derive(Default)]
pub(crate) struct Expected {
    list: String,
    numbers: Vec<u8>,
}

/// Where an array stands.
#[derive(Clone, Copy)]
pub(crate) struct Place<'a> {
    pub(crate) file: &'a str,
    /// `points`, `cells`, `point`, `cell` or `column`.
    pub(crate) part: &'a str,
    pub(crate) name: &'a str,
}

impl Expected {
    fn push(&mut self, place: Place<'_>, kind: &str, components: &[&str], bytes: Vec<u8>) {
        let width = if kind == "f4" { 4 } else { 8 };
        let Place { file, part, name } = place;
        let (names, offset, count) = (
            components.join(","),
            self.numbers.len(),
            bytes.len() / width,
        );
        // Writing to a string cannot fail.
        let _ = writeln!(
            self.list,
            "{file}\t{part}\t{name}\t{kind}\t{names}\t{offset}\t{count}"
        );
        self.numbers.extend(bytes);
    }

    pub(crate) fn reals(&mut self, place: Place<'_>, values: impl IntoIterator<Item = f64>) {
        let bytes = values.into_iter().flat_map(f64::to_le_bytes).collect();
        self.push(place, "f8", &[], bytes);
    }

    pub(crate) fn singles(&mut self, place: Place<'_>, values: impl IntoIterator<Item = f32>) {
        let bytes = values.into_iter().flat_map(f32::to_le_bytes).collect();
        self.push(place, "f4", &[], bytes);
    }

    pub(crate) fn integers(&mut self, place: Place<'_>, values: impl IntoIterator<Item = i64>) {
        let bytes = values.into_iter().flat_map(i64::to_le_bytes).collect();
        self.push(place, "i8", &[], bytes);
    }

    /// Named components; without names they are those of a vector.
    pub(crate) fn components<const N: usize>(
        &mut self,
        place: Place<'_>,
        names: [&str; N],
        values: impl IntoIterator<Item = [f64; N]>,
    ) {
        let bytes = values.into_iter().flatten().flat_map(f64::to_le_bytes);
        self.push(place, "f8", &names, bytes.collect());
    }

    pub(crate) fn texts(&mut self, place: Place<'_>, texts: &[String]) {
        let Place { file, part, name } = place;
        let texts = texts.join("|");
        let _ = writeln!(self.list, "{file}\t{part}\t{name}\ttext\t\t0\t{texts}");
    }

    /// Points (x, y) in the plane, and cells by their points.
    pub(crate) fn grid<'a>(
        &mut self,
        file: &str,
        points: impl IntoIterator<Item = [f64; 2]>,
        cells: impl IntoIterator<Item = &'a [u32]>,
    ) {
        let place = |part| Place {
            file,
            part,
            name: "",
        };
        let points = points.into_iter().map(|[x, y]| [x, y, 0.0]);
        self.components(place("points"), ["", "", ""], points);
        let counted = |cell: &[u32]| {
            let corners: Vec<i64> = cell.iter().map(|&it| i64::from(it)).collect();
            std::iter::once(corners.len() as i64).chain(corners)
        };
        self.integers(place("cells"), cells.into_iter().flat_map(counted));
    }

    /// Writes both files.
    pub(crate) fn write(&self, folder: &Path) {
        std::fs::write(folder.join("expected.tsv"), &self.list).unwrap();
        std::fs::write(folder.join("expected.bin"), &self.numbers).unwrap();
    }
}

/// A table that grows by rows and is expected by columns.
pub(crate) struct Rows {
    names: Vec<String>,
    rows: Vec<Vec<Entry>>,
}

/// An entry of a table.
#[derive(Clone)]
pub(crate) enum Entry {
    Real(f64),
    Integer(i64),
    Text(String),
}

impl From<f64> for Entry {
    fn from(value: f64) -> Self {
        Self::Real(value)
    }
}

impl From<usize> for Entry {
    fn from(value: usize) -> Self {
        Self::Integer(value as i64)
    }
}

impl From<&str> for Entry {
    fn from(value: &str) -> Self {
        Self::Text(value.to_owned())
    }
}

impl Rows {
    pub(crate) fn new<S: Into<String>>(names: impl IntoIterator<Item = S>) -> Self {
        Self {
            names: names.into_iter().map(Into::into).collect(),
            rows: Vec::new(),
        }
    }

    pub(crate) fn push(&mut self, row: impl IntoIterator<Item = Entry>) {
        let row: Vec<Entry> = row.into_iter().collect();
        assert_eq!(row.len(), self.names.len(), "{:?}", self.names);
        self.rows.push(row);
    }

    /// The columns of a file, each of the kind of its first entry.
    pub(crate) fn into_expected(self, file: &str, expected: &mut Expected) {
        for (column, name) in self.names.iter().enumerate() {
            let place = Place {
                file,
                part: "column",
                name,
            };
            let (mut reals, mut integers, mut texts) = (Vec::new(), Vec::new(), Vec::new());
            for row in &self.rows {
                match &row[column] {
                    Entry::Real(value) => reals.push(*value),
                    Entry::Integer(value) => integers.push(*value),
                    Entry::Text(text) => texts.push(text.clone()),
                }
            }
            let kinds = [reals.is_empty(), integers.is_empty(), texts.is_empty()];
            assert!(
                kinds.iter().filter(|it| !**it).count() <= 1,
                "{name} is of several kinds"
            );
            match kinds {
                [false, ..] => expected.reals(place, reals),
                [_, false, _] => expected.integers(place, integers),
                _ => expected.texts(place, &texts),
            }
        }
    }
}
