//! Cracks made of triangles.

use std::collections::{BTreeMap, BTreeSet};

use super::UnfitCrack;
use crate::bonds::precrack::Crossing;
use crate::geometry::{ascending, bounding_box, distance_to, edges_of, flattened};
use crate::predicates::{above, left};
use crate::shape::crosses_itself;
use crate::tensor::{cross, dot, minus, norm};

/// Distance of a corner of a polygon from its plane, over the size of the polygon, that counts as zero.
const FLATNESS: f64 = 1e-6;

/// A surface of triangles; neighbours have their fronts on the same side.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Sheet {
    points: Vec<[f64; 3]>,
    triangles: Vec<[u32; 3]>,
    /// Whether each edge of a triangle belongs to two triangles: from the first corner to the second, and so on.
    is_inner_edge: Vec<[bool; 3]>,
    /// Whether each point lies on no edge of the rim.
    is_inner_point: Vec<bool>,
}

impl Sheet {
    pub(super) fn new(points: Vec<[f64; 3]>, triangles: Vec<[u32; 3]>) -> Result<Self, UnfitCrack> {
        if triangles.is_empty() {
            return Err(UnfitCrack::TooFewCorners { corners: 0 });
        }
        for (number, nodes) in triangles.iter().enumerate() {
            if let Some(&point) = nodes.iter().find(|node| **node as usize >= points.len()) {
                let triangle = number;
                return Err(UnfitCrack::NoSuchPoint { triangle, point });
            }
            let [a, b, c] = nodes.map(|node| points[node as usize]);
            let size = norm(minus(b, a)).max(norm(minus(c, a)));
            let area = norm(cross(minus(b, a), minus(c, a)));
            if area.is_nan() || area <= 1e-12 * size * size {
                let triangle = Some(number);
                return Err(UnfitCrack::NoArea { triangle });
            }
        }
        let triangles = turned_alike(triangles);
        let mut at_edge: BTreeMap<[u32; 2], usize> = BTreeMap::new();
        for edge in triangles.iter().flat_map(|nodes| edges_of(*nodes)) {
            *at_edge.entry(ascending(edge)).or_default() += 1;
        }
        let is_inner = |edge: [u32; 2]| at_edge.get(&ascending(edge)).is_some_and(|n| *n > 1);
        let mut is_inner_point = vec![true; points.len()];
        for (edge, count) in &at_edge {
            for &end in edge {
                is_inner_point[end as usize] &= *count > 1;
            }
        }
        let is_inner_edge = triangles.iter().map(|nodes| edges_of(*nodes).map(is_inner));
        Ok(Self {
            is_inner_edge: is_inner_edge.collect(),
            points,
            triangles,
            is_inner_point,
        })
    }

    /// A plane polygon, divided into triangles by ear clipping.
    pub(super) fn polygon(corners: &[[f64; 3]]) -> Result<Self, UnfitCrack> {
        if corners.len() < 3 {
            let corners = corners.len();
            return Err(UnfitCrack::TooFewCorners { corners });
        }
        let next = corners.iter().skip(1).zip(corners.iter().skip(2));
        let areas = next.map(|(b, c)| cross(minus(*b, corners[0]), minus(*c, corners[0])));
        let normal = areas.fold([0.0; 3], |sum, it| [0, 1, 2].map(|k| sum[k] + it[k]));
        let from_first = corners
            .iter()
            .map(|corner| norm(minus(*corner, corners[0])));
        let size = from_first.fold(0.0, f64::max);
        let area = norm(normal);
        if area.is_nan() || area <= 1e-12 * size * size {
            return Err(UnfitCrack::NoArea { triangle: None });
        }
        for (corner, position) in corners.iter().enumerate() {
            let distance = dot(normal, minus(*position, corners[0])).abs() / area;
            if distance > FLATNESS * size {
                return Err(UnfitCrack::NotPlane { corner, distance });
            }
        }
        let flat: Vec<[f64; 2]> = corners.iter().map(|it| flattened(*it, normal)).collect();
        if crosses_itself(&flat) {
            return Err(UnfitCrack::CrossesItself);
        }
        Self::new(corners.to_vec(), ears(&flat))
    }

    pub(super) fn moved(&self, by: impl Fn([f64; 3]) -> [f64; 3]) -> Self {
        let points = self.points.iter().map(|point| by(*point));
        Self {
            points: points.collect(),
            ..self.clone()
        }
    }

    pub(super) fn n_triangles(&self) -> u32 {
        self.triangles.len() as u32
    }

    fn corners(&self, triangle: u32) -> [[f64; 3]; 3] {
        self.triangles[triangle as usize].map(|node| self.points[node as usize])
    }

    pub(super) fn bounds(&self, triangle: u32) -> [[f64; 3]; 2] {
        bounding_box(self.corners(triangle))
    }

    /// Contact of the line of a bond with a triangle.
    fn contact(&self, triangle: u32, [a, b]: [[f64; 3]; 2]) -> Contact {
        let [p, q, r] = self.corners(triangle);
        let sides = edges_of([p, q, r]).map(|[from, to]| above(a, b, from, to));
        if sides.iter().any(|it| *it > 0.0) && sides.iter().any(|it| *it < 0.0) {
            return Contact::None;
        }
        let is_inner_edge = self.is_inner_edge[triangle as usize];
        let nodes = self.triangles[triangle as usize];
        let is_inner = match sides.map(|it| it == 0.0) {
            [false, false, false] => true,
            [true, false, false] => is_inner_edge[0],
            [false, true, false] => is_inner_edge[1],
            [false, false, true] => is_inner_edge[2],
            [true, true, false] => self.is_inner_point[nodes[1] as usize],
            [false, true, true] => self.is_inner_point[nodes[2] as usize],
            [true, false, true] => self.is_inner_point[nodes[0] as usize],
            [true, true, true] => return Contact::None,
        };
        if is_inner {
            Contact::Inside
        } else {
            Contact::Rim
        }
    }

    pub(super) fn cuts(&self, triangle: u32, bond: [[f64; 3]; 2]) -> bool {
        let [p, q, r] = self.corners(triangle);
        let [start, end] = bond.map(|point| above(p, q, r, point) >= 0.0);
        start != end && self.contact(triangle, bond) == Contact::Inside
    }

    pub(super) fn touches(&self, triangle: u32, bond: [[f64; 3]; 2]) -> bool {
        let [p, q, r] = self.corners(triangle);
        let [start, end] = bond.map(|point| above(p, q, r, point));
        let is_parted = (start > 0.0 && end < 0.0) || (start < 0.0 && end > 0.0);
        is_parted && self.contact(triangle, bond) == Contact::Rim
    }

    /// Whether a triangle has a point in common with a bond, or comes within `slack` (m) of it.
    pub(super) fn meets(&self, triangle: u32, bond: [[f64; 3]; 2], slack: f64) -> bool {
        let [p, q, r] = self.corners(triangle);
        let [start, end] = bond.map(|point| above(p, q, r, point));
        let is_parted = (start >= 0.0) != (end >= 0.0);
        // Where they are disjoint, the nearest points are an end of the bond or on an edge of the triangle.
        (is_parted && self.contact(triangle, bond) != Contact::None)
            || edges_of([p, q, r])
                .into_iter()
                .any(|edge| gap(bond, edge) <= slack)
            || bond
                .into_iter()
                .any(|point| height_over([p, q, r], point) <= slack)
    }

    pub(super) fn crossing(&self, triangle: u32, [a, b]: [[f64; 3]; 2]) -> Crossing<3> {
        let [p, q, r] = self.corners(triangle);
        let normal = cross(minus(q, p), minus(r, p));
        let sides = edges_of([p, q, r]).map(|[from, to]| above(a, b, from, to));
        let sum: f64 = sides.iter().sum();
        let least = sides
            .iter()
            .map(|it| it / sum)
            .fold(f64::INFINITY, f64::min);
        Crossing {
            normal: normal.map(|it| it / norm(normal)),
            depth: if least.is_finite() {
                least
            } else {
                f64::NEG_INFINITY
            },
        }
    }
}

/// Contact of the line of a bond with a triangle.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Contact {
    None,
    /// A point of the rim of the surface.
    Rim,
    /// A point of the interior of the surface.
    Inside,
}

/// Triangles oriented so that neighbours run along their common edge in opposite directions, beginning with the first of each connected set.
fn turned_alike(mut triangles: Vec<[u32; 3]>) -> Vec<[u32; 3]> {
    let mut at_edge: BTreeMap<[u32; 2], Vec<usize>> = BTreeMap::new();
    for (number, nodes) in triangles.iter().enumerate() {
        for edge in edges_of(*nodes) {
            at_edge.entry(ascending(edge)).or_default().push(number);
        }
    }
    let mut left: BTreeSet<usize> = (0..triangles.len()).collect();
    let mut open = Vec::new();
    while let Some(first) = left.pop_first() {
        open.push(first);
        while let Some(number) = open.pop() {
            for edge in edges_of(triangles[number]) {
                for &other in &at_edge[&ascending(edge)] {
                    if !left.remove(&other) {
                        continue;
                    }
                    if edges_of(triangles[other]).contains(&edge) {
                        triangles[other].swap(1, 2);
                    }
                    open.push(other);
                }
            }
        }
    }
    triangles
}

/// Triangles of a polygon that does not cross itself, with its orientation.
fn ears(corners: &[[f64; 2]]) -> Vec<[u32; 3]> {
    let n = corners.len();
    let doubled: f64 = (1..n - 1)
        .map(|k| left(corners[0], corners[k], corners[k + 1]))
        .sum();
    let turn =
        |a: usize, b: usize, c: usize| doubled.signum() * left(corners[a], corners[b], corners[c]);
    let mut left: Vec<usize> = (0..n).collect();
    let mut triangles = Vec::new();
    while left.len() > 3 {
        let m = left.len();
        let is_ear = |place: usize| {
            let [a, b, c] = [
                left[(place + m - 1) % m],
                left[place],
                left[(place + 1) % m],
            ];
            // No corner may lie in the ear, or within rounding of the side that it leaves.
            let is_free = |&k: &usize| {
                let beyond = turn(c, a, k) < -FLATNESS * doubled.abs();
                [a, b, c].contains(&k) || beyond || turn(a, b, k) < 0.0 || turn(b, c, k) < 0.0
            };
            turn(a, b, c) > 0.0 && left.iter().all(is_free)
        };
        // A corner on a straight side is no ear, but is removed with one of its neighbours; without any ear, rounding would have bent a
        // side.
        let place = (0..m).find(|place| is_ear(*place)).unwrap_or_default();
        let [a, b, c] = [
            left[(place + m - 1) % m],
            left[place],
            left[(place + 1) % m],
        ];
        triangles.push([a, b, c].map(|k| k as u32));
        left.remove(place);
    }
    triangles.push([left[0], left[1], left[2]].map(|k| k as u32));
    triangles
}

/// Distance between two segments, m.
fn gap([a, b]: [[f64; 3]; 2], [p, q]: [[f64; 3]; 2]) -> f64 {
    let (u, v, w) = (minus(b, a), minus(q, p), minus(a, p));
    let across = cross(u, v);
    let size = dot(across, across);
    let between = |place: f64| (0.0..=1.0).contains(&place);
    // Feet of the common perpendicular, where it meets both segments.
    let places = [
        -dot(cross(w, v), across) / size,
        -dot(cross(w, u), across) / size,
    ];
    if size > 0.0 && places.into_iter().all(between) {
        return dot(w, across).abs() / size.sqrt();
    }
    let ends = [
        distance_to([p, q], a),
        distance_to([p, q], b),
        distance_to([a, b], p),
        distance_to([a, b], q),
    ];
    ends.into_iter().fold(f64::INFINITY, f64::min)
}

/// Height of a point over or under a triangle, m; infinite where its projection lies outside the triangle.
fn height_over([p, q, r]: [[f64; 3]; 3], point: [f64; 3]) -> f64 {
    let normal = cross(minus(q, p), minus(r, p));
    let is_over = edges_of([p, q, r])
        .into_iter()
        .all(|[from, to]| dot(cross(minus(to, from), minus(point, from)), normal) >= 0.0);
    if is_over {
        dot(normal, minus(point, p)).abs() / norm(normal)
    } else {
        f64::INFINITY
    }
}
