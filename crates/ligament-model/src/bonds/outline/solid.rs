//! Triangles of the outline of a solid mesh, and the tetrahedra beside them.
//!
//! Quadrangles are split into two triangles as their cells are split into tetrahedra. The nodes of a round body lie on its surface, but the
//! triangles between them dip below it wherever an edge runs around the body and its neighbours lie along it. These dips count as part of
//! the body (`dips.rs`): a convex body loses no bond.

mod dips;

use ligament_mesh::{Faces, SolidCell};

use super::{Outline, SolidOutline, marked};
use crate::cloud::PointCloud;
use crate::geometry::{bounding_box, boxes_meet, edges_of, flattened, is_between};
use crate::predicates::{above, crosses, side_of_plane};
use crate::tensor::{cross, minus, norm};

/// A triangle of the outline.
#[derive(Debug, Clone, Copy)]
pub struct Facet {
    nodes: [u32; 3],
    corners: [[f64; 3]; 3],
    /// Normal, whose length is twice the area.
    normal: [f64; 3],
    /// Length of the normal, twice the area, m^2.
    size: f64,
}

impl SolidOutline {
    /// The outline of some cells between the points of a cloud.
    pub fn from_cells(cells: &[SolidCell], cloud: &PointCloud<3>) -> Self {
        let positions = cloud.positions.as_slice();
        let outer = Faces::new(cells, positions.len()).outer();
        let triangles = outer.iter().flat_map(|side| side.face.triangles());
        let (triangles, filling) = dips::fill(triangles.collect(), positions);
        let is_on_outline = marked(&triangles, positions.len());
        let is_near = |cell: &&SolidCell| {
            let mut corners = cell.corners().iter();
            corners.any(|&node| is_on_outline[node as usize])
        };
        let parts = cells.iter().filter(is_near).flat_map(SolidCell::tetrahedra);
        Self::new(&triangles, parts.chain(filling), positions)
    }

    fn facet(&self, nodes: [u32; 3]) -> Facet {
        let corners = nodes.map(|node| self.at(node));
        let normal = cross(minus(corners[1], corners[0]), minus(corners[2], corners[0]));
        Facet {
            nodes,
            corners,
            normal,
            size: norm(normal),
        }
    }

    /// Whether a line leaves the body at a triangle, beyond the line's first end.
    fn is_left_at(&self, facet: &Facet, ends: [[f64; 3]; 2], slack: f64) -> bool {
        if facet.is_beside(ends, slack) {
            return false;
        }
        let least = slack * facet.size;
        let [start, end] = ends.map(|point| side_of_plane(facet.corners, point, least));
        if start == 0 && end == 0 {
            return self.is_left_along(facet, ends, slack);
        }
        if start * end >= 0 {
            return false;
        }
        let past = edges_of(facet.corners).map(|edge| passing_side(ends, edge, slack));
        if past.contains(&1) && past.contains(&-1) {
            return false;
        }
        let edges = edges_of(facet.nodes);
        match past.map(|it| it == 0) {
            [false, false, false] => true,
            [true, false, false] => !self.continues_beyond_edge(edges[0], ends, slack),
            [false, true, false] => !self.continues_beyond_edge(edges[1], ends, slack),
            [false, false, true] => !self.continues_beyond_edge(edges[2], ends, slack),
            _ => self.is_left_at_node(facet, ends, slack),
        }
    }

    /// Whether a line in the plane of a triangle leaves the body at an edge or a node of the triangle.
    fn is_left_along(&self, facet: &Facet, ends: [[f64; 3]; 2], slack: f64) -> bool {
        let flat = |point: [f64; 3]| flattened(point, facet.normal);
        let line = ends.map(flat);
        let mut sides = edges_of(facet.nodes)
            .into_iter()
            .zip(edges_of(facet.corners));
        self.is_left_at_node(facet, ends, slack)
            || sides.any(|(edge, corners)| {
                crosses(line, corners.map(flat), slack)
                    && !self.continues_beyond_edge(edge, ends, slack)
            })
    }

    /// Whether a line leaves the body at a node of a triangle.
    fn is_left_at_node(&self, facet: &Facet, ends: [[f64; 3]; 2], slack: f64) -> bool {
        let mut nodes = facet.nodes.iter().zip(facet.corners);
        nodes.any(|(&node, position)| {
            is_on_line(position, ends, slack) && !self.continues_in_body(node, ends[1], slack)
        })
    }

    /// Whether the line from a node to a position begins in a tetrahedron, or along a face or an edge of one; inside the body it always
    /// does.
    fn continues_in_body(&self, node: u32, end: [f64; 3], slack: f64) -> bool {
        let apex = self.at(node);
        let length = norm(minus(end, apex));
        let mut tetrahedra = self.parts_at(node).peekable();
        tetrahedra.peek().is_none()
            || tetrahedra.any(|nodes| {
                let others = opposite(nodes, node);
                let [p, q, r] = others.map(|other| self.at(other));
                let mut is_on_all = true;
                let is_in = edges_of([p, q, r]).into_iter().all(|[from, to]| {
                    let (along, across) = (minus(from, apex), minus(to, apex));
                    let far = length / norm(along).min(norm(across));
                    let least = slack * norm(cross(along, across)) * far.max(1.0);
                    let side = side_of_plane([apex, from, to], end, least);
                    is_on_all &= side == 0;
                    side >= 0
                });
                is_in && !is_on_all
            })
    }

    /// Whether a line that crosses an edge of the outline continues there into a tetrahedron, or along a face of one.
    fn continues_beyond_edge(&self, [p, q]: [u32; 2], ends: [[f64; 3]; 2], slack: f64) -> bool {
        let at = |node: u32| self.at(node);
        let length = norm(minus(ends[1], ends[0]));
        let mut at_edge = self.parts_at(p).filter(|nodes| nodes.contains(&q));
        at_edge.any(|nodes| {
            let others = opposite(nodes, p);
            let place = others
                .iter()
                .position(|&node| node == q)
                .unwrap_or_default();
            // Half-planes through the edge and each of the two other nodes, in this order.
            let [r, s] = [others[(place + 1) % 3], others[(place + 2) % 3]];
            let sides = [r, s].map(|other| {
                let (along, across) = (minus(at(q), at(p)), minus(at(other), at(p)));
                let far = length / norm(across);
                let least = slack * norm(cross(along, across)) * far.max(1.0);
                side_of_plane([at(p), at(q), at(other)], ends[1], least)
            });
            sides[0] >= 0 && sides[1] <= 0 && sides != [0, 0]
        })
    }
}

impl Outline<3> for SolidOutline {
    type Facet = Facet;

    fn facets_within(&self, bounds: [[f64; 3]; 2]) -> impl Iterator<Item = Facet> {
        self.facets_in_box(bounds).map(|nodes| self.facet(nodes))
    }

    fn is_crossed_by_bonds(&self, [a, b]: [u32; 2], near: &[Facet], slack: f64) -> bool {
        let ends = [a, b].map(|node| self.at(node));
        !self.continues_in_body(a, ends[1], slack)
            || near.iter().any(|facet| self.is_left_at(facet, ends, slack))
    }

    fn is_doubled(&self, node: u32) -> bool {
        self.is_doubled[node as usize]
    }

    fn position(&self, node: u32) -> [f64; 3] {
        self.at(node)
    }

    fn begins_in_body(&self, node: u32, end: [f64; 3]) -> bool {
        self.continues_in_body(node, end, 0.0)
    }

    fn first_crossing(&self) -> Option<[u32; 2]> {
        self.first_edge_through(|nodes, ends| self.facet(nodes).is_crossed_by(ends))
    }
}

impl Facet {
    /// Whether a line misses the box around the triangle.
    fn is_beside(&self, ends: [[f64; 3]; 2], slack: f64) -> bool {
        let [lower, upper] = bounding_box(ends);
        let around = [lower.map(|x| x - slack), upper.map(|x| x + slack)];
        !boxes_meet(around, bounding_box(self.corners))
    }

    /// Whether a line passes through the interior of the triangle.
    fn is_crossed_by(&self, [a, b]: [[f64; 3]; 2]) -> bool {
        let [p, q, r] = self.corners;
        let [start, end] = [a, b].map(|point| above(p, q, r, point));
        let past = edges_of(self.corners).map(|[from, to]| above(a, b, from, to));
        ((start > 0.0 && end < 0.0) || (start < 0.0 && end > 0.0))
            && (past.iter().all(|it| *it > 0.0) || past.iter().all(|it| *it < 0.0))
    }
}

/// Side on which a line passes the line of an edge; zero where they intersect.
fn passing_side([a, b]: [[f64; 3]; 2], [p, q]: [[f64; 3]; 2], slack: f64) -> i8 {
    let least = slack * norm(cross(minus(b, a), minus(q, p)));
    side_of_plane([a, b, p], q, least)
}

/// Whether a point lies on the line between two others, but at neither of them.
fn is_on_line(point: [f64; 3], ends: [[f64; 3]; 2], slack: f64) -> bool {
    let way = minus(ends[1], ends[0]);
    is_between(point, ends) && norm(cross(minus(point, ends[0]), way)) <= slack * norm(way)
}

/// Other corners of a tetrahedron, counter-clockwise as seen from inside at the node: with the node first, its volume is positive.
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
