//! Triangles and lines in space.

use super::View;

/// Drawable parts of a solid: places with their displacements, triangles between them and lines over them.
#[derive(Debug, Clone, PartialEq, Default)]
pub(crate) struct Scene {
    /// Places without load, shape (n_places), m.
    pub(super) places: Vec<[f64; 3]>,
    /// Displacements, shape (n_places), m.
    pub(super) moved: Vec<[f64; 3]>,
    /// Values of the field at the places; empty without one.
    pub(super) values: Vec<f64>,
    /// Corners of the triangles.
    pub(super) triangles: Vec<[u32; 3]>,
    /// Ends of lines: edges of the body.
    pub(super) edges: Vec<[u32; 2]>,
    /// Whether lines are drawn also where triangles hide them.
    pub(super) shows_all_edges: bool,
}

impl Scene {
    /// Adds a place; returns its number.
    pub(super) fn push(&mut self, place: [f64; 3], moved: [f64; 3], value: Option<f64>) -> u32 {
        self.places.push(place);
        self.moved.push(moved);
        self.values.extend(value);
        self.places.len() as u32 - 1
    }

    /// Positions and displacements in the axes of the view, to the right and up, m.
    pub(crate) fn projected_places(&self, view: View) -> [Vec<[f64; 2]>; 2] {
        [&self.places, &self.moved].map(|all| {
            let seen = all.iter().map(|it| view.projected_places(*it));
            seen.map(|[right, up, _]| [right, up]).collect()
        })
    }

    /// Deformed places in the axes of the view: to the right, up and to the eye, m.
    pub(super) fn deformed(&self, view: View, factor: f64) -> Vec<[f64; 3]> {
        let moved = self.places.iter().zip(&self.moved);
        moved
            .map(|(p, u)| view.projected_places([0, 1, 2].map(|axis| p[axis] + factor * u[axis])))
            .collect()
    }
}
