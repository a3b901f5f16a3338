//! Planar cells: their shape, their orientation, and checks for cells on the same side of an edge.

use super::super::cells::Cells;
use super::super::cursor::Cursor;
use super::super::element_type::Shape;
use super::super::error::GmshError;
use super::super::records::{Element, Records};
use crate::cell::{Cell, MeshCell};
use crate::edges::Edges;

/// Twice the area of a triangle, relative to its longest side times the mesh size, that counts as zero.
const FLATNESS: f64 = 1e-12;

/// The planar cell of an element; `None` for other elements.
pub(super) fn cell(shape: Shape, corners: &[u32]) -> Option<Cell> {
    match (shape, corners) {
        (Shape::Triangle, &[a, b, c]) => Some(Cell::Triangle([a, b, c])),
        (Shape::Quadrangle, &[a, b, c, d]) => Some(Cell::Quadrangle([a, b, c, d])),
        _ => None,
    }
}

/// Orients a cell counter-clockwise; refuses a cell without area, or one that is not convex.
pub(super) fn oriented(
    cursor: &Cursor<'_>,
    element: &Element,
    mut cell: Cell,
    positions: &[[f64; 2]],
    size: f64,
) -> Result<Cell, GmshError> {
    let corners = cell.corners_mut();
    let n = corners.len();
    let point = |index: usize| positions[corners[index % n] as usize];
    let mut longest: f64 = 0.0;
    let (mut left, mut right): (f64, f64) = (0.0, 0.0);
    for index in 0..n {
        let (before, here, after) = (point(index), point(index + 1), point(index + 2));
        let (dx, dy) = (here[0] - before[0], here[1] - before[1]);
        let turn = dx * (after[1] - here[1]) - dy * (after[0] - here[0]);
        longest = longest.max(dx.hypot(dy));
        left = left.max(turn);
        right = right.max(-turn);
    }
    let least = FLATNESS * longest * size;
    let place = || cursor.place(element.offset);
    match (left > least, right > least) {
        (true, false) => {}
        (false, true) => corners[1..].reverse(),
        (false, false) => {
            return Err(GmshError::ZeroArea {
                place: place(),
                element: element.tag,
            });
        }
        (true, true) => {
            return Err(GmshError::NotConvex {
                place: place(),
                element: element.tag,
            });
        }
    }
    Ok(cell)
}

/// Refuses cells on the same side of a common edge, which overlap.
pub(super) fn check_common_edges(
    cursor: &Cursor<'_>,
    records: &Records,
    planar: &Cells<Cell>,
    edges: &Edges,
) -> Result<(), GmshError> {
    let Some(pair) = edges.first_overlap() else {
        return Ok(());
    };
    let [first, second] = planar.elements_of(records, pair);
    Err(GmshError::OverlappingCells {
        place: cursor.place(second.offset),
        element: second.tag,
        other: first.tag,
    })
}
