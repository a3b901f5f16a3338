//! Cells cut into pieces on the sides of a crack.

use std::collections::HashMap;

use ligament_mesh::SolidCell;

use super::detached::with_detached_points_assigned;
use super::pieces::{pieces, solid};
use super::sides::{Links, sides};
use super::tetrahedra::Tetrahedra;

/// Cells without a crack, and pieces of the cells cut by a crack.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct OpenedCells {
    /// Points whose mean displacement each corner of the cells has, shape (n_corners).
    pub follows: Vec<Vec<u32>>,
    /// Positions of the corners, shape (n_corners), m.
    pub positions: Vec<[f64; 3]>,
    /// Cells between the corners.
    pub cells: Vec<SolidCell>,
    /// Cell of the mesh that contains each cell or piece, shape (n_cells).
    pub of: Vec<u32>,
}

/// Numbers of corners of pieces by the points between which they lie, and those of their side.
type Found = HashMap<(Vec<u32>, Vec<u32>), u32>;

/// The cells of a mesh, cut where the crack passes through their tetrahedra: each piece belongs to one side, and its corners on the crack
/// follow the points of that side. `tetrahedra` are those with a cut edge, of all cells.
pub fn opened_cells(
    (positions, cells): (&[[f64; 3]], &[SolidCell]),
    tetrahedra: &Tetrahedra,
    links: &Links,
) -> OpenedCells {
    let with_detached_points_assigned = with_detached_points_assigned(tetrahedra, links);
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
        is_cut[*cell as usize] |=
            sides(tetrahedra, &with_detached_points_assigned, corners) != [0; 4];
    }
    let mut found = Found::new();
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
                    .map(|of| opened.corner(&corners, of, &piece.side, &mut found))
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

impl OpenedCells {
    /// Corner of a piece in the middle of some corners of a tetrahedron, which follows those of them on a side.
    fn corner(
        &mut self,
        corners: &[u32; 4],
        of: &[usize],
        side: &[usize],
        found: &mut Found,
    ) -> u32 {
        let named = |all: &mut dyn Iterator<Item = &usize>| {
            let mut named: Vec<u32> = all.map(|it| corners[*it]).collect();
            named.sort_unstable();
            named
        };
        let between = named(&mut of.iter());
        if let &[point] = between.as_slice() {
            return point;
        }
        let own = named(&mut of.iter().filter(|it| side.contains(it)));
        *found
            .entry((between, own))
            .or_insert_with_key(|(between, own)| {
                let mean = |axis: usize| {
                    let all = between.iter().map(|it| self.positions[*it as usize][axis]);
                    all.sum::<f64>() / between.len() as f64
                };
                let middle = [mean(0), mean(1), mean(2)];
                self.positions.push(middle);
                self.follows.push(own.clone());
                self.positions.len() as u32 - 1
            })
    }
}
