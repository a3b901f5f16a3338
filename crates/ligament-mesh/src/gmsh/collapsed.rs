//! Cells with a repeated corner, which are cells with fewer corners: some programs write triangles as quadrangles, and other solid cells as
//! hexahedra.

use crate::cell::Cell;
use crate::solid::SolidCell;

/// A cell that may have a repeated corner.
pub(super) trait Collapsible: Sized {
    /// The cell with each corner once; `None` where this is no cell.
    fn collapsed(&self) -> Option<Self>;
}

impl Collapsible for Cell {
    /// The triangle of a quadrangle whose two successive corners are one node.
    fn collapsed(&self) -> Option<Self> {
        match *around(self.corners())?.as_slice() {
            [a, b, c] => Some(Cell::Triangle([a, b, c])),
            _ => None,
        }
    }
}

impl Collapsible for SolidCell {
    /// The tetrahedron, pyramid or prism that the faces enclose once edges and faces without extent are left out.
    fn collapsed(&self) -> Option<Self> {
        let (mut triangles, mut quadrangles) = (Vec::new(), Vec::new());
        for face in self.faces() {
            match *around(face.corners())?.as_slice() {
                [a, b, c] => triangles.push([a, b, c]),
                [a, b, c, d] => quadrangles.push([a, b, c, d]),
                _ => {}
            }
        }
        let outside = |base: &[u32]| {
            let mut corners = self.corners().iter();
            corners.find(|it| !base.contains(it)).copied()
        };
        // Faces are seen from outside, but the bases of cells from inside: in the opposite order.
        let cell = match (triangles.as_slice(), quadrangles.as_slice()) {
            (&[[a, b, c], _, _, _], []) => SolidCell::Tetrahedron([a, c, b, outside(&[a, b, c])?]),
            ([_, _, _, _], &[[a, b, c, d]]) => {
                SolidCell::Pyramid([a, d, c, b, outside(&[a, b, c, d])?])
            }
            (&[[a, b, c], opposite], [_, _, _]) => {
                let over = |corner| corner_over(corner, &quadrangles, opposite);
                SolidCell::Prism([a, c, b, over(a)?, over(c)?, over(b)?])
            }
            _ => return None,
        };
        // Faces with common corners could enclose nothing, such as a triangle and its back.
        let kept = triangles.iter().map(|it| it.as_slice());
        let mut kept = kept.chain(quadrangles.iter().map(|it| it.as_slice()));
        let is_face = |face: &[u32]| cell.faces().any(|it| is_same(it.corners(), face));
        (first_repeated(cell.corners()).is_none() && kept.all(is_face)).then_some(cell)
    }
}

/// First corner that stands a second time.
pub(super) fn first_repeated(corners: &[u32]) -> Option<u32> {
    let mut places = 1..corners.len();
    let repeated = places.find(|place| corners[..*place].contains(&corners[*place]))?;
    Some(corners[repeated])
}

/// Corners around a face without those that follow themselves; `None` where a corner still stands twice: the face is folded.
fn around(corners: &[u32]) -> Option<Vec<u32>> {
    let next = corners.iter().cycle().skip(1);
    let pairs = corners
        .iter()
        .zip(next)
        .filter(|(corner, next)| corner != next);
    let kept: Vec<u32> = pairs.map(|(corner, _)| *corner).collect();
    first_repeated(&kept).is_none().then_some(kept)
}

/// The corner of the opposite triangle that has an edge with a given corner.
fn corner_over(corner: u32, quadrangles: &[[u32; 4]], opposite: [u32; 3]) -> Option<u32> {
    let neighbours = quadrangles.iter().flat_map(|around| {
        let at = around.iter().position(|it| *it == corner);
        at.map(|at| [around[(at + 1) % 4], around[(at + 3) % 4]])
            .into_iter()
            .flatten()
    });
    let mut over = neighbours.filter(|it| opposite.contains(it));
    over.next()
}

/// Whether two lists are the same corners around a face, from any corner on.
fn is_same(one: &[u32], other: &[u32]) -> bool {
    let n = one.len();
    let mut shifts = 0..n;
    n == other.len()
        && shifts.any(|shift| (0..n).all(|place| one[(place + shift) % n] == other[place]))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The corners of the unit cube in the order of Gmsh, and the middle of its top.
    const PLACES: [[f64; 3]; 9] = [
        [0.0, 0.0, 0.0],
        [1.0, 0.0, 0.0],
        [1.0, 1.0, 0.0],
        [0.0, 1.0, 0.0],
        [0.0, 0.0, 1.0],
        [1.0, 0.0, 1.0],
        [1.0, 1.0, 1.0],
        [0.0, 1.0, 1.0],
        [0.5, 0.5, 1.0],
    ];

    /// Each way to collapse an edge or a face of a hexahedron, a prism and a pyramid gives the cell that remains, with its volume by hand.
    #[test]
    fn solids_become_what_they_are() {
        let hexahedron = SolidCell::Hexahedron;
        for (cell, shape, volume) in [
            (hexahedron([0, 1, 2, 2, 4, 5, 6, 6]), "prism", 0.5),
            (hexahedron([0, 0, 2, 3, 4, 4, 6, 7]), "prism", 0.5),
            (hexahedron([0, 4, 5, 1, 3, 3, 2, 2]), "prism", 0.5),
            (hexahedron([0, 1, 2, 3, 8, 8, 8, 8]), "pyramid", 1.0 / 3.0),
            (
                hexahedron([0, 1, 2, 2, 8, 8, 8, 8]),
                "tetrahedron",
                1.0 / 6.0,
            ),
            (
                hexahedron([0, 1, 2, 2, 5, 5, 5, 5]),
                "tetrahedron",
                1.0 / 6.0,
            ),
            (
                hexahedron([0, 1, 3, 3, 4, 4, 4, 4]),
                "tetrahedron",
                1.0 / 6.0,
            ),
            (
                SolidCell::Prism([0, 1, 3, 4, 4, 4]),
                "tetrahedron",
                1.0 / 6.0,
            ),
            (SolidCell::Prism([0, 1, 3, 4, 5, 3]), "pyramid", 1.0 / 3.0),
            (
                SolidCell::Pyramid([0, 1, 3, 3, 4]),
                "tetrahedron",
                1.0 / 6.0,
            ),
        ] {
            let found = cell.collapsed().unwrap();
            assert_eq!(found.shape_name(), shape, "{cell:?}");
            // A few roundings.
            let error = found.volume(&PLACES) - volume;
            assert!(error.abs() < 1e-15, "{cell:?} {found:?} {error}");
        }
    }

    #[test]
    fn what_is_no_cell_is_none() {
        for cell in [
            // One edge of eight: a solid with seven corners.
            SolidCell::Hexahedron([0, 1, 2, 3, 4, 5, 6, 6]),
            // Opposite corners of a face, and of the cell.
            SolidCell::Hexahedron([0, 1, 0, 3, 4, 5, 6, 7]),
            SolidCell::Hexahedron([0, 1, 2, 3, 4, 5, 0, 7]),
            SolidCell::Hexahedron([0, 1, 2, 3, 0, 1, 2, 3]),
            SolidCell::Hexahedron([0; 8]),
            SolidCell::Prism([0, 1, 3, 0, 1, 3]),
            SolidCell::Pyramid([0, 1, 2, 3, 3]),
            SolidCell::Tetrahedron([0, 1, 2, 2]),
        ] {
            assert_eq!(cell.collapsed(), None, "{cell:?}");
        }
    }

    #[test]
    fn quadrangles_become_triangles() {
        for corners in [[0, 0, 1, 2], [0, 1, 1, 2], [0, 1, 2, 2], [0, 1, 2, 0]] {
            let Some(Cell::Triangle(found)) = Cell::Quadrangle(corners).collapsed() else {
                panic!("{corners:?}");
            };
            assert!(is_same(&found, &[0, 1, 2]), "{found:?}");
        }
        for corners in [[0, 1, 0, 2], [0, 0, 1, 1], [0, 0, 0, 1], [0; 4]] {
            assert_eq!(Cell::Quadrangle(corners).collapsed(), None, "{corners:?}");
        }
        assert_eq!(Cell::Triangle([0, 1, 1]).collapsed(), None);
    }
}
