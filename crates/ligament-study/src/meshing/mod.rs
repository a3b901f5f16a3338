//! `ligament mesh`: meshes from other programs.
//!
//! | module | makes a mesh of |
//! |---|---|
//! | [`gmsh_program`] | a geometry, by the program gmsh |
//! | [`via_meshio`] | a mesh in another format, by the Python package meshio |

use std::ffi::OsString;
use std::io;
use std::path::{Path, PathBuf};
use std::process::{Command, Output, Stdio};

use ligament_output::{is_stream, remove_if_there};

mod error;
pub mod gmsh_program;
pub mod via_meshio;

pub use error::{MeshingError, Refusal};

/// Last lines of a program that an error repeats.
const LAST_LINES: usize = 5;

/// Whether two paths lead to one file; a path that leads nowhere is none.
fn is_same_file(a: &Path, b: &Path) -> bool {
    match (a.canonicalize(), b.canonicalize()) {
        (Ok(a), Ok(b)) => a == b,
        _ => false,
    }
}

/// What a program puts out; `remedy` says what to do where it cannot be found.
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

/// The end of what a program, in a word `who`, has put out in lines.
fn last_lines(mut lines: Vec<String>, who: &str, output: &Output) -> Vec<String> {
    let last = lines.split_off(lines.len().saturating_sub(LAST_LINES));
    if last.is_empty() {
        vec![format!("{who} said nothing ({})", output.status)]
    } else {
        last
    }
}

/// Makes the folder of a file, if need be.
fn make_folder_of(file: &Path) -> io::Result<()> {
    file.parent().map_or(Ok(()), std::fs::create_dir_all)
}

/// A mesh in the making: a hidden file beside its place, removed at the end.
struct Unfinished(PathBuf);

impl Unfinished {
    /// A name in the folder of `out`, which is made if need be, unique to this process. Beside a pipe or a device nothing is made: a
    /// mesh for it has a name among the system's temporary files.
    fn beside(out: &Path) -> io::Result<Self> {
        let aside = std::env::temp_dir().join("mesh");
        let out = if is_stream(out) { &aside } else { out };
        make_folder_of(out)?;
        let mut name = OsString::from(".");
        name.push(out.file_stem().unwrap_or_default());
        name.push(format!("-unfinished-{}.msh", std::process::id()));
        let path = out.with_file_name(name);
        // What is written there goes to no file that a link in its place leads to.
        remove_if_there(&path)?;
        Ok(Self(path))
    }

    fn path(&self) -> &Path {
        &self.0
    }
}

impl Drop for Unfinished {
    fn drop(&mut self) {
        // What the program called did not write is not there to be removed.
        let _ = std::fs::remove_file(&self.0);
    }
}
