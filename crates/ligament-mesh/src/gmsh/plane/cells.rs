//! The planar cells: their shape, their orientation, and those that stand twice in the file.

use super::super::assembly::refuse_covering;
use super::super::cursor::Cursor;
use super::super::element_type::Shape;
use super::super::error::GmshError;
use super::super::records::{Element, Records};
use crate::cell::{Cell, MeshCell};
use crate::overlap::first_covering;

/// Twice the area of a triangle, as a part of its longest side times the mesh size, that counts as none.
const FLATNESS: f64 = 1e-12;

/// A planar cell and the index of the element that it was.
pub(super) struct PlanarCell {
    pub(super) element: usize,
    pub(super) cell: Cell,
}

/// The planar cells, counter-clockwise.
pub(super) fn oriented(
    cursor: &Cursor<'_>,
    records: &Records,
    corners: &[u32],
    positions: &[[f64; 2]],
    size: f64,
) -> Result<Vec<PlanarCell>, GmshError> {
    let mut cells = Vec::with_capacity(records.elements.len());
    for (index, element) in records.elements.iter().enumerate() {
        if let Some(mut cell) = cell(element.shape, &corners[element.corners()]) {
            check_corners(cursor, records, element)?;
            orient(cursor, element, &mut cell, positions, size)?;
            cells.push(PlanarCell {
                element: index,
                cell,
            });
        }
    }
    Ok(cells)
}

fn cell(shape: Shape, corners: &[u32]) -> Option<Cell> {
    match (shape, corners) {
        (Shape::Triangle, &[a, b, c]) => Some(Cell::Triangle([a, b, c])),
        (Shape::Quadrangle, &[a, b, c, d]) => Some(Cell::Quadrangle([a, b, c, d])),
        _ => None,
    }
}

fn check_corners(
    cursor: &Cursor<'_>,
    records: &Records,
    element: &Element,
) -> Result<(), GmshError> {
    let corners = &records.corners[element.corners()];
    let repeated = (1..corners.len()).find(|index| corners[..*index].contains(&corners[*index]));
    match repeated {
        Some(index) => Err(GmshError::RepeatedCorner {
            place: cursor.place(element.offset),
            element: element.tag,
            node: corners[index],
        }),
        None => Ok(()),
    }
}

/// Turns a cell counter-clockwise; refuses it if it has no area or is not convex.
fn orient(
    cursor: &Cursor<'_>,
    element: &Element,
    cell: &mut Cell,
    positions: &[[f64; 2]],
    size: f64,
) -> Result<(), GmshError> {
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
    Ok(())
}

/// The cells each once, and the number of the cell of each element that is one.
///
/// In format 2.2 a cell stands in the file once for each of its groups: those become one. Any other
/// cell that stands there twice is refused.
pub(super) fn merge_repeated(
    cursor: &Cursor<'_>,
    records: &Records,
    planar: Vec<PlanarCell>,
) -> Result<(Vec<PlanarCell>, Vec<Option<u32>>), GmshError> {
    let first = first_alike(cursor, records, &planar)?;
    let mut cells = Vec::with_capacity(planar.len());
    let mut cell_of_element = vec![None; records.elements.len()];
    for planar_cell in planar {
        let index = planar_cell.element;
        if first[index] == index {
            let number = u32::try_from(cells.len()).map_err(|_| GmshError::TooLarge)?;
            cell_of_element[index] = Some(number);
            cells.push(planar_cell);
        } else {
            cell_of_element[index] = cell_of_element[first[index]];
        }
    }
    Ok((cells, cell_of_element))
}

/// Refuses cells that lie on the same side of a common edge, or otherwise over each other.
pub(super) fn check_overlap(
    cursor: &Cursor<'_>,
    records: &Records,
    planar: &[PlanarCell],
    positions: &[[f64; 2]],
) -> Result<(), GmshError> {
    check_common_edges(cursor, records, planar)?;
    let corners: Vec<&[u32]> = planar.iter().map(|it| it.cell.corners()).collect();
    let triangles = |cell: usize| planar[cell].cell.triangles();
    let covering = first_covering(positions, &corners, triangles);
    let elements = covering.map(|pair| pair.map(|cell| planar[cell as usize].element));
    refuse_covering(cursor, records, elements)
}

/// Refuses cells that lie on the same side of a common edge: one of them covers some of the other.
fn check_common_edges(
    cursor: &Cursor<'_>,
    records: &Records,
    planar: &[PlanarCell],
) -> Result<(), GmshError> {
    let sides = |planar: &PlanarCell| {
        let (corners, element) = (planar.cell.corners().to_vec(), planar.element);
        let n = corners.len();
        (0..n).map(move |k| (corners[k], corners[(k + 1) % n], element))
    };
    let mut sides: Vec<(u32, u32, usize)> = planar.iter().flat_map(sides).collect();
    sides.sort_unstable();
    // Cells stand counter-clockwise, so that neighbours go along their common edge in opposite directions.
    let same = |pair: &&[(u32, u32, usize)]| (pair[0].0, pair[0].1) == (pair[1].0, pair[1].1);
    match sides.windows(2).find(same) {
        Some(pair) => {
            let [first, second] = [0, 1].map(|k| &records.elements[pair[k].2]);
            Err(GmshError::OverlappingCells {
                place: cursor.place(second.offset),
                element: second.tag,
                other: first.tag,
            })
        }
        None => Ok(()),
    }
}

/// The corners of a cell in ascending order: the same for every cell of the same corners.
fn key(cell: &Cell) -> [u32; 4] {
    let mut key = [u32::MAX; 4];
    key[..cell.corners().len()].copy_from_slice(cell.corners());
    key.sort_unstable();
    key
}

/// For each element the first one in the file of the same corners.
fn first_alike(
    cursor: &Cursor<'_>,
    records: &Records,
    planar: &[PlanarCell],
) -> Result<Vec<usize>, GmshError> {
    // Where cells are repeated, only those of one owner are alike.
    let owner = |it: &PlanarCell| match records.repeats_cells {
        true => records.elements[it.element].owner,
        false => 0,
    };
    let mut sorted: Vec<([u32; 4], i32, usize)> = planar
        .iter()
        .map(|cell| (key(&cell.cell), owner(cell), cell.element))
        .collect();
    sorted.sort_unstable();
    let same = |pair: &&[([u32; 4], i32, usize)]| (pair[0].0, pair[0].1) == (pair[1].0, pair[1].1);
    if let Some(pair) = sorted.windows(2).find(same) {
        let (first, second) = (&records.elements[pair[0].2], &records.elements[pair[1].2]);
        return Err(GmshError::DuplicateCell {
            place: cursor.place(second.offset),
            element: second.tag,
            other: first.tag,
        });
    }
    let mut first: Vec<usize> = (0..records.elements.len()).collect();
    for run in sorted.chunk_by(|a, b| a.0 == b.0) {
        let least = run.iter().map(|entry| entry.2).min();
        for entry in run {
            first[entry.2] = least.unwrap_or(entry.2);
        }
    }
    Ok(first)
}
