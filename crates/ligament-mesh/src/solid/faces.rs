//! Which cells have which faces.

use super::cell::SolidCell;
use crate::cell::Cell;

/// The faces of solid cells, found by their lowest node.
#[derive(Debug)]
pub struct Faces<'a> {
    cells: &'a [SolidCell],
    /// Where the faces of each lowest node begin, shape (n_nodes + 1).
    offsets: Vec<usize>,
    /// Cells and places of faces among those of the cell.
    entries: Vec<(u32, u8)>,
}

/// A face as a side of one cell.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Side {
    /// The face, its corners counter-clockwise seen from outside of the cell.
    pub face: Cell,
    /// Number of the cell.
    pub cell: u32,
}

/// What tells faces of one lowest node apart: the other corners from the one beside it that has the lower number to that which
/// has the higher, with none for the last of a triangle; and whether the face goes through them in this order.
type Key = ([u32; 3], bool);

impl<'a> Faces<'a> {
    /// The faces of cells on `n_nodes` nodes.
    ///
    /// # Panics
    ///
    /// If a corner is no index below `n_nodes`, or there are more than 2^32 cells.
    pub fn new(cells: &'a [SolidCell], n_nodes: usize) -> Self {
        let mut offsets = vec![0; n_nodes + 1];
        for node in cells.iter().flat_map(lowest_nodes) {
            offsets[node as usize + 1] += 1;
        }
        for node in 0..n_nodes {
            offsets[node + 1] += offsets[node];
        }
        let mut next = offsets.clone();
        let mut entries = vec![(0, 0); offsets[n_nodes]];
        for (number, cell) in (0..).zip(cells) {
            for (place, node) in (0..).zip(lowest_nodes(cell)) {
                let free = &mut next[node as usize];
                entries[*free] = (number, place);
                *free += 1;
            }
        }
        Self {
            cells,
            offsets,
            entries,
        }
    }

    /// The sides of cells that are this face, whatever the order of its corners around it, by the number of their cells: none, one
    /// on the outline, two inside.
    pub fn sides_at(&self, face: &Cell) -> Vec<Side> {
        let lowest = face.corners().iter().copied().min().unwrap_or_default();
        let (wanted, _) = key(face);
        let sides = self.sides_of(lowest);
        sides.filter(|side| key(&side.face).0 == wanted).collect()
    }

    /// The faces that one cell has alone, by their lowest node.
    pub fn outer(&self) -> Vec<Side> {
        let mut outer = Vec::new();
        self.for_each(|sides| {
            if let [(_, side)] = sides {
                outer.push(*side);
            }
        });
        outer
    }

    /// The first two cells found on the same side of a common face: one of them covers some of the other.
    pub(crate) fn first_overlap(&self) -> Option<[u32; 2]> {
        let mut found: Option<[u32; 2]> = None;
        self.for_each(|sides| {
            // Neighbours go around their common face in opposite directions.
            let alike = sides.windows(2).find(|pair| pair[0].0 == pair[1].0);
            if let (Some(pair), None) = (alike, found) {
                found = Some([pair[0].1.cell, pair[1].1.cell]);
            }
        });
        found
    }

    fn sides_of(&self, lowest: u32) -> impl Iterator<Item = Side> + '_ {
        let range = self.offsets[lowest as usize]..self.offsets[lowest as usize + 1];
        self.entries[range].iter().map(|&(cell, place)| Side {
            face: self.cells[cell as usize].face(place as usize),
            cell,
        })
    }

    /// Calls a function with the sides at each face, in the order of the lowest nodes.
    fn for_each(&self, mut call: impl FnMut(&[(Key, Side)])) {
        let mut sides: Vec<(Key, Side)> = Vec::new();
        for lowest in 0..self.offsets.len() as u32 - 1 {
            sides.clear();
            sides.extend(self.sides_of(lowest).map(|side| (key(&side.face), side)));
            sides.sort_unstable_by_key(|(key, side)| (*key, side.cell));
            for at_face in sides.chunk_by(|one, other| one.0.0 == other.0.0) {
                call(at_face);
            }
        }
    }
}

fn lowest_nodes(cell: &SolidCell) -> impl Iterator<Item = u32> {
    let lowest = |face: Cell| face.corners().iter().copied().min().unwrap_or_default();
    cell.faces().map(lowest)
}

fn key(face: &Cell) -> Key {
    let ordered = |first: u32, middle: u32, last: u32| match first < last {
        true => ([first, middle, last], true),
        false => ([last, middle, first], false),
    };
    match *face {
        Cell::Triangle([a, b, c]) => {
            let [first, last] = match a.min(b).min(c) {
                lowest if lowest == a => [b, c],
                lowest if lowest == b => [c, a],
                _ => [a, b],
            };
            ordered(first, u32::MAX, last)
        }
        Cell::Quadrangle(corners) => {
            let lowest = (0..4)
                .min_by_key(|&place| corners[place])
                .unwrap_or_default();
            let after = |steps: usize| corners[(lowest + steps) % 4];
            ordered(after(1), after(2), after(3))
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A hexahedron, a prism and a pyramid on three of its faces, and a tetrahedron on the pyramid.
    fn cells() -> [SolidCell; 4] {
        [
            SolidCell::Hexahedron([0, 1, 2, 3, 4, 5, 6, 7]),
            SolidCell::Prism([1, 8, 2, 5, 9, 6]),
            SolidCell::Pyramid([4, 5, 6, 7, 10]),
            SolidCell::Tetrahedron([5, 6, 10, 11]),
        ]
    }

    #[test]
    fn outer_faces_are_those_of_one_cell() {
        let cells = cells();
        let faces = Faces::new(&cells, 12);
        let mut outer = [0; 4];
        for side in faces.outer() {
            outer[side.cell as usize] += 1;
            assert!(
                cells[side.cell as usize]
                    .faces()
                    .any(|face| face == side.face)
            );
        }
        assert_eq!(outer, [4, 4, 3, 3]);
        assert_eq!(faces.first_overlap(), None);
        let common = faces.sides_at(&Cell::Quadrangle([6, 2, 1, 5]));
        assert_eq!(
            common.iter().map(|side| side.cell).collect::<Vec<_>>(),
            [0, 1]
        );
        assert_eq!(faces.sides_at(&Cell::Triangle([6, 10, 5])).len(), 2);
        assert_eq!(faces.sides_at(&Cell::Triangle([6, 11, 5])).len(), 1);
        // The same corners, but not around the same face.
        assert!(faces.sides_at(&Cell::Quadrangle([6, 1, 2, 5])).is_empty());
        assert!(faces.sides_at(&Cell::Triangle([0, 1, 2])).is_empty());
    }

    #[test]
    fn cells_on_the_same_side_of_a_face_overlap() {
        let mut cells = cells().to_vec();
        // The tetrahedron turned over into the pyramid.
        cells[3] = SolidCell::Tetrahedron([5, 10, 6, 11]);
        assert_eq!(Faces::new(&cells, 12).first_overlap(), Some([2, 3]));
    }
}
