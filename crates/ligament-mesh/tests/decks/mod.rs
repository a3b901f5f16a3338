//! Input decks of Abaqus and CalculiX, each with a few nodes.

#![allow(clippy::unwrap_used, missing_docs)]

mod assemblies;
mod elements;
mod generated;
mod groups;
mod lines;
mod refusals;

use std::io;

use ligament_mesh::inp::{Deck, InpError, parse};
use ligament_mesh::{AnyMesh, DeckRemark, FileLine, Group, Mesh, Remark, SolidMesh};

/// Nodes of four squares of side 1, in rows of three.
const NODES: &str = "\
*NODE
1, 0, 0\n2, 1, 0\n3, 2, 0
4, 0, 1\n5, 1, 1\n6, 2, 1
7, 0, 2\n8, 1, 2\n9, 2, 2
";

/// The four squares.
const SQUARES: &str = "\
*ELEMENT, TYPE=CPS4, ELSET=Plate
1, 1, 2, 5, 4\n2, 2, 3, 6, 5
3, 4, 5, 8, 7\n4, 5, 6, 9, 8
";

/// A cube of side 1 with a pyramid of height 1 on it, whose apex is node 9.
const CHAPEL: &str = "\
*NODE
1, 0, 0, 0\n2, 1, 0, 0\n3, 1, 1, 0\n4, 0, 1, 0
5, 0, 0, 1\n6, 1, 0, 1\n7, 1, 1, 1\n8, 0, 1, 1
9, 0.5, 0.5, 2
*ELEMENT, TYPE=C3D8, ELSET=Nave
1, 1, 2, 3, 4, 5, 6, 7, 8
*ELEMENT, TYPE=C3D5, ELSET=Roof
2, 5, 6, 7, 8, 9
";

fn no_files(name: &str) -> io::Result<Vec<u8>> {
    Err(io::Error::new(io::ErrorKind::NotFound, name.to_owned()))
}

fn try_read(text: &str) -> Result<Deck, InpError> {
    parse(text.as_bytes(), &mut no_files)
}

fn read(text: &str) -> Deck {
    try_read(text).unwrap_or_else(|error| panic!("{error}"))
}

/// The four squares with further lines.
fn with_squares(lines: &str) -> Deck {
    read(&format!("{NODES}{SQUARES}{lines}"))
}

/// Message of the refusal of a deck.
fn refusal(text: &str) -> String {
    match try_read(text) {
        Ok(_) => panic!("the deck was read:\n{text}"),
        Err(error) => error.to_string(),
    }
}

fn plane(deck: &Deck) -> &Mesh {
    match &deck.mesh {
        AnyMesh::Plane(mesh) => mesh,
        AnyMesh::Solid(_) => panic!("a solid mesh"),
    }
}

fn solid(deck: &Deck) -> &SolidMesh {
    match &deck.mesh {
        AnyMesh::Solid(mesh) => mesh,
        AnyMesh::Plane(_) => panic!("a planar mesh"),
    }
}

/// The only group of a name.
fn group<'a>(deck: &'a Deck, name: &str) -> &'a Group {
    let groups: Vec<&Group> = deck.groups_named(name).collect();
    match groups.as_slice() {
        [group] => group,
        groups => panic!("{} groups {name}", groups.len()),
    }
}

/// Numbers in the deck of the nodes of a group.
fn labels(deck: &Deck, name: &str) -> Vec<u64> {
    let tags = match &deck.mesh {
        AnyMesh::Plane(mesh) => &mesh.node_tags,
        AnyMesh::Solid(mesh) => &mesh.node_tags,
    };
    let nodes = group(deck, name).nodes.iter();
    let mut labels: Vec<u64> = nodes.map(|node| tags[*node as usize]).collect();
    labels.sort_unstable();
    labels
}

fn line(number: usize) -> FileLine {
    FileLine { file: None, number }
}

/// Remarks on lines of the deck.
fn remarks(deck: &Deck) -> Vec<(usize, DeckRemark)> {
    let remarks = deck.mesh.remarks().iter().filter_map(|it| match it {
        Remark::Deck { line, remark } => Some((line.number, remark.clone())),
        _ => None,
    });
    remarks.collect()
}
