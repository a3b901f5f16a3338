//! Proof that no cells of a planar mesh overlap, from its outer edges: much cheaper than a search for cells that overlap.
//!
//! Each edge belongs to at most one cell on each of its sides. So the number of cells over a place changes at outer edges alone, and is zero
//! far from the mesh. The border of an overlap would have an outer edge with another cell on its inner side: there is no overlap if each
//! outer edge is parted from the triangles of all other cells.

use robust::{Coord, orient2d};
use rstar::primitives::{GeomWithData, Rectangle};
use rstar::{AABB, RTree};

use crate::cell::Cell;
use crate::overlap::box_around;
use crate::parallel;

/// Whether the outer edges, each with the cell on its left, prove that no cells overlap.
pub(crate) fn are_disjoint(
    positions: &[[f64; 2]],
    cells: &[Cell],
    outer: &[([u32; 2], u32)],
) -> bool {
    let at = |node: u32| positions[node as usize];
    let edges = outer.iter().map(|(nodes, cell)| {
        let ends = nodes.map(at);
        let [low, high] = box_around(ends.into_iter());
        GeomWithData::new(Rectangle::from_corners(low, high), (ends, *cell))
    });
    let edges: Vec<_> = edges.collect();
    let boxes = edges
        .iter()
        .map(|it| [it.geom().lower(), it.geom().upper()]);
    let mut raster = Raster::new(box_around(positions.iter().copied()), cells.len());
    raster.mark(boxes);
    let tree = RTree::bulk_load(edges);
    let is_disjoint = |number: usize| {
        let cell = &cells[number];
        let triangles = || cell.triangles().map(|it| it.map(at));
        let is_counter_clockwise = triangles().all(|[a, b, c]| side([a, b], c) > 0.0);
        let [low, high] = box_around(cell.corners().iter().map(|&node| at(node)));
        let is_alone = || {
            let mut near = tree.locate_in_envelope_intersecting(AABB::from_corners(low, high));
            near.all(|it| {
                let (edge, owner) = it.data;
                owner == number as u32 || triangles().all(|it| are_parted(edge, it))
            })
        };
        is_counter_clockwise && (!raster.is_marked([low, high]) || is_alone())
    };
    let of_ranges = parallel::of_ranges(cells.len(), |mut it| it.all(is_disjoint));
    !of_ranges.contains(&false)
}

/// Squares of a regular grid over a mesh, each marked or not.
struct Raster {
    low: [f64; 2],
    /// Number of squares along an axis, and over a length of each axis.
    count: usize,
    scale: [f64; 2],
    /// Number of marked squares left of and below each corner of squares, shape (count + 1, count + 1).
    sums: Vec<u32>,
}

impl Raster {
    /// A raster of at least `n` squares over a box.
    fn new([low, high]: [[f64; 2]; 2], n: usize) -> Self {
        let count = (n as f64).sqrt().ceil() as usize;
        let side = |axis: usize| (high[axis] - low[axis]).max(f64::MIN_POSITIVE);
        Self {
            low,
            count,
            scale: [0, 1].map(|axis| count as f64 / side(axis)),
            sums: vec![0; (count + 1) * (count + 1)],
        }
    }

    /// Marks the squares that boxes touch.
    fn mark(&mut self, boxes: impl Iterator<Item = [[f64; 2]; 2]>) {
        for ends in boxes {
            let [[left, bottom], [right, top]] = ends.map(|it| self.square(it));
            for row in bottom..=top {
                let first = self.corner(left + 1, row + 1);
                self.sums[first..=first + right - left].fill(1);
            }
        }
        for row in 1..=self.count {
            let mut of_row = 0;
            for column in 1..=self.count {
                let at = self.corner(column, row);
                of_row += self.sums[at];
                self.sums[at] = of_row + self.sums[self.corner(column, row - 1)];
            }
        }
    }

    /// Column and row of the square at a place, ascending with its coordinates.
    fn square(&self, place: [f64; 2]) -> [usize; 2] {
        let along = |axis: usize| ((place[axis] - self.low[axis]) * self.scale[axis]) as usize;
        [0, 1].map(|axis| along(axis).min(self.count - 1))
    }

    fn corner(&self, column: usize, row: usize) -> usize {
        row * (self.count + 1) + column
    }

    /// Whether a box touches a marked square.
    fn is_marked(&self, ends: [[f64; 2]; 2]) -> bool {
        let [[left, bottom], [right, top]] = ends.map(|it| self.square(it));
        let sum = |column: usize, row: usize| self.sums[self.corner(column, row)];
        sum(right + 1, top + 1) + sum(left, bottom) > sum(left, top + 1) + sum(right + 1, bottom)
    }
}

/// Whether a triangle has no part of an edge, but for one point, inside of it or on a side with the triangle on the left of the edge.
fn are_parted(edge: [[f64; 2]; 2], triangle: [[f64; 2]; 3]) -> bool {
    let corners = triangle.map(|it| side(edge, it));
    let n_on_line = corners.iter().filter(|it| **it == 0.0).count();
    let is_right = corners.iter().all(|it| *it <= 0.0);
    let is_left = corners.iter().all(|it| *it >= 0.0) && n_on_line < 2;
    let mut sides = (0..3).map(|k| [triangle[k], triangle[(k + 1) % 3]]);
    let is_outside = |line: [[f64; 2]; 2]| {
        let ends = edge.map(|it| side(line, it));
        ends.iter().all(|it| *it <= 0.0) && ends != [0.0; 2]
    };
    is_right || is_left || sides.any(is_outside)
}

/// Positive for a place on the left of a line, zero on the line, with the exact sign.
fn side(line: [[f64; 2]; 2], place: [f64; 2]) -> f64 {
    let [a, b, c] = [line[0], line[1], place].map(|[x, y]| Coord { x, y });
    orient2d(a, b, c)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::edges::Edges;

    /// A grid of squares turned by an angle, each of two triangles or a quadrangle, whose corners have exact places only by accident.
    fn grid(n: u32, angle: f64, has_quadrangles: bool) -> (Vec<[f64; 2]>, Vec<Cell>) {
        let (sin, cos) = angle.sin_cos();
        let along = |it: u32| f64::from(it) / 7.0;
        let place = |node: u32| {
            let (x, y) = (along(node % (n + 1)), along(node / (n + 1)));
            [cos * x - sin * y, sin * x + cos * y]
        };
        let positions = (0..(n + 1) * (n + 1)).map(place).collect();
        let cells = (0..n * n).flat_map(|it| {
            let first = it % n + (n + 1) * (it / n);
            let [a, b, c, d] = [first, first + 1, first + n + 2, first + n + 1];
            match has_quadrangles && it % 3 == 0 {
                true => vec![Cell::Quadrangle([a, b, c, d])],
                false => vec![Cell::Triangle([a, b, c]), Cell::Triangle([a, c, d])],
            }
        });
        (positions, cells.collect())
    }

    fn is_proven(positions: &[[f64; 2]], cells: &[Cell]) -> bool {
        are_disjoint(positions, cells, &Edges::new(cells).outer())
    }

    #[test]
    fn sound_meshes_are_proven() {
        for angle in [0.0, 0.3, 1.0, 2.5] {
            for has_quadrangles in [false, true] {
                let (mut positions, mut cells) = grid(9, angle, has_quadrangles);
                assert!(is_proven(&positions, &cells), "{angle}");
                // A hole, and a crack from its corner with nodes of its own on one side.
                cells.retain(|it| !it.corners().contains(&44));
                assert!(is_proven(&positions, &cells), "with a hole, {angle}");
                positions.push(positions[46]);
                let doubled = positions.len() as u32 - 1;
                for cell in &mut cells {
                    let is_above = cell.corners().iter().any(|it| (50..60).contains(it));
                    for node in crate::cell::MeshCell::corners_mut(cell) {
                        *node = if *node == 46 && is_above {
                            doubled
                        } else {
                            *node
                        };
                    }
                }
                assert!(is_proven(&positions, &cells), "with a crack, {angle}");
            }
        }
    }

    /// Cells over others: a copy of the mesh that is moved, inside of the mesh or at its place, and a fan of more than a turn.
    #[test]
    fn overlaps_are_never_proven_sound() {
        let (positions, cells) = grid(9, 0.3, true);
        let (small, few) = grid(2, 0.7, false);
        let n = positions.len() as u32;
        for [dx, dy] in [[0.3, 0.5], [0.0, 0.0], [-0.1, 0.2], [1e-9, 0.0]] {
            let moved = |of: &[[f64; 2]]| -> Vec<[f64; 2]> {
                let moved = of.iter().map(|[x, y]| [x + dx, y + dy]);
                positions.iter().copied().chain(moved).collect()
            };
            let with = |others: &[Cell]| -> Vec<Cell> {
                let mut others = others.to_vec();
                for cell in &mut others {
                    for node in crate::cell::MeshCell::corners_mut(cell) {
                        *node += n;
                    }
                }
                [cells.clone(), others].concat()
            };
            assert!(!is_proven(&moved(&small), &with(&few)), "{dx} {dy}");
            assert!(!is_proven(&moved(&positions), &with(&cells)), "{dx} {dy}");
        }
        let on_circle = |sixth: f64| {
            let (sin, cos) = (sixth * std::f64::consts::FRAC_PI_3).sin_cos();
            [cos, sin]
        };
        let ring = (0..7).map(|k| on_circle(1.1 * f64::from(k)));
        let fan: Vec<[f64; 2]> = [[0.0; 2]].into_iter().chain(ring).collect();
        let turn: Vec<Cell> = (1..7).map(|k| Cell::Triangle([0, k, k + 1])).collect();
        assert!(is_proven(&fan, &turn[..5]));
        assert!(!is_proven(&fan, &turn));
    }
}
