//! `ligament mesh`: meshes made or converted by other programs.
//!
//! | module | makes a mesh of |
//! |---|---|
//! | [`cad`] | a CAD file, by the program gmsh |
//! | [`gmsh_program`] | a geometry, by the program gmsh |
//! | [`input_deck`] | an input deck of Abaqus or CalculiX, or another mesh of Gmsh, by the program itself |
//! | [`via_meshio`] | a mesh in another format, by the Python package meshio |

use std::ffi::OsString;
use std::io;
use std::path::{Path, PathBuf};
use std::process::{Command, Output, Stdio};

use ligament_mesh::gmsh::CoordinatePlane;
use ligament_output::{is_stream, remove_if_there};

pub mod cad;
mod error;
pub mod gmsh_program;
pub mod input_deck;
pub mod via_meshio;

pub use error::{MeshingError, Refusal};

/// Conversion of the coordinates of a source to coordinates of the mesh.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Coordinates {
    /// Plane in which a source without solid cells lies; from another one than that of x and y the mesh is turned.
    pub plane: CoordinatePlane,
    /// Factor on the coordinates.
    pub scale: f64,
}

impl Default for Coordinates {
    fn default() -> Self {
        Self {
            plane: CoordinatePlane::Xy,
            scale: 1.0,
        }
    }
}

/// Number of last lines of a program in an error.
const LAST_LINES: usize = 5;

/// Whether the name of a file has an ending, in small or capital letters.
fn ends_in(path: &Path, ending: &str) -> bool {
    path.extension()
        .is_some_and(|it| it.eq_ignore_ascii_case(ending))
}

/// Whether two paths are the same existing file.
fn is_same_file(a: &Path, b: &Path) -> bool {
    match (a.canonicalize(), b.canonicalize()) {
        (Ok(a), Ok(b)) => a == b,
        _ => false,
    }
}

/// Runs a program and returns its output; `remedy` is the advice where it cannot be found.
fn output_of(command: &mut Command, remedy: &'static str) -> Result<Output, MeshingError> {
    let output = command.stdin(Stdio::null()).output();
    output.map_err(|source| {
        let program = PathBuf::from(command.get_program());
        match source.kind() {
            io::ErrorKind::NotFound => MeshingError::NoProgram { program, remedy },
            _ => MeshingError::Start { program, source },
        }
    })
}

/// Last lines of a program's output; `who` names the program.
fn last_lines(mut lines: Vec<String>, who: &str, output: &Output) -> Vec<String> {
    let last = lines.split_off(lines.len().saturating_sub(LAST_LINES));
    if last.is_empty() {
        vec![format!("{who} said nothing ({})", output.status)]
    } else {
        last
    }
}

/// Creates the folder of a file, if needed.
fn make_folder_of(file: &Path) -> io::Result<()> {
    file.parent().map_or(Ok(()), std::fs::create_dir_all)
}

/// An unfinished mesh or a script for it: a hidden file beside the final path of the mesh, removed at the end.
struct UnfinishedMesh(PathBuf);

impl UnfinishedMesh {
    /// A path in the folder of `out`, created if needed, with a name unique to this process and an ending. For a pipe or a device the path is in the
    /// system's folder of temporary files.
    fn beside(out: &Path, ending: &str) -> io::Result<Self> {
        let aside = std::env::temp_dir().join("mesh");
        let out = if is_stream(out) { &aside } else { out };
        make_folder_of(out)?;
        let mut name = OsString::from(".");
        name.push(out.file_stem().unwrap_or_default());
        name.push(format!("-unfinished-{}.{ending}", std::process::id()));
        let path = out.with_file_name(name);
        // A link at the path is removed, so that its target is not written.
        remove_if_there(&path)?;
        Ok(Self(path))
    }

    fn path(&self) -> &Path {
        &self.0
    }
}

impl Drop for UnfinishedMesh {
    fn drop(&mut self) {
        // The file may not exist if the program did not write it.
        let _ = std::fs::remove_file(&self.0);
    }
}
