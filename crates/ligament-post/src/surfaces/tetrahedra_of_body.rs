//! Tetrahedra of a body: parts of the cells of a mesh, or between the boxes of a lattice.

use std::collections::HashMap;

use ligament_model::{BodyGrid, Canvas};

use super::tetrahedra::Tetrahedra;

impl Tetrahedra {
    /// The tetrahedra of a body; none in the plane, or for boxes that do not fit together.
    pub fn new(grid: &BodyGrid) -> Self {
        match &grid.canvas {
            Canvas::Solid(cells) => {
                let numbered = (0..).zip(cells);
                let all = numbered.flat_map(|(cell, it)| it.tetrahedra().map(move |of| (of, cell)));
                let (corners, cells) = all.unzip();
                Self {
                    nodes: grid.positions.clone(),
                    points: (0..grid.positions.len() as u32).collect(),
                    corners,
                    cells,
                    held: vec![false; grid.positions.len()],
                }
            }
            Canvas::Boxes(boxes) => between_boxes(boxes),
            Canvas::Between(_) | Canvas::Around(_) => Self::default(),
        }
    }
}

/// Difference of sides and positions, relative to a side, up to which boxes fit together.
const SAME: f64 = 0.01;

/// Corners of the six tetrahedra of a cube about its diagonal (H. W. Kuhn, Some combinatorial lemmas in topology, 1960), as numbers whose
/// bits are the steps along x, y and z: adjacent cubes split their common face alike.
const KUHN: [[usize; 4]; 6] = [
    [0, 1, 3, 7],
    [0, 5, 1, 7],
    [0, 3, 2, 7],
    [0, 2, 6, 7],
    [0, 4, 5, 7],
    [0, 6, 4, 7],
];

/// Nodes by the lattice position of a box, possibly a missing one, and the point of the node.
#[derive(Default)]
struct Nodes {
    found: HashMap<([i64; 3], u32), u32>,
    places: Vec<[f64; 3]>,
    points: Vec<u32>,
}

/// Boxes by their lattice positions.
struct BoxLattice {
    of_boxes: Vec<[i64; 3]>,
    boxes: HashMap<[i64; 3], u32>,
    middles: Vec<[f64; 3]>,
    sides: [f64; 3],
}

/// The tetrahedra of the cubes between the middles of eight boxes; none where the boxes are of different size or form no lattice.
///
/// Where a box around a corner is missing, at the outside of the body, a node on the face of an adjacent box replaces its middle.
fn between_boxes(boxes: &[[[f64; 3]; 2]]) -> Tetrahedra {
    let Some(places) = BoxLattice::new(boxes) else {
        return Tetrahedra::default();
    };
    // Each corner of a box is the middle of a cube, whose lowest box may be missing.
    let of_boxes = places.of_boxes.iter();
    let mut lowest: Vec<[i64; 3]> = of_boxes
        .flat_map(|place| (0..8).map(|corner| moved_position(*place, corner, -1)))
        .collect();
    lowest.sort_unstable();
    lowest.dedup();
    let mut nodes = Nodes::default();
    let (mut corners, mut cells) = (Vec::new(), Vec::new());
    for (cell, low) in (0..).zip(lowest) {
        let of_cube: [u32; 8] = std::array::from_fn(|corner| nodes.at(&places, low, corner));
        corners.extend(KUHN.map(|of| of.map(|corner| of_cube[corner])));
        cells.extend([cell; KUHN.len()]);
    }
    Tetrahedra {
        nodes: nodes.places,
        points: nodes.points,
        corners,
        cells,
        held: vec![false; boxes.len()],
    }
}

/// A lattice position moved by a step along each axis whose bit is set.
fn moved_position(place: [i64; 3], steps: usize, by: i64) -> [i64; 3] {
    std::array::from_fn(|axis| place[axis] + by * (steps >> axis & 1) as i64)
}

impl BoxLattice {
    fn new(boxes: &[[[f64; 3]; 2]]) -> Option<Self> {
        let [low, high] = *boxes.first()?;
        let sides: [f64; 3] = std::array::from_fn(|axis| high[axis] - low[axis]);
        let mut places = Self {
            of_boxes: Vec::with_capacity(boxes.len()),
            boxes: HashMap::new(),
            middles: Vec::with_capacity(boxes.len()),
            sides,
        };
        for (number, [from, to]) in (0..).zip(boxes) {
            let steps: [f64; 3] =
                std::array::from_fn(|axis| (from[axis] - low[axis]) / sides[axis]);
            let place = steps.map(|it| it.round() as i64);
            let fits = (0..3).all(|axis| {
                let side = (to[axis] - from[axis]) / sides[axis];
                (side - 1.0).abs() < SAME && (steps[axis] - steps[axis].round()).abs() < SAME
            });
            if !fits || places.boxes.insert(place, number).is_some() {
                return None;
            }
            places.of_boxes.push(place);
            places
                .middles
                .push([0, 1, 2].map(|axis| 0.5 * (from[axis] + to[axis])));
        }
        Some(places)
    }
}

impl Nodes {
    /// Node at a corner of a cube whose lowest box has a given position.
    fn at(&mut self, places: &BoxLattice, low: [i64; 3], corner: usize) -> u32 {
        let place = moved_position(low, corner, 1);
        // Nearest box of the cube, along as few axes as possible.
        let mut away: Vec<usize> = (0..8).collect();
        away.sort_by_key(|steps: &usize| (steps.count_ones(), *steps));
        let mut boxes = away.into_iter().filter_map(|steps| {
            let number = places.boxes.get(&moved_position(low, corner ^ steps, 1))?;
            Some((*number, steps))
        });
        let (point, steps) = boxes.next().unwrap_or_default();
        *self.found.entry((place, point)).or_insert_with(|| {
            let middle = places.middles[point as usize];
            self.places.push(std::array::from_fn(|axis| {
                let half = 0.5 * places.sides[axis] * (steps >> axis & 1) as f64;
                let outward = if corner >> axis & 1 == 1 { half } else { -half };
                middle[axis] + outward
            }));
            self.points.push(point);
            self.points.len() as u32 - 1
        })
    }
}

#[cfg(test)]
mod tests {
    use ligament_model::tensor::{cross, dot, minus};

    use super::*;

    /// The tetrahedra of a block with a box missing in its corner fill all but the missing part, and the tetrahedra of a whole block fill it.
    #[test]
    fn tetrahedra_fill_the_boxes() {
        let boxes: Vec<[[f64; 3]; 2]> = (0..24)
            .map(|it| [it % 4, it / 4 % 3, it / 12].map(|it: i32| 0.5 * f64::from(it)))
            .map(|low| [low, low.map(|it| it + 0.5)])
            .collect();
        let tetrahedra = between_boxes(&boxes);
        let volume = |of: &Tetrahedra| -> f64 {
            let one = |it: &[u32; 4]| {
                let [a, b, c, d] = it.map(|node| of.nodes[node as usize]);
                let [b, c, d] = [b, c, d].map(|p| minus(p, a));
                dot(b, cross(c, d)) / 6.0
            };
            assert!(of.corners.iter().all(|it| one(it) > 0.0));
            of.corners.iter().map(one).sum()
        };
        assert!((volume(&tetrahedra) - 24.0 * 0.125).abs() < 1e-12);
        assert_eq!(
            between_boxes(&[[[0.0; 3], [1.0; 3]], [[0.7; 3], [1.7; 3]]]),
            Tetrahedra::default()
        );
    }
}
