//! Solid cells: their shape and their orientation.

use super::super::cursor::Cursor;
use super::super::element_type::Shape;
use super::super::error::GmshError;
use super::super::records::Element;
use crate::cell::MeshCell;
use crate::solid::SolidCell;

/// Volume between the edges at a corner of a cell, relative to the cube of its longest edge, below which the cell is flat.
const FLATNESS: f64 = 1e-8;

/// The solid cell of an element; `None` for other elements.
pub(super) fn cell(shape: Shape, corners: &[u32]) -> Option<SolidCell> {
    Some(match (shape, corners) {
        (Shape::Tetrahedron, &[a, b, c, d]) => SolidCell::Tetrahedron([a, b, c, d]),
        (Shape::Hexahedron, &[a, b, c, d, e, f, g, h]) => {
            SolidCell::Hexahedron([a, b, c, d, e, f, g, h])
        }
        (Shape::Prism, &[a, b, c, d, e, f]) => SolidCell::Prism([a, b, c, d, e, f]),
        (Shape::Pyramid, &[a, b, c, d, e]) => SolidCell::Pyramid([a, b, c, d, e]),
        _ => return None,
    })
}

/// Reorients an inverted cell; refuses a cell without volume, or one that is not convex.
pub(super) fn oriented(
    cursor: &Cursor<'_>,
    element: &Element,
    cell: SolidCell,
    positions: &[[f64; 3]],
) -> Result<SolidCell, GmshError> {
    let at = |node: u32| positions[node as usize];
    let lengths = cell.edges().map(|[a, b]| {
        let squares = (0..3).map(|axis| (at(b)[axis] - at(a)[axis]).powi(2));
        squares.sum::<f64>()
    });
    let longest = lengths.fold(0.0, f64::max).sqrt();
    let least = FLATNESS * longest.powi(3);
    let (mut smallest, mut largest) = (f64::INFINITY, f64::NEG_INFINITY);
    for corner in corner_tetrahedra(&cell) {
        let volume = SolidCell::Tetrahedron(corner).volume(positions);
        smallest = smallest.min(volume);
        largest = largest.max(volume);
    }
    let (place, shape) = (|| cursor.place(element.offset), cell.shape_name());
    let reoriented = if smallest > least {
        cell
    } else if largest < -least {
        reversed_orientation(cell)
    } else if smallest >= -least && largest <= least {
        return Err(GmshError::FlatCell {
            place: place(),
            element: element.tag,
            shape,
            fraction: cell.volume(positions).abs() / longest.powi(3),
            least: FLATNESS,
        });
    } else {
        return Err(GmshError::NotConvexSolid {
            place: place(),
            element: element.tag,
            shape,
        });
    };
    let is_tetrahedron = matches!(reoriented, SolidCell::Tetrahedron(_));
    let volume = |part: [u32; 4]| SolidCell::Tetrahedron(part).volume(positions);
    if is_tetrahedron || reoriented.tetrahedra().all(|part| volume(part) > 0.0) {
        return Ok(reoriented);
    }
    Err(GmshError::NotConvexSolid {
        place: place(),
        element: element.tag,
        shape,
    })
}

/// Tetrahedra of the three edges at each corner of a cell, except at the apex of a pyramid.
fn corner_tetrahedra(cell: &SolidCell) -> impl Iterator<Item = [u32; 4]> {
    const TETRAHEDRON: &[[usize; 4]] = &[[0, 1, 2, 3]];
    const HEXAHEDRON: &[[usize; 4]] = &[
        [0, 1, 3, 4],
        [1, 2, 0, 5],
        [2, 3, 1, 6],
        [3, 0, 2, 7],
        [4, 7, 5, 0],
        [5, 4, 6, 1],
        [6, 5, 7, 2],
        [7, 6, 4, 3],
    ];
    const PRISM: &[[usize; 4]] = &[
        [0, 1, 2, 3],
        [1, 2, 0, 4],
        [2, 0, 1, 5],
        [3, 5, 4, 0],
        [4, 3, 5, 1],
        [5, 4, 3, 2],
    ];
    const PYRAMID: &[[usize; 4]] = &[[0, 1, 3, 4], [1, 2, 0, 4], [2, 3, 1, 4], [3, 0, 2, 4]];
    let places = match cell {
        SolidCell::Tetrahedron(_) => TETRAHEDRON,
        SolidCell::Hexahedron(_) => HEXAHEDRON,
        SolidCell::Prism(_) => PRISM,
        SolidCell::Pyramid(_) => PYRAMID,
    };
    let corners = cell.corners();
    places.iter().map(|it| it.map(|place| corners[place]))
}

/// The cell with the opposite orientation: top and base are exchanged, or the corners of the base reversed.
fn reversed_orientation(cell: SolidCell) -> SolidCell {
    match cell {
        SolidCell::Tetrahedron([a, b, c, d]) => SolidCell::Tetrahedron([a, c, b, d]),
        SolidCell::Hexahedron([a, b, c, d, e, f, g, h]) => {
            SolidCell::Hexahedron([e, f, g, h, a, b, c, d])
        }
        SolidCell::Prism([a, b, c, d, e, f]) => SolidCell::Prism([d, e, f, a, b, c]),
        SolidCell::Pyramid([a, b, c, d, e]) => SolidCell::Pyramid([a, d, c, b, e]),
    }
}
