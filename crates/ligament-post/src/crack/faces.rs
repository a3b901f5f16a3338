//! Cells of the points and the faces between them.

use std::collections::HashMap;

use ligament_mesh::Cell;
use ligament_model::Canvas;

/// The faces between the cells of neighbouring points; the cells cover the body.
///
/// The cell of a node of a mesh is bounded by lines from the centroids of the mesh's cells to the middles of their edges; on a lattice it is
/// the square of the point. Squares around points of arrays have faces only where they fit together.
#[derive(Debug, Clone, PartialEq)]
pub struct Faces {
    /// End points of the faces, m.
    pub(super) corners: Vec<[f64; 2]>,
    /// Whether each corner lies on the outline of the body, shape (n_corners).
    pub(super) is_outside: Vec<bool>,
    /// The two corners of each face, shape (n_faces).
    pub(super) ends: Vec<[u32; 2]>,
    /// Middle of each face between its corners, where the face may bend, shape (n_faces), m.
    pub(super) middle: Vec<[f64; 2]>,
    /// The two points A < B separated by each face, shape (n_faces), ascending.
    points: Vec<[u32; 2]>,
}

/// State of the bond across a face.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum FaceState {
    /// Unbroken bond, or points that were never bonded.
    Whole,
    /// Bond cut by a pre-crack: not a grown crack, but cracks can start there.
    PreCrack,
    /// Broken bond.
    Open,
}

/// Distance, relative to the side of a square, within which corners of squares are merged.
const ONE_CORNER: f64 = 0.01;

impl Faces {
    /// The faces of a body in the plane with its points at `positions` (n_points), m; none for a solid, whose cracks are surfaces.
    pub fn new(positions: &[[f64; 2]], canvas: &Canvas) -> Self {
        match canvas {
            Canvas::Between(cells) => Self::between_nodes(positions, cells),
            Canvas::Around(squares) => Self::around_points(squares),
            Canvas::Solid(_) | Canvas::Boxes(_) => {
                UnsortedFaces::default().sort_faces(Vec::new(), Vec::new())
            }
        }
    }

    /// Number of faces.
    pub fn len(&self) -> usize {
        self.ends.len()
    }

    /// Whether there is no face.
    pub fn is_empty(&self) -> bool {
        self.ends.is_empty()
    }

    /// The face between the cells of two points; `None` where the cells do not touch.
    pub fn between(&self, [a, b]: [u32; 2]) -> Option<usize> {
        self.points.binary_search(&[a.min(b), a.max(b)]).ok()
    }

    /// Points A < B separated by each face, shape (n_faces).
    pub fn points(&self) -> &[[u32; 2]] {
        &self.points
    }

    fn between_nodes(positions: &[[f64; 2]], cells: &[Cell]) -> Self {
        let centroid = |cell: &Cell| mean(cell.corners().iter().map(|&it| positions[it as usize]));
        let mut corners: Vec<[f64; 2]> = cells.iter().map(centroid).collect();
        let mut is_outside = vec![false; cells.len()];
        let mut edges: Vec<([u32; 2], u32)> = Vec::new();
        for (number, cell) in (0..).zip(cells) {
            let corners = cell.corners();
            let next = corners.iter().cycle().skip(1);
            edges.extend(
                corners
                    .iter()
                    .zip(next)
                    .map(|(&a, &b)| ([a.min(b), a.max(b)], number)),
            );
        }
        edges.sort_unstable();
        let mut faces = UnsortedFaces::default();
        for edge in edges.chunk_by(|one, other| one.0 == other.0) {
            let points = edge[0].0;
            let middle = mean(points.map(|it| positions[it as usize]).into_iter());
            let far = edge.get(1).map_or(corners.len() as u32, |other| other.1);
            if edge.len() == 1 {
                corners.push(middle);
                is_outside.push(true);
            }
            faces.push(points, [edge[0].1, far], middle);
        }
        faces.sort_faces(corners, is_outside)
    }

    fn around_points(squares: &[[[f64; 2]; 4]]) -> Self {
        let mut corners = SquareCorners::default();
        let mut sides: HashMap<[u32; 2], u32> = HashMap::new();
        let mut faces = UnsortedFaces::default();
        for (point, square) in (0..).zip(squares) {
            let side = distance(square[0], square[1]).min(distance(square[1], square[2]));
            let numbers = square.map(|corner| corners.number(corner, side));
            for place in 0..4 {
                let [a, b] = [numbers[place], numbers[(place + 1) % 4]];
                let ends = [a.min(b), a.max(b)];
                if let Some(other) = sides.remove(&ends) {
                    let middle = mean(ends.map(|it| corners.places[it as usize]).into_iter());
                    faces.push([other, point], ends, middle);
                } else {
                    sides.insert(ends, point);
                }
            }
        }
        let mut is_outside = vec![false; corners.places.len()];
        for corner in sides.into_keys().flatten() {
            is_outside[corner as usize] = true;
        }
        faces.sort_faces(corners.places, is_outside)
    }
}

/// Unsorted faces, each with its points, its corners and its middle.
#[derive(Default)]
struct UnsortedFaces(Vec<([u32; 2], [u32; 2], [f64; 2])>);

impl UnsortedFaces {
    fn push(&mut self, points: [u32; 2], ends: [u32; 2], middle: [f64; 2]) {
        self.0.push((points, ends, middle));
    }

    fn sort_faces(mut self, corners: Vec<[f64; 2]>, is_outside: Vec<bool>) -> Faces {
        self.0.sort_by_key(|(points, ends, _)| (*points, *ends));
        Faces {
            corners,
            is_outside,
            points: self.0.iter().map(|it| it.0).collect(),
            ends: self.0.iter().map(|it| it.1).collect(),
            middle: self.0.iter().map(|it| it.2).collect(),
        }
    }
}

/// Corners of squares, each once.
#[derive(Default)]
struct SquareCorners {
    places: Vec<[f64; 2]>,
    /// Numbers of the corners by cells of a grid of the merging distance.
    found: HashMap<[i64; 2], u32>,
}

impl SquareCorners {
    /// Number of a corner of a square with a given side.
    fn number(&mut self, corner: [f64; 2], side: f64) -> u32 {
        let width = ONE_CORNER * side;
        let [x, y] = corner.map(|it| (it / width).floor() as i64);
        let around = (-1..=1).flat_map(|dx| (-1..=1).map(move |dy| [x + dx, y + dy]));
        for place in around {
            if let Some(&number) = self.found.get(&place)
                && distance(self.places[number as usize], corner) <= width
            {
                return number;
            }
        }
        let number = self.places.len() as u32;
        self.places.push(corner);
        self.found.insert([x, y], number);
        number
    }
}

pub(super) fn distance(a: [f64; 2], b: [f64; 2]) -> f64 {
    (a[0] - b[0]).hypot(a[1] - b[1])
}

fn mean(places: impl ExactSizeIterator<Item = [f64; 2]>) -> [f64; 2] {
    let count = places.len() as f64;
    let [x, y] = places.fold([0.0, 0.0], |[x, y], [dx, dy]| [x + dx, y + dy]);
    [x / count, y / count]
}

#[cfg(test)]
#[expect(clippy::unwrap_used, reason = "a failed unwrap fails the test")]
mod tests {
    use super::*;

    /// Two triangles on the unit square: five edges, one of them inside.
    #[test]
    fn cells_of_nodes_meet_along_the_edges_of_the_mesh() {
        let positions = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];
        let cells = vec![Cell::Triangle([0, 1, 2]), Cell::Triangle([0, 2, 3])];
        let faces = Faces::new(&positions, &Canvas::Between(cells));
        assert_eq!(faces.len(), 5);
        let inner = faces.between([2, 0]).unwrap();
        assert_eq!((faces.ends[inner], faces.middle[inner]), ([0, 1], [0.5; 2]));
        let outer = faces.between([0, 1]).unwrap();
        let far = faces.ends[outer][1] as usize;
        assert_eq!(
            (faces.corners[far], faces.is_outside[far]),
            ([0.5, 0.0], true)
        );
        assert_eq!(faces.between([1, 3]), None);
    }

    #[test]
    fn squares_meet_where_they_share_a_side() {
        let positions: Vec<[f64; 2]> = (0..6)
            .map(|k| [0.1 * f64::from(k % 3), 0.1 * f64::from(k / 3)])
            .collect();
        let square = |[x, y]: &[f64; 2]| {
            [[-0.05, -0.05], [0.05, -0.05], [0.05, 0.05], [-0.05, 0.05]]
                .map(|[dx, dy]| [x + dx, y + dy])
        };
        let canvas = Canvas::Around(positions.iter().map(square).collect());
        let faces = Faces::new(&positions, &canvas);
        assert_eq!((faces.len(), faces.corners.len()), (7, 12));
        assert_eq!(faces.points()[0], [0, 1]);
        assert!(faces.between([4, 1]).is_some() && faces.between([0, 4]).is_none());
        let [a, b] = faces.ends[faces.between([1, 4]).unwrap()];
        assert!(!faces.is_outside[a as usize] && !faces.is_outside[b as usize]);
    }
}
