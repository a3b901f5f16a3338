//! Smoothing of surfaces that follow the cells from which they were cut.

use std::collections::{BTreeMap, BTreeSet};

use ligament_model::tensor::{dot, norm};

use super::surface::{CrackSurface, area_vector};

/// Number of sweeps over all places: roughness up to some four edges long disappears.
const SWEEPS: usize = 20;

/// Fraction of the distance to the mean of its neighbours by which a place moves in a sweep.
const SHARE: f64 = 0.5;

/// Edges of a surface.
struct Edges {
    /// Neighbours of each place, ascending; for a place on the rim only its neighbours along the rim.
    neighbours: Vec<Vec<u32>>,
    /// Places on edges with one triangle.
    rim: BTreeSet<u32>,
}

impl CrackSurface {
    /// The surface with each place moved half way to the mean of its neighbours, twenty times.
    ///
    /// On the rim, where an edge has one triangle, only neighbours along the rim count, and places move along the normal alone: the rim
    /// does not shrink, and stays on a face of the body orthogonal to the crack. If a surface is smooth on the scale of a few cells, its
    /// area and shape agree with the crack to 2 % (`tests/crack_surfaces.rs`); before, the area is up to 1.7 times as large. A closed
    /// surface of radius R shrinks: R^2 decreases by about two squared cell sizes.
    pub fn smoothed(mut self) -> Self {
        let edges = self.edges();
        let triangles_of = self.triangles_of();
        for _ in 0..SWEEPS {
            let moved = |(number, place): (usize, &[f64; 3])| {
                let near = &edges.neighbours[number];
                if near.is_empty() {
                    return *place;
                }
                let way = [0, 1, 2].map(|axis| {
                    let sum: f64 = near.iter().map(|it| self.places[*it as usize][axis]).sum();
                    SHARE * (sum / near.len() as f64 - place[axis])
                });
                if !edges.rim.contains(&(number as u32)) {
                    return [0, 1, 2].map(|axis| place[axis] + way[axis]);
                }
                let normal = normal(&self.places, &triangles_of[number]);
                let ahead = dot(normal, way);
                [0, 1, 2].map(|axis| place[axis] + ahead * normal[axis])
            };
            self.places = self.places.iter().enumerate().map(moved).collect();
        }
        self
    }

    /// Unit normal at each place, shape (n_places); zero at places without a triangle.
    pub fn normals(&self) -> Vec<[f64; 3]> {
        let triangles_of = self.triangles_of();
        let of = triangles_of.iter();
        of.map(|it| normal(&self.places, it)).collect()
    }

    fn triangles_of(&self) -> Vec<Vec<[u32; 3]>> {
        let mut triangles_of = vec![Vec::new(); self.places.len()];
        for triangle in &self.triangles {
            for place in triangle {
                triangles_of[*place as usize].push(*triangle);
            }
        }
        triangles_of
    }

    fn edges(&self) -> Edges {
        let mut edges: BTreeMap<[u32; 2], usize> = BTreeMap::new();
        for &[a, b, c] in &self.triangles {
            for [p, q] in [[a, b], [b, c], [c, a]] {
                *edges.entry([p.min(q), p.max(q)]).or_default() += 1;
            }
        }
        let of_one = edges.iter().filter(|(_, count)| **count == 1);
        let rim: BTreeSet<u32> = of_one.flat_map(|(ends, _)| *ends).collect();
        let mut neighbours = vec![Vec::new(); self.places.len()];
        for (&[a, b], &count) in &edges {
            for [one, other] in [[a, b], [b, a]] {
                if count == 1 || !rim.contains(&one) {
                    neighbours[one as usize].push(other);
                }
            }
        }
        Edges { neighbours, rim }
    }
}

/// Unit normal at the common corner of triangles, whatever their orientation; zero without any.
fn normal(places: &[[f64; 3]], triangles: &[[u32; 3]]) -> [f64; 3] {
    let mut sum = [0.0; 3];
    for triangle in triangles {
        let area = area_vector(places, *triangle);
        let sign = if dot(sum, area) < 0.0 { -1.0 } else { 1.0 };
        sum = [0, 1, 2].map(|axis| sum[axis] + sign * area[axis]);
    }
    let length = norm(sum);
    if length > 0.0 {
        sum.map(|it| it / length)
    } else {
        sum
    }
}
