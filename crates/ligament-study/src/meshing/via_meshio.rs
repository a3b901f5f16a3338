//! Meshes in formats of other programs, read by the Python package meshio.
//!
//! A script in the executable (`via_meshio.py`) reads the file by meshio, collects its groups and prints nodes, cells and groups as text,
//! which becomes a Gmsh file and is read as such.

use std::path::{Path, PathBuf};
use std::process::{Command, Output};

use ligament_mesh::gmsh::{self, CoordinatePlane};
use ligament_mesh::{AnyMesh, Cell, Group, Mesh, SolidCell, SolidMesh};
use ligament_output::{check_file, write_file};

use super::error::{MeshingError, Refusal};
use super::{Coordinates, is_same_file, last_lines, make_folder_of, output_of};

/// Text of the script, which is passed on the command line.
const SCRIPT: &str = include_str!("via_meshio.py");

/// Request for the conversion of a mesh.
#[derive(Debug, Clone, PartialEq)]
pub struct ConversionRequest {
    /// The mesh of another program.
    pub source: PathBuf,
    /// Name of the source's format in meshio; by default from the extension.
    pub format: Option<String>,
    /// The mesh file to write.
    pub out: PathBuf,
    /// Whether an existing file may be replaced.
    pub force: bool,
    /// Program python: a path, or a name on the PATH.
    pub python: PathBuf,
    /// Coordinates of the mesh.
    pub coordinates: Coordinates,
}

/// A converted mesh.
#[derive(Debug, Clone, PartialEq)]
pub struct Conversion {
    /// The mesh in the written file.
    pub mesh: AnyMesh,
    /// Remarks on differences between the source and the mesh.
    pub remarks: Vec<String>,
}

/// Advice where Python is missing.
const REMEDY: &str = "install Python from https://python.org, or say where it is by --python PATH";

/// Faults of a source by their keywords in the script.
const FAULTS: [(&str, Refusal); 6] = [
    ("unknown-format", Refusal::UnknownFormat),
    ("unreadable", Refusal::Unreadable),
    ("is-gmsh", Refusal::IsGmsh),
    ("foreign-cells", Refusal::Shapes),
    ("no-cells", Refusal::NoCells),
    ("not-planar", Refusal::NotPlanar),
];

/// Converts a mesh by Python and meshio, and returns the mesh written to `request.out` in Gmsh's format 4.1.
///
/// The mesh is written to a temporary file and renamed only after it could be read, so a failure never damages an existing mesh.
///
/// # Errors
///
/// If Python or meshio are missing, the file cannot be read or has no mesh, or the result cannot be written.
pub fn convert(request: &ConversionRequest) -> Result<Conversion, MeshingError> {
    let ConversionRequest { source, out, .. } = request;
    if !source.is_file() {
        let (what, path) = ("mesh", source.clone());
        return Err(MeshingError::NoSource { what, path });
    }
    if is_same_file(source, out) {
        let (what, path) = ("mesh that is to be converted", out.clone());
        return Err(MeshingError::WouldReplaceSource { what, path });
    }
    check_file(out, request.force)?;
    let output = call_python(request)?;
    let text = String::from_utf8_lossy(&output.stdout);
    let failed = || MeshingError::Failed {
        python: request.python.clone(),
        mesh: source.clone(),
        lines: {
            let error_output = String::from_utf8_lossy(&output.stderr);
            last_lines(
                error_output.lines().map(str::to_owned).collect(),
                "it",
                &output,
            )
        },
    };
    if let Some(fault) = text.strip_prefix("error\n") {
        return Err(refused(request, fault).unwrap_or_else(failed));
    }
    let handed = output.status.success().then(|| ScriptOutput::parse(&text));
    let ScriptOutput { mesh, remarks } = handed.flatten().ok_or_else(failed)?;
    let Coordinates { plane, scale } = request.coordinates;
    if plane != CoordinatePlane::Xy && matches!(mesh, AnyMesh::Solid(_)) {
        let mesh = source.clone();
        return Err(MeshingError::SolidInPlane { mesh, plane });
    }
    let mesh = write_converted(source, &mesh.scaled(scale), (out, request.force))?;
    Ok(Conversion { mesh, remarks })
}

/// Writes the mesh of a source in Gmsh's format 4.1, in place of an existing file where `force` says so; returns the mesh as it is read back.
///
/// # Errors
///
/// If the mesh cannot be used or written.
pub fn write_converted(
    source: &Path,
    mesh: &AnyMesh,
    (out, force): (&Path, bool),
) -> Result<AnyMesh, MeshingError> {
    let text = match mesh {
        AnyMesh::Plane(mesh) => gmsh::write(mesh),
        AnyMesh::Solid(mesh) => gmsh::write(mesh),
    };
    let mesh = gmsh::parse_any(text.as_bytes()).map_err(|error| MeshingError::UnusableSource {
        mesh: source.to_owned(),
        source: error,
    })?;
    let write_error = |source| MeshingError::File {
        action: "write",
        path: out.to_owned(),
        source,
    };
    make_folder_of(out).map_err(write_error)?;
    write_file(out, text.as_bytes(), force)?;
    Ok(mesh)
}

fn call_python(request: &ConversionRequest) -> Result<Output, MeshingError> {
    // A relative path that begins with a hyphen would be an option of Python.
    let path = std::path::absolute(&request.source).unwrap_or_else(|_| request.source.clone());
    let mut command = Command::new(&request.python);
    command.args(["-c", SCRIPT]).arg(path);
    command
        .arg(request.coordinates.plane.word())
        .args(&request.format);
    output_of(&mut command, REMEDY)
}

/// The error for a fault found by the script, given by its kind and the lines of the reason.
fn refused(request: &ConversionRequest, fault: &str) -> Option<MeshingError> {
    let (kind, reason) = fault.split_once('\n').unwrap_or((fault, ""));
    let lines: Vec<String> = reason.lines().map(str::to_owned).collect();
    if kind == "no-package" {
        return Some(MeshingError::NoPackage {
            python: request.python.clone(),
            package: lines.concat(),
        });
    }
    let (_, refusal) = *FAULTS.iter().find(|(word, _)| *word == kind)?;
    let path = request.source.clone();
    Some(MeshingError::Refused {
        refusal,
        path,
        lines,
    })
}

/// Parsed output of the script.
struct ScriptOutput {
    mesh: AnyMesh,
    remarks: Vec<String>,
}

impl ScriptOutput {
    /// Parses the script's output; `None` if it has another format.
    fn parse(text: &str) -> Option<Self> {
        let mut lines = text.lines();
        let n_remarks = section(lines.next()?, "remarks")?;
        let remarks: Vec<String> = lines.by_ref().take(n_remarks).map(str::to_owned).collect();
        let n_nodes = section(lines.next()?, "nodes")?;
        let nodes: Vec<&str> = lines.by_ref().take(n_nodes).collect();
        let mesh = match nodes.first()?.split(' ').count() {
            3 => AnyMesh::Plane(plane(&nodes, lines)?),
            _ => AnyMesh::Solid(solid(&nodes, lines)?),
        };
        Some(Self { mesh, remarks })
    }
}

/// Parses a mesh in the plane from the lines of its nodes and the lines after them.
fn plane<'a>(nodes: &[&str], mut lines: impl Iterator<Item = &'a str>) -> Option<Mesh> {
    let (node_tags, positions) = tags_and_positions(nodes)?;
    let cells = cells(&mut lines, positions.len(), face)?;
    let groups = groups(&mut lines, 2, positions.len(), cells.len())?;
    Some(Mesh {
        node_tags: node_tags.into(),
        positions,
        cells,
        groups,
        ..Mesh::default()
    })
}

/// Parses a solid mesh from the lines of its nodes and the lines after them.
fn solid<'a>(nodes: &[&str], mut lines: impl Iterator<Item = &'a str>) -> Option<SolidMesh> {
    let (node_tags, positions) = tags_and_positions(nodes)?;
    let cells = cells(&mut lines, positions.len(), solid_cell)?;
    let groups = groups(&mut lines, 3, positions.len(), cells.len())?;
    Some(SolidMesh {
        node_tags: node_tags.into(),
        positions,
        cells,
        groups,
        ..SolidMesh::default()
    })
}

fn tags_and_positions<const D: usize>(nodes: &[&str]) -> Option<(Vec<u64>, Vec<[f64; D]>)> {
    let node = |line: &&str| {
        let mut words = line.split(' ');
        let tag: u64 = words.next()?.parse().ok()?;
        let position: Option<Vec<f64>> = words.map(|word| word.parse().ok()).collect();
        let position: [f64; D] = position?.try_into().ok()?;
        Some((tag, position))
    };
    nodes.iter().map(node).collect()
}

fn face(corners: &[u32]) -> Option<Cell> {
    match *corners {
        [a, b, c] => Some(Cell::Triangle([a, b, c])),
        [a, b, c, d] => Some(Cell::Quadrangle([a, b, c, d])),
        _ => None,
    }
}

fn solid_cell(corners: &[u32]) -> Option<SolidCell> {
    match corners.len() {
        4 => Some(SolidCell::Tetrahedron(corners.try_into().ok()?)),
        5 => Some(SolidCell::Pyramid(corners.try_into().ok()?)),
        6 => Some(SolidCell::Prism(corners.try_into().ok()?)),
        8 => Some(SolidCell::Hexahedron(corners.try_into().ok()?)),
        _ => None,
    }
}

/// Parses the section of cells, each constructed from its corners, indices below `n_nodes`.
fn cells<'a, C>(
    lines: &mut impl Iterator<Item = &'a str>,
    n_nodes: usize,
    of_corners: fn(&[u32]) -> Option<C>,
) -> Option<Vec<C>> {
    let n_cells = section(lines.next()?, "cells")?;
    let cell = |line: &str| {
        let corners = numbers(line)?;
        let are_nodes = corners.iter().all(|&node| (node as usize) < n_nodes);
        are_nodes.then(|| of_corners(&corners))?
    };
    lines.take(n_cells).map(cell).collect()
}

/// Parses the section of groups and the end, for a mesh with `n_nodes` nodes and `n_cells` cells of the dimension.
fn groups<'a>(
    lines: &mut impl Iterator<Item = &'a str>,
    dimension: u8,
    n_nodes: usize,
    n_cells: usize,
) -> Option<Vec<Group>> {
    let n_groups = section(lines.next()?, "groups")?;
    let mut groups: Vec<Group> = Vec::new();
    for _ in 0..n_groups {
        let group = group(lines, &groups, dimension, [n_nodes, n_cells])?;
        groups.push(group);
    }
    (lines.next()? == "end").then_some(groups)
}

/// Parses the next group after the groups `before`.
fn group<'a>(
    lines: &mut impl Iterator<Item = &'a str>,
    before: &[Group],
    of_cells: u8,
    [n_nodes, n_cells]: [usize; 2],
) -> Option<Group> {
    let mut words = lines.next()?.splitn(3, ' ');
    let dimension: u8 = words.next()?.parse().ok()?;
    let count = words.next()?.parse().ok()?;
    let mut group = Group {
        name: words.next()?.to_owned(),
        dimension,
        // Groups are numbered in their order within their dimension, from 1.
        number: 1 + before.iter().filter(|it| it.dimension == dimension).count() as i32,
        ..Group::default()
    };
    for line in lines.take(count) {
        let members = numbers(line)?;
        let below = if dimension == of_cells {
            n_cells
        } else {
            n_nodes
        };
        members
            .iter()
            .all(|&it| (it as usize) < below)
            .then_some(())?;
        match (dimension, members.as_slice()) {
            (_, &[cell]) if dimension == of_cells => group.cells.push(cell),
            (0, &[node]) => group.nodes.push(node),
            (1, &[a, b]) => group.edges.push([a, b]),
            (2, corners) if of_cells == 3 => group.faces.push(face(corners)?),
            _ => return None,
        }
    }
    Some(group)
}

/// Number of lines of a section, from its heading.
fn section(line: &str, name: &str) -> Option<usize> {
    line.strip_prefix(name)?.trim().parse().ok()
}

fn numbers(line: &str) -> Option<Vec<u32>> {
    line.split(' ').map(|word| word.parse().ok()).collect()
}

/// Default path of a converted mesh: the source's path with the extension `.msh`.
///
/// A source with the extension `.msh`, such as of ANSYS, gets `-gmsh.msh` instead.
pub fn default_out(source: &Path) -> PathBuf {
    let out = source.with_extension("msh");
    if out != source {
        return out;
    }
    let mut name = source.file_stem().unwrap_or_default().to_owned();
    name.push("-gmsh.msh");
    source.with_file_name(name)
}

#[cfg(test)]
mod tests {
    use super::*;

    const HANDED: &str = "remarks 1\n2 nodes were dropped\nnodes 4\n7 0.0 0.0\n8 1.0 0.0\n9 1.0 0.30000000000000004\n\
        4 0.0 1.0\ncells 2\n0 1 2\n0 2 3\ngroups 3\n2 1 a part\n1\n1 1 edge\n0 1\n0 2 edge\n0\n3\nend\n";

    #[test]
    fn what_is_handed_over_is_read() {
        let ScriptOutput { mesh, remarks } = ScriptOutput::parse(HANDED).unwrap();
        let AnyMesh::Plane(mesh) = mesh else {
            panic!("{mesh:?}")
        };
        assert_eq!(remarks, ["2 nodes were dropped"]);
        assert_eq!(*mesh.node_tags, [7, 8, 9, 4]);
        assert_eq!(mesh.positions[2], [1.0, 0.1 + 0.2]);
        let groups: Vec<(&str, u8, i32)> = (mesh.groups.iter())
            .map(|it| (it.name.as_str(), it.dimension, it.number))
            .collect();
        assert_eq!(groups, [("a part", 2, 1), ("edge", 1, 1), ("edge", 0, 1)]);
        assert_eq!(mesh.groups[0].cells, [1]);
        assert_eq!(mesh.groups[1].edges, [[0, 1]]);
        assert_eq!(mesh.groups[2].nodes, [0, 3]);
    }

    const SOLID: &str = "remarks 0\nnodes 5\n1 0.0 0.0 0.0\n2 1.0 0.0 0.0\n3 1.0 1.0 0.0\n4 0.0 1.0 0.0\n9 0.5 0.5 -1.0\n\
        cells 1\n0 1 2 3 4\ngroups 3\n3 1 all\n0\n2 1 side\n0 1 4\n1 1 edge\n0 4\nend\n";

    #[test]
    fn solids_are_handed_over_with_faces() {
        let Some(ScriptOutput {
            mesh: AnyMesh::Solid(mesh),
            ..
        }) = ScriptOutput::parse(SOLID)
        else {
            panic!("a solid mesh");
        };
        assert_eq!(mesh.cells, [SolidCell::Pyramid([0, 1, 2, 3, 4])]);
        assert_eq!(mesh.positions[4], [0.5, 0.5, -1.0]);
        assert_eq!(mesh.groups[0].cells, [0]);
        assert_eq!(mesh.groups[1].faces, [Cell::Triangle([0, 1, 4])]);
        assert_eq!(mesh.groups[2].edges, [[0, 4]]);
        // The pyramid hangs from its base: the reader reorients it.
        let Ok(AnyMesh::Solid(read)) = gmsh::parse_any(gmsh::write(&mesh).as_bytes()) else {
            panic!("a solid mesh");
        };
        assert_eq!(read.volume(), 1.0 / 3.0);
        assert_eq!(read.groups[1].faces.len(), 1);
    }

    /// A text that ends early, or refers to missing nodes or cells, is refused.
    #[test]
    fn anything_else_is_refused() {
        for text in [HANDED, SOLID] {
            for end in 0..text.len() - 1 {
                assert!(ScriptOutput::parse(&text[..end]).is_none(), "{end}");
            }
        }
        for (from, to) in [("0 2 3\n", "0 2 4\n"), ("part\n1\n", "part\n2\n")] {
            assert!(
                ScriptOutput::parse(&HANDED.replace(from, to)).is_none(),
                "{to}"
            );
        }
    }

    #[test]
    fn a_mesh_of_ansys_is_not_to_be_replaced() {
        let out = |path: &str| default_out(Path::new(path));
        assert_eq!(out("meshes/plate.inp"), Path::new("meshes/plate.msh"));
        assert_eq!(out("meshes/plate.msh"), Path::new("meshes/plate-gmsh.msh"));
    }
}
