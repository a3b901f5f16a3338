//! Reads back the VTU files of this program, array by array.
//!
//! Only what [`write_vtu`](super::write_vtu) writes is read: one piece, arrays in blocks compressed by zlib. The text is searched
//! once for the places of the arrays, and an array is decoded when it is asked for: a file of fields has some twenty.

use std::ops::Range;
use std::path::{Path, PathBuf};

use base64::Engine as _;
use base64::prelude::BASE64_STANDARD;
use miniz_oxide::inflate::decompress_to_vec_zlib_with_limit;
use rayon::prelude::*;

use super::Cell;
use crate::atomic::read_bytes;
use crate::xml::{attribute, unescape};
use crate::{Error, FieldLocation};

/// Corners of a cell at most.
const MOST_CORNERS: usize = 8;

/// Numbers that a field has for a point or cell at most.
const MOST_COMPONENTS: usize = 16;

/// Size that no number of a result has: squares and quotients of smaller ones are numbers.
const BEYOND: f64 = 1e100;

/// Bytes of a number in the header of an array.
const HEADER_ENTRY: usize = 8;

/// A VTU file with the places of its arrays.
#[derive(Debug)]
pub struct VtuFile {
    path: PathBuf,
    text: String,
    contents: Contents,
}

/// The arrays of a file, and the number of values that a field has.
#[derive(Debug)]
struct Contents {
    arrays: Vec<Entry>,
    n_points: usize,
    n_cells: usize,
}

/// The part of a file that an array belongs to.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Section {
    Fields(FieldLocation),
    Points,
    Cells,
}

/// An array that was found.
#[derive(Debug)]
struct Entry {
    section: Section,
    name: String,
    vtk_type: String,
    /// Numbers a point or cell.
    n_components: usize,
    /// Names of the components: all of them or none.
    components: Vec<String>,
    /// Range of the base64 text of the array.
    content: Range<usize>,
}

impl VtuFile {
    /// Reads a file and finds its arrays.
    ///
    /// # Errors
    ///
    /// If the file cannot be read, or is no VTU file as this program writes them.
    pub fn open(path: impl Into<PathBuf>) -> Result<Self, Error> {
        let path = path.into();
        let bytes = read_bytes(&path).map_err(Error::system("read", &path))?;
        let strange = |reason: &str| Error::Unreadable {
            path: path.clone(),
            reason: reason.to_owned(),
        };
        let text = String::from_utf8(bytes).map_err(|_| strange("it is no text"))?;
        let contents = contents(&text).map_err(strange)?;
        Ok(Self {
            path,
            text,
            contents,
        })
    }

    /// The path of the file.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// Names of the fields on the points or cells, in their order.
    pub fn fields(&self, location: FieldLocation) -> impl Iterator<Item = &str> {
        let section = Section::Fields(location);
        let arrays = self.contents.arrays.iter();
        let of_section = arrays.filter(move |array| array.section == section);
        of_section.map(|array| array.name.as_str())
    }

    /// The number of values that a field has for each point or cell, and the names of these components if they have any;
    /// None where there is no such field.
    pub fn components(&self, location: FieldLocation, name: &str) -> Option<(usize, &[String])> {
        let entry = self.find(Section::Fields(location), name)?;
        Some((entry.n_components, &entry.components))
    }

    /// The numbers of a field, point by point or cell by cell; None where there is no such field.
    ///
    /// # Errors
    ///
    /// If it is damaged, or does not hold numbers.
    pub fn numbers(&self, location: FieldLocation, name: &str) -> Result<Option<Vec<f64>>, Error> {
        let entry = self.find(Section::Fields(location), name);
        entry.map(|entry| self.floats(entry)).transpose()
    }

    /// The integers of a field; None where there is no such field.
    ///
    /// # Errors
    ///
    /// If it is damaged, or does not hold integers.
    pub fn integers(&self, location: FieldLocation, name: &str) -> Result<Option<Vec<i64>>, Error> {
        let entry = self.find(Section::Fields(location), name);
        entry.map(|entry| self.whole(entry)).transpose()
    }

    /// The numbers of a field that the file must have.
    ///
    /// # Errors
    ///
    /// If it is missing or damaged, or does not hold numbers.
    pub fn required_numbers(&self, location: FieldLocation, name: &str) -> Result<Vec<f64>, Error> {
        let values = self.numbers(location, name)?;
        values.ok_or_else(|| self.missing(location, name))
    }

    /// The numbers of a field that the file must have, all of which are of a size that results have.
    ///
    /// # Errors
    ///
    /// If it is missing or damaged, or holds something else.
    pub fn finite_numbers(&self, location: FieldLocation, name: &str) -> Result<Vec<f64>, Error> {
        self.finite(name, self.required_numbers(location, name)?)
    }

    /// The integers of a field that the file must have.
    ///
    /// # Errors
    ///
    /// If it is missing or damaged, or does not hold integers.
    pub fn required_integers(
        &self,
        location: FieldLocation,
        name: &str,
    ) -> Result<Vec<i64>, Error> {
        let values = self.integers(location, name)?;
        values.ok_or_else(|| self.missing(location, name))
    }

    /// The tags of what the points of a model are: the noun `node` or `cell`, and the tags of the nodes or cells.
    ///
    /// # Errors
    ///
    /// If there are none, or they are damaged.
    pub fn tags(&self, location: FieldLocation) -> Result<(&'static str, Vec<i64>), Error> {
        for tagged in ["node", "cell"] {
            if let Some(tags) = self.integers(location, tagged)? {
                return Ok((tagged, tags));
            }
        }
        Err(self.strange(format!("its {location}s have no tags")))
    }

    /// Positions of the points, shape (n_points); z = 0 of a planar grid.
    ///
    /// # Errors
    ///
    /// If they are damaged or missing.
    pub fn points(&self) -> Result<Vec<[f64; 3]>, Error> {
        let values = self.floats(self.required(Section::Points, "Points")?)?;
        let values = self.finite("Points", values)?;
        Ok(values.as_chunks().0.to_vec())
    }

    /// Positions of the points of a planar grid, shape (n_points).
    ///
    /// # Errors
    ///
    /// If they are damaged or missing, or do not lie in the plane z = 0.
    pub fn points_in_plane(&self) -> Result<Vec<[f64; 2]>, Error> {
        let in_plane = |[x, y, z]: [f64; 3]| (z == 0.0).then_some([x, y]);
        let points: Option<Vec<[f64; 2]>> = self.points()?.into_iter().map(in_plane).collect();
        points.ok_or_else(|| {
            self.strange(
                "its points do not lie in the plane z = 0: the body is a solid, and what is asked for shows bodies in the plane alone",
            )
        })
    }

    /// The cells, whose points are points of the file.
    ///
    /// # Errors
    ///
    /// If they are damaged or missing, or of another kind than this program writes.
    pub fn cells(&self) -> Result<Vec<Cell>, Error> {
        let connectivity = self.whole(self.required(Section::Cells, "connectivity")?)?;
        let offsets = self.whole(self.required(Section::Cells, "offsets")?)?;
        let types = self.required(Section::Cells, "types")?;
        let types = self.values(types, u8::from_le_bytes)?;
        let point = |number: &i64| {
            let number = u32::try_from(*number).ok();
            number.filter(|point| (*point as usize) < self.contents.n_points)
        };
        let mut from = 0;
        let cell = |(vtk_type, to): (u8, i64)| {
            let to = usize::try_from(to).ok()?;
            let points: Option<Vec<u32>> = connectivity.get(from..to)?.iter().map(point).collect();
            from = to;
            Cell::from_vtk(vtk_type, &points?)
        };
        let cells: Option<Vec<Cell>> = types.into_iter().zip(offsets).map(cell).collect();
        let cells = cells.filter(|cells| cells.len() == self.contents.n_cells);
        cells
            .ok_or_else(|| self.strange("its cells are of a kind that this program does not write"))
    }

    /// The cells of a file whose cells are lines between its points, as their ends.
    ///
    /// # Errors
    ///
    /// If they are damaged or missing, or not all of them are lines.
    pub fn lines(&self) -> Result<Vec<[u32; 2]>, Error> {
        let ends = |cell: Cell| match cell {
            Cell::Line(ends) => Some(ends),
            _ => None,
        };
        let lines: Option<Vec<[u32; 2]>> = self.cells()?.into_iter().map(ends).collect();
        lines.ok_or_else(|| self.strange("its cells are no pairs of its points"))
    }

    /// The error of something in the file that is not as it should be.
    pub(crate) fn strange(&self, reason: impl Into<String>) -> Error {
        Error::Unreadable {
            path: self.path.clone(),
            reason: reason.into(),
        }
    }

    fn finite(&self, name: &str, values: Vec<f64>) -> Result<Vec<f64>, Error> {
        match values
            .iter()
            .find(|value| value.is_nan() || value.abs() >= BEYOND)
        {
            None => Ok(values),
            Some(value) => Err(self.strange(format!("array {name} holds {value}"))),
        }
    }

    fn missing(&self, location: FieldLocation, name: &str) -> Error {
        self.strange(format!("it has no {location} field {name}"))
    }

    fn find(&self, section: Section, name: &str) -> Option<&Entry> {
        let is_meant = |it: &&Entry| it.section == section && it.name == name;
        self.contents.arrays.iter().find(is_meant)
    }

    fn required(&self, section: Section, name: &str) -> Result<&Entry, Error> {
        self.find(section, name)
            .ok_or_else(|| self.strange(format!("it has no array {name}")))
    }

    fn floats(&self, entry: &Entry) -> Result<Vec<f64>, Error> {
        match entry.vtk_type.as_str() {
            "Float64" => self.values(entry, f64::from_le_bytes),
            "Float32" => self.values(entry, |bytes| f64::from(f32::from_le_bytes(bytes))),
            "Int64" => self.values(entry, |bytes| i64::from_le_bytes(bytes) as f64),
            other => Err(self.strange(format!("array {} has {other}, no numbers", entry.name))),
        }
    }

    fn whole(&self, entry: &Entry) -> Result<Vec<i64>, Error> {
        match entry.vtk_type.as_str() {
            "Int64" => self.values(entry, i64::from_le_bytes),
            other => Err(self.strange(format!("array {} has {other}, no integers", entry.name))),
        }
    }

    fn values<T, const SIZE: usize>(
        &self,
        entry: &Entry,
        from_bytes: impl Fn([u8; SIZE]) -> T,
    ) -> Result<Vec<T>, Error> {
        let damaged = || self.strange(format!("array {} is damaged", entry.name));
        let Contents {
            n_points, n_cells, ..
        } = self.contents;
        let (fewest, most) = match entry.section {
            Section::Fields(FieldLocation::Point) | Section::Points => (n_points, n_points),
            Section::Fields(FieldLocation::Cell) => (n_cells, n_cells),
            Section::Cells => (n_cells, MOST_CORNERS * n_cells),
        };
        let [fewest, most] = [fewest, most].map(|it| it * entry.n_components);
        let bytes = decode(self.text[entry.content.clone()].trim(), most * SIZE);
        let bytes = bytes.ok_or_else(damaged)?;
        let (values, rest) = bytes.as_chunks::<SIZE>();
        if rest.is_empty() && (fewest..=most).contains(&values.len()) {
            Ok(values.iter().map(|bytes| from_bytes(*bytes)).collect())
        } else {
            Err(damaged())
        }
    }
}

/// The contents of a text. Base64 has no `<`, so that tags are what lies between the angles.
fn contents(text: &str) -> Result<Contents, &'static str> {
    let mut arrays = Vec::new();
    let mut counts = None;
    let mut section = None;
    let mut is_known_format = false;
    let mut at = 0;
    while let Some(start) = text[at..].find('<').map(|offset| at + offset + 1) {
        let end = text[start..].find('>').ok_or("it ends in a tag")? + start;
        let tag = &text[start..end];
        at = end + 1;
        let name_end = tag.find([' ', '\n', '/']).unwrap_or(tag.len());
        match &tag[..name_end] {
            "VTKFile" => is_known_format = is_ours(tag),
            "Piece" => {
                let count = |key| attribute(tag, key)?.parse().ok();
                counts = count("NumberOfPoints").zip(count("NumberOfCells"));
            }
            "PointData" => section = Some(Section::Fields(FieldLocation::Point)),
            "CellData" => section = Some(Section::Fields(FieldLocation::Cell)),
            "Points" => section = Some(Section::Points),
            "Cells" => section = Some(Section::Cells),
            "DataArray" => {
                let of = |key| attribute(tag, key).ok_or("an array has no name or type");
                let length = text[at..].find('<').ok_or("it ends in an array")?;
                let count = attribute(tag, "NumberOfComponents").map_or(Ok(1), str::parse);
                let component = |number| attribute(tag, &format!("ComponentName{number}"));
                arrays.push(Entry {
                    section: section.ok_or("an array is out of place")?,
                    name: unescape(of("Name")?),
                    vtk_type: of("type")?.to_owned(),
                    n_components: (count
                        .ok()
                        .filter(|count| (1..=MOST_COMPONENTS).contains(count)))
                    .ok_or("an array has no number of components")?,
                    components: (0..).map_while(component).map(unescape).collect(),
                    content: at..at + length,
                });
            }
            _ => {}
        }
    }
    if !is_known_format {
        return Err("it is no VTU file of this program");
    }
    if !text.trim_end().ends_with("</VTKFile>") {
        return Err("its end is missing");
    }
    let (n_points, n_cells): (usize, usize) =
        counts.ok_or("it has no number of points and cells")?;
    // However well it is compressed, a point or cell takes more than a byte for its position and corners.
    if n_points.max(n_cells) > text.len() {
        return Err("it is too short for its number of points and cells");
    }
    Ok(Contents {
        arrays,
        n_points,
        n_cells,
    })
}

fn is_ours(tag: &str) -> bool {
    [
        ("type", "UnstructuredGrid"),
        ("byte_order", "LittleEndian"),
        ("header_type", "UInt64"),
        ("compressor", "vtkZLibDataCompressor"),
    ]
    .into_iter()
    .all(|(key, value)| attribute(tag, key) == Some(value))
}

/// The bytes of an array, of which there are so many at most: a header in base64, then the compressed blocks in base64 of their
/// own. None where they are damaged.
fn decode(text: &str, most: usize) -> Option<Vec<u8>> {
    // Three bytes take four letters; the first three entries take 24 bytes.
    let start = BASE64_STANDARD.decode(text.get(..32)?).ok()?;
    let entry = |bytes: &[u8], place: usize| -> Option<usize> {
        let bytes = bytes.get(place * HEADER_ENTRY..(place + 1) * HEADER_ENTRY)?;
        usize::try_from(u64::from_le_bytes(bytes.try_into().ok()?)).ok()
    };
    let n_blocks = entry(&start, 0)?;
    let header_bytes = n_blocks.checked_add(3)?.checked_mul(HEADER_ENTRY)?;
    let header_letters = header_bytes.div_ceil(3).checked_mul(4)?;
    let header = BASE64_STANDARD.decode(text.get(..header_letters)?).ok()?;
    let compressed = BASE64_STANDARD.decode(&text[header_letters..]).ok()?;
    let (whole, last) = (entry(&header, 1)?, entry(&header, 2)?);
    let mut blocks = Vec::with_capacity(n_blocks);
    let (mut from, mut left) = (0_usize, most);
    for block in 0..n_blocks {
        let to = from.checked_add(entry(&header, 3 + block)?)?;
        let size = if block + 1 == n_blocks && last > 0 {
            last
        } else {
            whole
        };
        blocks.push((compressed.get(from..to)?, size));
        from = to;
        left = left.checked_sub(size)?;
    }
    let inflated: Option<Vec<Vec<u8>>> = (blocks.par_iter())
        .map(|(block, size)| {
            let bytes = decompress_to_vec_zlib_with_limit(block, *size).ok()?;
            (bytes.len() == *size).then_some(bytes)
        })
        .collect();
    Some(inflated?.concat())
}

#[cfg(test)]
mod tests;
