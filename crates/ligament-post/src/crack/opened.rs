//! Cells of a body in the plane, cut into pieces along its open faces.

use std::collections::HashMap;

use ligament_mesh::Cell;
use ligament_model::raised;

use crate::opened::{Found, OpenedCells};

/// The cells of a mesh, cut along the faces between the cells of its points ([`Faces`](super::Faces)) where pairs of points are parted: a
/// cell with two or more such edges falls into pieces between the middles of these edges and the middle of the cell, and the corners of a
/// piece on the crack follow the points of the piece. A cell that alone has such edges, where no crack goes on, stays whole.
pub fn opened_cells(
    (positions, cells): (&[[f64; 2]], &[Cell]),
    is_parted: impl Fn([u32; 2]) -> bool,
) -> OpenedCells<Cell> {
    let parted_sides = |cell: &Cell| -> Vec<usize> {
        let sides = (0..cell.corners().len()).filter(|&place| is_parted(side(cell, place)));
        sides.collect()
    };
    let mut n_cracked: HashMap<[u32; 2], usize> = HashMap::new();
    let cracked: Vec<Vec<usize>> = cells.iter().map(parted_sides).collect();
    let with_two = |(_, parted): &(&Cell, &Vec<usize>)| parted.len() > 1;
    for (cell, parted) in cells.iter().zip(&cracked).filter(with_two) {
        for &place in parted {
            *n_cracked.entry(side(cell, place)).or_default() += 1;
        }
    }
    let mut opened = OpenedCells::at_points(raised(positions));
    let mut found = Found::new();
    for ((number, cell), parted) in (0..).zip(cells).zip(&cracked) {
        let corners = cell.corners();
        let next = |place: usize| (place + 1) % corners.len();
        let goes_on = parted
            .iter()
            .any(|&place| n_cracked.get(&side(cell, place)) == Some(&2));
        if parted.len() < 2 || !goes_on {
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

/// Points at the ends of the side of a cell from a corner to the next, ascending.
fn side(cell: &Cell, place: usize) -> [u32; 2] {
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

    /// Squares that are parted along a row fall into halves, and the triangles, of which one edge is parted at most, stay whole. The pieces fill
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

    #[test]
    fn parted_edges_of_one_cell_alone_are_no_crack() {
        assert_eq!(opened(&[[0, 3], [0, 1], [4, 6]]).cells, CELLS);
    }
}
