//! Faces of solid cells and the cells on either side.

use super::cell::SolidCell;
use crate::cell::Cell;

/// Faces of solid cells, indexed by their lowest node.
#[derive(Debug)]
pub struct Faces<'a> {
    cells: &'a [SolidCell],
    /// First entry of each lowest node, shape (n_nodes + 1).
    offsets: Vec<usize>,
    /// Cells, and indices of faces in the cell.
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

impl<'a> Faces<'a> {
    /// Faces of cells on `n_nodes` nodes.
    ///
    /// # Panics
    ///
    /// Panics if a corner is no index below `n_nodes`, or there are more than 2^32 cells.
    pub fn new(cells: &'a [SolidCell], n_nodes: usize) -> Self {
        let mut offsets = vec![0; n_nodes + 1];
        for cell in cells {
            for face in cell.faces() {
                offsets[lowest(&face) as usize + 1] += 1;
            }
        }
        for node in 0..n_nodes {
            offsets[node + 1] += offsets[node];
        }
        let mut next = offsets.clone();
        let mut entries = vec![(0, 0); offsets[n_nodes]];
        for (number, cell) in (0..).zip(cells) {
            for (place, face) in (0..).zip(cell.faces()) {
                let free = &mut next[lowest(&face) as usize];
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

    /// Sides of cells at a face, ascending by cell: none, one on the outline, or two inside. The corners of the face may begin anywhere and
    /// run either way around it.
    pub fn sides_at(&self, face: &Cell) -> Vec<Side> {
        let wanted = face_key(face) >> ORIENTATION;
        let sides = self.sides_of(lowest(face));
        sides
            .filter(|side| face_key(&side.face) >> ORIENTATION == wanted)
            .collect()
    }

    /// Faces that belong to one cell only, by their lowest node.
    pub fn outer(&self) -> Vec<Side> {
        let mut outer = Vec::new();
        self.for_each(|keys, sides| {
            if let [key] = keys {
                outer.push(sides[place(*key)]);
            }
        });
        outer
    }

    /// First two cells on the same side of a common face, which overlap.
    pub(crate) fn first_overlap(&self) -> Option<[u32; 2]> {
        let mut found = None;
        self.for_each(|keys, sides| {
            // Neighbours run around their common face in opposite directions.
            let mut pairs = keys.windows(2);
            let alike = pairs.find(|pair| pair[0] >> PLACE == pair[1] >> PLACE);
            if let (Some(pair), None) = (alike, found) {
                let cells = [pair[0], pair[1]].map(|key| sides[place(key)].cell);
                found = Some([cells[0].min(cells[1]), cells[0].max(cells[1])]);
            }
        });
        found
    }

    fn sides_of(&self, lowest: u32) -> impl Iterator<Item = Side> + '_ {
        let range = self.offsets[lowest as usize]..self.offsets[lowest as usize + 1];
        let sides = self.entries[range].iter();
        sides.filter_map(|&(cell, place)| {
            let face = self.cells[cell as usize].face(usize::from(place))?;
            Some(Side { face, cell })
        })
    }

    /// Calls a function for each face, in the order of the lowest nodes, with the keys of its sides and all sides at its lowest node.
    fn for_each(&self, mut call: impl FnMut(&[u128], &[Side])) {
        let (mut sides, mut keys) = (Vec::new(), Vec::new());
        for lowest in 0..self.offsets.len() as u32 - 1 {
            sides.clear();
            sides.extend(self.sides_of(lowest));
            keys.clear();
            let numbered = (0..).zip(&sides);
            keys.extend(
                numbered.map(|(place, side): (u128, &Side)| face_key(&side.face) << PLACE | place),
            );
            keys.sort_unstable();
            for at_face in
                keys.chunk_by(|a, b| a >> (PLACE + ORIENTATION) == b >> (PLACE + ORIENTATION))
            {
                call(at_face, &sides);
            }
        }
    }
}

/// Number of bits of a key for the orientation of a face.
const ORIENTATION: u32 = 1;

/// Number of bits of a key for the index of a side among the sides at a node: no mesh has nodes with more cells.
const PLACE: u32 = 31;

fn place(key: u128) -> usize {
    (key & ((1 << PLACE) - 1)) as usize
}

fn lowest(face: &Cell) -> u32 {
    match *face {
        Cell::Triangle([a, b, c]) => a.min(b).min(c),
        Cell::Quadrangle([a, b, c, d]) => a.min(b).min(c).min(d),
    }
}

/// Key of a face among the faces with the same lowest node: its other corners, beginning with the neighbour of the lowest one that has the
/// smaller number, 32 bits each, with zero for the middle one of a triangle; and a bit for the direction of this order around the face.
fn face_key(face: &Cell) -> u128 {
    let ordered = |first: u32, middle: u32, last: u32| {
        let (low, high) = (first.min(last), first.max(last));
        let corners = u128::from(low) << 64 | u128::from(middle) << 32 | u128::from(high);
        corners << ORIENTATION | u128::from(first < last)
    };
    match *face {
        Cell::Triangle([a, b, c]) => {
            if a < b && a < c {
                ordered(b, 0, c)
            } else if b < c {
                ordered(c, 0, a)
            } else {
                ordered(a, 0, b)
            }
        }
        Cell::Quadrangle(corners) => {
            let lowest = (0..4).min_by_key(|&place| corners[place]);
            let after = |steps: usize| corners[(lowest.unwrap_or_default() + steps) % 4];
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
