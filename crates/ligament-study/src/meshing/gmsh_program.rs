//! Meshes of geometries by the external program gmsh.

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

use ligament_mesh::AnyMesh;
use ligament_mesh::gmsh;
use ligament_output::{check_file, write_file};

use super::error::{MeshingError, Refusal};
use super::via_meshio::write_converted;
use super::{Coordinates, UnfinishedMesh, cad, is_same_file, last_lines, output_of};

/// Request for a mesh.
#[derive(Debug, Clone, PartialEq)]
pub struct MeshRequest {
    /// The geometry, a Gmsh .geo file or a CAD file.
    pub geometry: PathBuf,
    /// The mesh file to write.
    pub out: PathBuf,
    /// Whether an existing file may be replaced.
    pub force: bool,
    /// Program gmsh: a path, or a name on the PATH.
    pub gmsh: PathBuf,
    /// Numbers of the geometry to be set, by name.
    pub numbers: Vec<(String, f64)>,
    /// Largest size of the cells, m; necessary for a CAD file.
    pub size: Option<f64>,
    /// Coordinates of the mesh.
    pub coordinates: Coordinates,
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
    let is_cad = cad::is_cad(geometry);
    if !is_cad && !geometry.extension().is_some_and(is_geo) {
        return Err(MeshingError::NoGeo(geometry.clone()));
    }
    if is_same_file(geometry, out) {
        let (what, path) = ("geometry itself", out.clone());
        return Err(MeshingError::WouldReplaceSource { what, path });
    }
    check_file(out, request.force)?;
    let write_error = |source| MeshingError::File {
        action: "write",
        path: out.clone(),
        source,
    };
    let unfinished = UnfinishedMesh::beside(out, "msh").map_err(write_error)?;
    let script = UnfinishedMesh::beside(out, "geo").map_err(write_error)?;
    let mut meshed = geometry.as_path();
    if is_cad {
        meshed = script.path();
        std::fs::write(meshed, cad::script(geometry)).map_err(write_error)?;
    }
    check_numbers(request, meshed)?;
    if is_cad && request.size.is_none() {
        let said = call_gmsh(request, meshed, None)?;
        let size = cad::proposed_size(&said, request.coordinates.scale);
        let geometry = geometry.clone();
        return Err(MeshingError::NoSize { geometry, size });
    }
    call_gmsh(request, meshed, Some(unfinished.path()))?;
    let bytes = std::fs::read(unfinished.path()).map_err(write_error)?;
    let mesh = gmsh::parse_any_with(&bytes, request.coordinates.plane);
    let mut mesh = mesh.map_err(|source| MeshingError::Unusable {
        geometry: geometry.clone(),
        source,
    })?;
    if !is_cad && request.coordinates == Coordinates::default() {
        write_file(out, &bytes, request.force)?;
        return Ok(mesh);
    }
    if is_cad {
        cad::name_groups(&mut mesh);
    }
    let mesh = mesh.scaled(request.coordinates.scale);
    write_converted(geometry, &mesh, (out, request.force))?;
    Ok(mesh)
}

/// Refuses numbers that the program of the geometry does not use, which gmsh ignores without a message.
fn check_numbers(request: &MeshRequest, program: &Path) -> Result<(), MeshingError> {
    let MeshRequest {
        geometry, numbers, ..
    } = request;
    let bytes = std::fs::read(program).map_err(|source| MeshingError::File {
        action: "read the geometry",
        path: geometry.clone(),
        source,
    })?;
    let text = String::from_utf8_lossy(&bytes);
    let words: BTreeSet<&str> = text.split(|character| !is_word(character)).collect();
    let is_geometry = program == geometry.as_path();
    if is_geometry && (words.contains("Include") || words.contains("Merge")) {
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

/// Calls gmsh to mesh a geometry, or only to read it where no mesh file is given; returns its output.
fn call_gmsh(
    request: &MeshRequest,
    geometry: &Path,
    out: Option<&Path>,
) -> Result<Vec<String>, MeshingError> {
    let mut command = Command::new(&request.gmsh);
    match out {
        Some(out) => {
            command.arg("-3").arg(operand(geometry));
            command
                .arg("-o")
                .arg(operand(out))
                .args(["-format", "msh41"]);
        }
        None => {
            command.arg(operand(geometry)).arg("-parse_and_exit");
        }
    }
    if let Some(size) = request.size {
        let size = size / request.coordinates.scale;
        command.args(["-clmax", &size.to_string()]);
    }
    for (name, value) in &request.numbers {
        command.args(["-setnumber", name, &value.to_string()]);
    }
    let output = output_of(&mut command, REMEDY)?;
    let said = lines(&output);
    let is_complaint = |line: &&String| line.trim_start().starts_with("Error");
    let complaints: Vec<String> = said.iter().filter(is_complaint).cloned().collect();
    let is_made = out.is_none_or(Path::is_file);
    if output.status.success() && complaints.is_empty() && is_made {
        return Ok(said);
    }
    Err(MeshingError::Refused {
        refusal: Refusal::NotMeshed,
        path: request.geometry.clone(),
        lines: match complaints.is_empty() {
            true => last_lines(said, "gmsh", &output),
            false => complaints,
        },
    })
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
    // Text after a carriage return overwrites a line of progress.
    both.split(['\n', '\r'])
        .map(str::trim_end)
        .filter(|line| !line.is_empty())
        .map(str::to_owned)
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
