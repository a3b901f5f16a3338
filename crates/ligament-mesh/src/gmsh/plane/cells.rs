//! Planar cells: their shape, their orientation, and checks for cells on the same side of an edge.

use super::super::cells::Cells;
use super::super::cursor::Cursor;
use super::super::element_type::Shape;
use super::super::error::GmshError;
use super::super::records::{Element, Records};
use crate::cell::{Cell, MeshCell};

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
) -> Result<(), GmshError> {
    let sides = |(cell, element): (&Cell, &u32)| {
        let (corners, element) = (cell.corners().to_vec(), *element);
        let n = corners.len();
        (0..n).map(move |k| (corners[k], corners[(k + 1) % n], element))
    };
    let of_cells = planar.cells.iter().zip(&planar.elements);
    let mut sides: Vec<(u32, u32, u32)> = of_cells.flat_map(sides).collect();
    sides.sort_unstable();
    // Cells are counter-clockwise, so that neighbours run along their common edge in opposite directions.
    let same = |pair: &&[(u32, u32, u32)]| (pair[0].0, pair[0].1) == (pair[1].0, pair[1].1);
    match sides.windows(2).find(same) {
        Some(pair) => {
            let [first, second] = [0, 1].map(|k| &records.elements[pair[k].2 as usize]);
            Err(GmshError::OverlappingCells {
                place: cursor.place(second.offset),
                element: second.tag,
                other: first.tag,
            })
        }
        None => Ok(()),
    }
}
