//! The solid cells: their shape, their orientation, and those that stand twice in the file.

use super::super::cursor::Cursor;
use super::super::element_type::Shape;
use super::super::error::GmshError;
use super::super::records::{Element, Records};
use crate::cell::MeshCell;
use crate::solid::SolidCell;

/// Volume between the edges at a corner of a cell, as a part of the cube of its longest edge, below which the cell is flat.
const FLATNESS: f64 = 1e-8;

/// Solid cells and the indices of the elements that they were.
pub(super) struct SolidCells {
    pub(super) cells: Vec<SolidCell>,
    pub(super) elements: Vec<usize>,
}

/// The solid cells, of positive volume.
pub(super) fn oriented(
    cursor: &Cursor<'_>,
    records: &Records,
    corners: &[u32],
    positions: &[[f64; 3]],
) -> Result<SolidCells, GmshError> {
    let mut solid = SolidCells {
        cells: Vec::new(),
        elements: Vec::new(),
    };
    for (index, element) in records.elements.iter().enumerate() {
        if let Some(cell) = cell(element.shape, &corners[element.corners()]) {
            check_corners(cursor, records, element)?;
            solid.cells.push(orient(cursor, element, cell, positions)?);
            solid.elements.push(index);
        }
    }
    Ok(solid)
}

fn cell(shape: Shape, corners: &[u32]) -> Option<SolidCell> {
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

/// Turns a cell that is inside out; refuses it if it has no volume or is not convex.
fn orient(
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
    let oriented = if smallest > least {
        cell
    } else if largest < -least {
        turned(cell)
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
    let is_tetrahedron = matches!(oriented, SolidCell::Tetrahedron(_));
    let volume = |part: [u32; 4]| SolidCell::Tetrahedron(part).volume(positions);
    if is_tetrahedron || oriented.tetrahedra().all(|part| volume(part) > 0.0) {
        return Ok(oriented);
    }
    Err(GmshError::NotConvexSolid {
        place: place(),
        element: element.tag,
        shape,
    })
}

/// The tetrahedra between the three edges at each corner of a cell, at the apex of a pyramid excepted.
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

/// The cell turned inside out: top and base change places, or the corners of the base go round the other way.
fn turned(cell: SolidCell) -> SolidCell {
    match cell {
        SolidCell::Tetrahedron([a, b, c, d]) => SolidCell::Tetrahedron([a, c, b, d]),
        SolidCell::Hexahedron([a, b, c, d, e, f, g, h]) => {
            SolidCell::Hexahedron([e, f, g, h, a, b, c, d])
        }
        SolidCell::Prism([a, b, c, d, e, f]) => SolidCell::Prism([d, e, f, a, b, c]),
        SolidCell::Pyramid([a, b, c, d, e]) => SolidCell::Pyramid([a, d, c, b, e]),
    }
}

/// The cells each once, and the number of the cell of each element that is one.
///
/// In format 2.2 a cell stands in the file once for each of its groups: those become one. Any other cell that stands there twice
/// is refused.
pub(super) fn merge_repeated(
    cursor: &Cursor<'_>,
    records: &Records,
    solid: SolidCells,
    n_nodes: usize,
) -> Result<(SolidCells, Vec<Option<u32>>), GmshError> {
    let first = first_alike(cursor, records, &solid, n_nodes)?;
    let mut once = SolidCells {
        cells: Vec::with_capacity(solid.cells.len()),
        elements: Vec::with_capacity(solid.cells.len()),
    };
    let mut numbers: Vec<u32> = Vec::with_capacity(solid.cells.len());
    let mut cell_of_element = vec![None; records.elements.len()];
    for (index, (cell, element)) in solid.cells.into_iter().zip(solid.elements).enumerate() {
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

/// For each cell the first one of the same corners.
fn first_alike(
    cursor: &Cursor<'_>,
    records: &Records,
    solid: &SolidCells,
    n_nodes: usize,
) -> Result<Vec<usize>, GmshError> {
    // Where cells are repeated, only those of one owner are alike.
    let owner = |cell: usize| match records.repeats_cells {
        true => records.elements[solid.elements[cell]].owner,
        false => 0,
    };
    let mut first: Vec<usize> = (0..solid.cells.len()).collect();
    let mut alike: Vec<([u32; 8], i32, usize)> = Vec::new();
    let (offsets, by_lowest) = by_lowest_corner(&solid.cells, n_nodes);
    for range in offsets.windows(2) {
        alike.clear();
        let at_node = by_lowest[range[0]..range[1]].iter();
        alike.extend(at_node.map(|&cell| (key(&solid.cells[cell]), owner(cell), cell)));
        alike.sort_unstable();
        let mut pairs = alike.windows(2);
        if let Some(pair) = pairs.find(|pair| (pair[0].0, pair[0].1) == (pair[1].0, pair[1].1)) {
            let [one, other] = [0, 1].map(|k| &records.elements[solid.elements[pair[k].2]]);
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

/// The cells in the order of their lowest corners, and where those of each node begin (n_nodes + 1).
fn by_lowest_corner(cells: &[SolidCell], n_nodes: usize) -> (Vec<usize>, Vec<usize>) {
    let lowest = |cell: &SolidCell| cell.corners().iter().copied().min().unwrap_or_default();
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

/// The corners of a cell in ascending order: the same for every cell of the same corners.
fn key(cell: &SolidCell) -> [u32; 8] {
    let mut key = [u32::MAX; 8];
    key[..cell.corners().len()].copy_from_slice(cell.corners());
    key.sort_unstable();
    key
}
