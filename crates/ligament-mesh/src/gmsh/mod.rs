//! Gmsh mesh files, formats 2.2 and 4.1, ASCII and binary (of either byte order).
//!
//! - Tetrahedra, hexahedra, prisms and pyramids make a solid mesh, where there are any; triangles and quadrangles else a planar
//!   one. Of cells of higher order only the corners are taken. Elements of lower dimension serve the groups.
//! - A physical group takes the nodes of its elements. In 4.1 an element finds its groups by its
//!   entity in `$Entities`; elements without a group (`Mesh.SaveAll`) are part of the mesh all the same.
//!   With `Mesh.SaveAll`, Gmsh drops the groups from files of 2.2: save 4.1 then.
//! - Nodes that no cell uses are dropped, from the groups too.
//! - `$NodeData` makes the fields of the mesh, of which scalars are kept.
//! - In a planar mesh the z coordinate must be constant and is dropped.
//! - Cells that are clockwise, or turned inside out, are turned round. In a solid mesh a surface element in a group must be a face
//!   of a cell.
//!
//! Files by the Python package meshio are read as well. Its writer of 4.1 (`gmsh`) keeps at most one
//! physical group per entity, and drops all of them where the mesh has no `gmsh:dim_tags`: such
//! elements are in no group here, which [`Remark::UndescribedEntities`](crate::Remark) tells. Its
//! writer of 2.2 (`gmsh22`) keeps the groups.

mod arrays;
mod assembly;
mod cells;
mod cursor;
mod element_type;
mod error;
mod fields;
mod groups;
mod kind;
mod nodes;
mod plane;
mod records;
mod sections;
mod solid;
mod tags;
mod v2;
mod v4;
mod write;

pub use arrays::{Element, assemble};
pub use error::{GmshError, Place};
pub use kind::holds_solid;
pub use write::write;

use crate::any_mesh::AnyMesh;
use crate::mesh::Mesh;

/// Reads the bytes of a Gmsh mesh file of a planar mesh.
///
/// # Errors
/// Where the file is damaged or not planar, with the place and what to do.
pub fn parse(bytes: &[u8]) -> Result<Mesh, GmshError> {
    let mut cursor = cursor::Cursor::new(bytes);
    let records = sections::read(&mut cursor)?;
    plane::assemble(&cursor, &records)
}

/// Reads the bytes of a Gmsh mesh file: a solid mesh where it has a solid cell, a planar one else.
///
/// # Errors
/// Where the file is damaged, or has no solid cell and is not planar, with the place and what to do.
pub fn parse_any(bytes: &[u8]) -> Result<AnyMesh, GmshError> {
    let mut cursor = cursor::Cursor::new(bytes);
    let records = sections::read(&mut cursor)?;
    if records.first_solid.is_some() {
        solid::assemble(&cursor, &records).map(AnyMesh::Solid)
    } else {
        plane::assemble(&cursor, &records).map(AnyMesh::Plane)
    }
}
