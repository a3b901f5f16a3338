//! Cells of a mesh from the elements of a file, with checks for repeated and overlapping cells.

use super::cursor::Cursor;
use super::element_type::Shape;
use super::error::GmshError;
use super::records::{Element, Records};
use crate::cell::MeshCell;
use crate::overlap::first_covering;

/// Cells and the indices of their elements.
pub(super) struct Cells<C> {
    pub(super) cells: Vec<C>,
    pub(super) elements: Vec<usize>,
}

impl<C> Cells<C> {
    fn with_capacity(n_cells: usize) -> Self {
        Self {
            cells: Vec::with_capacity(n_cells),
            elements: Vec::with_capacity(n_cells),
        }
    }

    /// Cells made by `cell` from the shapes of elements and their corners (numbers of nodes), and oriented by `oriented`.
    pub(super) fn of_elements(
        cursor: &Cursor<'_>,
        records: &Records,
        corners: &[u32],
        cell: impl Fn(Shape, &[u32]) -> Option<C>,
        oriented: impl Fn(&Element, C) -> Result<C, GmshError>,
    ) -> Result<Self, GmshError> {
        let mut found = Self::with_capacity(records.elements.len());
        for (index, element) in records.elements.iter().enumerate() {
            if let Some(cell) = cell(element.shape, &corners[element.corners()]) {
                check_corners(cursor, records, element)?;
                found.cells.push(oriented(element, cell)?);
                found.elements.push(index);
            }
        }
        Ok(found)
    }

    /// Number of cells made from elements of higher order.
    pub(super) fn of_higher_order(&self, records: &Records) -> usize {
        let elements = self.elements.iter();
        let higher = elements.filter(|element| records.elements[**element].higher_order);
        higher.count()
    }

    /// Elements of two cells.
    pub(super) fn elements_of<'a>(
        &self,
        records: &'a Records,
        cells: [u32; 2],
    ) -> [&'a Element; 2] {
        cells.map(|cell| &records.elements[self.elements[cell as usize]])
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

/// Merges repeated cells; returns the cells, each once, and the number of the cell of each element, if any.
///
/// In format 2.2 a cell occurs in the file once for each of its groups: these are merged. Any other repeated cell is refused.
pub(super) fn merge_repeated<const D: usize, C: MeshCell<D>>(
    cursor: &Cursor<'_>,
    records: &Records,
    all: Cells<C>,
    n_nodes: usize,
) -> Result<(Cells<C>, Vec<Option<u32>>), GmshError> {
    let first = first_alike(cursor, records, &all, n_nodes)?;
    let mut once = Cells::with_capacity(all.cells.len());
    let mut numbers: Vec<u32> = Vec::with_capacity(all.cells.len());
    let mut cell_of_element = vec![None; records.elements.len()];
    for (index, (cell, element)) in all.cells.into_iter().zip(all.elements).enumerate() {
        let number = if first[index] == index {
            once.cells.push(cell);
            once.elements.push(element);
            u32::try_from(once.cells.len() - 1).map_err(|_| GmshError::TooLarge)?
        } else {
            numbers[first[index]]
        };
        numbers.push(number);
        cell_of_element[element] = Some(number);
    }
    Ok((once, cell_of_element))
}

/// Refuses cells that overlap without a common edge or face, by the triangles or tetrahedra of each cell.
pub(super) fn check_covering<const D: usize, const N: usize, C, S>(
    cursor: &Cursor<'_>,
    records: &Records,
    all: &Cells<C>,
    positions: &[[f64; D]],
    simplices: impl Fn(&C) -> S + Sync,
) -> Result<(), GmshError>
where
    C: MeshCell<D>,
    S: Iterator<Item = [u32; N]>,
{
    let corners: Vec<&[u32]> = all.cells.iter().map(C::corners).collect();
    let of_cell = |cell: usize| simplices(&all.cells[cell]);
    let Some([one, other]) = first_covering(positions, &corners, of_cell) else {
        return Ok(());
    };
    let [one, other] = [one, other].map(|cell| all.elements[cell as usize]);
    let [first, second] = [one.min(other), one.max(other)].map(|it| &records.elements[it]);
    Err(GmshError::CoveringCells {
        place: cursor.place(second.offset),
        element: second.tag,
        other: first.tag,
        other_place: cursor.place(first.offset),
    })
}

/// First cell with the same corners, for each cell.
fn first_alike<const D: usize, C: MeshCell<D>>(
    cursor: &Cursor<'_>,
    records: &Records,
    all: &Cells<C>,
    n_nodes: usize,
) -> Result<Vec<usize>, GmshError> {
    // Where cells are repeated, duplicates are only those of one owner.
    let owner = |cell: usize| match records.repeats_cells {
        true => records.elements[all.elements[cell]].owner,
        false => 0,
    };
    let mut first: Vec<usize> = (0..all.cells.len()).collect();
    let mut alike: Vec<([u32; 8], i32, usize)> = Vec::new();
    let (offsets, by_lowest) = by_lowest_corner(&all.cells, n_nodes);
    for range in offsets.windows(2) {
        alike.clear();
        let at_node = by_lowest[range[0]..range[1]].iter();
        alike.extend(at_node.map(|&cell| (key(&all.cells[cell]), owner(cell), cell)));
        alike.sort_unstable();
        let mut pairs = alike.windows(2);
        if let Some(pair) = pairs.find(|pair| (pair[0].0, pair[0].1) == (pair[1].0, pair[1].1)) {
            let [one, other] = all.elements_of(records, [0, 1].map(|k| pair[k].2 as u32));
            return Err(GmshError::DuplicateCell {
                place: cursor.place(other.offset),
                element: other.tag,
                other: one.tag,
            });
        }
        for run in alike.chunk_by(|a, b| a.0 == b.0) {
            let least = run.iter().map(|entry| entry.2).min();
            for entry in run {
                first[entry.2] = least.unwrap_or(entry.2);
            }
        }
    }
    Ok(first)
}

/// Cells in the order of their lowest corners, and the first cell of each node in this order (n_nodes + 1).
fn by_lowest_corner<const D: usize, C: MeshCell<D>>(
    cells: &[C],
    n_nodes: usize,
) -> (Vec<usize>, Vec<usize>) {
    let lowest = |cell: &C| cell.corners().iter().copied().min().unwrap_or_default();
    let mut offsets = vec![0; n_nodes + 1];
    for cell in cells {
        offsets[lowest(cell) as usize + 1] += 1;
    }
    for node in 0..n_nodes {
        offsets[node + 1] += offsets[node];
    }
    let mut next = offsets.clone();
    let mut ordered = vec![0; cells.len()];
    for (number, cell) in cells.iter().enumerate() {
        let free = &mut next[lowest(cell) as usize];
        ordered[*free] = number;
        *free += 1;
    }
    (offsets, ordered)
}

/// Corners of a cell in ascending order: equal for all cells with the same corners.
fn key<const D: usize, C: MeshCell<D>>(cell: &C) -> [u32; 8] {
    let mut key = [u32::MAX; 8];
    key[..cell.corners().len()].copy_from_slice(cell.corners());
    key.sort_unstable();
    key
}
