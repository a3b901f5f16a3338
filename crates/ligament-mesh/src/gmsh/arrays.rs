//! A mesh from arrays of nodes and elements, as libraries for meshes hold them in memory.

use std::collections::HashMap;

use super::cursor::Cursor;
use super::element_type::Shape;
use super::error::GmshError;
use super::plane;
use super::records::{self, Node, Records};
use crate::mesh::Mesh;

/// An element by its corners, and the group that it is part of; an element in several groups stands once for each.
#[derive(Debug, Clone, PartialEq)]
pub struct Element<'a> {
    /// Tags of the corners: one of a point, two of an edge, three or four of a cell.
    pub corners: Vec<u64>,
    /// Name of the group.
    pub group: Option<&'a str>,
}

/// The mesh of nodes, by their tags and positions (m), and elements. What no file of a mesh may have is refused here, too.
///
/// # Errors
/// Where an element has more than four corners, or the elements are no planar mesh; places count elements as lines.
pub fn assemble(nodes: &[(u64, [f64; 2])], elements: &[Element<'_>]) -> Result<Mesh, GmshError> {
    // An element is found by its line, as in a file.
    let lines = "\n".repeat(elements.len());
    let cursor = Cursor::new(lines.as_bytes());
    let mut records = Records {
        repeats_cells: true,
        ..Records::default()
    };
    for &(tag, [x, y]) in nodes {
        let node = Node {
            tag,
            position: [x, y, 0.0],
            offset: 0,
        };
        records.push_node(&cursor, node)?;
    }
    let mut numbers: HashMap<(u8, &str), i32> = HashMap::new();
    for (index, element) in elements.iter().enumerate() {
        let shape = shape_of(&cursor, index, element)?;
        let dimension = shape.dimension();
        let owner = match element.group {
            None => 0,
            Some(name) => {
                let next = 1 + numbers.len() as i32;
                let number = *numbers.entry((dimension, name)).or_insert(next);
                records.names.insert((dimension, number), name.to_owned());
                number
            }
        };
        records
            .physicals
            .entry((dimension, owner))
            .or_insert_with(|| vec![owner]);
        let first_corner = records.corners.len();
        records.corners.extend_from_slice(&element.corners);
        records.elements.push(records::Element {
            tag: 1 + index as u64,
            shape,
            higher_order: false,
            owner,
            first_corner,
            offset: index,
        });
    }
    plane::assemble(&cursor, &records)
}

fn shape_of(cursor: &Cursor<'_>, index: usize, element: &Element<'_>) -> Result<Shape, GmshError> {
    match element.corners.len() {
        1 => Ok(Shape::Point),
        2 => Ok(Shape::Edge),
        3 => Ok(Shape::Triangle),
        4 => Ok(Shape::Quadrangle),
        other => Err(GmshError::UnknownElementType {
            place: cursor.place(index),
            code: other as i32,
        }),
    }
}
