//! Meshes from arrays of nodes and elements, as mesh libraries store them in memory.

use std::collections::HashMap;

use super::cursor::Cursor;
use super::element_type::Shape;
use super::error::GmshError;
use super::records::{self, Node, Records};
use super::{plane, solid};
use crate::coordinate_plane::CoordinatePlane;
use crate::mesh::AnyMesh;

/// An element, given by its corners, and its group; an element in several groups occurs once for each.
#[derive(Debug, Clone, PartialEq)]
pub struct Element<'a> {
    /// Dimension: 0 a point, 1 an edge, 2 a planar cell or the face of a solid one, 3 a solid cell.
    pub dimension: u8,
    /// Tags of the corners: one for a point, two for an edge, three or four for a planar cell; four, five, six or eight for a solid one.
    pub corners: Vec<u64>,
    /// Name of the group.
    pub group: Option<&'a str>,
}

/// The mesh of nodes, given by their tags and positions (m), and elements: a solid mesh if an element is solid. It is checked like a
/// mesh file; a planar mesh lies in a given plane.
///
/// # Errors
/// Returns an error if an element has another number of corners, or the elements form no mesh; as its position it names the number of an
/// element as a line.
pub fn assemble(
    nodes: &[(u64, [f64; 3])],
    elements: &[Element<'_>],
    plane: CoordinatePlane,
) -> Result<AnyMesh, GmshError> {
    // One line for each element: errors give the number of an element as a line.
    let lines = "\n".repeat(elements.len());
    let cursor = Cursor::new(lines.as_bytes());
    let mut records = Records {
        repeats_cells: true,
        ..Records::default()
    };
    for &(tag, position) in nodes {
        let node = Node {
            tag,
            position,
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
    match elements.iter().position(|it| it.dimension == 3) {
        Some(index) if plane != CoordinatePlane::Xy => Err(GmshError::SolidInPlane {
            place: cursor.place(index),
            plane,
        }),
        Some(_) => solid::assemble(&cursor, records).map(AnyMesh::Solid),
        None => plane::assemble(&cursor, records, plane).map(AnyMesh::Plane),
    }
}

fn shape_of(cursor: &Cursor<'_>, index: usize, element: &Element<'_>) -> Result<Shape, GmshError> {
    match (element.dimension, element.corners.len()) {
        (0, 1) => Ok(Shape::Point),
        (1, 2) => Ok(Shape::Edge),
        (2, 3) => Ok(Shape::Triangle),
        (2, 4) => Ok(Shape::Quadrangle),
        (3, 4) => Ok(Shape::Tetrahedron),
        (3, 5) => Ok(Shape::Pyramid),
        (3, 6) => Ok(Shape::Prism),
        (3, 8) => Ok(Shape::Hexahedron),
        (_, other) => Err(GmshError::UnknownElementType {
            place: cursor.place(index),
            code: other as i32,
        }),
    }
}
