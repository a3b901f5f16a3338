//! Interface of all cells, planar cells, and faces of solid cells.

use std::collections::BTreeMap;

use serde::de::DeserializeOwned;
use serde::{Deserialize, Serialize};

/// Interface of a cell in D dimensions.
pub trait MeshCell<const D: usize>: Copy + Sync + Serialize + DeserializeOwned {
    /// The cell with given corner nodes, in their order; `None` where no kind of cell has this number of corners.
    fn from_corners(corners: &[u32]) -> Option<Self>;

    /// The corner nodes of the cell.
    fn corners(&self) -> &[u32];

    /// The corner nodes of the cell, to be renumbered.
    fn corners_mut(&mut self) -> &mut [u32];

    /// Edges of the cell, each once, from the lower to the higher node.
    fn edges(&self) -> impl Iterator<Item = [u32; 2]> + use<Self, D>;

    /// Area of the cell with the nodes at `positions`, m², or in space its volume, m³.
    fn size(&self, positions: &[[f64; D]]) -> f64;

    /// Corner nodes of the cell, each with its share of the cell's size, the integral of its shape function. The shares have the centre of
    /// mass of the cell if its faces are parallelograms or triangles.
    fn shares(&self, positions: &[[f64; D]]) -> impl Iterator<Item = (u32, f64)>;
}

/// A planar cell given by its corner nodes (indices into the mesh's nodes), counter-clockwise; in space the face of a solid cell, whose
/// corners are counter-clockwise seen from its front.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub enum Cell {
    /// Three corners.
    Triangle([u32; 3]),
    /// Four corners of a convex quadrangle.
    Quadrangle([u32; 4]),
}

impl Cell {
    /// Corner nodes of the cell, in order around it.
    pub fn corners(&self) -> &[u32] {
        match self {
            Cell::Triangle(corners) => corners,
            Cell::Quadrangle(corners) => corners,
        }
    }

    /// Corner nodes of the cell, ascending, with the largest number as the fourth corner of a triangle.
    pub(crate) fn sorted_corners(&self) -> [u32; 4] {
        let mut sorted = [u32::MAX; 4];
        sorted[..self.corners().len()].copy_from_slice(self.corners());
        sorted.sort_unstable();
        sorted
    }

    /// Area of the cell with the nodes at `positions`, m²; negative for clockwise corners.
    ///
    /// # Panics
    /// Panics if a corner is no index into `positions`.
    pub fn area(&self, positions: &[[f64; 2]]) -> f64 {
        let corners = self.corners();
        let [x0, y0] = positions[corners[0] as usize];
        // A fan of triangles from the first corner: differences keep the digits of a cell far from the origin.
        let twice: f64 = corners[1..]
            .windows(2)
            .map(|pair| {
                let [xa, ya] = positions[pair[0] as usize];
                let [xb, yb] = positions[pair[1] as usize];
                (xa - x0) * (yb - y0) - (xb - x0) * (ya - y0)
            })
            .sum();
        0.5 * twice
    }

    /// Area of a face in space times its unit normal, with the nodes at `positions`, m²: towards the side from which its corners are
    /// counter-clockwise. For a warped quadrangle the vector is the same for every surface with these edges.
    ///
    /// # Panics
    /// Panics if a corner is no index into `positions`.
    pub fn area_vector(&self, positions: &[[f64; 3]]) -> [f64; 3] {
        let between = |from: u32, to: u32| {
            let [from, to] = [from, to].map(|node| positions[node as usize]);
            [to[0] - from[0], to[1] - from[1], to[2] - from[2]]
        };
        let [u, v] = match *self {
            Cell::Triangle([a, b, c]) => [between(a, b), between(a, c)],
            Cell::Quadrangle([a, b, c, d]) => [between(a, c), between(b, d)],
        };
        [
            0.5 * (u[1] * v[2] - u[2] * v[1]),
            0.5 * (u[2] * v[0] - u[0] * v[2]),
            0.5 * (u[0] * v[1] - u[1] * v[0]),
        ]
    }

    /// Triangles of a face, in its orientation. A quadrangle is split along the diagonal from its lowest node, so both of its cells split
    /// it alike.
    pub fn triangles(&self) -> impl Iterator<Item = [u32; 3]> + use<> {
        let (first, second) = match *self {
            Cell::Triangle(corners) => (corners, None),
            Cell::Quadrangle([a, b, c, d]) if a.min(c) < b.min(d) => ([a, b, c], Some([a, c, d])),
            Cell::Quadrangle([a, b, c, d]) => ([b, c, d], Some([b, d, a])),
        };
        std::iter::once(first).chain(second)
    }
}

/// The nodes of an edge, the lower one first.
pub(crate) fn ascending([a, b]: [u32; 2]) -> [u32; 2] {
    [a.min(b), a.max(b)]
}

/// Edges of planar cells, keyed by their nodes in ascending order: the number of cells, and the nodes in the order with the last of these cells
/// on the left.
pub fn cells_at_edges(cells: &[Cell]) -> BTreeMap<[u32; 2], (usize, [u32; 2])> {
    let mut edges = BTreeMap::new();
    for cell in cells {
        let corners = cell.corners();
        let next = corners.iter().cycle().skip(1);
        for (&from, &to) in corners.iter().zip(next) {
            let edge = edges.entry(ascending([from, to])).or_insert((0, [0; 2]));
            *edge = (edge.0 + 1, [from, to]);
        }
    }
    edges
}

impl MeshCell<2> for Cell {
    fn from_corners(corners: &[u32]) -> Option<Self> {
        let triangle = corners.try_into().ok().map(Self::Triangle);
        triangle.or_else(|| Some(Self::Quadrangle(corners.try_into().ok()?)))
    }

    fn corners(&self) -> &[u32] {
        self.corners()
    }

    fn corners_mut(&mut self) -> &mut [u32] {
        match self {
            Cell::Triangle(corners) => corners,
            Cell::Quadrangle(corners) => corners,
        }
    }

    fn edges(&self) -> impl Iterator<Item = [u32; 2]> + use<> {
        let cell = *self;
        let n = self.corners().len();
        (0..n).map(move |place| {
            ascending([place, (place + 1) % n].map(|place| cell.corners()[place]))
        })
    }

    fn size(&self, positions: &[[f64; 2]]) -> f64 {
        self.area(positions)
    }

    /// A third of a triangle, a quarter of a quadrangle for each corner.
    fn shares(&self, positions: &[[f64; 2]]) -> impl Iterator<Item = (u32, f64)> {
        let share = self.area(positions) / self.corners().len() as f64;
        self.corners().iter().map(move |&corner| (corner, share))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn area_of_a_triangle_changes_sign_with_its_orientation() {
        let positions = [[1.0, 1.0], [4.0, 1.0], [1.0, 3.0]];
        assert_eq!(Cell::Triangle([0, 1, 2]).area(&positions), 3.0);
        assert_eq!(Cell::Triangle([0, 2, 1]).area(&positions), -3.0);
    }

    #[test]
    fn area_of_a_trapezium_is_mean_width_times_height() {
        let positions = [[0.0, 0.0], [4.0, 0.0], [3.0, 2.0], [1.0, 2.0]];
        assert_eq!(Cell::Quadrangle([0, 1, 2, 3]).area(&positions), 6.0);
    }

    #[test]
    fn area_vector_of_a_face_is_that_of_its_triangles() {
        let positions = [
            [0.0, 0.0, 1.0],
            [2.0, 0.0, 1.0],
            [2.0, 3.0, 2.0],
            [0.0, 3.0, 1.0],
        ];
        assert_eq!(
            Cell::Triangle([0, 1, 3]).area_vector(&positions),
            [0.0, 0.0, 3.0]
        );
        for corners in [[0, 1, 2, 3], [1, 2, 3, 0]] {
            let face = Cell::Quadrangle(corners);
            let mut sum = [0.0; 3];
            for part in face.triangles() {
                assert!(
                    part.contains(&0) && part.contains(&2),
                    "the diagonal from the lowest node"
                );
                let area = Cell::Triangle(part).area_vector(&positions);
                sum = [0, 1, 2].map(|axis| sum[axis] + area[axis]);
            }
            assert_eq!(face.area_vector(&positions), sum);
            assert_eq!(sum, [-1.5, -1.0, 6.0]);
        }
    }

    #[test]
    fn area_keeps_its_digits_far_from_the_origin() {
        let positions = [[1e6, 1e6], [1e6 + 0.5, 1e6], [1e6, 1e6 + 0.5]];
        assert_eq!(Cell::Triangle([0, 1, 2]).area(&positions), 0.125);
    }
}
