//! Reader of mesh files for cases and commands.

use std::io::{self, Read};
use std::path::{Path, PathBuf};

use ligament_mesh::gmsh::{self, CoordinatePlane, GmshError};
use ligament_mesh::{AnyMesh, Mesh};

use crate::input_file;
use crate::point_table;

/// Error of reading a mesh file.
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
    #[error("cannot use the mesh {}{}", path.display(), by_key(source))]
    Parse {
        /// The mesh file.
        path: PathBuf,
        /// The reader's reason.
        source: GmshError,
    },
    /// The first of several processes, the only one that reads the mesh, could not use it.
    #[error("the first process could not use the mesh, and its message says why")]
    OfFirstProcess,
}

/// The key for a mesh in another plane.
fn by_key(error: &GmshError) -> String {
    match error {
        GmshError::OtherPlane { plane, .. } => {
            let word = plane.word();
            format!("; `coordinates = \"{word}\"` in [mesh] takes it as it is")
        }
        _ => String::new(),
    }
}

/// Reads a file of a mesh that lies in a plane.
///
/// # Errors
///
/// If the file cannot be read or is not a Gmsh mesh in this plane.
pub fn read_mesh(path: &Path, plane: CoordinatePlane) -> Result<Mesh, MeshFileError> {
    read(path, |bytes| gmsh::parse_with(bytes, plane))
}

/// Reads a file of a mesh in a plane or of solid cells.
///
/// # Errors
///
/// If the file cannot be read or is not a Gmsh mesh of either kind.
pub fn read_any_mesh(path: &Path, plane: CoordinatePlane) -> Result<AnyMesh, MeshFileError> {
    read(path, |bytes| gmsh::parse_any_with(bytes, plane))
}

/// Reads a file of a mesh of solid cells, or in whichever plane of two coordinates it lies, which is returned with it.
///
/// # Errors
///
/// As for [`read_any_mesh`].
pub fn read_in_own_plane(path: &Path) -> Result<(AnyMesh, CoordinatePlane), MeshFileError> {
    let usual = CoordinatePlane::Xy;
    match read_any_mesh(path, usual) {
        Err(MeshFileError::Parse {
            source: GmshError::OtherPlane { plane, .. },
            ..
        }) => Ok((read_any_mesh(path, plane)?, plane)),
        read => Ok((read?, usual)),
    }
}

fn read<T>(
    path: &Path,
    parse: impl FnOnce(&[u8]) -> Result<T, GmshError>,
) -> Result<T, MeshFileError> {
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

/// Number of bytes that determine the kind of most files.
const BEGINNING: usize = 1 << 16;

/// Whether a file has a mesh of solid cells, or points of a solid. At most twice the bytes that determine this are in memory.
///
/// # Errors
///
/// If the file cannot be read.
pub(crate) fn holds_solid(path: &Path) -> io::Result<bool> {
    let mut file = input_file::open(path)?;
    let mut bytes = Vec::new();
    loop {
        let more = bytes.len().max(BEGINNING);
        let read = file.by_ref().take(more as u64).read_to_end(&mut bytes)?;
        if read < more {
            // The last line may lack its end.
            bytes.push(b'\n');
        }
        let is_solid = match point_table::is_table(path) {
            true => point_table::holds_solid(&bytes),
            false => gmsh::holds_solid(&bytes),
        };
        if is_solid.is_some() || read < more {
            return Ok(is_solid.unwrap_or(false));
        }
    }
}

/// The lowest and the highest corner of the box around positions, m.
pub fn bounding_box<const D: usize>(positions: &[[f64; D]]) -> [[f64; D]; 2] {
    let start = [[f64::INFINITY; D], [f64::NEG_INFINITY; D]];
    positions.iter().fold(start, |[low, high], position| {
        [
            std::array::from_fn(|axis| low[axis].min(position[axis])),
            std::array::from_fn(|axis| high[axis].max(position[axis])),
        ]
    })
}
