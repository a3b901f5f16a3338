//! Meshes of input decks of Abaqus and CalculiX and of Gmsh files, read by the program itself.

use std::fs;
use std::path::{Path, PathBuf};

use ligament_mesh::gmsh::CoordinatePlane;
use ligament_mesh::inp::{self, Deck, Plane};
use ligament_mesh::{AnyMesh, gmsh};
use ligament_output::check_file;

use super::error::MeshingError;
use super::via_meshio::{Conversion, write_converted};
use super::{Coordinates, ends_in, is_same_file};

/// Endings of the names of input decks and of Gmsh meshes.
const DECK: &str = "inp";
const GMSH: &str = "msh";

/// Request for the mesh of an input deck or of another mesh.
#[derive(Debug, Clone, PartialEq)]
pub struct DeckRequest {
    /// The deck, or the Gmsh mesh.
    pub source: PathBuf,
    /// The mesh file to write.
    pub out: PathBuf,
    /// Whether an existing file may be replaced.
    pub force: bool,
    /// Coordinates of the mesh.
    pub coordinates: Coordinates,
}

/// Whether a file is an input deck, by its name.
pub fn is_deck(path: &Path) -> bool {
    ends_in(path, DECK)
}

/// Whether a file is an input deck or a Gmsh mesh, by its name.
pub fn is_read(path: &Path) -> bool {
    is_deck(path) || ends_in(path, GMSH)
}

/// Reads a Gmsh mesh, or an input deck with the files that it includes, from its folder, and returns the mesh written to `request.out` in
/// Gmsh's format 4.1. Remarks name contents of the source that the mesh lacks.
///
/// # Errors
///
/// If the source cannot be read or has no mesh, or the result cannot be written.
pub fn convert_deck(request: &DeckRequest) -> Result<Conversion, MeshingError> {
    let DeckRequest {
        source,
        out,
        force,
        coordinates,
    } = request;
    if is_same_file(source, out) {
        let (what, path) = ("source itself", out.clone());
        return Err(MeshingError::WouldReplaceSource { what, path });
    }
    check_file(out, *force)?;
    let plane = coordinates.plane;
    let (mesh, remarks) = if ends_in(source, GMSH) {
        let mesh = gmsh::parse_any_with(&content(source, "mesh")?, plane);
        let mesh = mesh.map_err(|error| MeshingError::UnusableSource {
            mesh: source.clone(),
            source: error,
        })?;
        let remarks = mesh_remarks(&mesh).collect();
        (mesh, remarks)
    } else {
        let deck = read_deck(source, plane)?;
        let remarks = remarks(&deck);
        (deck.mesh, remarks)
    };
    let mesh = write_converted(source, &mesh.scaled(coordinates.scale), (out, *force))?;
    Ok(Conversion { mesh, remarks })
}

/// Reads an input deck with the files that it includes, from its folder; a planar mesh lies in a given plane.
///
/// # Errors
///
/// If the deck cannot be read or has no mesh.
pub fn read_deck(source: &Path, plane: CoordinatePlane) -> Result<Deck, MeshingError> {
    let bytes = content(source, "input deck")?;
    let folder = source.parent().unwrap_or(Path::new(""));
    let deck = inp::parse_with(&bytes, plane, &mut |name| fs::read(folder.join(name)));
    deck.map_err(|error| MeshingError::Deck {
        deck: source.to_owned(),
        source: Box::new(error),
    })
}

/// Content of a source, which must exist.
fn content(source: &Path, what: &'static str) -> Result<Vec<u8>, MeshingError> {
    if !source.is_file() {
        let path = source.to_owned();
        return Err(MeshingError::NoSource { what, path });
    }
    fs::read(source).map_err(|error| MeshingError::File {
        action: "read",
        path: source.to_owned(),
        source: error,
    })
}

fn mesh_remarks(mesh: &AnyMesh) -> impl Iterator<Item = String> {
    mesh.remarks().iter().map(ToString::to_string)
}

/// Remarks on contents of a deck that the mesh lacks.
fn remarks(deck: &Deck) -> Vec<String> {
    let mut remarks: Vec<String> = mesh_remarks(&deck.mesh).collect();
    if let Some(plane) = deck.plane {
        let word = match plane {
            Plane::Stress => "stress",
            Plane::Strain => "strain",
        };
        remarks.push(format!(
            "the elements are of plane {word}: `plane = \"{word}\"` in [mesh]"
        ));
    }
    let others = deck.other_keywords().into_iter();
    let others: Vec<String> = others
        .map(|(name, (count, line))| match count {
            1 => format!("*{name} ({line})"),
            _ => format!("*{name} ({count} times, first {line})"),
        })
        .collect();
    if !others.is_empty() {
        remarks.push(format!(
            "a mesh does not have what these keywords say: {}; give it in the case file",
            others.join(", ")
        ));
    }
    remarks
}
