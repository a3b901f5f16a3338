//! Meshes of geometries by the external program gmsh.

use std::collections::BTreeSet;
use std::io;
use std::path::PathBuf;
use std::process::{Command, Output, Stdio};

use ligament_mesh::Mesh;
use ligament_mesh::gmsh::{self, GmshError};

use super::{Unfinished, indented, is_same_file};
use ligament::suggestion::hint;

/// A mesh to be made.
#[derive(Debug, Clone, PartialEq)]
pub struct MeshRequest {
    /// The geometry, a Gmsh .geo file.
    pub geometry: PathBuf,
    /// The mesh file to write.
    pub out: PathBuf,
    /// The program gmsh: a path, or a name to be found on the PATH.
    pub gmsh: PathBuf,
    /// Numbers of the geometry to be set.
    pub numbers: Vec<(String, f64)>,
}

/// Why no mesh was made. An existing mesh is then as it was.
#[derive(Debug, thiserror::Error)]
pub enum MeshingError {
    /// The file is no geometry, by its ending.
    #[error(
        "{} is no .geo file: `ligament mesh` meshes geometries of Gmsh; a mesh of another program is \
         converted by `ligament mesh --via-meshio {}`",
        .0.display(), .0.display()
    )]
    NoGeo(PathBuf),
    /// There is no such geometry.
    #[error("there is no geometry {}", .0.display())]
    NoGeometry(PathBuf),
    /// The geometry could not be read.
    #[error("cannot read the geometry {}", geometry.display())]
    Read {
        /// The geometry.
        geometry: PathBuf,
        /// The system's reason.
        source: io::Error,
    },
    /// A number is to be set that the geometry does not use.
    #[error(
        "--set {name}=...: {} does not mention `{name}`{}",
        geometry.display(), hint(name, declared, "it declares", '`')
    )]
    UnusedNumber {
        /// The geometry.
        geometry: PathBuf,
        /// The name that was to be set.
        name: String,
        /// The names that the geometry declares by `DefineConstant`.
        declared: Vec<String>,
    },
    /// The mesh would replace its own geometry.
    #[error("--out {} is the geometry itself", .0.display())]
    WouldReplaceGeometry(PathBuf),
    /// The program could not be found.
    #[error(
        "cannot find the program `{}`; install it (`pip install gmsh`, `apt install gmsh`, or from \
         https://gmsh.info), or say where it is by --gmsh PATH",
        .0.display()
    )]
    NoGmsh(PathBuf),
    /// The program could not be started.
    #[error("cannot start `{}`", gmsh.display())]
    Start {
        /// The program.
        gmsh: PathBuf,
        /// The system's reason.
        source: io::Error,
    },
    /// The program reported errors or made no mesh.
    #[error("gmsh could not mesh {}{}", geometry.display(), indented(lines))]
    Gmsh {
        /// The geometry.
        geometry: PathBuf,
        /// What gmsh said.
        lines: Vec<String>,
    },
    /// The program's mesh cannot be read.
    #[error("gmsh made a mesh of {} that cannot be used", geometry.display())]
    Unusable {
        /// The geometry.
        geometry: PathBuf,
        /// The reader's reason.
        source: GmshError,
    },
    /// The mesh could not be put in its place.
    #[error("cannot write {}", path.display())]
    Write {
        /// The mesh file.
        path: PathBuf,
        /// The system's reason.
        source: io::Error,
    },
}

/// Calls gmsh and returns the mesh it wrote to `request.out`.
///
/// The mesh is made next to its place and put there only once it could be read, so a failure never
/// damages an existing one.
///
/// # Errors
///
/// If gmsh is missing or fails, or its mesh cannot be used or put in place.
pub fn make_mesh(request: &MeshRequest) -> Result<Mesh, MeshingError> {
    let MeshRequest { geometry, out, .. } = request;
    if !geometry.is_file() {
        return Err(MeshingError::NoGeometry(geometry.clone()));
    }
    let is_geo = |end: &std::ffi::OsStr| end.eq_ignore_ascii_case("geo");
    if !geometry.extension().is_some_and(is_geo) {
        return Err(MeshingError::NoGeo(geometry.clone()));
    }
    if is_same_file(geometry, out) {
        return Err(MeshingError::WouldReplaceGeometry(out.clone()));
    }
    check_numbers(request)?;
    let write_error = |source| MeshingError::Write {
        path: out.clone(),
        source,
    };
    let unfinished = Unfinished::beside(out).map_err(write_error)?;
    let output = call_gmsh(request, unfinished.path())?;
    let complaints = complaints(&output);
    if !output.status.success() || !complaints.is_empty() || !unfinished.path().is_file() {
        let lines = if complaints.is_empty() {
            last_words(&output)
        } else {
            complaints
        };
        return Err(MeshingError::Gmsh {
            geometry: geometry.clone(),
            lines,
        });
    }
    let bytes = std::fs::read(unfinished.path()).map_err(write_error)?;
    let mesh = gmsh::parse(&bytes).map_err(|source| MeshingError::Unusable {
        geometry: geometry.clone(),
        source,
    })?;
    unfinished.put_at(out).map_err(write_error)?;
    Ok(mesh)
}

/// Gmsh says nothing of a number that is not used, so a misspelt one would go unnoticed.
fn check_numbers(request: &MeshRequest) -> Result<(), MeshingError> {
    let MeshRequest {
        geometry, numbers, ..
    } = request;
    let bytes = std::fs::read(geometry).map_err(|source| MeshingError::Read {
        geometry: geometry.clone(),
        source,
    })?;
    let text = String::from_utf8_lossy(&bytes);
    let words: BTreeSet<&str> = text.split(|character| !is_word(character)).collect();
    if words.contains("Include") || words.contains("Merge") {
        return Ok(());
    }
    // Names with other characters are options and parameters of gmsh itself: Mesh.MeshSizeFactor.
    let unused = |name: &&String| name.chars().all(is_word) && !words.contains(name.as_str());
    match numbers.iter().map(|(name, _)| name).find(unused) {
        None => Ok(()),
        Some(name) => Err(MeshingError::UnusedNumber {
            geometry: geometry.clone(),
            name: name.clone(),
            declared: declared_constants(&text),
        }),
    }
}

fn is_word(character: char) -> bool {
    character.is_alphanumeric() || character == '_'
}

/// The names before `=` in every `DefineConstant[ ... ]`.
fn declared_constants(geometry: &str) -> Vec<String> {
    let blocks = geometry.split("DefineConstant").skip(1);
    let inside = blocks.filter_map(|block| block.split_once('[')?.1.split_once(']'));
    let names = inside.flat_map(|(declarations, _)| {
        let (before_equals, _) = declarations.rsplit_once('=').unwrap_or_default();
        before_equals
            .split('=')
            .filter_map(|part| part.trim_end().rsplit(|c| !is_word(c)).next())
    });
    names
        .filter(|name| !name.is_empty())
        .map(str::to_owned)
        .collect()
}

fn call_gmsh(request: &MeshRequest, out: &std::path::Path) -> Result<Output, MeshingError> {
    let MeshRequest {
        geometry,
        gmsh,
        numbers,
        ..
    } = request;
    let mut command = Command::new(gmsh);
    command
        .arg("-2")
        .arg(geometry)
        .arg("-o")
        .arg(out)
        .args(["-format", "msh41"]);
    for (name, value) in numbers {
        command.arg("-setnumber").arg(name).arg(value.to_string());
    }
    command
        .stdin(Stdio::null())
        .output()
        .map_err(|source| match source.kind() {
            io::ErrorKind::NotFound => MeshingError::NoGmsh(gmsh.clone()),
            _ => MeshingError::Start {
                gmsh: gmsh.clone(),
                source,
            },
        })
}

fn lines(output: &Output) -> Vec<String> {
    let text = |bytes| String::from_utf8_lossy(bytes).into_owned();
    let both = text(&output.stdout) + "\n" + &text(&output.stderr);
    both.lines()
        .map(str::trim_end)
        .filter(|line| !line.is_empty())
        .map(str::to_owned)
        .collect()
}

/// The lines in which gmsh reports errors; it may do so and still exit with success.
fn complaints(output: &Output) -> Vec<String> {
    lines(output)
        .into_iter()
        .filter(|line| line.trim_start().starts_with("Error"))
        .collect()
}

/// The end of what gmsh said, where it failed without an error line.
fn last_words(output: &Output) -> Vec<String> {
    let mut lines = lines(output);
    let last = lines.split_off(lines.len().saturating_sub(5));
    if last.is_empty() {
        vec![format!("gmsh said nothing ({})", output.status)]
    } else {
        last
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn declared_constants_are_found_in_all_their_forms() {
        let text = "DefineConstant[ size = 0.004 ]; // mesh size\nx = 3;\n\
            DefineConstant[ a = {1, Min 0, Name \"Geometry/a\"}, b=2 ];";
        assert_eq!(declared_constants(text), ["size", "a", "b"]);
        assert!(declared_constants("Point(1) = {0, 0, 0};").is_empty());
    }
}
