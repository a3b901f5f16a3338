//! Cells in pieces that belong to the sides of a crack.

use std::collections::HashMap;

use ligament_mesh::SolidCell;

use super::loose::settled;
use super::sides::{Links, sides};
use super::tetrahedra::Tetrahedra;

/// Cells that no crack goes through, and pieces of those that it does.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct OpenedCells {
    /// What each corner of the cells follows, shape (n_corners): the mean of some points.
    pub follows: Vec<Vec<u32>>,
    /// Positions of the corners, shape (n_corners), m.
    pub positions: Vec<[f64; 3]>,
    /// Cells between the corners.
    pub cells: Vec<SolidCell>,
    /// The cell of the mesh of each, shape (n_cells).
    pub of: Vec<u32>,
}

/// The cells of a mesh, cut where the crack goes through their tetrahedra: each piece belongs to one side, and its corners on the
/// crack follow the points of that side. `tetrahedra` are those in which something is cut, of all cells.
pub fn opened_cells(
    (positions, cells): (&[[f64; 3]], &[SolidCell]),
    tetrahedra: &Tetrahedra,
    links: &Links,
) -> OpenedCells {
    let settled = settled(tetrahedra, links);
    let mut opened = OpenedCells {
        follows: (0..positions.len() as u32)
            .map(|point| vec![point])
            .collect(),
        positions: positions.to_vec(),
        ..OpenedCells::default()
    };
    let mut is_cut = vec![false; cells.len()];
    let all = || tetrahedra.corners.iter().zip(&tetrahedra.cells);
    for (corners, cell) in all() {
        is_cut[*cell as usize] |= sides(tetrahedra, &settled, corners) != [0; 4];
    }
    let mut found: HashMap<(Vec<u32>, Vec<u32>), u32> = HashMap::new();
    for ((number, cell), is_cut) in (0..).zip(cells).zip(&is_cut) {
        if !is_cut {
            opened.cells.push(*cell);
            opened.of.push(number);
            continue;
        }
        for corners in cell.tetrahedra() {
            for piece in pieces(sides(tetrahedra, &settled, &corners)) {
                let mut corner = |of: &Vec<usize>, side: &[usize]| {
                    let mut between: Vec<u32> = of.iter().map(|it| corners[*it]).collect();
                    let own = of.iter().filter(|it| side.contains(it));
                    let mut own: Vec<u32> = own.map(|it| corners[*it]).collect();
                    between.sort_unstable();
                    own.sort_unstable();
                    if let &[point] = between.as_slice() {
                        return point;
                    }
                    *found
                        .entry((between, own))
                        .or_insert_with_key(|(between, own)| {
                            let mean = |axis: usize| {
                                let sum = between.iter().map(|it| positions[*it as usize][axis]);
                                sum.sum::<f64>() / between.len() as f64
                            };
                            opened.positions.push([mean(0), mean(1), mean(2)]);
                            opened.follows.push(own.clone());
                            opened.positions.len() as u32 - 1
                        })
                };
                let numbers: Vec<u32> = piece
                    .corners
                    .iter()
                    .map(|of| corner(of, &piece.side))
                    .collect();
                if let Some(piece) = solid(&numbers) {
                    opened.cells.push(oriented(piece, &opened.positions));
                    opened.of.push(number);
                }
            }
        }
    }
    opened
}

/// A piece of a tetrahedron on a side: each of its corners is the middle of some corners of the tetrahedron.
struct Piece {
    side: Vec<usize>,
    corners: Vec<Vec<usize>>,
}

/// The pieces of a tetrahedron whose corners are on these sides.
fn pieces(sides: [u8; 4]) -> Vec<Piece> {
    let count = sides.iter().max().map_or(0, |it| it + 1);
    let of = |side: u8| {
        let side: Vec<usize> = (0..4).filter(|it| sides[*it] == side).collect();
        let others: Vec<usize> = (0..4).filter(|it| !side.contains(it)).collect();
        let alike = |one: usize, other: usize| sides[one] == sides[other];
        let corners = match (side.as_slice(), others.as_slice()) {
            (&[a, b, c, d], _) => vec![vec![a], vec![b], vec![c], vec![d]],
            (&[a, b, c], &[d]) => {
                vec![
                    vec![a],
                    vec![b],
                    vec![c],
                    vec![a, d],
                    vec![b, d],
                    vec![c, d],
                ]
            }
            (&[c, d], &[a, b]) if alike(a, b) => {
                vec![
                    vec![c],
                    vec![a, c],
                    vec![b, c],
                    vec![d],
                    vec![a, d],
                    vec![b, d],
                ]
            }
            (&[c, d], &[a, b]) => vec![
                vec![c],
                vec![a, c],
                vec![a, b, c],
                vec![b, c],
                vec![d],
                vec![a, d],
                vec![a, b, d],
                vec![b, d],
            ],
            (&[a], &[b, c, d]) if alike(b, c) && alike(c, d) => {
                vec![vec![a], vec![a, b], vec![a, c], vec![a, d]]
            }
            (&[a], &[b, c, d]) if count == 4 => vec![
                vec![a],
                vec![a, b],
                vec![a, b, c],
                vec![a, c],
                vec![a, d],
                vec![a, b, d],
                vec![a, b, c, d],
                vec![a, c, d],
            ],
            (&[a], &[x, y, z]) => {
                // Two of the others are alike: the third has a side of its own.
                let [b, c, d] = match (alike(x, y), alike(y, z)) {
                    (true, _) => [z, x, y],
                    (_, true) => [x, y, z],
                    _ => [y, x, z],
                };
                vec![
                    vec![a],
                    vec![a, c],
                    vec![a, d],
                    vec![a, b],
                    vec![a, b, c],
                    vec![a, b, d],
                ]
            }
            _ => Vec::new(),
        };
        Piece { side, corners }
    };
    (0..count).map(of).collect()
}

fn solid(corners: &[u32]) -> Option<SolidCell> {
    match corners.len() {
        4 => corners.try_into().ok().map(SolidCell::Tetrahedron),
        6 => corners.try_into().ok().map(SolidCell::Prism),
        8 => corners.try_into().ok().map(SolidCell::Hexahedron),
        _ => None,
    }
}

/// The cell turned so that its volume is positive.
fn oriented(cell: SolidCell, positions: &[[f64; 3]]) -> SolidCell {
    if cell.volume(positions) >= 0.0 {
        return cell;
    }
    match cell {
        SolidCell::Tetrahedron([a, b, c, d]) => SolidCell::Tetrahedron([a, c, b, d]),
        SolidCell::Prism([a, b, c, d, e, f]) => SolidCell::Prism([d, e, f, a, b, c]),
        SolidCell::Hexahedron([a, b, c, d, e, f, g, h]) => {
            SolidCell::Hexahedron([e, f, g, h, a, b, c, d])
        }
        SolidCell::Pyramid([a, b, c, d, e]) => SolidCell::Pyramid([a, d, c, b, e]),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The pieces of every case fill the tetrahedron.
    #[test]
    fn pieces_fill_the_tetrahedron() {
        let nodes = [
            [0.0, 0.0, 0.0],
            [2.0, 0.0, 0.5],
            [0.0, 1.5, 0.0],
            [0.3, 0.1, 1.0],
        ];
        let whole = SolidCell::Tetrahedron([0, 1, 2, 3]).volume(&nodes);
        let cases = [
            [0, 0, 0, 0],
            [0, 1, 1, 1],
            [0, 1, 0, 0],
            [0, 0, 0, 1],
            [0, 0, 1, 1],
            [0, 1, 0, 1],
            [0, 1, 1, 0],
            [0, 1, 2, 2],
            [0, 1, 2, 1],
            [0, 1, 1, 2],
            [0, 0, 1, 2],
            [0, 1, 0, 2],
            [0, 1, 2, 0],
            [0, 1, 2, 3],
        ];
        for sides in cases {
            let mut sum = 0.0;
            for piece in pieces(sides) {
                let mean = |of: &Vec<usize>| {
                    [0, 1, 2].map(|axis| {
                        of.iter().map(|it| nodes[*it][axis]).sum::<f64>() / of.len() as f64
                    })
                };
                let positions: Vec<[f64; 3]> = piece.corners.iter().map(mean).collect();
                let numbers: Vec<u32> = (0..positions.len() as u32).collect();
                let cell = oriented(solid(&numbers).unwrap(), &positions);
                assert!(cell.volume(&positions) > 0.0, "{sides:?}");
                sum += cell.volume(&positions);
            }
            assert!((sum - whole).abs() < 1e-14, "{sides:?}: {sum} of {whole}");
        }
    }
}
