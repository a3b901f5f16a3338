//! Graph of the open faces, and shortest paths in it.

use std::cmp::Reverse;
use std::collections::BinaryHeap;

use super::faces::{FaceState, Faces, distance};

/// Open faces as edges between their corners.
pub(super) struct Graph {
    /// Corners, in the order of the corners of the faces.
    pub(super) corners: Vec<Corner>,
    edges: Vec<OpenFace>,
}

/// A corner at which open faces end.
pub(super) struct Corner {
    /// Position, m.
    pub(super) place: [f64; 2],
    /// Mean horizon of the points around the corner, m: the resolution of the crack.
    pub(super) horizon: f64,
    /// Whether a face cut by a pre-crack ends at the corner.
    pub(super) is_cut: bool,
    /// Whether the corner lies on the outline of the body.
    pub(super) is_outside: bool,
    /// Open faces that end at the corner, ascending.
    open: Vec<u32>,
}

struct OpenFace {
    ends: [u32; 2],
    middle: [f64; 2],
    /// Length via the middle of the face, m.
    length: f64,
}

/// Shortest paths from some corners to all others.
pub(super) struct ShortestPaths {
    /// Length of the path to each corner, m; infinite where there is none.
    pub(super) length: Vec<f64>,
    /// Last face of the path to each corner.
    last_face: Vec<Option<u32>>,
}

/// A path along open faces.
pub(super) struct CrackPath {
    /// Corners from start to end, one or more.
    pub(super) corners: Vec<u32>,
    /// Positions of corners and, between two of them, of the middle of their face, m.
    pub(super) places: Vec<[f64; 2]>,
}

impl CrackPath {
    /// The path from its end to its start.
    pub(super) fn reversed(mut self) -> Self {
        self.corners.reverse();
        self.places.reverse();
        self
    }

    /// Corners at the start and the end.
    pub(super) fn ends(&self) -> [u32; 2] {
        [self.corners[0], self.corners[self.corners.len() - 1]]
    }

    /// Extends the path by another path that starts at one of its ends.
    pub(super) fn append(&mut self, other: Self) {
        let [start, end] = self.ends();
        let root = other.corners[0];
        if root == start && root != end {
            self.corners.reverse();
            self.places.reverse();
        }
        self.corners.extend(&other.corners[1..]);
        self.places.extend(&other.places[1..]);
    }
}

impl Graph {
    /// The graph of faces with given states (n_faces), for the horizons of the points (n_points), m.
    pub(super) fn new(faces: &Faces, states: &[FaceState], horizon: &[f64]) -> Self {
        let mut is_cut = vec![false; faces.corners.len()];
        let mut numbers = vec![u32::MAX; faces.corners.len()];
        for (ends, state) in faces.ends.iter().zip(states) {
            for &end in ends {
                is_cut[end as usize] |= *state == FaceState::PreCrack;
                if *state == FaceState::Open {
                    numbers[end as usize] = 0;
                }
            }
        }
        let mut corners = Vec::new();
        for (number, corner) in numbers.iter_mut().enumerate().filter(|it| *it.1 == 0) {
            *corner = corners.len() as u32;
            corners.push(Corner {
                place: faces.corners[number],
                horizon: 0.0,
                is_cut: is_cut[number],
                is_outside: faces.is_outside[number],
                open: Vec::new(),
            });
        }
        let mut edges = Vec::new();
        let open = (0..faces.len()).filter(|&face| states[face] == FaceState::Open);
        for face in open {
            let ends = faces.ends[face].map(|it| numbers[it as usize]);
            let middle = faces.middle[face];
            let horizon = faces.points()[face].map(|it| 0.5 * horizon[it as usize]);
            let mut length = 0.0;
            for end in ends {
                let corner: &mut Corner = &mut corners[end as usize];
                corner.open.push(edges.len() as u32);
                corner.horizon += horizon[0] + horizon[1];
                length += distance(corner.place, middle);
            }
            edges.push(OpenFace {
                ends,
                middle,
                length,
            });
        }
        for corner in &mut corners {
            corner.horizon /= corner.open.len() as f64;
        }
        Self { corners, edges }
    }

    /// Connects two corners by a straight edge.
    pub(super) fn add_straight_edge(&mut self, ends: [u32; 2]) {
        let [a, b] = ends.map(|it| self.corners[it as usize].place);
        for end in ends {
            self.corners[end as usize]
                .open
                .push(self.edges.len() as u32);
        }
        self.edges.push(OpenFace {
            ends,
            middle: [0.5 * (a[0] + b[0]), 0.5 * (a[1] + b[1])],
            length: distance(a, b),
        });
    }

    /// Corners of each connected part, both in the order of their numbers.
    pub(super) fn components(&self) -> Vec<Vec<u32>> {
        let mut is_found = vec![false; self.corners.len()];
        let mut components = Vec::new();
        for start in 0..self.corners.len() as u32 {
            if std::mem::replace(&mut is_found[start as usize], true) {
                continue;
            }
            let mut component = vec![start];
            let mut next = 0;
            while let Some(&corner) = component.get(next) {
                next += 1;
                for &face in &self.corners[corner as usize].open {
                    let far = self.opposite_end(face, corner);
                    if !std::mem::replace(&mut is_found[far as usize], true) {
                        component.push(far);
                    }
                }
            }
            component.sort_unstable();
            components.push(component);
        }
        components
    }

    /// Length of all open faces of a connected part, m.
    pub(super) fn total_length(&self, component: &[u32]) -> f64 {
        let corners = component.iter().map(|&it| &self.corners[it as usize]);
        let faces = corners.flat_map(|it| &it.open);
        faces
            .map(|&face| 0.5 * self.edges[face as usize].length)
            .sum()
    }

    /// Shortest paths from some corners; among paths of equal length, the one through the corner with the lower number.
    pub(super) fn shortest_paths_from(&self, starts: &[u32]) -> ShortestPaths {
        let mut paths = ShortestPaths {
            length: vec![f64::INFINITY; self.corners.len()],
            last_face: vec![None; self.corners.len()],
        };
        // Lengths are not negative, so that their bits have the same order.
        let mut front = BinaryHeap::new();
        for &start in starts {
            paths.length[start as usize] = 0.0;
            front.push(Reverse((0.0_f64.to_bits(), start)));
        }
        while let Some(Reverse((bits, corner))) = front.pop() {
            let length = f64::from_bits(bits);
            if length > paths.length[corner as usize] {
                continue;
            }
            for &face in &self.corners[corner as usize].open {
                let far = self.opposite_end(face, corner);
                let longer = length + self.edges[face as usize].length;
                if longer < paths.length[far as usize] {
                    paths.length[far as usize] = longer;
                    paths.last_face[far as usize] = Some(face);
                    front.push(Reverse((longer.to_bits(), far)));
                }
            }
        }
        paths
    }

    /// The path to a corner from its start.
    pub(super) fn path_to(&self, paths: &ShortestPaths, end: u32) -> CrackPath {
        let mut corners = vec![end];
        let mut places = vec![self.corners[end as usize].place];
        let mut corner = end;
        while let Some(face) = paths.last_face[corner as usize] {
            corner = self.opposite_end(face, corner);
            corners.push(corner);
            places.push(self.edges[face as usize].middle);
            places.push(self.corners[corner as usize].place);
        }
        CrackPath { corners, places }.reversed()
    }

    fn opposite_end(&self, face: u32, corner: u32) -> u32 {
        let [a, b] = self.edges[face as usize].ends;
        if a == corner { b } else { a }
    }
}
