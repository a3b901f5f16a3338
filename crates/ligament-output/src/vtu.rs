//! VTU files: fields on the points and cells of an unstructured grid.
//!
//! The files are binary, compressed by zlib and little-endian. Integers are `Int64`, which VTK, PyVista and meshio read
//! exactly. The format is that of VTK XML files, version 1.0 (<https://vtk.org/Wiki/VTK_XML_Formats>).

mod data_array;
pub mod read;

use std::collections::HashSet;
use std::fmt::Write as _;
use std::path::Path;

use rayon::prelude::*;

use self::data_array::data_array;
use crate::atomic::replace_file;
use crate::xml::escape_attribute;
use crate::{Error, FieldLocation};

/// A cell given by its points, indices from 0.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Cell {
    /// A single point.
    Vertex([u32; 1]),
    /// A segment, such as a bond.
    Line([u32; 2]),
    /// Three corners.
    Triangle([u32; 3]),
    /// Four corners in order around the cell.
    Quad([u32; 4]),
}

impl Cell {
    /// The points of the cell.
    pub fn points(&self) -> &[u32] {
        match self {
            Self::Vertex(points) => points,
            Self::Line(points) => points,
            Self::Triangle(points) => points,
            Self::Quad(points) => points,
        }
    }

    /// The cell of a number in `vtkCellType.h`; None where it is of another kind, or has other points.
    fn from_vtk(vtk_type: u8, points: &[u32]) -> Option<Self> {
        match (vtk_type, points) {
            (1, &[a]) => Some(Self::Vertex([a])),
            (3, &[a, b]) => Some(Self::Line([a, b])),
            (5, &[a, b, c]) => Some(Self::Triangle([a, b, c])),
            (9, &[a, b, c, d]) => Some(Self::Quad([a, b, c, d])),
            _ => None,
        }
    }

    /// The number of the kind in `vtkCellType.h`.
    fn vtk_type(&self) -> u8 {
        match self {
            Self::Vertex(_) => 1,
            Self::Line(_) => 3,
            Self::Triangle(_) => 5,
            Self::Quad(_) => 9,
        }
    }
}

/// The values of a field, one per point or cell.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum FieldValues<'a> {
    /// Numbers.
    Scalar(&'a [f64]),
    /// Numbers of seven digits, in half of the space.
    Single(&'a [f32]),
    /// Vectors; planar ones have a third component of 0, which VTK requires.
    Vector(&'a [[f64; 3]]),
    /// Integers, such as numbers of bonds or flags.
    Integer(&'a [i64]),
    /// Named components, such as those of a stress, one point or cell after the other.
    Components {
        /// Names of the components, which readers show.
        names: &'a [&'a str],
        /// The values, shape (n, number of names).
        values: &'a [f64],
    },
}

impl FieldValues<'_> {
    fn len(&self) -> usize {
        match self {
            Self::Scalar(values) => values.len(),
            Self::Single(values) => values.len(),
            Self::Vector(values) => values.len(),
            Self::Integer(values) => values.len(),
            Self::Components { names, values } => values.len() / names.len().max(1),
        }
    }
}

/// A named field.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Field<'a> {
    /// The name readers show, unique among the point fields and among the cell fields.
    pub name: &'a str,
    /// The values.
    pub values: FieldValues<'a>,
}

impl<'a> Field<'a> {
    /// A field of numbers.
    pub fn scalar(name: &'a str, values: &'a [f64]) -> Self {
        let values = FieldValues::Scalar(values);
        Self { name, values }
    }

    /// A field of numbers of seven digits.
    pub fn single(name: &'a str, values: &'a [f32]) -> Self {
        let values = FieldValues::Single(values);
        Self { name, values }
    }

    /// A field of vectors.
    pub fn vector(name: &'a str, values: &'a [[f64; 3]]) -> Self {
        let values = FieldValues::Vector(values);
        Self { name, values }
    }

    /// A field of integers.
    pub fn integer(name: &'a str, values: &'a [i64]) -> Self {
        let values = FieldValues::Integer(values);
        Self { name, values }
    }

    /// A field of named components, shape (n, number of names).
    pub fn components(name: &'a str, names: &'a [&'a str], values: &'a [f64]) -> Self {
        let values = FieldValues::Components { names, values };
        Self { name, values }
    }

    fn to_xml(self) -> String {
        match self.values {
            FieldValues::Scalar(values) => float_array(self.name, 1, &[], values),
            FieldValues::Single(values) => {
                data_array(self.name, "Float32", 1, &[], values, f32::to_le_bytes)
            }
            FieldValues::Vector(values) => float_array(self.name, 3, &[], values.as_flattened()),
            FieldValues::Integer(values) => integer_array(self.name, values),
            FieldValues::Components { names, values } => {
                float_array(self.name, names.len(), names, values)
            }
        }
    }
}

/// A planar grid with its fields.
#[derive(Debug, Clone, Copy)]
pub struct UnstructuredGrid<'a> {
    /// Reference positions; the file has z = 0.
    pub points: &'a [[f64; 2]],
    /// Cells on these points, of any mixture of kinds.
    pub cells: &'a [Cell],
    /// Fields on the points. ParaView colours by the first scalar and warps by the first vector.
    pub point_fields: &'a [Field<'a>],
    /// Fields on the cells.
    pub cell_fields: &'a [Field<'a>],
}

impl UnstructuredGrid<'_> {
    fn check(&self, path: &Path) -> Result<(), Error> {
        let (n_points, n_cells) = (self.points.len(), self.cells.len());
        if n_points == 0 || n_cells == 0 {
            return Err(Error::EmptyGrid {
                path: path.to_path_buf(),
                n_points,
                n_cells,
            });
        }
        for (cell, points) in self.cells.iter().map(Cell::points).enumerate() {
            if let Some(&point) = points.iter().find(|&&point| point as usize >= n_points) {
                return Err(Error::PointOutOfRange {
                    path: path.to_path_buf(),
                    cell,
                    point,
                    n_points,
                });
            }
        }
        check_fields(path, FieldLocation::Point, self.point_fields, n_points)?;
        check_fields(path, FieldLocation::Cell, self.cell_fields, n_cells)
    }

    /// The document, the same for any number of threads: they share arrays and blocks of fixed size.
    fn to_xml(self) -> String {
        let mut xml = format!(
            "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n\
             <VTKFile type=\"UnstructuredGrid\" version=\"1.0\" byte_order=\"LittleEndian\" header_type=\"UInt64\" \
             compressor=\"vtkZLibDataCompressor\">\n<UnstructuredGrid>\n\
             <Piece NumberOfPoints=\"{}\" NumberOfCells=\"{}\">\n",
            self.points.len(),
            self.cells.len()
        );
        push_fields(&mut xml, "PointData", self.point_fields);
        push_fields(&mut xml, "CellData", self.cell_fields);
        let points: Vec<f64> = self.points.iter().flat_map(|&[x, y]| [x, y, 0.0]).collect();
        xml.push_str("<Points>\n");
        xml.push_str(&float_array("Points", 3, &[], &points));
        xml.push_str("</Points>\n<Cells>\n");
        xml.extend(cell_arrays(self.cells));
        xml.push_str("</Cells>\n</Piece>\n</UnstructuredGrid>\n</VTKFile>\n");
        xml
    }
}

fn check_fields(
    path: &Path,
    location: FieldLocation,
    fields: &[Field<'_>],
    expected: usize,
) -> Result<(), Error> {
    let mut names = HashSet::new();
    for field in fields {
        if field.values.len() != expected {
            return Err(Error::FieldLength {
                path: path.to_path_buf(),
                location,
                field: field.name.to_owned(),
                expected,
                found: field.values.len(),
            });
        }
        if !names.insert(field.name) {
            return Err(Error::DuplicateField {
                path: path.to_path_buf(),
                location,
                field: field.name.to_owned(),
            });
        }
    }
    Ok(())
}

fn float_array(
    name: &str,
    n_components: usize,
    component_names: &[&str],
    values: &[f64],
) -> String {
    data_array(
        name,
        "Float64",
        n_components,
        component_names,
        values,
        f64::to_le_bytes,
    )
}

fn integer_array(name: &str, values: &[i64]) -> String {
    data_array(name, "Int64", 1, &[], values, i64::to_le_bytes)
}

fn cell_arrays(cells: &[Cell]) -> [String; 3] {
    let mut connectivity = Vec::with_capacity(4 * cells.len());
    let mut offsets = Vec::with_capacity(cells.len());
    for cell in cells {
        connectivity.extend(cell.points().iter().map(|&point| i64::from(point)));
        offsets.push(connectivity.len() as i64);
    }
    let types: Vec<u8> = cells.iter().map(Cell::vtk_type).collect();
    [
        integer_array("connectivity", &connectivity),
        integer_array("offsets", &offsets),
        data_array("types", "UInt8", 1, &[], &types, u8::to_le_bytes),
    ]
}

/// The element `PointData` or `CellData`. It names the first scalar and the first vector, which readers show first; an
/// index is none of them.
fn push_fields(xml: &mut String, element: &str, fields: &[Field<'_>]) {
    let scalar = |field: &&Field<'_>| {
        matches!(
            field.values,
            FieldValues::Scalar(_) | FieldValues::Single(_)
        )
    };
    let vector = |field: &&Field<'_>| matches!(field.values, FieldValues::Vector(_));
    let arrays: Vec<String> = fields.par_iter().map(|field| field.to_xml()).collect();
    // Writing to a string cannot fail.
    let _ = write!(xml, "<{element}");
    if let Some(first) = fields.iter().find(scalar) {
        let _ = write!(xml, " Scalars=\"{}\"", escape_attribute(first.name));
    }
    if let Some(first) = fields.iter().find(vector) {
        let _ = write!(xml, " Vectors=\"{}\"", escape_attribute(first.name));
    }
    xml.push_str(">\n");
    xml.extend(arrays);
    let _ = writeln!(xml, "</{element}>");
}

/// Writes the grid to `path`, which should end in `.vtu`. The file appears complete or not at all.
pub fn write_vtu(path: impl AsRef<Path>, grid: &UnstructuredGrid<'_>) -> Result<(), Error> {
    let path = path.as_ref();
    grid.check(path)?;
    replace_file(path, grid.to_xml().as_bytes())
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
#[path = "vtu_tests.rs"]
mod tests;
