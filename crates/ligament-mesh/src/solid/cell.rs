//! Solid cells.

use serde::{Deserialize, Serialize};

use crate::cell::{Cell, MeshCell, ascending};

/// A solid cell given by its corner nodes (indices into the mesh's nodes), in the order of Gmsh.
///
/// The volume is positive: seen from the top (or the apex), the corners of the base are counter-clockwise.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub enum SolidCell {
    /// A triangle and the apex over it.
    Tetrahedron([u32; 4]),
    /// A quadrangle and an opposite quadrangle, corner over corner.
    Hexahedron([u32; 8]),
    /// A triangle and an opposite triangle, corner over corner.
    Prism([u32; 6]),
    /// A quadrangle and the apex over it.
    Pyramid([u32; 5]),
}

/// Corners of each face as indices of the corners of the cell, counter-clockwise seen from outside: first triangles, then quadrangles.
type Faces = (&'static [[usize; 3]], &'static [[usize; 4]]);

const FACES_OF_TETRAHEDRON: Faces = (&[[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]], &[]);
const FACES_OF_HEXAHEDRON: Faces = (
    &[],
    &[
        [0, 3, 2, 1],
        [4, 5, 6, 7],
        [0, 1, 5, 4],
        [1, 2, 6, 5],
        [2, 3, 7, 6],
        [3, 0, 4, 7],
    ],
);
const FACES_OF_PRISM: Faces = (
    &[[0, 2, 1], [3, 4, 5]],
    &[[0, 1, 4, 3], [1, 2, 5, 4], [2, 0, 3, 5]],
);
const FACES_OF_PYRAMID: Faces = (
    &[[0, 1, 4], [1, 2, 4], [2, 3, 4], [3, 0, 4]],
    &[[0, 3, 2, 1]],
);

/// Ends of each edge as indices of the corners of the cell.
type Edges = &'static [[usize; 2]];

const EDGES_OF_TETRAHEDRON: Edges = &[[0, 1], [1, 2], [2, 0], [0, 3], [1, 3], [2, 3]];
const EDGES_OF_HEXAHEDRON: Edges = &[
    [0, 1],
    [1, 2],
    [2, 3],
    [3, 0],
    [4, 5],
    [5, 6],
    [6, 7],
    [7, 4],
    [0, 4],
    [1, 5],
    [2, 6],
    [3, 7],
];
const EDGES_OF_PRISM: Edges = &[
    [0, 1],
    [1, 2],
    [2, 0],
    [3, 4],
    [4, 5],
    [5, 3],
    [0, 3],
    [1, 4],
    [2, 5],
];
const EDGES_OF_PYRAMID: Edges = &[
    [0, 1],
    [1, 2],
    [2, 3],
    [3, 0],
    [0, 4],
    [1, 4],
    [2, 4],
    [3, 4],
];

impl SolidCell {
    /// Corner nodes of the cell.
    #[inline]
    pub fn corners(&self) -> &[u32] {
        match self {
            SolidCell::Tetrahedron(corners) => corners,
            SolidCell::Hexahedron(corners) => corners,
            SolidCell::Prism(corners) => corners,
            SolidCell::Pyramid(corners) => corners,
        }
    }

    /// Name of the shape.
    pub fn shape_name(&self) -> &'static str {
        match self {
            SolidCell::Tetrahedron(_) => "tetrahedron",
            SolidCell::Hexahedron(_) => "hexahedron",
            SolidCell::Prism(_) => "prism",
            SolidCell::Pyramid(_) => "pyramid",
        }
    }

    /// Faces of the cell, their corners counter-clockwise seen from outside.
    #[inline]
    pub fn faces(&self) -> impl Iterator<Item = Cell> + use<> {
        let cell = *self;
        (0..).map_while(move |place| cell.face(place))
    }

    /// Face with a given index in the cell.
    #[inline]
    pub(crate) fn face(&self, place: usize) -> Option<Cell> {
        let (triangles, quadrangles) = match self {
            SolidCell::Tetrahedron(_) => FACES_OF_TETRAHEDRON,
            SolidCell::Hexahedron(_) => FACES_OF_HEXAHEDRON,
            SolidCell::Prism(_) => FACES_OF_PRISM,
            SolidCell::Pyramid(_) => FACES_OF_PYRAMID,
        };
        let corners = self.corners();
        match triangles.get(place) {
            Some(places) => Some(Cell::Triangle(places.map(|place| corners[place]))),
            None => {
                let places = quadrangles.get(place - triangles.len())?;
                Some(Cell::Quadrangle(places.map(|place| corners[place])))
            }
        }
    }

    /// Volume of the cell with the nodes at `positions`, m³; negative for an inverted cell.
    ///
    /// A quadrangular face that is not plane is the bilinear surface through its corners: the volume belongs to the trilinear cell, the mean
    /// of the volumes of the two polyhedra in which each face is split along one diagonal and along the other.
    ///
    /// # Panics
    /// Panics if a corner is no index into `positions`.
    pub fn volume(&self, positions: &[[f64; 3]]) -> f64 {
        // Differences keep the digits of a cell far from the origin.
        if let SolidCell::Tetrahedron(corners) = self {
            let [o, a, b, c] = corners.map(|node| positions[node as usize]);
            return determinant(difference(a, o), difference(b, o), difference(c, o)) / 6.0;
        }
        let origin = positions[self.corners()[0] as usize];
        let at = |node: u32| difference(positions[node as usize], origin);
        let over = |a, b, c| determinant(at(a), at(b), at(c));
        let sixfold = self.faces().map(|face| match face {
            Cell::Triangle([a, b, c]) => over(a, b, c),
            Cell::Quadrangle([a, b, c, d]) => {
                0.5 * (over(a, b, c) + over(a, c, d) + over(b, c, d) + over(b, d, a))
            }
        });
        sixfold.sum::<f64>() / 6.0
    }

    /// Tetrahedra of the cell, of positive volume where the cell is convex.
    ///
    /// A quadrangular face is split along the diagonal from its lowest node, so that neighbours split it alike (J. Dompierre et
    /// al., How to subdivide pyramids, prisms and hexahedra into tetrahedra, 1999).
    pub fn tetrahedra(&self) -> impl Iterator<Item = [u32; 4]> + use<> {
        let lowest = self.corners().iter().copied().min().unwrap_or_default();
        let opposite = self
            .faces()
            .filter(move |face| !face.corners().contains(&lowest));
        opposite.flat_map(move |face| face.triangles().map(move |[a, b, c]| [lowest, a, b, c]))
    }
}

impl MeshCell<3> for SolidCell {
    fn from_corners(corners: &[u32]) -> Option<Self> {
        Some(match corners.len() {
            4 => Self::Tetrahedron(corners.try_into().ok()?),
            5 => Self::Pyramid(corners.try_into().ok()?),
            6 => Self::Prism(corners.try_into().ok()?),
            8 => Self::Hexahedron(corners.try_into().ok()?),
            _ => return None,
        })
    }

    fn corners(&self) -> &[u32] {
        self.corners()
    }

    fn corners_mut(&mut self) -> &mut [u32] {
        match self {
            SolidCell::Tetrahedron(corners) => corners,
            SolidCell::Hexahedron(corners) => corners,
            SolidCell::Prism(corners) => corners,
            SolidCell::Pyramid(corners) => corners,
        }
    }

    #[inline]
    fn edges(&self) -> impl Iterator<Item = [u32; 2]> + use<> {
        let cell = *self;
        let edges = match self {
            SolidCell::Tetrahedron(_) => EDGES_OF_TETRAHEDRON,
            SolidCell::Hexahedron(_) => EDGES_OF_HEXAHEDRON,
            SolidCell::Prism(_) => EDGES_OF_PRISM,
            SolidCell::Pyramid(_) => EDGES_OF_PYRAMID,
        };
        edges
            .iter()
            .map(move |places| ascending(places.map(|place| cell.corners()[place])))
    }

    fn size(&self, positions: &[[f64; 3]]) -> f64 {
        self.volume(positions)
    }

    /// Equal parts of the volume, except for pyramids, whose apex has a quarter and whose other corners have 3/16 each. Unlike the parts of
    /// a split into tetrahedra, they do not depend on the numbers of the nodes.
    fn shares(&self, positions: &[[f64; 3]]) -> impl Iterator<Item = (u32, f64)> {
        let parts: &[f64] = match self {
            SolidCell::Tetrahedron(_) => &[0.25; 4],
            SolidCell::Hexahedron(_) => &[0.125; 8],
            SolidCell::Prism(_) => &[1.0 / 6.0; 6],
            SolidCell::Pyramid(_) => &[0.1875, 0.1875, 0.1875, 0.1875, 0.25],
        };
        let volume = self.volume(positions);
        let corners = self.corners().iter().zip(parts);
        corners.map(move |(&corner, part)| (corner, part * volume))
    }
}

fn difference(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

fn determinant(a: [f64; 3], b: [f64; 3], c: [f64; 3]) -> f64 {
    a[0] * (b[1] * c[2] - b[2] * c[1])
        + a[1] * (b[2] * c[0] - b[0] * c[2])
        + a[2] * (b[0] * c[1] - b[1] * c[0])
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The corners of the cube of side 2 around (1, 1, 1), in the order of Gmsh.
    const CUBE: [[f64; 3]; 8] = [
        [0.0, 0.0, 0.0],
        [2.0, 0.0, 0.0],
        [2.0, 2.0, 0.0],
        [0.0, 2.0, 0.0],
        [0.0, 0.0, 2.0],
        [2.0, 0.0, 2.0],
        [2.0, 2.0, 2.0],
        [0.0, 2.0, 2.0],
    ];

    /// One cell of each shape on nodes of the cube, with its volume.
    const CELLS: [(SolidCell, f64); 4] = [
        (SolidCell::Tetrahedron([0, 1, 3, 4]), 8.0 / 6.0),
        (SolidCell::Hexahedron([0, 1, 2, 3, 4, 5, 6, 7]), 8.0),
        (SolidCell::Prism([0, 1, 3, 4, 5, 7]), 4.0),
        (SolidCell::Pyramid([0, 1, 2, 3, 4]), 8.0 / 3.0),
    ];

    fn volume_of_tetrahedra(cell: SolidCell, positions: &[[f64; 3]]) -> f64 {
        let parts = cell
            .tetrahedra()
            .map(|it| SolidCell::Tetrahedron(it).volume(positions));
        parts
            .inspect(|it| {
                assert!(*it > 0.0, "{cell:?}");
            })
            .sum()
    }

    #[test]
    fn volumes_are_those_of_elementary_geometry() {
        for (cell, expected) in CELLS {
            assert!(
                (cell.volume(&CUBE) - expected).abs() < 1e-15 * 8.0,
                "{cell:?}"
            );
            let far = CUBE.map(|it| it.map(|x| 1e6 + x));
            assert!(
                (cell.volume(&far) - expected).abs() < 1e-15 * 8.0,
                "{cell:?} far away"
            );
        }
    }

    /// The faces of a closed surface run along every edge once in each direction, and their normals point away from the middle.
    #[test]
    fn faces_are_closed_and_look_outwards() {
        for (cell, _) in CELLS {
            let mut edges = Vec::new();
            let corners = cell.corners();
            let middle = [0, 1, 2].map(|axis| {
                let sum: f64 = corners.iter().map(|&node| CUBE[node as usize][axis]).sum();
                sum / corners.len() as f64
            });
            for face in cell.faces() {
                let on = face.corners();
                edges.extend((0..on.len()).map(|k| [on[k], on[(k + 1) % on.len()]]));
                let area = face.area_vector(&CUBE);
                let from_middle = difference(CUBE[on[0] as usize], middle);
                let outward: f64 = (0..3).map(|axis| area[axis] * from_middle[axis]).sum();
                assert!(outward > 0.0, "{cell:?} {face:?}");
            }
            let n_edges = edges.len();
            assert!(
                edges.iter().all(|&[a, b]| edges.contains(&[b, a])),
                "{cell:?}"
            );
            edges.sort_unstable();
            edges.dedup();
            assert_eq!(edges.len(), n_edges, "{cell:?}");
            assert_eq!(2 * cell.edges().count(), n_edges, "{cell:?}");
        }
    }

    /// Whichever node is the lowest, the tetrahedra fill the cell.
    #[test]
    fn tetrahedra_fill_the_cell_for_any_numbering() {
        for (cell, expected) in CELLS {
            for shift in 0..8 {
                let mut renumbered = cell;
                for node in renumbered.corners_mut() {
                    *node = (3 * *node + shift) % 8;
                }
                let mut positions = CUBE;
                for (node, &position) in (0..8).zip(&CUBE) {
                    positions[(3 * node + shift as usize) % 8] = position;
                }
                let sum = volume_of_tetrahedra(renumbered, &positions);
                assert!((sum - expected).abs() < 1e-14, "{renumbered:?} {sum}");
            }
        }
    }

    /// The trilinear cell, by Gauss quadrature of its Jacobian, which two points an axis integrate exactly.
    #[test]
    fn a_warped_hexahedron_has_the_volume_of_the_trilinear_cell() {
        let mut positions = CUBE;
        positions[6] = [2.7, 2.2, 2.5];
        positions[1] = [2.1, -0.3, 0.4];
        let gauss = [-1.0, 1.0].map(|sign: f64| 0.5 + sign * 0.5 / 3.0_f64.sqrt());
        let sign = [
            [0, 0, 0],
            [1, 0, 0],
            [1, 1, 0],
            [0, 1, 0],
            [0, 0, 1],
            [1, 0, 1],
            [1, 1, 1],
            [0, 1, 1],
        ];
        let mut volume = 0.0;
        for place in (0..8).map(|k: usize| [gauss[k & 1], gauss[k >> 1 & 1], gauss[k >> 2]]) {
            let tangent = |along: usize| {
                let mut sum = [0.0; 3];
                for (corner, position) in sign.iter().zip(&positions) {
                    let factor = |axis: usize| match (axis == along, corner[axis] == 1) {
                        (true, true) => 1.0,
                        (true, false) => -1.0,
                        (false, true) => place[axis],
                        (false, false) => 1.0 - place[axis],
                    };
                    let weight: f64 = (0..3).map(factor).product();
                    sum = [0, 1, 2].map(|axis| sum[axis] + weight * position[axis]);
                }
                sum
            };
            volume += 0.125 * determinant(tangent(0), tangent(1), tangent(2));
        }
        let found = SolidCell::Hexahedron([0, 1, 2, 3, 4, 5, 6, 7]).volume(&positions);
        assert!((found - volume).abs() < 1e-13, "{found} {volume}");
    }
}
