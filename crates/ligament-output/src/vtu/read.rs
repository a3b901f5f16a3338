//! Reads back the VTU files of this program, array by array.
//!
//! Only files of [`write_vtu`](super::write_vtu) are read: one piece, arrays in blocks compressed by zlib; and grids in pieces of
//! [`write_shared`](super::write_shared), which are read as if one process had written them. The text is searched once for the arrays, and
//! an array is decoded when it is asked for: a file of fields has some twenty.

mod text;

use std::path::{Path, PathBuf};

use super::pieces::{CELL_NUMBER, POINT_NUMBER};
use super::{Cell, TIME_VALUE};
use crate::{Error, FieldLocation};
use text::{ArrayEntry, ArraySection, VtuText, malformed, sources};

/// Nouns for the points of a model whose tags a file has: nodes of a mesh, cells of a lattice, points of a table.
pub const TAG_NOUNS: [&str; 3] = ["node", "cell", "point"];

/// Size that no result reaches: squares and quotients of smaller numbers are finite.
const BEYOND: f64 = 1e100;

/// A VTU file or a grid in pieces, with the positions of its arrays.
#[derive(Debug)]
pub struct VtuFile {
    path: PathBuf,
    pieces: Vec<Piece>,
    n_points: usize,
    n_cells: usize,
}

/// A piece of a grid, with the places of its points and cells in the whole grid.
#[derive(Debug)]
struct Piece {
    text: VtuText,
    points: RowNumbers,
    cells: RowNumbers,
}

/// Numbers in the whole grid of the rows of a piece.
#[derive(Debug)]
enum RowNumbers {
    /// Consecutive numbers from this one on.
    From(usize),
    /// The number of each row.
    Numbers(Vec<u32>),
}

impl VtuFile {
    /// Reads a file, or all pieces of a grid, and finds the arrays.
    ///
    /// # Errors
    ///
    /// If a file cannot be read, or is not as this program writes it.
    pub fn open(path: impl Into<PathBuf>) -> Result<Self, Error> {
        let path = path.into();
        if path.extension().is_none_or(|it| it != "pvtu") {
            let text = VtuText::open(&path)?;
            return Ok(Self {
                path,
                n_points: text.n_points(),
                n_cells: text.n_cells(),
                pieces: vec![Piece {
                    text,
                    points: RowNumbers::From(0),
                    cells: RowNumbers::From(0),
                }],
            });
        }
        Self::open_pieces(path)
    }

    /// Reads the pieces of a grid.
    fn open_pieces(path: PathBuf) -> Result<Self, Error> {
        let mut pieces = Vec::new();
        let mut before = [0, 0];
        for source in sources(&path)? {
            // A piece lies beside the file that names it: a path in its name is ignored.
            let name = Path::new(&source).file_name().unwrap_or_default();
            let text = VtuText::open(&path.with_file_name(name))?;
            let points = RowNumbers::read(&text, FieldLocation::Point, before[0])?;
            let cells = RowNumbers::read(&text, FieldLocation::Cell, before[1])?;
            before = [before[0] + text.n_points(), before[1] + text.n_cells()];
            pieces.push(Piece {
                text,
                points,
                cells,
            });
        }
        let n_points = grid_size(pieces.iter().map(|it| (&it.points, it.text.n_points())));
        let n_cells = grid_size(pieces.iter().map(|it| (&it.cells, it.text.n_cells())));
        match n_points.zip(n_cells) {
            Some((n_points, n_cells)) => Ok(Self {
                path,
                pieces,
                n_points,
                n_cells,
            }),
            None => Err(malformed(&path, "its pieces do not make a whole")),
        }
    }

    /// The path of the file.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// Names of the fields on the points or cells, in their order.
    pub fn fields(&self, location: FieldLocation) -> impl Iterator<Item = &str> {
        let section = ArraySection::Fields(location);
        let arrays = self.pieces[0].text.arrays(section);
        let names = arrays.map(|array| array.name.as_str());
        names.filter(|name| ![POINT_NUMBER, CELL_NUMBER].contains(name))
    }

    /// Numbers of the whole grid with their names, such as its time.
    ///
    /// # Errors
    ///
    /// If they are damaged.
    pub fn field_data(&self) -> Result<Vec<(&str, f64)>, Error> {
        let text = &self.pieces[0].text;
        let arrays = text.arrays(ArraySection::FieldData);
        let number = |it: &'_ ArrayEntry| text.floats(it).map(|values| values[0]);
        arrays
            .map(|it| Ok((it.name.as_str(), number(it)?)))
            .collect()
    }

    /// Time of the grid, where it has one: s in a motion, otherwise the number of a step or mode.
    ///
    /// # Errors
    ///
    /// If the field data are damaged.
    pub fn time(&self) -> Result<Option<f64>, Error> {
        let numbers = self.field_data()?.into_iter();
        let mut times = numbers.filter(|it| it.0 == TIME_VALUE);
        Ok(times.next().map(|it| it.1))
    }

    /// The number of values that a field has for each point or cell, and the names of these components if they have any;
    /// None where there is no such field.
    pub fn components(&self, location: FieldLocation, name: &str) -> Option<(usize, &[String])> {
        let entry = self.find(ArraySection::Fields(location), name)?;
        Some((entry.n_components, &entry.components))
    }

    /// Names of the components of a field for requests of single components: the names in the file, otherwise `x`, `y` and `z` for a vector
    /// and numbers for other fields; empty for a scalar, or where there is no such field.
    pub fn component_names(&self, location: FieldLocation, name: &str) -> Vec<String> {
        match self.components(location, name) {
            None | Some((1, _)) => Vec::new(),
            Some((3, [])) => ["x", "y", "z"].map(str::to_owned).to_vec(),
            Some((count, [])) => (0..count).map(|it| it.to_string()).collect(),
            Some((_, names)) => names.to_vec(),
        }
    }

    /// The numbers of a field, point by point or cell by cell; None where there is no such field.
    ///
    /// # Errors
    ///
    /// If it is damaged, or does not hold numbers.
    pub fn numbers(&self, location: FieldLocation, name: &str) -> Result<Option<Vec<f64>>, Error> {
        self.values_of_pieces(ArraySection::Fields(location), name, VtuText::floats)
    }

    /// The integers of a field; None where there is no such field.
    ///
    /// # Errors
    ///
    /// If it is damaged, or does not hold integers.
    pub fn integers(&self, location: FieldLocation, name: &str) -> Result<Option<Vec<i64>>, Error> {
        self.values_of_pieces(ArraySection::Fields(location), name, VtuText::integers)
    }

    /// The numbers of a field that the file must have.
    ///
    /// # Errors
    ///
    /// If it is missing or damaged, or does not hold numbers.
    pub fn required_numbers(&self, location: FieldLocation, name: &str) -> Result<Vec<f64>, Error> {
        let values = self.numbers(location, name)?;
        values.ok_or_else(|| self.missing_field(location, name))
    }

    /// The numbers of a field that the file must have, all finite and of a size that results can have.
    ///
    /// # Errors
    ///
    /// If it is missing or damaged, or holds something else.
    pub fn finite_numbers(&self, location: FieldLocation, name: &str) -> Result<Vec<f64>, Error> {
        self.require_finite(name, self.required_numbers(location, name)?)
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
        values.ok_or_else(|| self.missing_field(location, name))
    }

    /// The tags of the points of a model, with the noun of [`TAG_NOUNS`] for these points.
    ///
    /// # Errors
    ///
    /// If there are none, or they are damaged.
    pub fn tags(&self, location: FieldLocation) -> Result<(&'static str, Vec<i64>), Error> {
        for tagged in TAG_NOUNS {
            if let Some(tags) = self.integers(location, tagged)? {
                return Ok((tagged, tags));
            }
        }
        Err(self.malformed(format!("its {location}s have no tags")))
    }

    /// Positions of the points, shape (n_points); z = 0 of a planar grid.
    ///
    /// # Errors
    ///
    /// If they are damaged or missing.
    pub fn points(&self) -> Result<Vec<[f64; 3]>, Error> {
        let values = self.values_of_pieces(ArraySection::Points, "Points", VtuText::floats)?;
        let values = values.ok_or_else(|| self.missing_array("Points"))?;
        let values = self.require_finite("Points", values)?;
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
            self.malformed(
                "its points do not lie in the plane z = 0: the body is a solid, and this shows only bodies in the plane",
            )
        })
    }

    /// The cells, whose points are points of the file.
    ///
    /// # Errors
    ///
    /// If they are damaged or missing, or of another kind than this program writes.
    pub fn cells(&self) -> Result<Vec<Cell>, Error> {
        let mut cells = vec![None; self.n_cells];
        for piece in &self.pieces {
            for (place, cell) in self.cells_of(piece)?.into_iter().enumerate() {
                cells[piece.cells.global_number(place)] = cell;
            }
        }
        let cells: Option<Vec<Cell>> = cells.into_iter().collect();
        cells.ok_or_else(|| {
            self.malformed("its cells are of a kind that this program does not write")
        })
    }

    /// The cells of a piece, with the numbers of their points in the whole grid; `None` for a cell of another kind.
    fn cells_of(&self, piece: &Piece) -> Result<Vec<Option<Cell>>, Error> {
        let text = &piece.text;
        let array = |name| {
            text.find(ArraySection::Cells, name)
                .ok_or_else(|| self.missing_array(name))
        };
        let connectivity = text.integers(array("connectivity")?)?;
        let offsets = text.integers(array("offsets")?)?;
        let types = text.bytes(array("types")?)?;
        let point = |number: &i64| {
            let number = usize::try_from(*number).ok();
            let number = number.filter(|point| *point < text.n_points());
            number.map(|place| piece.points.global_number(place) as u32)
        };
        let mut from = 0;
        let cell = |(vtk_type, to): (u8, i64)| {
            let to = usize::try_from(to).ok()?;
            let points: Option<Vec<u32>> = connectivity.get(from..to)?.iter().map(point).collect();
            from = to;
            Cell::from_vtk(vtk_type, &points?)
        };
        let cells: Vec<Option<Cell>> = types.into_iter().zip(offsets).map(cell).collect();
        match cells.len() == text.n_cells() {
            true => Ok(cells),
            false => Err(self.malformed("array types is damaged")),
        }
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
        lines.ok_or_else(|| self.malformed("its cells are no pairs of its points"))
    }

    /// The error for a file with an invalid part, given the reason.
    pub(crate) fn malformed(&self, reason: impl Into<String>) -> Error {
        malformed(&self.path, reason)
    }

    fn require_finite(&self, name: &str, values: Vec<f64>) -> Result<Vec<f64>, Error> {
        match values
            .iter()
            .find(|value| value.is_nan() || value.abs() >= BEYOND)
        {
            None => Ok(values),
            Some(value) => Err(self.malformed(format!("array {name} holds {value}"))),
        }
    }

    fn missing_field(&self, location: FieldLocation, name: &str) -> Error {
        self.malformed(format!("it has no {location} field {name}"))
    }

    fn missing_array(&self, name: &str) -> Error {
        self.malformed(format!("it has no array {name}"))
    }

    fn find(&self, section: ArraySection, name: &str) -> Option<&ArrayEntry> {
        self.pieces[0].text.find(section, name)
    }

    /// The values of an array over all pieces; None where there is no such array.
    fn values_of_pieces<T: Copy + Default>(
        &self,
        section: ArraySection,
        name: &str,
        values: impl Fn(&VtuText, &ArrayEntry) -> Result<Vec<T>, Error>,
    ) -> Result<Option<Vec<T>>, Error> {
        let Some(first) = self.find(section, name) else {
            return Ok(None);
        };
        if let [Piece { text, .. }] = self.pieces.as_slice() {
            return values(text, first).map(Some);
        }
        let (n, is_of_cells) = (
            first.n_components,
            section == ArraySection::Fields(FieldLocation::Cell),
        );
        let n_rows = if is_of_cells {
            self.n_cells
        } else {
            self.n_points
        };
        let mut all = vec![T::default(); n * n_rows];
        for piece in &self.pieces {
            let entry = piece
                .text
                .find(section, name)
                .filter(|it| it.n_components == n);
            let of_piece = values(&piece.text, entry.ok_or_else(|| self.missing_array(name))?)?;
            let places = if is_of_cells {
                &piece.cells
            } else {
                &piece.points
            };
            for (place, row) in of_piece.chunks_exact(n).enumerate() {
                all[n * places.global_number(place)..][..n].copy_from_slice(row);
            }
        }
        Ok(Some(all))
    }
}

impl RowNumbers {
    /// Places of the rows of a piece: by their stored numbers, otherwise following the `before` rows of the pieces before it.
    fn read(text: &VtuText, location: FieldLocation, before: usize) -> Result<Self, Error> {
        let name = match location {
            FieldLocation::Point => POINT_NUMBER,
            FieldLocation::Cell => CELL_NUMBER,
        };
        let Some(entry) = text.find(ArraySection::Fields(location), name) else {
            return Ok(Self::From(before));
        };
        let numbers = text.integers(entry)?.into_iter().map(u32::try_from);
        let numbers: Result<Vec<u32>, _> = numbers.collect();
        let numbers = numbers.map_err(|_| text.malformed(format!("array {name} is damaged")))?;
        Ok(Self::Numbers(numbers))
    }

    /// Place in the grid of a row of the piece.
    fn global_number(&self, row: usize) -> usize {
        match self {
            Self::From(first) => first + row,
            Self::Numbers(numbers) => numbers[row] as usize,
        }
    }
}

/// Number of the rows of a grid, with the places and the number of rows of each piece; None where a place is missing.
fn grid_size<'a>(pieces: impl Iterator<Item = (&'a RowNumbers, usize)> + Clone) -> Option<usize> {
    let most = pieces.clone().map(|(_, n)| n).sum();
    let mut is_there = vec![false; most];
    for (places, n) in pieces {
        for row in 0..n {
            *is_there.get_mut(places.global_number(row))? = true;
        }
    }
    let n_rows = is_there.iter().rposition(|it| *it)? + 1;
    is_there[..n_rows].iter().all(|it| *it).then_some(n_rows)
}

#[cfg(test)]
mod tests;
