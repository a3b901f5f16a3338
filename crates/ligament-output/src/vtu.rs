//! VTU files: fields on the points and cells of an unstructured grid.
//!
//! The files are binary, compressed by zlib and little-endian. Integers are `Int64`, which VTK, PyVista and meshio read
//! exactly. The format is VTK XML, version 1.0 (<https://vtk.org/Wiki/VTK_XML_Formats>).

mod field;
mod pieces;
pub mod read;

use std::collections::HashSet;
use std::fmt::Write as _;
use std::path::Path;

use ligament_mesh::SolidCell;
use rayon::prelude::*;

use crate::replace_file;
use crate::xml::escape_attribute;
use crate::{Error, FieldLocation};

pub use field::Field;
pub(crate) use field::SelectedValues;
pub use pieces::{
    FILE_EXTENSION, GlobalIndices, PIECES_EXTENSION, SharedCells, file_name, stem, write_shared,
};

/// Name of the time in the field data of a grid, which VTK recognises.
pub const TIME_VALUE: &str = "TimeValue";

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

/// A grid with its fields.
#[derive(Debug, Clone, Copy)]
pub struct UnstructuredGrid<'a> {
    /// Reference positions, m; z = 0 in a planar grid.
    pub points: &'a [[f64; 3]],
    /// Cells on these points, of mixed types.
    pub cells: &'a [Cell],
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
        for (cell, points) in self.cells.iter().map(Cell::points).enumerate() {
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

    /// The document, independent of the number of threads, which share arrays and blocks of fixed size.
    fn to_xml(self) -> String {
        let mut xml = format!(
            "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n\
             <VTKFile type=\"UnstructuredGrid\" version=\"1.0\" byte_order=\"LittleEndian\" header_type=\"UInt64\" \
             compressor=\"vtkZLibDataCompressor\">\n<UnstructuredGrid>\n\
             {}<Piece NumberOfPoints=\"{}\" NumberOfCells=\"{}\">\n",
            field_data_xml(self.field_data),
            self.points.len(),
            self.cells.len()
        );
        push_fields(&mut xml, "PointData", self.point_fields, |it| it.to_xml());
        push_fields(&mut xml, "CellData", self.cell_fields, |it| it.to_xml());
        xml.push_str("<Points>\n");
        xml.push_str(&Field::vector("Points", self.points).to_xml());
        xml.push_str("</Points>\n<Cells>\n");
        xml.extend(cell_arrays(self.cells));
        xml.push_str("</Cells>\n</Piece>\n</UnstructuredGrid>\n</VTKFile>\n");
        xml
    }
}

/// The element `FieldData` of some numbers; empty without any.
fn field_data_xml(numbers: &[(&str, f64)]) -> String {
    if numbers.is_empty() {
        return String::new();
    }
    let array = |(name, number): &(&str, f64)| {
        let array = Field::scalar(name, std::slice::from_ref(number)).to_xml();
        // Other arrays have the number of the points or cells.
        array.replacen("<DataArray", "<DataArray NumberOfTuples=\"1\"", 1)
    };
    let arrays: String = numbers.iter().map(array).collect();
    format!("<FieldData>\n{arrays}</FieldData>\n")
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
        Field::integer("connectivity", &connectivity),
        Field::integer("offsets", &offsets),
        Field::bytes("types", &types),
    ]
    .map(Field::to_xml)
}

/// Appends the element `PointData` or `CellData`, or its outline for all pieces of a grid, naming the first scalar and the first vector,
/// which readers show first.
fn push_fields(
    xml: &mut String,
    element: &str,
    fields: &[Field<'_>],
    array: fn(&Field<'_>) -> String,
) {
    let arrays: Vec<String> = fields.par_iter().map(array).collect();
    // Writing to a string cannot fail.
    let _ = write!(xml, "<{element}");
    if let Some(first) = fields.iter().find(|field| field.is_scalar()) {
        let _ = write!(xml, " Scalars=\"{}\"", escape_attribute(first.name));
    }
    if let Some(first) = fields.iter().find(|field| field.is_vector()) {
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
