//! The triangles of an outline and the tetrahedra beside them.

use ligament_mesh::{Faces, SolidCell};
use rstar::primitives::{GeomWithData, Rectangle};
use rstar::{AABB, RTree};

use super::dips;
use crate::bonds::Incidence;
use crate::bonds::outline::crosses;
use crate::cloud::PointCloud;
use crate::horizon::INCLUSION_TOLERANCE;
use crate::space::predicates::{above, side};
use crate::tensor::{cross, dot, minus, norm};

/// The outline of a mesh.
#[derive(Debug)]
pub struct Surface {
    positions: Vec<[f64; 3]>,
    /// The triangles, counter-clockwise seen from outside, as a tree for searches by place.
    triangles: RTree<GeomWithData<Rectangle<[f64; 3]>, [u32; 3]>>,
    /// Tetrahedra at nodes of the outline, of positive volume.
    tetrahedra: Vec<[u32; 4]>,
    /// Numbers of the tetrahedra at each node of the outline; none at the others.
    tetrahedra_at: Incidence,
}

/// A triangle of the outline.
#[derive(Debug, Clone, Copy)]
pub(super) struct Facet {
    nodes: [u32; 3],
    corners: [[f64; 3]; 3],
    /// Normal, twice as long as its area.
    normal: [f64; 3],
    /// Length of the normal.
    size: f64,
}

impl Surface {
    /// The outline of some cells between the points of a cloud.
    pub fn new(cells: &[SolidCell], cloud: &PointCloud<3>) -> Self {
        let positions = cloud.positions.as_slice();
        let outer = Faces::new(cells, positions.len()).outer();
        let triangles = outer.iter().flat_map(|side| side.face.triangles());
        let (triangles, filling) = dips::filled(triangles.collect(), positions);
        let mut is_on_outline = vec![false; positions.len()];
        for &node in triangles.as_flattened() {
            is_on_outline[node as usize] = true;
        }
        let is_near = |nodes: &[u32]| nodes.iter().any(|&node| is_on_outline[node as usize]);
        let near = cells.iter().filter(|cell| is_near(cell.corners()));
        let parts = near.flat_map(SolidCell::tetrahedra);
        let mut tetrahedra: Vec<[u32; 4]> = parts.filter(|part| is_near(part)).collect();
        tetrahedra.extend(filling);
        let numbered = (0..).zip(&tetrahedra);
        let corners = numbered.flat_map(|(number, nodes)| nodes.map(|node| (node, number)));
        let at_outline = corners.filter(|(node, _)| is_on_outline[*node as usize]);
        let bounds = |nodes: [u32; 3]| {
            let [a, b, c] = nodes.map(|node| positions[node as usize]);
            let least = [0, 1, 2].map(|axis| a[axis].min(b[axis]).min(c[axis]));
            let most = [0, 1, 2].map(|axis| a[axis].max(b[axis]).max(c[axis]));
            GeomWithData::new(Rectangle::from_corners(least, most), nodes)
        };
        Self {
            positions: cloud.positions.clone(),
            triangles: RTree::bulk_load(triangles.iter().map(|&nodes| bounds(nodes)).collect()),
            tetrahedra_at: Incidence::from_pairs(at_outline, positions.len()),
            tetrahedra,
        }
    }

    /// Whether a triangle may be in the reach (m) of any of some points, by the box around them.
    pub(super) fn may_be_reached(&self, points: &[u32], reach: impl Fn(u32) -> f64) -> bool {
        let (mut lower, mut upper) = ([f64::INFINITY; 3], [f64::NEG_INFINITY; 3]);
        for &point in points {
            let reach = reach(point) * (1.0 + INCLUSION_TOLERANCE);
            for (axis, x) in self.positions[point as usize].into_iter().enumerate() {
                lower[axis] = lower[axis].min(x - reach);
                upper[axis] = upper[axis].max(x + reach);
            }
        }
        let around = AABB::from_corners(lower, upper);
        let mut triangles = self.triangles.locate_in_envelope_intersecting(around);
        triangles.next().is_some()
    }

    /// The triangles that are no farther from a position than `reach` along every axis, m.
    pub(super) fn near(&self, position: [f64; 3], reach: f64) -> Vec<Facet> {
        let reach = reach * (1.0 + INCLUSION_TOLERANCE);
        let around = AABB::from_corners(position.map(|x| x - reach), position.map(|x| x + reach));
        let found = self.triangles.locate_in_envelope_intersecting(around);
        found.map(|triangle| self.facet(triangle.data)).collect()
    }

    fn facet(&self, nodes: [u32; 3]) -> Facet {
        let corners = nodes.map(|node| self.positions[node as usize]);
        let normal = cross(minus(corners[1], corners[0]), minus(corners[2], corners[0]));
        Facet {
            nodes,
            corners,
            normal,
            size: norm(normal),
        }
    }

    /// Whether the line between two nodes leaves the body, with all triangles of the outline that it may meet.
    pub(super) fn is_left_by(&self, [a, b]: [u32; 2], near: &[Facet], slack: f64) -> bool {
        let ends = [a, b].map(|node| self.positions[node as usize]);
        !self.goes_on(a, ends[1], slack)
            || near.iter().any(|facet| self.is_left_at(facet, ends, slack))
    }

    /// Whether a line leaves the body at a triangle, behind the line's first end.
    fn is_left_at(&self, facet: &Facet, ends: [[f64; 3]; 2], slack: f64) -> bool {
        if facet.is_beside(ends, slack) {
            return false;
        }
        let least = slack * facet.size;
        let [start, end] = ends.map(|point| side(facet.corners, point, least));
        if start == 0 && end == 0 {
            return self.is_left_along(facet, ends, slack);
        }
        if start * end >= 0 {
            return false;
        }
        let places = [[0, 1], [1, 2], [2, 0]];
        let past = places.map(|edge| passes(ends, edge.map(|k| facet.corners[k]), slack));
        if past.contains(&1) && past.contains(&-1) {
            return false;
        }
        let edges = places.map(|edge| edge.map(|k| facet.nodes[k]));
        match past.map(|it| it == 0) {
            [false, false, false] => true,
            [true, false, false] => !self.goes_on_past(edges[0], ends, slack),
            [false, true, false] => !self.goes_on_past(edges[1], ends, slack),
            [false, false, true] => !self.goes_on_past(edges[2], ends, slack),
            _ => self.is_left_at_node(facet, ends, slack),
        }
    }

    /// Whether a line in the plane of a triangle leaves the body at an edge or a node of it.
    fn is_left_along(&self, facet: &Facet, ends: [[f64; 3]; 2], slack: f64) -> bool {
        let flat = |point: [f64; 3]| facet.flattened(point);
        let line = ends.map(flat);
        let mut edges = [[0, 1], [1, 2], [2, 0]].into_iter();
        self.is_left_at_node(facet, ends, slack)
            || edges.any(|edge| {
                crosses(line, edge.map(|k| flat(facet.corners[k])), slack)
                    && !self.goes_on_past(edge.map(|k| facet.nodes[k]), ends, slack)
            })
    }

    /// Whether a line leaves the body at a node of a triangle.
    fn is_left_at_node(&self, facet: &Facet, ends: [[f64; 3]; 2], slack: f64) -> bool {
        let mut nodes = facet.nodes.iter().zip(facet.corners);
        nodes.any(|(&node, position)| {
            is_between(position, ends, slack) && !self.goes_on(node, ends[1], slack)
        })
    }

    /// Whether the way from a node to a position begins in a tetrahedron, or along a face or an edge of one; inside the body it
    /// always does.
    fn goes_on(&self, node: u32, end: [f64; 3], slack: f64) -> bool {
        let tetrahedra = self.tetrahedra_at.at(node);
        let apex = self.positions[node as usize];
        let length = norm(minus(end, apex));
        tetrahedra.is_empty()
            || tetrahedra.iter().any(|&number| {
                let others = opposite(self.tetrahedra[number as usize], node);
                let [p, q, r] = others.map(|other| self.positions[other as usize]);
                let mut is_on_all = true;
                let is_in = [[p, q], [q, r], [r, p]].into_iter().all(|[from, to]| {
                    let (along, across) = (minus(from, apex), minus(to, apex));
                    let far = length / norm(along).min(norm(across));
                    let least = slack * norm(cross(along, across)) * far.max(1.0);
                    let side = side([apex, from, to], end, least);
                    is_on_all &= side == 0;
                    side >= 0
                });
                is_in && !is_on_all
            })
    }

    /// Whether a line that meets an edge of the outline goes on there into a tetrahedron, or along a face of one.
    fn goes_on_past(&self, [p, q]: [u32; 2], ends: [[f64; 3]; 2], slack: f64) -> bool {
        let at = |node: u32| self.positions[node as usize];
        let length = norm(minus(ends[1], ends[0]));
        let tetrahedra = self.tetrahedra_at.at(p).iter();
        let mut at_edge = tetrahedra
            .map(|&number| self.tetrahedra[number as usize])
            .filter(|nodes| nodes.contains(&q));
        at_edge.any(|nodes| {
            let others = opposite(nodes, p);
            let place = others
                .iter()
                .position(|&node| node == q)
                .unwrap_or_default();
            // Between the half-planes of the edge and the two other nodes, in this order.
            let [r, s] = [others[(place + 1) % 3], others[(place + 2) % 3]];
            let sides = [r, s].map(|other| {
                let (along, across) = (minus(at(q), at(p)), minus(at(other), at(p)));
                let far = length / norm(across);
                let least = slack * norm(cross(along, across)) * far.max(1.0);
                side([at(p), at(q), at(other)], ends[1], least)
            });
            sides[0] >= 0 && sides[1] <= 0 && sides != [0, 0]
        })
    }

    /// The nodes of an edge that passes through a triangle, the first of them all; none where cells do not overlap.
    pub fn first_crossing(&self) -> Option<[u32; 2]> {
        let edges =
            |nodes: [u32; 3]| [[0, 1], [1, 2], [2, 0]].map(|it| it.map(|k: usize| nodes[k]));
        let is_crossing = |edge: &[u32; 2]| {
            let ends = edge.map(|node| self.positions[node as usize]);
            let least = [0, 1, 2].map(|axis| ends[0][axis].min(ends[1][axis]));
            let most = [0, 1, 2].map(|axis| ends[0][axis].max(ends[1][axis]));
            let around = AABB::from_corners(least, most);
            let mut near = self.triangles.locate_in_envelope_intersecting(around);
            near.any(|triangle| self.facet(triangle.data).is_crossed_by(ends))
        };
        let all = self
            .triangles
            .iter()
            .flat_map(|triangle| edges(triangle.data));
        // Each edge stands there in both directions.
        let once = all.filter(|[from, to]| from < to);
        once.filter(is_crossing).min()
    }
}

impl Facet {
    /// Whether a line misses the box around the triangle.
    fn is_beside(&self, [a, b]: [[f64; 3]; 2], slack: f64) -> bool {
        let [p, q, r] = self.corners;
        (0..3).any(|axis| {
            let least = p[axis].min(q[axis]).min(r[axis]);
            let most = p[axis].max(q[axis]).max(r[axis]);
            a[axis].max(b[axis]) + slack < least || a[axis].min(b[axis]) - slack > most
        })
    }

    /// Whether a line passes through the inside of the triangle.
    fn is_crossed_by(&self, [a, b]: [[f64; 3]; 2]) -> bool {
        let [p, q, r] = self.corners;
        let [start, end] = [a, b].map(|point| above(p, q, r, point));
        let past = [[p, q], [q, r], [r, p]].map(|[from, to]| above(a, b, from, to));
        ((start > 0.0 && end < 0.0) || (start < 0.0 && end > 0.0))
            && (past.iter().all(|it| *it > 0.0) || past.iter().all(|it| *it < 0.0))
    }

    /// A point of the plane of the triangle by the two coordinates in which the triangle is widest.
    fn flattened(&self, point: [f64; 3]) -> [f64; 2] {
        let [x, y, z] = self.normal.map(f64::abs);
        if x >= y && x >= z {
            [point[1], point[2]]
        } else if y >= z {
            [point[2], point[0]]
        } else {
            [point[0], point[1]]
        }
    }
}

/// The side on which a line passes the line of an edge; zero where they meet.
fn passes([a, b]: [[f64; 3]; 2], [p, q]: [[f64; 3]; 2], slack: f64) -> i8 {
    let least = slack * norm(cross(minus(b, a), minus(q, p)));
    side([a, b, p], q, least)
}

/// Whether a point lies on the line between two others, but at none of them.
fn is_between(point: [f64; 3], [start, end]: [[f64; 3]; 2], slack: f64) -> bool {
    let way = minus(end, start);
    let from_start = minus(point, start);
    dot(from_start, way) > 0.0
        && dot(minus(point, end), way) < 0.0
        && norm(cross(from_start, way)) <= slack * norm(way)
}

/// The other corners of a tetrahedron, counter-clockwise seen from inside of it at the node: with the node first, its volume is
/// positive.
fn opposite([a, b, c, d]: [u32; 4], node: u32) -> [u32; 3] {
    if node == a {
        [b, c, d]
    } else if node == b {
        [a, d, c]
    } else if node == c {
        [a, b, d]
    } else {
        [a, c, b]
    }
}
