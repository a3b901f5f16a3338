//! Crack surface between the sides of tetrahedra.

use std::collections::HashMap;

use ligament_model::tensor::{dot, minus};

use super::Link;
use super::detached::sides_of_tetrahedra;
use super::sides::Links;
use super::surface::{CrackSurface, with_orientation_and_parts};
use super::tetrahedra::{EDGES, Tetrahedra};

/// Filler for the unused end of the key of a place, not the number of a node.
const NONE: u32 = u32::MAX;

/// State of the search for the surface.
struct SurfaceSearch<'a> {
    tetrahedra: &'a Tetrahedra,
    links: &'a Links,
    surface: CrackSurface,
    /// Numbers of the places by the nodes between which they lie.
    found: HashMap<[u32; 4], u32>,
}

/// The surface between the sides of tetrahedra, for the links of their points. See [the rules](super).
pub fn crack_surface(tetrahedra: &Tetrahedra, links: &Links) -> CrackSurface {
    let mut finder = SurfaceSearch {
        tetrahedra,
        links,
        surface: CrackSurface::default(),
        found: HashMap::new(),
    };
    let sides = sides_of_tetrahedra(tetrahedra, links);
    for (corners, sides) in tetrahedra.corners.iter().zip(sides) {
        finder.add(corners, sides);
    }
    with_orientation_and_parts(finder.surface)
}

/// Polygons between the sides of a tetrahedron: their corners, each the middle of some corners of the tetrahedron, with the two sides.
pub(super) fn interfaces(sides: [u8; 4]) -> Vec<([u8; 2], Vec<Vec<usize>>)> {
    let count = sides.iter().max().map_or(0, |it| it + 1);
    let corners_of = |side: u8| (0..4).filter(move |corner| sides[*corner] == side);
    let mut polygons = Vec::new();
    for one in 0..count {
        for other in one + 1..count {
            let [ours, theirs]: [Vec<usize>; 2] = [one, other].map(|it| corners_of(it).collect());
            let third: Vec<usize> = (0..4)
                .filter(|it| sides[*it] != one && sides[*it] != other)
                .collect();
            let polygon = match (ours.as_slice(), theirs.as_slice(), third.as_slice()) {
                (&[a], &[b], &[c, d]) if count == 4 => {
                    vec![vec![a, b], vec![a, b, c], vec![a, b, c, d], vec![a, b, d]]
                }
                (&[a], &[b], &[c, d]) => vec![vec![a, b], vec![a, b, c], vec![a, b, d]],
                (&[a], &[c, d], &[b]) | (&[c, d], &[a], &[b]) => {
                    vec![vec![a, c], vec![a, b, c], vec![a, b, d], vec![a, d]]
                }
                (&[a, b], &[c, d], _) => vec![vec![a, c], vec![a, d], vec![b, d], vec![b, c]],
                (&[a], others, _) | (others, &[a], _) => {
                    others.iter().map(|it| vec![a, *it]).collect()
                }
                _ => continue,
            };
            polygons.push(([one, other], polygon));
        }
    }
    polygons
}

impl SurfaceSearch<'_> {
    fn add(&mut self, corners: &[u32; 4], sides: [u8; 4]) {
        for (between, polygon) in interfaces(sides) {
            let is_precrack = self.is_precrack(corners, sides, between);
            let places: Vec<u32> = (polygon.iter())
                .map(|of| self.place(corners, of, sides))
                .collect();
            let triangles = match *places.as_slice() {
                [a, b, c, d] if self.squared_length([b, d]) < self.squared_length([a, c]) => {
                    vec![[a, b, d], [b, c, d]]
                }
                [a, b, c, d] => vec![[a, b, c], [a, c, d]],
                [a, b, c] => vec![[a, b, c]],
                _ => Vec::new(),
            };
            self.surface
                .is_precrack
                .extend(triangles.iter().map(|_| is_precrack));
            self.surface.triangles.extend(triangles);
        }
    }

    /// Whether all cut edges between two sides of a tetrahedron were cut by a pre-crack.
    fn is_precrack(&self, corners: &[u32; 4], sides: [u8; 4], between: [u8; 2]) -> bool {
        let crossing = EDGES.into_iter().filter(|[a, b]| {
            let of_ends = [sides[*a], sides[*b]];
            of_ends == between || of_ends == [between[1], between[0]]
        });
        let links = crossing.map(|it| self.links.between(self.tetrahedra.pair(corners, it)));
        let mut cut = links.filter(|link| link.is_cut()).peekable();
        cut.peek().is_some() && cut.all(|link| link == Link::PreCrack)
    }

    fn squared_length(&self, ends: [u32; 2]) -> f64 {
        let [p, q] = ends.map(|it| self.surface.places[it as usize]);
        let way = minus(q, p);
        dot(way, way)
    }

    /// Number of the place in the middle of some corners of a tetrahedron.
    fn place(&mut self, corners: &[u32; 4], of: &[usize], sides: [u8; 4]) -> u32 {
        let mut key = [NONE; 4];
        for (entry, corner) in key.iter_mut().zip(of) {
            *entry = corners[*corner];
        }
        key.sort_unstable();
        if let Some(&place) = self.found.get(&key) {
            return place;
        }
        let nodes = &self.tetrahedra.nodes;
        let middle = [0, 1, 2].map(|axis| {
            // Summed in the order of the nodes, so that the result is the same from any tetrahedron.
            let all = key.iter().filter(|node| **node != NONE);
            let sum = all.map(|node| nodes[*node as usize][axis]).sum::<f64>();
            sum / of.len() as f64
        });
        let parted = EDGES
            .into_iter()
            .filter(|[a, b]| of.contains(a) && of.contains(b) && sides[*a] != sides[*b]);
        let parted = parted.map(|ends| self.tetrahedra.pair(corners, ends));
        let place = self.surface.places.len() as u32;
        self.surface.parted.push(parted.collect());
        self.surface.places.push(middle);
        self.found.insert(key, place);
        place
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The corners of every polygon, by the number of sides; polygons of neighbours end on the same segments of a face.
    #[test]
    fn polygons_close_on_the_faces() {
        for sides in [
            [0, 1, 1, 1],
            [0, 0, 1, 1],
            [0, 1, 0, 1],
            [0, 1, 2, 2],
            [0, 1, 2, 1],
            [0, 1, 2, 3],
        ] {
            let mut segments: Vec<[Vec<usize>; 2]> = Vec::new();
            for (between, polygon) in interfaces(sides) {
                let n = polygon.len();
                assert!(between[0] < between[1] && (3..=4).contains(&n));
                for k in 0..n {
                    let mut ends = [polygon[k].clone(), polygon[(k + 1) % n].clone()];
                    ends.iter_mut().for_each(|it| it.sort_unstable());
                    ends.sort();
                    segments.push(ends);
                }
            }
            for face in [[0, 1, 2], [0, 1, 3], [0, 2, 3], [1, 2, 3]] {
                let on_face = |it: &&[Vec<usize>; 2]| it.iter().flatten().all(|c| face.contains(c));
                let of_face = face.map(|corner| sides[corner]);
                let mut all = of_face.to_vec();
                all.sort_unstable();
                all.dedup();
                let expected = [0, 1, 3][all.len() - 1];
                assert_eq!(
                    segments.iter().filter(on_face).count(),
                    expected,
                    "{sides:?} {face:?}"
                );
            }
        }
    }
}
