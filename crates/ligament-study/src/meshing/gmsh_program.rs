//! Meshes of geometries by the external program gmsh.

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

use ligament_mesh::AnyMesh;
use ligament_mesh::gmsh;
use ligament_output::{check_file, write_file};

use super::error::{MeshingError, Refusal};
use super::{UnfinishedMesh, is_same_file, last_lines, output_of};

/// Request for a mesh.
#[derive(Debug, Clone, PartialEq)]
pub struct MeshRequest {
    /// The geometry, a Gmsh .geo file.
    pub geometry: PathBuf,
    /// The mesh file to write.
    pub out: PathBuf,
    /// Whether an existing file may be replaced.
    pub force: bool,
    /// Program gmsh: a path, or a name on the PATH.
    pub gmsh: PathBuf,
    /// Numbers of the geometry to be set, by name.
    pub numbers: Vec<(String, f64)>,
}

/// Advice where gmsh is missing.
const REMEDY: &str = "install it (`pip install gmsh`, `apt install gmsh`, or from https://gmsh.info), or say where it is by \
                      --gmsh PATH";

/// Runs gmsh and returns the mesh written to `request.out`.
///
/// The mesh is written to a temporary file and renamed only after it could be read, so a failure never damages an existing mesh.
///
/// # Errors
///
/// If gmsh is missing or fails, or its mesh cannot be used or written.
pub fn make_mesh(request: &MeshRequest) -> Result<AnyMesh, MeshingError> {
    let MeshRequest { geometry, out, .. } = request;
    if !geometry.is_file() {
        let (what, path) = ("geometry", geometry.clone());
        return Err(MeshingError::NoSource { what, path });
    }
    let is_geo = |end: &std::ffi::OsStr| end.eq_ignore_ascii_case("geo");
    if !geometry.extension().is_some_and(is_geo) {
        return Err(MeshingError::NoGeo(geometry.clone()));
    }
    if is_same_file(geometry, out) {
        let (what, path) = ("geometry itself", out.clone());
        return Err(MeshingError::WouldReplaceSource { what, path });
    }
    check_file(out, request.force)?;
    check_numbers(request)?;
    let write_error = |source| MeshingError::File {
        action: "write",
        path: out.clone(),
        source,
    };
    let unfinished = UnfinishedMesh::beside(out).map_err(write_error)?;
    let output = call_gmsh(request, unfinished.path())?;
    let complaints = complaints(&output);
    if !output.status.success() || !complaints.is_empty() || !unfinished.path().is_file() {
        return Err(MeshingError::Refused {
            refusal: Refusal::NotMeshed,
            path: geometry.clone(),
            lines: match complaints.is_empty() {
                true => last_lines(lines(&output), "gmsh", &output),
                false => complaints,
            },
        });
    }
    let bytes = std::fs::read(unfinished.path()).map_err(write_error)?;
    let mesh = gmsh::parse_any(&bytes).map_err(|source| MeshingError::Unusable {
        geometry: geometry.clone(),
        source,
    })?;
    write_file(out, &bytes, request.force)?;
    Ok(mesh)
}

/// Refuses numbers that the geometry does not use, which gmsh ignores without a message.
fn check_numbers(request: &MeshRequest) -> Result<(), MeshingError> {
    let MeshRequest {
        geometry, numbers, ..
    } = request;
    let bytes = std::fs::read(geometry).map_err(|source| MeshingError::File {
        action: "read the geometry",
        path: geometry.clone(),
        source,
    })?;
    let text = String::from_utf8_lossy(&bytes);
    let words: BTreeSet<&str> = text.split(|character| !is_word(character)).collect();
    if words.contains("Include") || words.contains("Merge") {
        return Ok(());
    }
    // Names with other characters are options of gmsh, such as Mesh.MeshSizeFactor.
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

fn call_gmsh(request: &MeshRequest, out: &Path) -> Result<Output, MeshingError> {
    let mut command = Command::new(&request.gmsh);
    let [geometry, out] = [request.geometry.as_path(), out].map(operand);
    command.arg("-3").arg(geometry).arg("-o").arg(out);
    command.args(["-format", "msh41"]);
    for (name, value) in &request.numbers {
        command.args(["-setnumber", name, &value.to_string()]);
    }
    output_of(&mut command, REMEDY)
}

/// A path in a form that gmsh does not read as an option.
fn operand(path: &Path) -> PathBuf {
    match path.as_os_str().as_encoded_bytes().first() {
        Some(b'-') => Path::new(".").join(path),
        _ => path.to_owned(),
    }
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

/// The lines in which gmsh reports errors, possibly with a successful exit status.
fn complaints(output: &Output) -> Vec<String> {
    lines(output)
        .into_iter()
        .filter(|line| line.trim_start().starts_with("Error"))
        .collect()
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
