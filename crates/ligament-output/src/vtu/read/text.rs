//! The text of a VTU file, and its arrays.

use std::ops::Range;
use std::path::{Path, PathBuf};

use base64::Engine as _;
use base64::prelude::BASE64_STANDARD;
use ligament_model::parallel;
use miniz_oxide::inflate::decompress_to_vec_zlib_with_limit;
use roxmltree::{Document, Node};

use crate::atomic::read_bytes;
use crate::{Error, FieldLocation};

/// Corners of a cell at most.
const MOST_CORNERS: usize = 8;

/// Numbers that a field has for a point or cell at most.
const MOST_COMPONENTS: usize = 16;

/// Bytes of a number in the header of an array.
const HEADER_ENTRY: usize = 8;

/// The text of a file with the places of its arrays.
#[derive(Debug)]
pub(super) struct VtuText {
    path: PathBuf,
    text: String,
    contents: VtuContents,
}

/// The arrays of a file, and the number of values that a field has.
#[derive(Debug)]
struct VtuContents {
    arrays: Vec<ArrayEntry>,
    n_points: usize,
    n_cells: usize,
}

/// The part of a file that an array belongs to.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum ArraySection {
    Fields(FieldLocation),
    FieldData,
    Points,
    Cells,
}

/// An array that was found.
#[derive(Debug)]
pub(super) struct ArrayEntry {
    section: ArraySection,
    pub(super) name: String,
    vtk_type: String,
    /// Number of values per point or cell.
    pub(super) n_components: usize,
    /// Names of the components: all of them or none.
    pub(super) components: Vec<String>,
    /// Range of the base64 text of the array.
    content: Range<usize>,
}

impl VtuText {
    /// Reads a file and finds its arrays.
    pub(super) fn open(path: &Path) -> Result<Self, Error> {
        let text = read(path)?;
        let contents = contents(&text).map_err(|reason| malformed(path, reason))?;
        let path = path.to_path_buf();
        Ok(Self {
            path,
            text,
            contents,
        })
    }

    pub(super) fn n_points(&self) -> usize {
        self.contents.n_points
    }

    pub(super) fn n_cells(&self) -> usize {
        self.contents.n_cells
    }

    /// The arrays of a part of the file, in their order.
    pub(super) fn arrays(&self, section: ArraySection) -> impl Iterator<Item = &ArrayEntry> {
        let arrays = self.contents.arrays.iter();
        arrays.filter(move |array| array.section == section)
    }

    pub(super) fn find(&self, section: ArraySection, name: &str) -> Option<&ArrayEntry> {
        self.arrays(section).find(|it| it.name == name)
    }

    /// Numbers of any kind.
    pub(super) fn floats(&self, entry: &ArrayEntry) -> Result<Vec<f64>, Error> {
        match entry.vtk_type.as_str() {
            "Float64" => self.values(entry, f64::from_le_bytes),
            "Float32" => self.values(entry, |bytes| f64::from(f32::from_le_bytes(bytes))),
            "Int64" => self.values(entry, |bytes| i64::from_le_bytes(bytes) as f64),
            other => Err(self.malformed(format!("array {} has {other}, no numbers", entry.name))),
        }
    }

    pub(super) fn integers(&self, entry: &ArrayEntry) -> Result<Vec<i64>, Error> {
        match entry.vtk_type.as_str() {
            "Int64" => self.values(entry, i64::from_le_bytes),
            other => Err(self.malformed(format!("array {} has {other}, no integers", entry.name))),
        }
    }

    pub(super) fn bytes(&self, entry: &ArrayEntry) -> Result<Vec<u8>, Error> {
        self.values(entry, u8::from_le_bytes)
    }

    pub(super) fn malformed(&self, reason: impl Into<String>) -> Error {
        malformed(&self.path, reason)
    }

    fn values<T, const SIZE: usize>(
        &self,
        entry: &ArrayEntry,
        from_bytes: impl Fn([u8; SIZE]) -> T,
    ) -> Result<Vec<T>, Error> {
        let damaged = || self.malformed(format!("array {} is damaged", entry.name));
        let VtuContents {
            n_points, n_cells, ..
        } = self.contents;
        let (fewest, most) = match entry.section {
            ArraySection::Fields(FieldLocation::Point) | ArraySection::Points => {
                (n_points, n_points)
            }
            ArraySection::Fields(FieldLocation::Cell) => (n_cells, n_cells),
            ArraySection::Cells => (n_cells, MOST_CORNERS * n_cells),
            ArraySection::FieldData => (1, 1),
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

/// Names of the pieces of a grid in pieces.
///
/// # Errors
///
/// If the file is something else.
pub(super) fn sources(path: &Path) -> Result<Vec<String>, Error> {
    let text = read(path)?;
    let names = || {
        let document = Document::parse(&text).ok()?;
        let grid = document.root_element();
        let pieces = grid.descendants().filter(|it| it.has_tag_name("Piece"));
        let names: Option<Vec<String>> = pieces
            .map(|piece| piece.attribute("Source").map(str::to_owned))
            .collect();
        let is_in_pieces = grid.attribute("type") == Some("PUnstructuredGrid");
        names.filter(|names| is_in_pieces && !names.is_empty())
    };
    names().ok_or_else(|| malformed(path, "it is no PVTU file of this program"))
}

fn read(path: &Path) -> Result<String, Error> {
    let bytes = read_bytes(path).map_err(Error::system("read", path))?;
    String::from_utf8(bytes).map_err(|_| malformed(path, "it is no text"))
}

/// The error for a file with an invalid part, given the reason.
pub(super) fn malformed(path: &Path, reason: impl Into<String>) -> Error {
    Error::Unreadable {
        path: path.to_path_buf(),
        reason: reason.into(),
    }
}

/// The contents of a text.
fn contents(text: &str) -> Result<VtuContents, String> {
    const OTHER: &str = "it is no VTU file of this program";
    let fault = |error: roxmltree::Error| match text.contains("<VTKFile") {
        true => format!("it is damaged: {error}"),
        false => OTHER.to_owned(),
    };
    let document = Document::parse(text).map_err(fault)?;
    let grid = document.root_element();
    if !is_written_here(grid) {
        return Err(OTHER.to_owned());
    }
    let piece = grid.descendants().find(|it| it.has_tag_name("Piece"));
    let count = |key| piece?.attribute(key)?.parse().ok();
    let (n_points, n_cells): (usize, usize) = count("NumberOfPoints")
        .zip(count("NumberOfCells"))
        .ok_or("it has no number of points and cells")?;
    // However well it is compressed, a point or cell takes more than a byte for its position and corners.
    if n_points.max(n_cells) > text.len() {
        return Err("it is too short for its number of points and cells".to_owned());
    }
    let arrays = grid.descendants().filter(|it| it.has_tag_name("DataArray"));
    Ok(VtuContents {
        arrays: arrays.map(ArrayEntry::new).collect::<Result<_, _>>()?,
        n_points,
        n_cells,
    })
}

impl ArrayEntry {
    fn new(array: Node<'_, '_>) -> Result<Self, &'static str> {
        let section = array.parent_element().map(|it| it.tag_name().name());
        let section = match section {
            Some("PointData") => ArraySection::Fields(FieldLocation::Point),
            Some("CellData") => ArraySection::Fields(FieldLocation::Cell),
            Some("FieldData") => ArraySection::FieldData,
            Some("Points") => ArraySection::Points,
            Some("Cells") => ArraySection::Cells,
            _ => return Err("an array is out of place"),
        };
        let text_of = |key: &str| array.attribute(key).map(str::to_owned);
        let count = array.attribute("NumberOfComponents").unwrap_or("1");
        let component = |number| Some(text_of(&format!("ComponentName{number}"))?.to_lowercase());
        let content = array.first_child().filter(Node::is_text);
        Ok(Self {
            section,
            name: text_of("Name").ok_or("an array has no name")?,
            vtk_type: text_of("type").ok_or("an array has no type")?,
            n_components: (count.parse().ok())
                .filter(|count| (1..=MOST_COMPONENTS).contains(count))
                .ok_or("an array has no number of components")?,
            components: (0..).map_while(component).collect(),
            content: content.ok_or("an array has no content")?.range(),
        })
    }
}

fn is_written_here(grid: Node<'_, '_>) -> bool {
    [
        ("type", "UnstructuredGrid"),
        ("byte_order", "LittleEndian"),
        ("header_type", "UInt64"),
        ("compressor", "vtkZLibDataCompressor"),
    ]
    .into_iter()
    .all(|(key, value)| grid.attribute(key) == Some(value))
}

/// The bytes of an array, at most `most`: a header in base64, then the compressed blocks in a base64 text of their own. `None` where they
/// are damaged.
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
    let inflated = parallel::map(&blocks, |(block, size)| {
        let bytes = decompress_to_vec_zlib_with_limit(block, *size).ok()?;
        (bytes.len() == *size).then_some(bytes)
    });
    let inflated: Option<Vec<Vec<u8>>> = inflated.into_iter().collect();
    Some(inflated?.concat())
}
