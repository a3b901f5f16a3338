//! Cells of a body in the plane, cut into pieces along its open faces.

use std::collections::HashMap;

use ligament_mesh::Cell;
use ligament_model::raised;

use crate::opened::{OpenedCells, PieceCorners};

/// The cells of a mesh, cut along the faces between the cells of its points ([`Faces`](super::Faces)) where pairs of points are separated: a
/// cell with corners on several [sides](sides_of_cells) falls into pieces between the middles of its parted edges and the middle of the
/// cell, and the corners of a piece on the crack follow the points of the piece.
pub fn opened_cells(
    (positions, cells): (&[[f64; 2]], &[Cell]),
    is_parted: impl Fn([u32; 2]) -> bool,
) -> OpenedCells<Cell> {
    let mut opened = OpenedCells::at_points(raised(positions));
    let mut found = PieceCorners::new();
    let sides = sides_of_cells(cells, is_parted);
    for ((number, cell), sides) in (0..).zip(cells).zip(&sides) {
        let corners = cell.corners();
        let next = |place: usize| (place + 1) % corners.len();
        let parted = (0..corners.len()).filter(|&it| sides[it] != sides[next(it)]);
        let parted: Vec<usize> = parted.collect();
        if parted.is_empty() {
            opened.cells.push(*cell);
            opened.of.push(number);
            continue;
        }
        let mut all = corners.to_vec();
        all.sort_unstable();
        for (before, after) in parted.iter().zip(parted.iter().cycle().skip(1)) {
            // Corners of the piece from the end of one parted edge to the start of the next.
            let count = (after + corners.len() - before - 1) % corners.len() + 1;
            let side: Vec<u32> = (1..=count)
                .map(|it| corners[(before + it) % corners.len()])
                .collect();
            let mut own = side.clone();
            own.sort_unstable();
            let mut middle = |point: u32, other: u32| {
                let between = vec![point.min(other), point.max(other)];
                opened.corner(between, vec![point], &mut found)
            };
            let first = middle(side[0], corners[*before]);
            let last = middle(side[count - 1], corners[next(*after)]);
            let centre = opened.corner(all.clone(), own, &mut found);
            let rim: Vec<u32> = [&[first], side.as_slice(), &[last]].concat();
            for pair in rim.windows(2) {
                opened
                    .cells
                    .push(Cell::Triangle([centre, pair[0], pair[1]]));
                opened.of.push(number);
            }
        }
    }
    opened
}

/// Sides of the crack on which the corners of the cells (n_cells) of a mesh lie where pairs of points are separated, numbered from the side of
/// the first corner: two or more parted edges of a cell separate the corners between them. All are 0 in a cell that shares no parted edge
/// with another such cell, because no crack continues there; the fourth of a triangle is always 0.
pub fn sides_of_cells(cells: &[Cell], is_parted: impl Fn([u32; 2]) -> bool) -> Vec<[u8; 4]> {
    let parted_edges = |cell: &Cell| -> Vec<usize> {
        let edges = (0..cell.corners().len()).filter(|&place| is_parted(edge(cell, place)));
        edges.collect()
    };
    let mut n_cracked: HashMap<[u32; 2], usize> = HashMap::new();
    let cracked: Vec<Vec<usize>> = cells.iter().map(parted_edges).collect();
    let with_two = |(_, parted): &(&Cell, &Vec<usize>)| parted.len() > 1;
    for (cell, parted) in cells.iter().zip(&cracked).filter(with_two) {
        for &place in parted {
            *n_cracked.entry(edge(cell, place)).or_default() += 1;
        }
    }
    let sides = |(cell, parted): (&Cell, &Vec<usize>)| {
        let mut goes_on = parted
            .iter()
            .map(|&place| n_cracked.get(&edge(cell, place)));
        let mut sides = [0; 4];
        if parted.len() > 1 && goes_on.any(|count| count == Some(&2)) {
            for (corner, side) in sides.iter_mut().enumerate().take(cell.corners().len()) {
                let before = parted.iter().filter(|&&place| place < corner).count();
                *side = (before % parted.len()) as u8;
            }
        }
        sides
    };
    cells.iter().zip(&cracked).map(sides).collect()
}

/// Points at the ends of the edge of a cell from a corner to the next, ascending.
fn edge(cell: &Cell, place: usize) -> [u32; 2] {
    let corners = cell.corners();
    let [a, b] = [corners[place], corners[(place + 1) % corners.len()]];
    [a.min(b), a.max(b)]
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Two squares beside each other with triangles above them.
    const PLACES: [[f64; 2]; 8] = [
        [0.0, 0.0],
        [2.0, 0.0],
        [4.0, 0.0],
        [0.0, 2.0],
        [2.0, 2.0],
        [4.0, 2.0],
        [1.0, 4.0],
        [3.0, 4.0],
    ];

    const CELLS: [Cell; 4] = [
        Cell::Quadrangle([0, 1, 4, 3]),
        Cell::Quadrangle([1, 2, 5, 4]),
        Cell::Triangle([3, 4, 6]),
        Cell::Triangle([4, 5, 7]),
    ];

    fn opened(parted: &[[u32; 2]]) -> OpenedCells<Cell> {
        let opened = opened_cells((&PLACES, &CELLS), |pair| parted.contains(&pair));
        let places: Vec<[f64; 2]> = opened.positions.iter().map(|it| [it[0], it[1]]).collect();
        let areas: Vec<f64> = opened.cells.iter().map(|it| it.area(&places)).collect();
        assert!(areas.iter().all(|it| *it > 0.0), "{areas:?}");
        assert!((areas.iter().sum::<f64>() - 12.0).abs() < 1e-14);
        opened
    }

    /// Squares that are parted along a row fall into halves, and the triangles, with at most one parted edge, stay whole. The pieces fill
    /// the cells, and their corners follow the points of their side.
    #[test]
    fn a_row_falls_into_halves() {
        let opened = opened(&[[0, 3], [1, 4], [2, 5]]);
        assert_eq!(opened.cells[opened.cells.len() - 2..], CELLS[2..]);
        let moved = opened.means(|point| f64::from(u8::from(point > 2)));
        for cell in &opened.cells {
            let side = cell.corners().iter().map(|it| moved[*it as usize]);
            let side: Vec<f64> = side.collect();
            assert!(side.iter().all(|it| *it == side[0]), "{side:?}");
        }
    }

    /// A crack that turns into a triangle parts one of its corners from the others; where all of its edges are parted, every corner.
    #[test]
    fn a_triangle_falls_into_pieces() {
        let count = |opened: &OpenedCells<Cell>| opened.of.iter().filter(|it| **it == 2).count();
        assert_eq!(count(&opened(&[[0, 3], [3, 4], [4, 6]])), 5);
        assert_eq!(count(&opened(&[[0, 3], [3, 4], [3, 6], [4, 6]])), 6);
    }

    /// Sides are numbered around the cell from the side of its first corner.
    #[test]
    fn corners_between_parted_edges_are_on_one_side() {
        let sides = |parted: &[[u32; 2]]| sides_of_cells(&CELLS, |pair| parted.contains(&pair));
        let [left, right, above, whole] = sides(&[[0, 3], [1, 4], [2, 5]])[..] else {
            panic!("a cell is missing");
        };
        assert_eq!(left, [0, 0, 1, 1]);
        assert_eq!(right, [0, 0, 1, 1]);
        assert_eq!([above, whole], [[0; 4]; 2]);
        assert_eq!(sides(&[[0, 3], [0, 1], [1, 4], [2, 5]])[0], [0, 1, 2, 2]);
        assert_eq!(sides(&[[0, 3], [3, 4], [3, 6], [4, 6]])[2], [0, 1, 2, 0]);
    }

    #[test]
    fn parted_edges_of_one_cell_alone_are_no_crack() {
        assert_eq!(opened(&[[0, 3], [0, 1], [4, 6]]).cells, CELLS);
    }
}
