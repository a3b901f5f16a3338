//! Outlines and lines in whole hundredths of a pixel.

use serde::{Deserialize, Serialize};
use tiny_skia::{Path, PathBuilder, Transform};

/// Units of coordinates per pixel: a unit is 2.6 micrometres on paper.
pub(super) const UNITS_PER_PIXEL: f64 = 100.0;

/// Pieces of a path.
#[derive(Debug, Default, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub(crate) struct PathData {
    /// Corners of all pieces, hundredths of a pixel.
    points: Vec<[i32; 2]>,
    /// Number of corners up to the end of each piece, and whether it is a closed outline.
    ends: Vec<(usize, bool)>,
}

impl PathData {
    pub(super) fn is_empty(&self) -> bool {
        self.ends.is_empty()
    }

    /// Adds a closed outline; one without extent is left out.
    pub(crate) fn outline(&mut self, points: impl IntoIterator<Item = [f64; 2]>) {
        let start = self.push(points);
        while self.points.len() > start + 1 && self.points.last() == self.points.get(start) {
            self.points.pop();
        }
        self.finish(start, 3, true);
    }

    /// Adds lines from each point to the next; those without length are left out.
    pub(crate) fn line(&mut self, points: impl IntoIterator<Item = [f64; 2]>) {
        let start = self.push(points);
        self.finish(start, 2, false);
    }

    /// Adds a line between two points, which may coincide.
    pub(crate) fn segment(&mut self, ends: [[f64; 2]; 2]) {
        self.points.extend(ends.map(units));
        self.ends.push((self.points.len(), false));
    }

    /// Adds the corners of a piece, without repeated ones, and returns the number of the first.
    fn push(&mut self, points: impl IntoIterator<Item = [f64; 2]>) -> usize {
        let start = self.points.len();
        for point in points.into_iter().map(units) {
            if self.points.len() == start || self.points.last() != Some(&point) {
                self.points.push(point);
            }
        }
        start
    }

    /// Ends a piece, which is left out where it has fewer corners than it needs.
    fn finish(&mut self, start: usize, fewest: usize, is_closed: bool) {
        if self.points.len() - start < fewest {
            self.points.truncate(start);
        } else {
            self.ends.push((self.points.len(), is_closed));
        }
    }

    /// Corners of each piece in hundredths of a pixel, and whether it is closed.
    pub(super) fn pieces(&self) -> impl Iterator<Item = (&[[i32; 2]], bool)> {
        let mut start = 0;
        self.ends.iter().map(move |&(end, is_closed)| {
            let piece = &self.points[start..end];
            start = end;
            (piece, is_closed)
        })
    }

    /// The path in pixels; None where it has no finite extent.
    pub(super) fn in_pixels(&self) -> Option<Path> {
        let mut builder = PathBuilder::new();
        for (points, is_closed) in self.pieces() {
            for (place, point) in points.iter().enumerate() {
                let [x, y] = point.map(|it| it as f32);
                match place {
                    0 => builder.move_to(x, y),
                    _ => builder.line_to(x, y),
                }
            }
            if is_closed {
                builder.close();
            }
        }
        let unit = (1.0 / UNITS_PER_PIXEL) as f32;
        builder
            .finish()?
            .transform(Transform::from_scale(unit, unit))
    }
}

fn units(point: [f64; 2]) -> [i32; 2] {
    point.map(|it| (it * UNITS_PER_PIXEL).round() as i32)
}
