//! Meshes of input decks of Abaqus and CalculiX, read by the program itself.

use std::fs;
use std::path::{Path, PathBuf};

use ligament_mesh::inp::{self, Deck, Plane};
use ligament_output::check_file;

use super::error::MeshingError;
use super::is_same_file;
use super::via_meshio::{Conversion, write_converted};

/// Ending of the names of input decks.
const ENDING: &str = "inp";

/// Request for the mesh of an input deck.
#[derive(Debug, Clone, PartialEq)]
pub struct DeckRequest {
    /// The deck.
    pub source: PathBuf,
    /// The mesh file to write.
    pub out: PathBuf,
    /// Whether an existing file may be replaced.
    pub force: bool,
}

/// Whether a file is an input deck, by its name.
pub fn is_deck(path: &Path) -> bool {
    path.extension()
        .is_some_and(|it| it.eq_ignore_ascii_case(ENDING))
}

/// Reads an input deck with the files that it includes, from its folder, and returns the mesh written to `request.out` in Gmsh's format 4.1. Remarks name
/// what of the deck the mesh does not have.
///
/// # Errors
///
/// If the deck cannot be read or has no mesh, or the result cannot be written.
pub fn convert_deck(request: &DeckRequest) -> Result<Conversion, MeshingError> {
    let DeckRequest { source, out, force } = request;
    if !source.is_file() {
        let (what, path) = ("input deck", source.clone());
        return Err(MeshingError::NoSource { what, path });
    }
    if is_same_file(source, out) {
        let (what, path) = ("deck itself", out.clone());
        return Err(MeshingError::WouldReplaceSource { what, path });
    }
    check_file(out, *force)?;
    let folder = source.parent().unwrap_or(Path::new(""));
    let bytes = fs::read(source).map_err(|error| MeshingError::File {
        action: "read",
        path: source.clone(),
        source: error,
    })?;
    let deck = inp::parse(&bytes, &mut |name| fs::read(folder.join(name)));
    let deck = deck.map_err(|error| MeshingError::Deck {
        deck: source.clone(),
        source: Box::new(error),
    })?;
    let remarks = remarks(&deck);
    let mesh = write_converted(source, &deck.mesh, (out, *force))?;
    Ok(Conversion { mesh, remarks })
}

/// What the mesh does not say of a deck.
fn remarks(deck: &Deck) -> Vec<String> {
    let mut remarks: Vec<String> = deck
        .mesh
        .remarks()
        .iter()
        .map(ToString::to_string)
        .collect();
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
