//! Cells of a mesh from the elements of a file, with checks for repeated and overlapping cells.

use super::assembly::Assembly;
use super::collapsed::{Collapsible, first_repeated};
use super::cursor::Cursor;
use super::element_type::Shape;
use super::error::GmshError;
use super::records::{Element, Records};
use crate::cell::MeshCell;
use crate::overlap::first_covering;
use crate::remark::Remark;

/// Cells and the indices of their elements.
pub(super) struct Cells<C> {
    pub(super) cells: Vec<C>,
    pub(super) elements: Vec<u32>,
    /// Number of elements with a repeated corner, which are cells with fewer corners.
    pub(super) n_collapsed: usize,
}

impl<C> Cells<C> {
    /// Cells made by `cell` from the shapes of elements and their corners (numbers of nodes), and oriented by `oriented`.
    pub(super) fn from_elements(
        cursor: &Cursor<'_>,
        records: &Records,
        assembly: &Assembly,
        cell: impl Fn(Shape, &[u32]) -> Option<C>,
        oriented: impl Fn(&Element, C) -> Result<C, GmshError>,
    ) -> Result<Self, GmshError>
    where
        C: Collapsible,
    {
        let mut found = Self {
            cells: Vec::with_capacity(records.elements.len()),
            elements: Vec::with_capacity(records.elements.len()),
            n_collapsed: 0,
        };
        for (index, element) in (0..).zip(&records.elements) {
            let corners = &assembly.corners[element.corners()];
            let Some(mut cell) = cell(element.shape, corners) else {
                continue;
            };
            if let Some(repeated) = first_repeated(corners) {
                let unreadable = || GmshError::RepeatedCorner {
                    place: cursor.place(element.offset),
                    element: element.tag,
                    node: assembly.nodes[repeated as usize].tag,
                };
                cell = cell.collapsed().ok_or_else(unreadable)?;
                found.n_collapsed += 1;
            }
            found.cells.push(oriented(element, cell)?);
            found.elements.push(index);
        }
        Ok(found)
    }

    /// Remarks on cells with a repeated corner, and on the faces of a crack.
    pub(super) fn remarks(&self, crack_faces: usize) -> impl Iterator<Item = Remark> {
        let cells = self.n_collapsed;
        let collapsed = (cells > 0).then_some(Remark::CollapsedCells { cells });
        let crack = (crack_faces > 0).then_some(Remark::Crack { faces: crack_faces });
        collapsed.into_iter().chain(crack)
    }

    /// Number of cells made from elements of higher order.
    pub(super) fn n_higher_order(&self, records: &Records) -> usize {
        let elements = self.elements.iter();
        let higher = elements.filter(|element| records.elements[**element as usize].higher_order);
        higher.count()
    }

    /// Element records from which cells were made.
    pub(super) fn elements_of<'a, const N: usize>(
        &self,
        records: &'a Records,
        cells: [u32; N],
    ) -> [&'a Element; N] {
        cells.map(|cell| &records.elements[self.elements[cell as usize] as usize])
    }
}

/// Merges repeated cells; returns the cells, each once, and the number of the cell of each element, if any.
///
/// In format 2.2 a cell occurs in the file once for each of its groups: these are merged. Any other repeated cell is refused.
pub(super) fn merge_repeated<const D: usize, C: MeshCell<D>>(
    cursor: &Cursor<'_>,
    records: &Records,
    mut all: Cells<C>,
    n_nodes: usize,
) -> Result<(Cells<C>, Vec<Option<u32>>), GmshError> {
    let first = first_with_same_corners(cursor, records, &all, n_nodes)?;
    let is_first = || (0..).zip(&first).map(|(cell, first)| cell == *first);
    let mut numbers: Vec<u32> = Vec::with_capacity(first.len());
    let mut n_once = 0;
    for (is_first, &first) in is_first().zip(&first) {
        numbers.push(if is_first {
            n_once
        } else {
            numbers[first as usize]
        });
        n_once += u32::from(is_first);
    }
    let mut cell_of_element = vec![None; records.elements.len()];
    for (&element, &number) in all.elements.iter().zip(&numbers) {
        cell_of_element[element as usize] = Some(number);
    }
    let (mut of_cells, mut of_elements) = (is_first(), is_first());
    all.cells.retain(|_| of_cells.next() == Some(true));
    all.elements.retain(|_| of_elements.next() == Some(true));
    Ok((all, cell_of_element))
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
    let Some([one, other]) = first_covering(positions, &all.cells, simplices) else {
        return Ok(());
    };
    let [first, second] = all.elements_of(records, [one.min(other), one.max(other)]);
    Err(GmshError::CoveringCells {
        place: cursor.place(second.offset),
        element: second.tag,
        other: first.tag,
        other_place: cursor.place(first.offset),
    })
}

/// First cell with the corners of each cell, shape (n_cells).
fn first_with_same_corners<const D: usize, C: MeshCell<D>>(
    cursor: &Cursor<'_>,
    records: &Records,
    all: &Cells<C>,
    n_nodes: usize,
) -> Result<Vec<u32>, GmshError> {
    let n_cells = u32::try_from(all.cells.len()).map_err(|_| GmshError::TooLarge)?;
    // In a file that repeats a cell for each of its groups, equal cells are duplicates only within one group.
    let owner = |cell: u32| match records.repeats_cells {
        // A negative owner is an entity.
        true => all.elements_of(records, [cell])[0].owner.max(0),
        false => 0,
    };
    let mut first: Vec<u32> = (0..n_cells).collect();
    let mut alike: Vec<([u32; 8], i32, u32)> = Vec::new();
    let (offsets, by_lowest) = by_lowest_corner(&all.cells, n_nodes);
    for range in offsets.windows(2) {
        alike.clear();
        let at_node = by_lowest[range[0]..range[1]].iter();
        alike.extend(at_node.map(|&cell| (key(&all.cells[cell as usize]), owner(cell), cell)));
        alike.sort_unstable();
        let mut pairs = alike.windows(2);
        if let Some(pair) = pairs.find(|pair| (pair[0].0, pair[0].1) == (pair[1].0, pair[1].1)) {
            let [one, other] = all.elements_of(records, [0, 1].map(|k| pair[k].2));
            return Err(GmshError::DuplicateCell {
                place: cursor.place(other.offset),
                element: other.tag,
                other: one.tag,
            });
        }
        for run in alike.chunk_by(|a, b| a.0 == b.0) {
            let least = run.iter().map(|entry| entry.2).min();
            for entry in run {
                first[entry.2 as usize] = least.unwrap_or(entry.2);
            }
        }
    }
    Ok(first)
}

/// Cells in the order of their lowest corners, and the first cell of each node in this order (n_nodes + 1).
fn by_lowest_corner<const D: usize, C: MeshCell<D>>(
    cells: &[C],
    n_nodes: usize,
) -> (Vec<usize>, Vec<u32>) {
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
    for (number, cell) in (0..).zip(cells) {
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
