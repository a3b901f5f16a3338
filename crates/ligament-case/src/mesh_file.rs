//! Mesh files, as cases and commands name them.

use std::io;
use std::path::{Path, PathBuf};

use ligament_mesh::gmsh::{self, GmshError};
use ligament_mesh::{AnyMesh, Mesh};

use crate::input_file;

/// Why a mesh file could not be read.
#[derive(Debug, thiserror::Error)]
pub enum MeshFileError {
    /// The file could not be read.
    #[error("cannot read the mesh {}", path.display())]
    Read {
        /// The mesh file.
        path: PathBuf,
        /// The system's reason.
        source: io::Error,
    },
    /// The file is not a planar Gmsh mesh.
    #[error("cannot use the mesh {}", path.display())]
    Parse {
        /// The mesh file.
        path: PathBuf,
        /// The reader's reason.
        source: GmshError,
    },
}

/// Reads a mesh file.
///
/// # Errors
///
/// If the file cannot be read or is not a planar Gmsh mesh.
pub fn read_mesh(path: &Path) -> Result<Mesh, MeshFileError> {
    read(path, gmsh::parse)
}

/// Reads a file of a mesh in the plane or of solid cells.
///
/// # Errors
///
/// If the file cannot be read or is no Gmsh mesh of one of the two kinds.
pub fn read_any_mesh(path: &Path) -> Result<AnyMesh, MeshFileError> {
    read(path, gmsh::parse_any)
}

fn read<T>(path: &Path, parse: fn(&[u8]) -> Result<T, GmshError>) -> Result<T, MeshFileError> {
    let read = input_file::read(path);
    let bytes = read.map_err(|source| MeshFileError::Read {
        path: path.to_owned(),
        source,
    })?;
    parse(&bytes).map_err(|source| MeshFileError::Parse {
        path: path.to_owned(),
        source,
    })
}

/// Whether a file holds a mesh of solids; not if it cannot be read.
pub(crate) fn holds_solid(path: &Path) -> bool {
    input_file::read(path).is_ok_and(|bytes| gmsh::holds_solid(&bytes))
}

/// Lower left and upper right corner.
pub fn bounding_box(positions: &[[f64; 2]]) -> [[f64; 2]; 2] {
    let start = [[f64::INFINITY; 2], [f64::NEG_INFINITY; 2]];
    positions.iter().fold(start, |[low, high], [x, y]| {
        [
            [low[0].min(*x), low[1].min(*y)],
            [high[0].max(*x), high[1].max(*y)],
        ]
    })
}
