//! VTU files: fields on the points and cells of an unstructured grid.
//!
//! The files are binary, compressed by zlib and little-endian. Integers are `Int64`, which VTK, PyVista and meshio read
//! exactly. The format is VTK XML, version 1.0 (<https://vtk.org/Wiki/VTK_XML_Formats>).

mod field;
mod pieces;
pub mod read;

use std::collections::HashSet;
use std::io::{self, Write};
use std::path::Path;

use ligament_mesh::SolidCell;
use ligament_model::parallel;

use crate::single_file::replace_file_with;
use crate::xml::escape_attribute;
use crate::{Error, FieldLocation};

use field::Array;
pub use field::Field;
pub(crate) use field::SelectedValues;
pub use pieces::{
    FILE_EXTENSION, GlobalIndices, PIECES_EXTENSION, SharedCells, file_name, stem, write_shared,
};

/// Name of the time in the field data of a grid, which VTK recognises.
pub const TIME_VALUE: &str = "TimeValue";

/// Number of values from which on an array is compressed and written by itself, so that only one is in memory.
const LARGE: usize = 1 << 18;

/// A cell given by its points, indices from 0.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Cell {
    /// A single point.
    Vertex([u32; 1]),
    /// A segment, such as a bond.
    Line([u32; 2]),
    /// A triangle by its three points.
    Triangle([u32; 3]),
    /// A quadrangle, with corners in order around the cell.
    Quad([u32; 4]),
    /// A tetrahedron, hexahedron, prism or pyramid with corners in the order of Gmsh, for which VTK finds a positive volume. For prisms
    /// VTK's documentation differs, and meshio reverses both triangles.
    Solid(SolidCell),
}

impl From<ligament_mesh::Cell> for Cell {
    fn from(cell: ligament_mesh::Cell) -> Self {
        match cell {
            ligament_mesh::Cell::Triangle(points) => Self::Triangle(points),
            ligament_mesh::Cell::Quadrangle(points) => Self::Quad(points),
        }
    }
}

impl From<SolidCell> for Cell {
    fn from(cell: SolidCell) -> Self {
        Self::Solid(cell)
    }
}

impl Cell {
    /// The cell of a body in the plane; `None` for other kinds of cells.
    pub fn planar(&self) -> Option<ligament_mesh::Cell> {
        match *self {
            Self::Triangle(points) => Some(ligament_mesh::Cell::Triangle(points)),
            Self::Quad(points) => Some(ligament_mesh::Cell::Quadrangle(points)),
            Self::Vertex(_) | Self::Line(_) | Self::Solid(_) => None,
        }
    }

    /// The points of the cell.
    pub fn points(&self) -> &[u32] {
        match self {
            Self::Vertex(points) => points,
            Self::Line(points) => points,
            Self::Triangle(points) => points,
            Self::Quad(points) => points,
            Self::Solid(cell) => cell.corners(),
        }
    }

    /// The cell with its points renumbered.
    fn renumbered(self, number: impl Fn(u32) -> u32) -> Self {
        use SolidCell::{Hexahedron, Prism, Pyramid, Tetrahedron};
        match self {
            Self::Vertex(points) => Self::Vertex(points.map(number)),
            Self::Line(points) => Self::Line(points.map(number)),
            Self::Triangle(points) => Self::Triangle(points.map(number)),
            Self::Quad(points) => Self::Quad(points.map(number)),
            Self::Solid(cell) => Self::Solid(match cell {
                Tetrahedron(points) => Tetrahedron(points.map(number)),
                Hexahedron(points) => Hexahedron(points.map(number)),
                Prism(points) => Prism(points.map(number)),
                Pyramid(points) => Pyramid(points.map(number)),
            }),
        }
    }

    /// The cell of a type in `vtkCellType.h`; `None` for other types, or another number of points.
    fn from_vtk(vtk_type: u8, points: &[u32]) -> Option<Self> {
        use SolidCell::{Hexahedron, Prism, Pyramid, Tetrahedron};
        match vtk_type {
            1 => points.try_into().ok().map(Self::Vertex),
            3 => points.try_into().ok().map(Self::Line),
            5 => points.try_into().ok().map(Self::Triangle),
            9 => points.try_into().ok().map(Self::Quad),
            10 => points.try_into().ok().map(Tetrahedron).map(Self::Solid),
            12 => points.try_into().ok().map(Hexahedron).map(Self::Solid),
            13 => points.try_into().ok().map(Prism).map(Self::Solid),
            14 => points.try_into().ok().map(Pyramid).map(Self::Solid),
            _ => None,
        }
    }

    /// The cell's type in `vtkCellType.h`.
    fn vtk_type(&self) -> u8 {
        match self {
            Self::Vertex(_) => 1,
            Self::Line(_) => 3,
            Self::Triangle(_) => 5,
            Self::Quad(_) => 9,
            Self::Solid(SolidCell::Tetrahedron(_)) => 10,
            Self::Solid(SolidCell::Hexahedron(_)) => 12,
            Self::Solid(SolidCell::Prism(_)) => 13,
            Self::Solid(SolidCell::Pyramid(_)) => 14,
        }
    }
}

/// The cells of a grid.
#[derive(Debug, Clone, Copy)]
pub enum Cells<'a> {
    /// Cells of mixed types.
    Mixed(&'a [Cell]),
    /// Segments by their ends.
    Lines(&'a [[u32; 2]]),
}

impl<'a> Cells<'a> {
    fn len(self) -> usize {
        match self {
            Self::Mixed(cells) => cells.len(),
            Self::Lines(lines) => lines.len(),
        }
    }

    fn get(self, number: usize) -> Cell {
        match self {
            Self::Mixed(cells) => cells[number],
            Self::Lines(lines) => Cell::Line(lines[number]),
        }
    }

    /// The points of a cell.
    fn points(self, number: usize) -> &'a [u32] {
        match self {
            Self::Mixed(cells) => cells[number].points(),
            Self::Lines(lines) => &lines[number],
        }
    }
}

/// A grid with its fields.
#[derive(Debug, Clone, Copy)]
pub struct UnstructuredGrid<'a> {
    /// Reference positions, m; z = 0 in a planar grid.
    pub points: &'a [[f64; 3]],
    /// Cells on these points.
    pub cells: Cells<'a>,
    /// Fields on the points. ParaView colours by the first scalar and warps by the first vector.
    pub point_fields: &'a [Field<'a>],
    /// Fields on the cells.
    pub cell_fields: &'a [Field<'a>],
    /// Numbers of the whole grid with their names, such as its time.
    pub field_data: &'a [(&'a str, f64)],
}

impl UnstructuredGrid<'_> {
    fn check(&self, path: &Path) -> Result<(), Error> {
        let (n_points, n_cells) = (self.points.len(), self.cells.len());
        let refused = |reason: String| {
            let path = path.to_path_buf();
            Err(Error::Refused { path, reason })
        };
        if n_points == 0 || n_cells == 0 {
            return refused(format!(
                "a VTU file needs points and cells, got {n_points} points and {n_cells} cells; write no file instead"
            ));
        }
        for cell in 0..n_cells {
            let points = self.cells.points(cell);
            if let Some(&point) = points.iter().find(|&&point| point as usize >= n_points) {
                return refused(format!(
                    "cell {cell} names point {point}, but there are only {n_points} points (counted from 0)"
                ));
            }
        }
        for (location, fields, expected) in [
            (FieldLocation::Point, self.point_fields, n_points),
            (FieldLocation::Cell, self.cell_fields, n_cells),
        ] {
            let mut names = HashSet::new();
            for field in fields {
                let (name, found) = (field.name, field.len());
                if found != expected {
                    return refused(format!(
                        "{location} field '{name}' has {found} values, expected {expected}, one per {location}"
                    ));
                }
                // Readers would keep only one of two fields of the same name.
                if !names.insert(name) {
                    return refused(format!(
                        "two {location} fields are named '{name}'; give each its own name"
                    ));
                }
            }
        }
        Ok(())
    }

    /// Appends the document, independent of the number of threads, which share arrays and blocks of fixed size.
    fn write(self, out: &mut dyn Write) -> io::Result<()> {
        write!(
            out,
            "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n\
             <VTKFile type=\"UnstructuredGrid\" version=\"1.0\" byte_order=\"LittleEndian\" header_type=\"UInt64\" \
             compressor=\"vtkZLibDataCompressor\">\n<UnstructuredGrid>\n"
        )?;
        write_field_data(self.field_data, out)?;
        let (n_points, n_cells) = (self.points.len(), self.cells.len());
        writeln!(
            out,
            "<Piece NumberOfPoints=\"{n_points}\" NumberOfCells=\"{n_cells}\">"
        )?;
        // Arrays of a large grid are in memory one at a time.
        let together = LARGE / n_cells.max(n_points) + 1;
        for (element, fields) in [
            ("PointData", self.point_fields),
            ("CellData", self.cell_fields),
        ] {
            out.write_all(opening(element, fields).as_bytes())?;
            for fields in fields.chunks(together) {
                let arrays: Vec<Array> = parallel::map(fields, Field::array);
                arrays.iter().try_for_each(|it| it.write(out))?;
            }
            writeln!(out, "</{element}>")?;
        }
        out.write_all(b"<Points>\n")?;
        Field::vector("Points", self.points).array().write(out)?;
        out.write_all(b"</Points>\n<Cells>\n")?;
        write_cells(self.cells, out)?;
        out.write_all(b"</Cells>\n</Piece>\n</UnstructuredGrid>\n</VTKFile>\n")
    }
}

/// Appends the element `FieldData` of some numbers; nothing without any.
fn write_field_data(numbers: &[(&str, f64)], out: &mut dyn Write) -> io::Result<()> {
    if numbers.is_empty() {
        return Ok(());
    }
    out.write_all(b"<FieldData>\n")?;
    for (name, number) in numbers {
        let array = Field::scalar(name, std::slice::from_ref(number)).array();
        // Other arrays have the number of the points or cells.
        array.with_attribute("NumberOfTuples", 1).write(out)?;
    }
    out.write_all(b"</FieldData>\n")
}

/// Appends the arrays of cells, one after the other, which is the less memory.
fn write_cells(cells: Cells<'_>, out: &mut dyn Write) -> io::Result<()> {
    let numbers = 0..cells.len();
    let ends = numbers.clone().scan(0, |end, cell| {
        *end += cells.points(cell).len();
        Some(*end as i64)
    });
    let offsets: Vec<i64> = ends.collect();
    let points = numbers.clone().flat_map(|cell| cells.points(cell));
    let mut connectivity = Vec::with_capacity(offsets.last().map_or(0, |end| *end as usize));
    connectivity.extend(points.map(|&point| i64::from(point)));
    Field::integer("connectivity", &connectivity)
        .array()
        .write(out)?;
    drop(connectivity);
    Field::integer("offsets", &offsets).array().write(out)?;
    let types: Vec<u8> = numbers.map(|cell| cells.get(cell).vtk_type()).collect();
    Field::bytes("types", &types).array().write(out)
}

/// The start tag of `PointData` or `CellData`, or of their outline for all pieces of a grid, with the names of the first scalar and the first
/// vector, which readers show first.
fn opening(element: &str, fields: &[Field<'_>]) -> String {
    let named = |kind: &str, first: Option<&Field<'_>>| {
        first.map_or_else(String::new, |it| {
            format!(" {kind}=\"{}\"", escape_attribute(it.name))
        })
    };
    let scalar = named("Scalars", fields.iter().find(|it| it.is_scalar()));
    let vector = named("Vectors", fields.iter().find(|it| it.is_vector()));
    format!("<{element}{scalar}{vector}>\n")
}

/// Writes the grid to `path`, which should end in `.vtu`. The file appears complete or not at all.
pub fn write_vtu(path: impl AsRef<Path>, grid: &UnstructuredGrid<'_>) -> Result<(), Error> {
    let path = path.as_ref();
    grid.check(path)?;
    replace_file_with(path, |out| grid.write(out))
}
