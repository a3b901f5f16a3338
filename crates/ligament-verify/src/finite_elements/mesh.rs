//! Meshes of quadrilaterals.

use std::collections::BTreeMap;
use std::f64::consts::FRAC_PI_2;

/// Distance below which two nodes coincide, m.
const SAME: f64 = 1e-9;

/// Grading of the cells towards a hole: the exponent of the relative depth into the body.
const GRADING: f64 = 1.3;

/// Degree of the shape functions along each side of a quadrilateral.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Degree {
    /// Bilinear: four nodes.
    Linear = 1,
    /// Biquadratic: nine nodes.
    Quadratic = 2,
}

/// Nodes, and the quadrilaterals between them.
#[derive(Debug, Clone, PartialEq)]
pub struct Mesh {
    /// Degree of the elements.
    pub degree: Degree,
    /// Positions of the nodes, shape (n_nodes, 2), m.
    pub nodes: Vec<[f64; 2]>,
    /// Nodes of each quadrilateral, row by row from its lower left corner, shape (n_cells, 4 or 9).
    pub cells: Vec<Vec<usize>>,
}

/// A part of a mesh: the numbers of cells of a grid over the unit square, and the mapping of its points.
type Patch<'a> = ([usize; 2], Box<dyn Fn([f64; 2]) -> [f64; 2] + 'a>);

impl Mesh {
    /// A rectangle of squares about the origin, with `cells` squares of width `spacing` (m) along x and y.
    pub fn rectangle(degree: Degree, cells: [usize; 2], spacing: f64) -> Self {
        let place =
            move |at: [f64; 2]| [0, 1].map(|axis| (at[axis] - 0.5) * spacing * cells[axis] as f64);
        Self::from_patches(degree, &[(cells, Box::new(place))])
    }

    /// A lamina about the origin, twice as long (along x) as high, with a round hole in the middle and `n` quadrilaterals along an eighth
    /// of it; at both ends a mesh line is at the distance `layer` inside the body. Lengths in m.
    ///
    /// The square around the hole is divided along rays; edges on the hole are as round as the degree allows.
    pub fn lamina_with_hole(
        degree: Degree,
        height: f64,
        radius: f64,
        layer: f64,
        n: usize,
    ) -> Self {
        let half = 0.5 * height;
        let ring = move |turn: f64| {
            move |at: [f64; 2]| {
                let border = [half, half * (2.0 * at[1] - 1.0)];
                let scale = radius / border[0].hypot(border[1]);
                let depth = scale + at[0].powf(GRADING) * (1.0 - scale);
                let (s, c) = turn.sin_cos();
                let [x, y] = border.map(|it| depth * it);
                [c * x - s * y, s * x + c * y]
            }
        };
        let strip = move |from: f64, to: f64| {
            move |at: [f64; 2]| [from + at[0] * (to - from), half * (2.0 * at[1] - 1.0)]
        };
        let mut patches: Vec<Patch<'_>> = Vec::new();
        for quarter in 0..4 {
            patches.push(([n, 2 * n], Box::new(ring(FRAC_PI_2 * f64::from(quarter)))));
        }
        let inner = height - layer;
        for side in [-1.0, 1.0] {
            let at_end = (n / 6).max(1);
            patches.push(([n, 2 * n], Box::new(strip(side * half, side * inner))));
            patches.push((
                [at_end, 2 * n],
                Box::new(strip(side * inner, side * height)),
            ));
        }
        Self::from_patches(degree, &patches)
    }

    /// Joins patches; coinciding nodes are merged.
    fn from_patches(degree: Degree, patches: &[Patch<'_>]) -> Self {
        let p = degree as usize;
        let mut mesh = Self {
            degree,
            nodes: Vec::new(),
            cells: Vec::new(),
        };
        let mut numbers = BTreeMap::new();
        for ([columns, rows], place) in patches {
            for cell in 0..columns * rows {
                let (i, j) = (p * (cell % columns), p * (cell / columns));
                let mut nodes: Vec<usize> = (0..(p + 1).pow(2))
                    .map(|k| {
                        let share = |at: usize, cells: usize| at as f64 / (p * cells) as f64;
                        let at = [i + k % (p + 1), j + k / (p + 1)];
                        let node = place([share(at[0], *columns), share(at[1], *rows)]);
                        *numbers
                            .entry(node.map(|x| (x / SAME).round() as i64))
                            .or_insert_with(|| {
                                mesh.nodes.push(node);
                                mesh.nodes.len() - 1
                            })
                    })
                    .collect();
                // A mirrored patch has clockwise cells.
                if mesh.is_mirrored(&nodes) {
                    nodes.chunks_mut(p + 1).for_each(<[usize]>::reverse);
                }
                mesh.cells.push(nodes);
            }
        }
        mesh
    }

    fn is_mirrored(&self, cell: &[usize]) -> bool {
        let p = self.degree as usize;
        let [start, right, up] = [0, p, p * (p + 1)].map(|corner| self.nodes[cell[corner]]);
        let along = |end: [f64; 2]| [end[0] - start[0], end[1] - start[1]];
        let ([a, b], [c, d]) = (along(right), along(up));
        a * d - b * c < 0.0
    }

    /// The positions of the nodes of a quadrilateral, m.
    pub(super) fn places(&self, cell: &[usize]) -> Vec<[f64; 2]> {
        cell.iter().map(|&node| self.nodes[node]).collect()
    }

    /// The middles of the quadrilaterals, shape (n_cells, 2), m: the mean of the corners.
    pub fn centres(&self) -> Vec<[f64; 2]> {
        let p = self.degree as usize;
        let corners = [0, p, p * (p + 1), (p + 1) * (p + 1) - 1];
        let centre = |cell: &Vec<usize>| {
            [0, 1].map(|axis| {
                let sum: f64 = (corners.iter())
                    .map(|&corner| self.nodes[cell[corner]][axis])
                    .sum();
                0.25 * sum
            })
        };
        self.cells.iter().map(centre).collect()
    }

    /// The node nearest to a position, the first of several.
    pub fn nearest_node(&self, place: [f64; 2]) -> usize {
        let distance =
            |node: usize| (self.nodes[node][0] - place[0]).hypot(self.nodes[node][1] - place[1]);
        (0..self.nodes.len())
            .min_by(|&one, &other| distance(one).total_cmp(&distance(other)))
            .unwrap_or_default()
    }
}
