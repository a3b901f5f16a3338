//! Dips of a triangulated outline below a round surface.
//!
//! The edge between two triangles on four nodes of a convex surface may be either diagonal of the four. Along one diagonal the triangles
//! bulge, along the other they dip, by the difference of the sagittas; the dip is part of the body, as its surface passes through all four
//! nodes. A dip is filled by the tetrahedron of the four nodes; the edge becomes the other diagonal. Re-entrant edges of the body itself are
//! no dips: they turn by more, or the outline around them is not convex.

use std::collections::{BTreeSet, HashMap};

use crate::geometry::{ascending, edges_of};
use crate::predicates::above;
use crate::tensor::{cross, dot, minus, norm};

/// Cosine of the largest angle between two triangles of a round surface, 45 degrees.
const ROUND: f64 = 0.707;

/// Height of a node over a triangle, relative to the size of the triangle, that counts as zero.
const FLATNESS: f64 = 1e-9;

/// Triangles of an outline (counter-clockwise as seen from outside) after its dips are filled, and the tetrahedra that fill them.
pub(super) fn fill(
    triangles: Vec<[u32; 3]>,
    positions: &[[f64; 3]],
) -> (Vec<[u32; 3]>, Vec<[u32; 4]>) {
    let mut skin = TriangulatedSurface::new(triangles, positions);
    let mut filling = Vec::new();
    // Every filling adds to the volume of the body, so the loop ends. The bound is for triangles that form no surface.
    let mut left = 8 * skin.triangles.len();
    let mut open: BTreeSet<[u32; 2]> = skin.edges.keys().copied().collect();
    open.retain(|edge| skin.dip(*edge).is_some());
    while let Some(edge) = open.pop_first() {
        let Some(dip) = skin.dip(edge) else {
            continue;
        };
        if left == 0 {
            break;
        }
        left -= 1;
        let [p, q, r, s] = dip.nodes;
        filling.push(dip.nodes);
        skin.turn(dip);
        open.extend([[p, r], [p, s], [q, r], [q, s]].map(ascending));
    }
    (skin.triangles, filling)
}

/// A dip: two triangles (p, q, r) and (q, p, s) with the outside between them.
struct Dip {
    nodes: [u32; 4],
    /// Numbers of the triangles.
    triangles: [usize; 2],
}

/// Triangles with their edges.
struct TriangulatedSurface<'a> {
    positions: &'a [[f64; 3]],
    triangles: Vec<[u32; 3]>,
    /// Triangles at each edge.
    edges: HashMap<[u32; 2], Vec<usize>>,
}

impl<'a> TriangulatedSurface<'a> {
    fn new(triangles: Vec<[u32; 3]>, positions: &'a [[f64; 3]]) -> Self {
        let mut edges: HashMap<[u32; 2], Vec<usize>> = HashMap::with_capacity(2 * triangles.len());
        for (number, nodes) in triangles.iter().enumerate() {
            for edge in edges_of(*nodes).map(ascending) {
                edges.entry(edge).or_default().push(number);
            }
        }
        Self {
            positions,
            triangles,
            edges,
        }
    }

    fn at(&self, node: u32) -> [f64; 3] {
        self.positions[node as usize]
    }

    /// The two triangles at an edge, as (p, q, r) and (q, p, s); `None` at other edges.
    fn pair(&self, edge: [u32; 2]) -> Option<Dip> {
        let &[one, other] = self.edges.get(&edge)?.as_slice() else {
            return None;
        };
        let [p, q, r] = from_edge(self.triangles[one], edge)?;
        let [from, to, s] = from_edge(self.triangles[other], edge)?;
        ([from, to] == [q, p]).then_some(Dip {
            nodes: [p, q, r, s],
            triangles: [one, other],
        })
    }

    /// The dip at an edge, if any.
    fn dip(&self, edge: [u32; 2]) -> Option<Dip> {
        let pair = self.pair(edge)?;
        let [p, q, r, s] = pair.nodes;
        let normals = [[p, q, r], [q, p, s]].map(|nodes| self.normal(nodes));
        let is_round =
            |one: [f64; 3], other: [f64; 3]| dot(one, other) > ROUND * norm(one) * norm(other);
        let height = above(self.at(p), self.at(q), self.at(r), self.at(s));
        let is_dip = height > FLATNESS * norm(normals[0]) * norm(minus(self.at(s), self.at(p)));
        if !is_dip
            || !is_round(normals[0], normals[1])
            || self.edges.contains_key(&ascending([r, s]))
        {
            return None;
        }
        let mean = [0, 1, 2].map(|axis| normals[0][axis] + normals[1][axis]);
        let turned = [[r, p, s], [s, q, r]].map(|nodes| self.normal(nodes));
        let around = [[p, r], [p, s], [q, r], [q, s]];
        let around: Vec<f64> = around
            .iter()
            .filter_map(|it| self.bend(ascending(*it)))
            .collect();
        // Each of these four edges counts half, as it belongs to two pairs; sharp edges give no information on the surface beside them.
        let mean_bend = around.iter().sum::<f64>() / around.len().max(1) as f64;
        let is_convex = self.bend(edge)? + 2.0 * mean_bend > 0.0;
        (is_convex && turned.iter().all(|it| is_round(*it, mean))).then_some(pair)
    }

    /// Length of an edge times the angle between its triangles, positive where the body is convex: a contribution to the integral of the
    /// mean curvature (D. Cohen-Steiner and J.-M. Morvan, Restricted Delaunay triangulations and normal cycle, 2003). `None` at edges of the
    /// body itself, where the surface is not round.
    fn bend(&self, edge: [u32; 2]) -> Option<f64> {
        let [p, q, r, s] = self.pair(edge)?.nodes;
        let [one, other] = [[p, q, r], [q, p, s]].map(|nodes| self.normal(nodes));
        let cosine = dot(one, other) / (norm(one) * norm(other));
        if cosine <= ROUND {
            return None;
        }
        let sine = dot(cross(one, other), minus(self.at(q), self.at(p)));
        let length = norm(minus(self.at(q), self.at(p)));
        let angle = (sine / (length * norm(one) * norm(other))).atan2(cosine);
        Some(angle * length)
    }

    fn normal(&self, [a, b, c]: [u32; 3]) -> [f64; 3] {
        cross(minus(self.at(b), self.at(a)), minus(self.at(c), self.at(a)))
    }

    /// Replaces the edge of a dip by the other diagonal.
    fn turn(&mut self, dip: Dip) {
        let [p, q, r, s] = dip.nodes;
        for number in dip.triangles {
            for edge in edges_of(self.triangles[number]).map(ascending) {
                if let Some(at_edge) = self.edges.get_mut(&edge) {
                    at_edge.retain(|it| *it != number);
                }
            }
        }
        self.edges.remove(&ascending([p, q]));
        for (number, nodes) in dip.triangles.into_iter().zip([[r, p, s], [s, q, r]]) {
            self.triangles[number] = nodes;
            for edge in edges_of(nodes).map(ascending) {
                self.edges.entry(edge).or_default().push(number);
            }
        }
    }
}

/// Corners of a triangle, beginning with the ends of an edge.
fn from_edge(nodes: [u32; 3], edge: [u32; 2]) -> Option<[u32; 3]> {
    let turns = (0..3).map(|k| [nodes[k], nodes[(k + 1) % 3], nodes[(k + 2) % 3]]);
    turns
        .into_iter()
        .find(|turned| ascending([turned[0], turned[1]]) == edge)
}
