//! Tables of comma-separated values at positions: temperatures, factors of loads, and bodies of points; amplitudes, at times; and curves of
//! softening.

use std::collections::BTreeMap;
use std::path::Path;

use ligament::body::{AnyBody, Points};
use ligament::setup::{FinePlace, Sample};
use ligament_analysis::Amplitude;

use crate::input_file;

/// Names of the coordinates in a header.
const AXES: [&str; 3] = ["x", "y", "z"];

/// Column of the size of a point of a body: its area in the plane, m^2, its volume in space, m^3.
const SIZES: [&str; 2] = ["area", "volume"];

/// Word before the names of the columns in files of points of PeriLab.
const HEADER: &str = "header:";

/// Endings of the names of tables.
const ENDINGS: [&str; 2] = ["csv", "txt"];

/// Column of the numbers of blocks of other programs, whose points are the groups `block-1`, `block-2` and so on.
const BLOCK: &str = "block_id";

/// Whether a body's file is a table of points.
pub fn is_table(path: &Path) -> bool {
    let ending = path.extension().unwrap_or_default();
    ENDINGS.iter().any(|it| ending.eq_ignore_ascii_case(it))
}

/// Whether the points of a table belong to a solid, by the header in its first bytes; `None` where the header is incomplete.
pub(crate) fn holds_solid(bytes: &[u8]) -> Option<bool> {
    let end = bytes.iter().position(|it| *it == b'\n')?;
    let header = String::from_utf8_lossy(&bytes[..end]);
    let header = header.trim_start_matches(['\u{feff}', '#', ' ']);
    let header = header.trim_start_matches(HEADER);
    let mut names = Separator::in_header(header).values(header);
    Some(names.any(|it| name_of(&it) == AXES[2]))
}

/// Treatment of the tables that a case names.
#[derive(Debug, Clone, Copy)]
pub(crate) enum Tables {
    /// Tables that stay unread, and so without rows, where a substitute stands in for the body.
    Unread,
    /// Tables of positions in some dimensions.
    Read {
        /// Number of dimensions of the body.
        dimensions: usize,
    },
}

impl Tables {
    /// Reads the values of a column at their positions; as the error a description of the fault.
    pub(crate) fn samples(
        self,
        path: &Path,
        [column, unit]: [&str; 2],
    ) -> Result<Vec<Sample>, String> {
        let Self::Read { dimensions } = self else {
            return Ok(Vec::new());
        };
        let names: Vec<String> = AXES[..dimensions]
            .iter()
            .map(|it| format!("`{it}`"))
            .collect();
        let expected = format!(
            "the first row must name the columns {} (m) and `{column}`{unit}",
            names.join(", ")
        );
        let table = Table::read(path, &expected)?;
        let wanted = AXES[..dimensions].iter().copied().chain([column]);
        let places: Vec<usize> = wanted.map(|it| table.place(it)).collect::<Result<_, _>>()?;
        let (value, axes) = places.split_last().unwrap_or((&0, &[]));
        let sample = |row: &Row| {
            let mut position = [0.0; 3];
            for (coordinate, &place) in position.iter_mut().zip(axes) {
                *coordinate = table.number(row, place)?;
            }
            let value = table.number(row, *value)?;
            Ok(Sample { position, value })
        };
        table.rows.iter().map(sample).collect()
    }

    /// Reads the places of a refinement, each with its pass and whether its bond is open, where the table has these columns; as the error a
    /// description of the fault.
    pub(crate) fn fine_places(self, path: &Path) -> Result<Vec<FinePlace>, String> {
        let Self::Read { dimensions } = self else {
            return Ok(Vec::new());
        };
        let expected = "the first row must name the columns `x` and `y` (m), in a solid also `z`";
        let table = Table::read(path, expected)?;
        let axes = AXES[..dimensions].iter().map(|it| table.place(it));
        let axes: Vec<usize> = axes.collect::<Result<_, _>>()?;
        let [pass, open] = ["pass", "open"].map(|name| table.place(name).ok());
        let optional = |row: &Row, place: Option<usize>| {
            place.map_or(Ok(0.0), |place| table.number(row, place))
        };
        let place = |row: &Row| {
            let mut position = [0.0; 3];
            for (coordinate, &place) in position.iter_mut().zip(&axes) {
                *coordinate = table.number(row, place)?;
            }
            Ok(FinePlace {
                position,
                pass: optional(row, pass)? as u32,
                is_open: optional(row, open)? != 0.0,
            })
        };
        table.rows.iter().map(place).collect()
    }

    /// Reads an amplitude, whose times must grow from row to row; as the error a description of the fault.
    pub(crate) fn amplitude(self, path: &Path) -> Result<Amplitude, String> {
        if let Self::Unread = self {
            return Ok(Amplitude::constant());
        }
        let expected = "the first row must name the columns `time` (s) and `factor`";
        let table = Table::read(path, expected)?;
        let (time, factor) = (table.place("time")?, table.place("factor")?);
        let mut points: Vec<[f64; 2]> = Vec::with_capacity(table.rows.len());
        for row in &table.rows {
            let now = table.number(row, time)?;
            if let Some([before, _]) = points.last().filter(|it| it[0] >= now) {
                let reason = format!(
                    "the time {now:?} s is not later than that of the row before, {before:?} s"
                );
                return Err(at(path, row.line, &reason));
            }
            points.push([now, table.number(row, factor)?]);
        }
        if points.is_empty() {
            return Err(at(path, table.line, "there is no row below the header"));
        }
        Ok(Amplitude::through(&points))
    }
}

/// Reads the corners (opening, stress) of a curve of softening; as the error a description of the fault.
pub(crate) fn curve(path: &Path) -> Result<Vec<[f64; 2]>, String> {
    let expected = "the first row must name the columns `opening` (m, or over any other) and `stress` (Pa, or over the strength)";
    let table = Table::read(path, expected)?;
    let columns = [table.place("opening")?, table.place("stress")?];
    let corner = |row: &Row| {
        let [opening, stress] = columns.map(|it| table.number(row, it));
        Ok([opening?, stress?])
    };
    table.rows.iter().map(corner).collect()
}

/// Lines of the rows of a table; none of a file that is no table.
pub(crate) fn lines_of_rows(path: &Path) -> Vec<usize> {
    let table = Table::read(path, "");
    table.map_or_else(
        |_| Vec::new(),
        |it| it.rows.iter().map(|row| row.line).collect(),
    )
}

/// Reads a body of points: positions, the area or in space the volume of each, and a column of ones and zeros for each group.
pub(crate) fn body(path: &Path) -> Result<AnyBody, String> {
    let expected = "the first row of a body of points must name the columns `x`, `y` (m) and `area` (m^2), of a solid `x`, `y`, `z` and \
                    `volume` (m^3), then those of groups with 1 for their points and 0 for others";
    let table = Table::read(path, expected)?;
    let is_solid = table.names.iter().any(|it| it == AXES[2]);
    match is_solid {
        true => table.body::<3>().map(AnyBody::from),
        false => table.body::<2>().map(AnyBody::from),
    }
}

/// The text of a table of points at positions (n_points, m) with the area or volume of each (n_points, m^2 or m^3) and groups by indices, from which
/// a case makes the body.
///
/// # Errors
///
/// If a name of a group cannot head a column, or has the name of another column.
pub fn table_text<const D: usize>(
    positions: &[[f64; D]],
    sizes: &[f64],
    groups: &[(String, Vec<u32>)],
) -> Result<String, String> {
    let axes = AXES[..D].iter().chain([&SIZES[D - 2]]).copied();
    let mut header: Vec<&str> = axes.collect();
    let mut members = vec![vec!['0'; groups.len()]; positions.len()];
    for (column, (name, points)) in groups.iter().enumerate() {
        let is_plain = !name.is_empty() && name.trim() == name && !name.contains(['"', ',', '\n']);
        if !is_plain || header.contains(&name.as_str()) {
            return Err(format!(
                "`{name}` cannot be the name of a group: it heads a column of a table of points, beside {}",
                header.join(", ")
            ));
        }
        header.push(name);
        for &point in points {
            if let Some(row) = members.get_mut(point as usize) {
                row[column] = '1';
            }
        }
    }
    let points = positions.iter().zip(sizes).zip(&members);
    let rows = points.map(|((position, size), members)| {
        let numbers = position.iter().chain([size]).map(|it| format!("{it:?}"));
        numbers.chain(members.iter().map(char::to_string)).collect()
    });
    Ok(text_of_rows(&header, rows))
}

/// The text of a table.
fn text_of_rows(header: &[&str], rows: impl Iterator<Item = Vec<String>>) -> String {
    let header = header.join(",") + "\n";
    rows.fold(header, |text, row| text + &row.join(",") + "\n")
}

/// The text of a table of values at positions, from which a case reads them.
pub fn text_of_samples<const D: usize>(
    column: &str,
    positions: &[[f64; D]],
    values: &[f64],
) -> String {
    let header: Vec<&str> = AXES[..D].iter().copied().chain([column]).collect();
    let rows = positions.iter().zip(values).map(|(position, value)| {
        let numbers = position.iter().chain([value]);
        numbers.map(|it| format!("{it:?}")).collect()
    });
    text_of_rows(&header, rows)
}

/// The text of the places of a refinement in some dimensions, from which a case reads them.
pub fn text_of_fine_places(places: &[FinePlace], dimensions: usize) -> String {
    let axes = AXES[..dimensions].iter().copied();
    let header: Vec<&str> = axes.chain(["pass", "open"]).collect();
    let rows = places.iter().map(|it| {
        let numbers = it.position[..dimensions].iter().map(|it| format!("{it:?}"));
        let found = [it.pass, u32::from(it.is_open)].map(|it| it.to_string());
        numbers.chain(found).collect()
    });
    text_of_rows(&header, rows)
}

/// A row of a table: its line and the texts of its values.
struct Row {
    line: usize,
    values: Vec<String>,
}

/// A table of values.
struct Table<'a> {
    path: &'a Path,
    /// Line of the header.
    line: usize,
    names: Vec<String>,
    rows: Vec<Row>,
    /// Description of the columns that the table must have.
    expected: &'a str,
}

impl<'a> Table<'a> {
    fn read(path: &'a Path, expected: &'a str) -> Result<Self, String> {
        let text = input_file::read_text(path)
            .map_err(|source| format!("cannot read {}: {source}", path.display()))?;
        Self::parse(path, &text, expected)
    }

    /// Parses the rows below the header, with values separated by commas, by semicolons or tabs (as in spreadsheets with decimal commas), or by
    /// blanks; blank lines and lines that begin with # are ignored, except for a header.
    fn parse(path: &'a Path, text: &str, expected: &'a str) -> Result<Self, String> {
        // Spreadsheets write a byte order mark at the beginning of a file.
        let lines = text.trim_start_matches('\u{feff}').lines();
        let lines = (1..)
            .zip(lines.map(str::trim))
            .filter(|(_, text)| !text.is_empty());
        let (comments, lines): (Vec<_>, Vec<_>) = lines.partition(|it| it.1.starts_with('#'));
        let (&(line, first), below) = lines
            .split_first()
            .ok_or_else(|| at(path, 1, &format!("the file is empty: {expected}")))?;
        // Other programs write the names of the columns as a comment above rows of numbers.
        let above = comments.iter().rev().find(|it| it.0 < line);
        let above = above.filter(|_| {
            Separator::in_header(first)
                .values(first)
                .all(|it| number(&it).is_some())
        });
        let (line, header, below) = match above {
            Some((line, comment)) => (*line, comment.trim_start_matches('#'), &lines[..]),
            None => (line, first, below),
        };
        let header = header.trim().trim_start_matches(HEADER);
        let separator = Separator::in_header(header);
        let row = |(line, text): &(usize, &str)| Row {
            line: *line,
            values: separator.values(text).collect(),
        };
        Ok(Self {
            path,
            line,
            names: separator
                .values(header)
                .map(|it| name_of(&it).to_owned())
                .collect(),
            rows: below.iter().map(row).collect(),
            expected,
        })
    }

    /// The number of a row at a place.
    fn number(&self, row: &Row, place: usize) -> Result<f64, String> {
        let (given, columns) = (row.values.len(), self.names.len());
        if given != columns {
            let reason = format!("{given} values, but the header names {columns} columns");
            return Err(at(self.path, row.line, &reason));
        }
        let text = &row.values[place];
        number(text).ok_or_else(|| at(self.path, row.line, &format!("`{text:.40}` is no number")))
    }

    /// The numbers of a column.
    fn column(&self, place: usize) -> Result<Vec<f64>, String> {
        self.rows
            .iter()
            .map(|row| self.number(row, place))
            .collect()
    }

    /// Place of a column.
    fn place(&self, wanted: &str) -> Result<usize, String> {
        let place = self.names.iter().position(|name| name == wanted);
        let alike = || {
            let mut names = self.names.iter();
            names.position(|name| name.eq_ignore_ascii_case(wanted))
        };
        place.or_else(alike).ok_or_else(|| {
            let reason = format!("there is no column `{wanted}`: {}", self.expected);
            at(self.path, self.line, &reason)
        })
    }

    /// The body of the points of the table.
    fn body<const D: usize>(&self) -> Result<Points<D>, String> {
        let mut axes = [0; D];
        for (place, axis) in axes.iter_mut().zip(AXES) {
            *place = self.place(axis)?;
        }
        let size = self.place(SIZES[D - 2])?;
        let mut positions = vec![[0.0; D]; self.rows.len()];
        for (axis, &place) in axes.iter().enumerate() {
            for (position, coordinate) in positions.iter_mut().zip(self.column(place)?) {
                position[axis] = coordinate;
            }
        }
        let sizes = self.column(size)?;
        let fault =
            |error: ligament::body::PointsError| format!("{}: {error}", self.path.display());
        let mut points = Points::new(positions, sizes).map_err(fault)?;
        let is_group = |place: &usize| *place != size && !axes.contains(place);
        for place in (0..self.names.len()).filter(is_group) {
            let column = self.column(place)?;
            for (name, members) in groups(&self.names[place], &column) {
                points = points.with_group(&name, members).map_err(fault)?;
            }
        }
        Ok(points)
    }
}

/// Groups of a column with their points: the column as a group of the points with a nonzero value, or the groups of a column of block numbers.
fn groups(name: &str, column: &[f64]) -> Vec<(String, Vec<u32>)> {
    if name != BLOCK {
        let members = (0..).zip(column).filter(|(_, it)| **it != 0.0);
        return vec![(name.to_owned(), members.map(|it| it.0).collect())];
    }
    let mut blocks: BTreeMap<i64, Vec<u32>> = BTreeMap::new();
    for (point, block) in (0..).zip(column) {
        blocks.entry(*block as i64).or_default().push(point);
    }
    let named = |(block, members)| (format!("block-{block}"), members);
    blocks.into_iter().map(named).collect()
}

/// Separator of the values of a row.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Separator {
    Comma,
    /// A semicolon or a tab, with which decimals may have commas.
    OfSpreadsheets(char),
    Blanks,
}

impl Separator {
    /// The separator of a header.
    fn in_header(header: &str) -> Self {
        match header {
            _ if header.contains(';') => Self::OfSpreadsheets(';'),
            _ if header.contains('\t') => Self::OfSpreadsheets('\t'),
            _ if header.contains(',') => Self::Comma,
            _ => Self::Blanks,
        }
    }

    /// The values of a row, without quotes around them.
    fn values(self, row: &str) -> impl Iterator<Item = String> {
        let values: Vec<&str> = match self {
            Self::Comma => row.split(',').collect(),
            Self::OfSpreadsheets(separator) => row.split(separator).collect(),
            Self::Blanks => row.split_whitespace().collect(),
        };
        let has_comma = matches!(self, Self::OfSpreadsheets(_));
        values.into_iter().map(move |it| {
            let bare = it.trim().trim_matches('"').trim();
            match has_comma {
                true => bare.replacen(',', ".", 1),
                false => bare.to_owned(),
            }
        })
    }
}

/// A finite number, also with the D of double precision in Fortran before its exponent.
fn number(text: &str) -> Option<f64> {
    let read = text
        .parse()
        .or_else(|_| text.replace(['d', 'D'], "e").parse());
    read.ok().filter(|it: &f64| it.is_finite())
}

fn at(path: &Path, line: usize, reason: &str) -> String {
    format!("{}:{line}: {reason}", path.display())
}

/// Name of a column without quotes and without a unit in brackets behind it.
fn name_of(text: &str) -> &str {
    let bare = text.trim().trim_start_matches('\u{feff}').trim_matches('"');
    let unit = bare.find(['[', '(']).filter(|it| *it > 0);
    bare[..unit.unwrap_or(bare.len())].trim_end()
}

#[cfg(test)]
mod tests {
    use super::*;
    use ligament::body::Body;

    #[test]
    fn points_are_read_as_they_are_written() {
        let positions = [[0.1, 0.2], [0.1 + 0.2, 1e-300]];
        let groups = [("left".to_owned(), vec![0]), ("all".to_owned(), vec![0, 1])];
        let text = table_text(&positions, &[1e-4, 2e-4], &groups).unwrap();
        let table = Table::parse(Path::new("points.csv"), &text, "").unwrap();
        let body = table.body::<2>().unwrap();
        let direct = Points::new(positions.to_vec(), vec![1e-4, 2e-4]).unwrap();
        let direct = direct
            .with_group("left", [0])
            .unwrap()
            .with_group("all", [0, 1])
            .unwrap();
        assert_eq!(body, direct);
        assert_eq!(body.group_names(), ["all", "left"]);
        assert!(table_text(&positions, &[1.0; 2], &[("x".to_owned(), vec![0])]).is_err());
        assert!(table_text(&positions, &[1.0; 2], &[("a,b".to_owned(), vec![0])]).is_err());
        assert_eq!(holds_solid(text.as_bytes()), Some(false));
        assert_eq!(holds_solid(b"x, y,\"z\",volume\n"), Some(true));
        assert_eq!(holds_solid(b"x, y,\"z\""), None);
    }

    /// Tables of spreadsheets and of other programs have the numbers of a plain one.
    #[test]
    fn separators_quotes_and_units_are_read() {
        for text in [
            "time,factor\n0.5,1.25\n",
            "\u{feff}\"time\",\"factor\"\n\"0.5\",\"1.25\"\n",
            "Time [s];Factor (-)\n0,5;1,25\n",
            "time\tfactor\n0,5\t1.25\n",
            "# made by hand\n# time factor\n0.5 1.25\n",
            "header: time factor\n5.0D-1 1.25D0\n",
        ] {
            let table = Table::parse(Path::new("a.csv"), text, "").unwrap();
            let columns = ["time", "factor"].map(|it| table.place(it).unwrap());
            let numbers = columns.map(|it| table.column(it).unwrap());
            assert_eq!(numbers, [vec![0.5], vec![1.25]], "{text}");
        }
    }

    #[test]
    fn points_of_other_programs_have_their_blocks_as_groups() {
        let text = "# x y z block_id volume\n0 0 0 1 0.5\n1 0 0 2 0.5\n2 0 0 1 0.5\n";
        assert_eq!(holds_solid(text.as_bytes()), Some(true));
        let table = Table::parse(Path::new("points.txt"), text, "").unwrap();
        let body = table.body::<3>().unwrap();
        assert_eq!(body.group_names(), ["block-1", "block-2"]);
        assert_eq!(body.points_of("block-1"), Some(vec![0, 2]));
    }

    #[test]
    fn what_is_no_table_is_told_with_its_line() {
        let fault = |text: &str| {
            let table = Table::parse(Path::new("p.csv"), text, "EXPECTED");
            table.and_then(|it| it.body::<2>()).err().unwrap()
        };
        assert_eq!(fault(" \n"), "p.csv:1: the file is empty: EXPECTED");
        assert_eq!(
            fault("x,y\n0,0\n"),
            "p.csv:1: there is no column `area`: EXPECTED"
        );
        assert_eq!(
            fault("x,y,area\n0,0\n"),
            "p.csv:2: 2 values, but the header names 3 columns"
        );
        assert_eq!(
            fault("x,y,area\n# no\n0,b,1\n"),
            "p.csv:3: `b` is no number"
        );
        assert!(fault("x,y,area\n0,0,-1\n").contains("areas greater than 0"));
        assert!(fault("x,y,area,left\n0,0,1,0\n").contains("group `left` is empty"));
    }
}
