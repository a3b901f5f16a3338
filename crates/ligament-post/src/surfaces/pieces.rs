//! Pieces of a tetrahedron on the sides of a crack.

use ligament_mesh::SolidCell;

/// A piece of a tetrahedron on a side: each of its corners is the middle of some corners of the tetrahedron.
pub(super) struct Piece {
    /// Corners of the tetrahedron on the side.
    pub(super) side: Vec<usize>,
    /// Corners of the piece, in the order of a cell.
    pub(super) corners: Vec<Vec<usize>>,
}

/// The pieces of a tetrahedron whose corners are on given sides.
pub(super) fn pieces(sides: [u8; 4]) -> Vec<Piece> {
    let count = sides.iter().max().map_or(0, |it| it + 1);
    let piece = |number: u8| {
        let side: Vec<usize> = (0..4).filter(|it| sides[*it] == number).collect();
        let others: Vec<usize> = (0..4).filter(|it| sides[*it] != number).collect();
        let named: &[&[usize]] = match (side.as_slice(), others.as_slice()) {
            (&[a, b, c, d], _) => &[&[a], &[b], &[c], &[d]],
            (&[a, b, c], &[d]) => &[&[a], &[b], &[c], &[a, d], &[b, d], &[c, d]],
            (&[c, d], &[a, b]) => {
                return Piece {
                    corners: two_corner_pieces([c, d], [a, b], sides),
                    side,
                };
            }
            (&[a], &[b, c, d]) => {
                return Piece {
                    corners: one_corner_pieces(a, [b, c, d], sides),
                    side,
                };
            }
            _ => &[],
        };
        Piece {
            corners: named.iter().map(|it| it.to_vec()).collect(),
            side,
        }
    };
    (0..count).map(piece).collect()
}

/// The piece of two corners: a prism where the other two are on one side, else a hexahedron.
fn two_corner_pieces([c, d]: [usize; 2], [a, b]: [usize; 2], sides: [u8; 4]) -> Vec<Vec<usize>> {
    let between = |own: usize| vec![vec![own], vec![a, own], vec![a, b, own], vec![b, own]];
    let mut corners = [between(c), between(d)].concat();
    if sides[a] == sides[b] {
        corners.retain(|it| it.len() < 3);
    }
    corners
}

/// The piece of one corner: a tetrahedron where the others are on one side, a prism where they are on two, else a hexahedron.
fn one_corner_pieces(a: usize, [x, y, z]: [usize; 3], sides: [u8; 4]) -> Vec<Vec<usize>> {
    let alike = |one: usize, other: usize| sides[one] == sides[other];
    // Where two of the others are on one side, the third stands first.
    let [b, c, d] = match [alike(x, y), alike(y, z), alike(x, z)] {
        [true, true, _] => return vec![vec![a], vec![a, x], vec![a, y], vec![a, z]],
        [true, ..] => [z, x, y],
        [_, true, _] => [x, y, z],
        [.., true] => [y, x, z],
        _ => {
            let bottom = [vec![a], vec![a, x], vec![a, x, y], vec![a, y]];
            let top = [vec![a, z], vec![a, x, z], vec![a, x, y, z], vec![a, y, z]];
            return [bottom, top].concat();
        }
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

/// The cell with given corners, oriented to positive volume; `None` for numbers of corners without a cell.
pub(super) fn solid(corners: &[u32], positions: &[[f64; 3]]) -> Option<SolidCell> {
    let cell = match corners.len() {
        4 => corners.try_into().ok().map(SolidCell::Tetrahedron),
        6 => corners.try_into().ok().map(SolidCell::Prism),
        8 => corners.try_into().ok().map(SolidCell::Hexahedron),
        _ => None,
    };
    Some(oriented(cell?, positions))
}

/// The cell oriented to positive volume.
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
#[allow(clippy::unwrap_used, reason = "a failed unwrap fails the test")]
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
                let cell = solid(&numbers, &positions).unwrap();
                assert!(cell.volume(&positions) > 0.0, "{sides:?}");
                sum += cell.volume(&positions);
            }
            assert!((sum - whole).abs() < 1e-14, "{sides:?}: {sum} of {whole}");
        }
    }
}
