//! Gmsh mesh files, formats 2.2 (also 2.0 and 2.1) and 4.1, ASCII and binary (of either byte order).
//!
//! - A file with tetrahedra, hexahedra, prisms or pyramids gives a solid mesh; triangles and quadrangles alone give a planar one. Only the
//!   corners of cells of higher order are read. Elements of lower dimension serve the groups.
//! - A physical group has the nodes of its elements. In 4.1 an element has the groups of its entity in `$Entities`; elements without a
//!   group (`Mesh.SaveAll`) are part of the mesh as well. With `Mesh.SaveAll`, Gmsh drops the groups from files of 2.2, but for
//!   `Mesh.SaveTopology`: save 4.1 then.
//! - Nodes that no cell uses are dropped, also from the groups.
//! - `$NodeData` gives the fields of the mesh; only scalars are stored.
//! - In a planar mesh the z coordinate must be constant and is dropped; a mesh in another plane is turned into it by its [`CoordinatePlane`].
//! - Doubled nodes along a crack are read, and a remark tells it; a seam that parts the mesh into pieces is refused.
//! - Clockwise or inverted cells are reoriented. In a solid mesh a surface element in a group must be a face of a cell.
//! - A cell with a repeated corner is the cell with fewer corners that it is.
//! - Other sections are ignored, as the format says, with a remark where they say something about the body.
//!
//! Files written by the Python package meshio are read as well. Its writer of 4.1 (`gmsh`) keeps at most one physical group per entity, and
//! drops all of them where the mesh has no `gmsh:dim_tags`: such elements are in no group here, as
//! [`Remark::UndescribedEntities`](crate::Remark) reports. Its writer of 2.2 (`gmsh22`) keeps the groups.
//!
//! The program Neper adds sections: its sets of nodes (`$NSets`) and of faces (`$Fasets`) become groups by their names, and the sets of
//! cells of a group (`$Groups`) become a group such as `group-1`.

mod arrays;
mod assembly;
mod cells;
mod collapsed;
mod cursor;
mod element_type;
mod error;
mod fields;
mod groups;
mod ignored;
mod neper;
mod nodes;
mod plane;
mod records;
mod sections;
mod solid;
mod tags;
mod v2;
mod v4;
mod write;

use cursor::Cursor;
use records::Records;
use sections::{Version, read_format};

use crate::mesh::{AnyMesh, Mesh};

pub use arrays::{Element, assemble};
pub use error::GmshError;
pub use write::{write, write_any};

pub use crate::coordinate_plane::CoordinatePlane;
pub use crate::remark::FilePosition;

/// Reads the bytes of a Gmsh mesh file of a planar mesh.
///
/// # Errors
/// Returns an error if the file is damaged or not planar, with the position in the file and a remedy.
pub fn parse(bytes: &[u8]) -> Result<Mesh, GmshError> {
    parse_with(bytes, CoordinatePlane::Xy)
}

/// Reads the bytes of a Gmsh mesh file of a planar mesh like [`parse`], which lies in a given plane.
///
/// # Errors
/// Returns an error as [`parse`] does.
pub fn parse_with(bytes: &[u8], plane: CoordinatePlane) -> Result<Mesh, GmshError> {
    let mut cursor = Cursor::new(bytes);
    let records = sections::read(&mut cursor)?;
    plane::assemble(&cursor, records, plane)
}

/// Reads the bytes of a Gmsh mesh file: a solid mesh if it has a solid cell, else a planar one.
///
/// # Errors
/// Returns an error if the file is damaged, or has no solid cell and is not planar, with the position in the file and a remedy.
pub fn parse_any(bytes: &[u8]) -> Result<AnyMesh, GmshError> {
    parse_any_with(bytes, CoordinatePlane::Xy)
}

/// Reads the bytes of a Gmsh mesh file like [`parse_any`]; without solid cells it lies in a given plane.
///
/// # Errors
/// Returns an error as [`parse_any`] does, and for a solid mesh with another plane than that of x and y.
pub fn parse_any_with(bytes: &[u8], plane: CoordinatePlane) -> Result<AnyMesh, GmshError> {
    let mut cursor = Cursor::new(bytes);
    let records = sections::read(&mut cursor)?;
    match records.first_solid {
        None => plane::assemble(&cursor, records, plane).map(AnyMesh::Plane),
        Some(record) if plane != CoordinatePlane::Xy => Err(GmshError::SolidInPlane {
            place: cursor.place(record.offset),
            plane,
        }),
        Some(_) => solid::assemble(&cursor, records).map(AnyMesh::Solid),
    }
}

/// Whether a Gmsh mesh file that begins with these bytes contains volumes, i.e. a solid mesh; files of 4.1 are judged by their entities.
/// `None` where the bytes end before this is known, or cannot be read.
pub fn holds_solid(bytes: &[u8]) -> Option<bool> {
    has_volumes(&mut Cursor::new(bytes)).ok().flatten()
}

fn has_volumes(cursor: &mut Cursor<'_>) -> Result<Option<bool>, GmshError> {
    let version = read_format(cursor)?;
    let mut records = Records::default();
    while let Some(name) = cursor.begin_section()? {
        match (name, version) {
            ("Entities", Version::V4) => {
                return cursor.with_free_rows(|cursor| {
                    let mut count = || cursor.size("a number of entities");
                    let [_, _, _, volumes] = [count()?, count()?, count()?, count()?];
                    Ok(Some(volumes > 0))
                });
            }
            ("Elements", Version::V2) => v2::read_elements(cursor, &mut records)?,
            ("Elements", Version::V4) => v4::read_elements(cursor, &mut records)?,
            _ => {
                cursor.skip_section()?;
                continue;
            }
        }
        return Ok(Some(records.first_solid.is_some()));
    }
    Ok(None)
}
