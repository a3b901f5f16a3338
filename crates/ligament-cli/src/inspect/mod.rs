//! `ligament inspect`: summary of a mesh.

mod plane;
mod solid;
mod words;

use std::io::{self, Write};
use std::path::Path;

use ligament_mesh::AnyMesh;

/// Writes a summary of a mesh under the heading `path`.
///
/// # Errors
///
/// If `out` cannot be written to.
pub fn write_summary(out: &mut dyn Write, path: &Path, mesh: &AnyMesh) -> io::Result<()> {
    writeln!(out, "{}", path.display())?;
    match mesh {
        AnyMesh::Plane(mesh) => plane::write(out, mesh),
        AnyMesh::Solid(mesh) => solid::write(out, mesh),
    }
}
