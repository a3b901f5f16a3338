//! Cells cut into pieces on the sides of a crack.

use ligament_mesh::SolidCell;

use super::detached::with_detached_points_assigned;
use super::pieces::{pieces, solid};
use super::sides::{Links, sides};
use super::tetrahedra::Tetrahedra;
use crate::opened::{OpenedCells, PieceCorners};

/// The cells of a mesh, cut where the crack passes through their tetrahedra: each piece belongs to one side, and its corners on the crack
/// follow the points of that side. `tetrahedra` are the tetrahedra of all cells that have a cut edge.
pub fn opened_cells(
    (positions, cells): (&[[f64; 3]], &[SolidCell]),
    tetrahedra: &Tetrahedra,
    links: &Links,
) -> OpenedCells<SolidCell> {
    let with_detached_points_assigned = with_detached_points_assigned(tetrahedra, links);
    let mut opened = OpenedCells::at_points(positions.to_vec());
    let mut is_cut = vec![false; cells.len()];
    let all = || tetrahedra.corners.iter().zip(&tetrahedra.cells);
    for (corners, cell) in all() {
        is_cut[*cell as usize] |=
            sides(tetrahedra, &with_detached_points_assigned, corners) != [0; 4];
    }
    let mut found = PieceCorners::new();
    for ((number, cell), is_cut) in (0..).zip(cells).zip(&is_cut) {
        if !is_cut {
            opened.cells.push(*cell);
            opened.of.push(number);
            continue;
        }
        for corners in cell.tetrahedra() {
            for piece in pieces(sides(tetrahedra, &with_detached_points_assigned, &corners)) {
                let named = piece.corners.iter();
                let numbers: Vec<u32> = named
                    .map(|of| {
                        let own: Vec<usize> = of
                            .iter()
                            .copied()
                            .filter(|it| piece.side.contains(it))
                            .collect();
                        opened.corner(
                            ascending(&corners, of),
                            ascending(&corners, &own),
                            &mut found,
                        )
                    })
                    .collect();
                if let Some(piece) = solid(&numbers, &opened.positions) {
                    opened.cells.push(piece);
                    opened.of.push(number);
                }
            }
        }
    }
    opened
}

/// Some corners of a tetrahedron by their numbers, ascending.
fn ascending(corners: &[u32; 4], places: &[usize]) -> Vec<u32> {
    let mut numbers: Vec<u32> = places.iter().map(|it| corners[*it]).collect();
    numbers.sort_unstable();
    numbers
}
