//! Filled contours: the region of a triangulated body in which a field reaches a level, as closed outlines.
//!
//! An edge that two triangles share bounds nothing, so that an outline consists of edges of the body's boundary and of one
//! straight piece in every triangle that the level crosses. Ends of pieces are named by the node or the edge that they lie on: they
//! meet exactly in spite of rounding. Regions of rising levels painted over each other leave no seams between the bands.

use std::collections::HashMap;

/// Triangles with their corners counter-clockwise, and the edges that bound them.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct Surface {
    /// The triangles whose corners all have a value.
    triangles: Vec<[u32; 3]>,
    /// Edges that belong to only one triangle, with the body at their left.
    boundary: Vec<[u32; 2]>,
}

/// End of a piece of an outline: at a node (twice the same), or on an edge between two, the smaller number first.
type OutlinePoint = [u32; 2];

impl Surface {
    /// The triangles over which `has_value` holds at all corners; orientations are judged by the positions.
    pub(super) fn new(
        triangles: impl IntoIterator<Item = [u32; 3]>,
        positions: &[[f64; 2]],
        has_value: impl Fn(u32) -> bool,
    ) -> Self {
        let with_values = |triangle: &[u32; 3]| triangle.iter().all(|&node| has_value(node));
        let triangles = triangles.into_iter().filter(with_values);
        Self::from_counter_clockwise(
            triangles
                .map(|it| counter_clockwise(it, positions))
                .collect(),
        )
    }

    /// Triangles whose corners are counter-clockwise already.
    pub(super) fn from_counter_clockwise(triangles: Vec<[u32; 3]>) -> Self {
        // For each edge, the number of triangles that run along it from its smaller to its larger node minus the number of others.
        let mut edges: Vec<(OutlinePoint, i32)> = triangles
            .iter()
            .flat_map(edges_of)
            .map(|[a, b]| ([a.min(b), a.max(b)], if a < b { 1 } else { -1 }))
            .collect();
        edges.sort_unstable();
        let boundary = edges
            .chunk_by(|a, b| a.0 == b.0)
            .flat_map(|same| {
                let [a, b] = same[0].0;
                let count: i32 = same.iter().map(|it| it.1).sum();
                let directed = if count > 0 { [a, b] } else { [b, a] };
                std::iter::repeat_n(directed, count.unsigned_abs() as usize)
            })
            .collect();
        Self {
            triangles,
            boundary,
        }
    }

    /// The outlines of the whole surface, as nodes; the surface at their left.
    pub(super) fn outlines(&self, positions: &[[f64; 2]]) -> Vec<Vec<[f64; 2]>> {
        let pieces = self.boundary.iter().map(|&[a, b]| [[a, a], [b, b]]);
        closed_outlines(pieces.collect(), |[a, _]| positions[a as usize])
    }

    /// The outlines of the region in which the field (one value per node) is at least `level`; the region at their left.
    pub(super) fn region(
        &self,
        positions: &[[f64; 2]],
        field: &[f64],
        level: f64,
    ) -> Vec<Vec<[f64; 2]>> {
        let value = |node: u32| field[node as usize];
        let reaches = |node: u32| value(node) >= level;
        let crossing = |a: u32, b: u32| [a.min(b), a.max(b)];
        let along_boundary =
            self.boundary
                .iter()
                .filter_map(|&[a, b]| match (reaches(a), reaches(b)) {
                    (true, true) => Some([[a, a], [b, b]]),
                    (true, false) => Some([[a, a], crossing(a, b)]),
                    (false, true) => Some([crossing(a, b), [b, b]]),
                    (false, false) => None,
                });
        let across_triangles = self.triangles.iter().filter_map(|triangle| {
            let find = |from: bool| {
                let edge =
                    edges_of(triangle).find(|&[a, b]| reaches(a) == from && reaches(b) != from);
                edge.map(|[a, b]| crossing(a, b))
            };
            Some([find(true)?, find(false)?])
        });
        let position = |[a, b]: OutlinePoint| {
            let ([xa, ya], [xb, yb]) = (positions[a as usize], positions[b as usize]);
            if a == b {
                return [xa, ya];
            }
            let share = (level - value(a)) / (value(b) - value(a));
            [xa + share * (xb - xa), ya + share * (yb - ya)]
        };
        closed_outlines(along_boundary.chain(across_triangles).collect(), position)
    }
}

/// A triangle with its corners counter-clockwise.
pub(super) fn counter_clockwise([a, b, c]: [u32; 3], positions: &[[f64; 2]]) -> [u32; 3] {
    let at = |node: u32| positions[node as usize];
    if doubled_area(at(a), at(b), at(c)) < 0.0 {
        [a, c, b]
    } else {
        [a, b, c]
    }
}

/// A quadrangle as two triangles.
pub(super) fn triangles_of_quadrangle([a, b, c, d]: [u32; 4]) -> [[u32; 3]; 2] {
    [[a, b, c], [a, c, d]]
}

fn edges_of(&[a, b, c]: &[u32; 3]) -> impl Iterator<Item = [u32; 2]> + use<> {
    [[a, b], [b, c], [c, a]].into_iter()
}

fn doubled_area(a: [f64; 2], b: [f64; 2], c: [f64; 2]) -> f64 {
    (b[0] - a[0]) * (c[1] - a[1]) - (c[0] - a[0]) * (b[1] - a[1])
}

/// Closed outlines from directed pieces, in the order of the pieces; as many pieces end at every place as begin there.
fn closed_outlines(
    pieces: Vec<[OutlinePoint; 2]>,
    position: impl Fn(OutlinePoint) -> [f64; 2],
) -> Vec<Vec<[f64; 2]>> {
    let mut from: HashMap<OutlinePoint, Vec<usize>> = HashMap::with_capacity(pieces.len());
    for (piece, [start, _]) in pieces.iter().enumerate().rev() {
        from.entry(*start).or_default().push(piece);
    }
    let mut is_used = vec![false; pieces.len()];
    let mut outlines = Vec::new();
    for first in 0..pieces.len() {
        let mut outline = Vec::new();
        let mut next = (!is_used[first]).then_some(first);
        while let Some(piece) = next {
            is_used[piece] = true;
            let [start, end] = pieces[piece];
            outline.push(position(start));
            let candidates = from.get_mut(&end);
            next = candidates.and_then(|all| {
                all.retain(|&it| !is_used[it]);
                all.last().copied()
            });
        }
        if !outline.is_empty() {
            outlines.push(outline);
        }
    }
    outlines
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A unit square of n x n cells, each two triangles; every other triangle is given clockwise.
    fn square(n: u32, keep: impl Fn(u32, u32) -> bool) -> (Vec<[f64; 2]>, Vec<[u32; 3]>) {
        let positions = (0..=n)
            .flat_map(|j| (0..=n).map(move |i| [i, j].map(|it| f64::from(it) / f64::from(n))))
            .collect();
        let mut triangles = Vec::new();
        for (i, j) in (0..n).flat_map(|j| (0..n).map(move |i| (i, j))) {
            let corner = |i: u32, j: u32| j * (n + 1) + i;
            let quad = [
                corner(i, j),
                corner(i + 1, j),
                corner(i + 1, j + 1),
                corner(i, j + 1),
            ];
            let [a, [p, q, r]] = triangles_of_quadrangle(quad);
            if keep(i, j) {
                triangles.extend([a, [p, r, q]]);
            }
        }
        (positions, triangles)
    }

    fn area(outlines: &[Vec<[f64; 2]>]) -> f64 {
        let of = |outline: &Vec<[f64; 2]>| {
            let next = outline.iter().cycle().skip(1);
            let doubled = outline
                .iter()
                .zip(next)
                .map(|(p, q)| p[0] * q[1] - q[0] * p[1]);
            0.5 * doubled.sum::<f64>()
        };
        outlines.iter().map(of).sum()
    }

    fn n_points(outlines: &[Vec<[f64; 2]>]) -> usize {
        outlines.iter().map(Vec::len).sum()
    }

    /// {x >= c} of the unit square has the area 1 - c, also where c is the value of nodes; x is linear, so only rounding is left.
    #[test]
    fn areas_are_those_of_the_closed_form_and_points_those_of_the_outline() {
        let n = 8;
        let (positions, triangles) = square(n, |_, _| true);
        let surface = Surface::new(triangles, &positions, |_| true);
        let x: Vec<f64> = positions.iter().map(|it| it[0]).collect();
        for level in [0.1, 0.25, 0.5, 0.77, 1.0 - 1e-12] {
            let region = surface.region(&positions, &x, level);
            assert!((area(&region) - (1.0 - level)).abs() < 1e-14, "{level}");
            assert_eq!(region.len(), 1, "{level}");
        }
        // The isoline x = 0.3 runs through 2 triangles of each of 8 rows: 16 pieces; above it the boundary has 8 edges at the
        // right and 5 whole and one cut edge (0.375 to 1, 0.3 to 0.375) at top and bottom.
        let region = surface.region(&positions, &x, 0.3);
        assert_eq!(n_points(&region), 16 + 8 + 2 * 6);
        assert_eq!(n_points(&surface.outlines(&positions)), 4 * n as usize);
        assert!((area(&surface.outlines(&positions)) - 1.0).abs() < 1e-14);
    }

    #[test]
    fn a_constant_field_reaches_its_value_everywhere_and_more_nowhere() {
        let (positions, triangles) = square(4, |_, _| true);
        let surface = Surface::new(triangles, &positions, |_| true);
        let field = vec![2.0; positions.len()];
        let region = surface.region(&positions, &field, 2.0);
        assert_eq!(region, surface.outlines(&positions));
        assert!(
            surface
                .region(&positions, &field, 2.0 + 1e-15 * 2.0)
                .is_empty()
        );
    }

    /// A square with a square hole: two outlines, the area without the hole; a level about the hole has two as well.
    #[test]
    fn holes_turn_the_other_way() {
        let hole = |i: u32, j: u32| (2..4).contains(&i) && (2..4).contains(&j);
        let (positions, triangles) = square(6, |i, j| !hole(i, j));
        let surface = Surface::new(triangles, &positions, |_| true);
        let outlines = surface.outlines(&positions);
        assert_eq!(outlines.len(), 2);
        assert!((area(&outlines) - (1.0 - 1.0 / 9.0)).abs() < 1e-14);
        let far = |p: &[f64; 2]| (p[0] - 0.5).abs().max((p[1] - 0.5).abs());
        let near: Vec<f64> = positions.iter().map(|it| -far(it)).collect();
        let ring = surface.region(&positions, &near, -0.25);
        assert_eq!(ring.len(), 2);
        // Within 0.25 of the middle, less the hole: corners of the isoline are cut off where a diagonal crosses them.
        let expected = 0.25 - 1.0 / 9.0;
        assert!((area(&ring) - expected).abs() < 0.01, "{}", area(&ring));
    }

    /// Two regions that touch at one node: their pieces still form closed outlines.
    #[test]
    fn regions_may_touch_at_a_node() {
        let (positions, triangles) = square(2, |i, j| i == j);
        let surface = Surface::new(triangles, &positions, |_| true);
        let outlines = surface.outlines(&positions);
        assert!((area(&outlines) - 0.5).abs() < 1e-15);
        assert_eq!(n_points(&outlines), 8);
    }

    #[test]
    fn triangles_without_a_value_are_left_out() {
        let (positions, triangles) = square(4, |_, _| true);
        let mut field = vec![1.0; positions.len()];
        field[12] = f64::NAN;
        let surface = Surface::new(triangles, &positions, |node| {
            field[node as usize].is_finite()
        });
        // Six of the 32 triangles meet at the middle.
        let region = surface.region(&positions, &field, 0.0);
        assert!((area(&region) - (1.0 - 6.0 / 32.0)).abs() < 1e-14);
    }
}
