//! Triangles and lines that other triangles do not hide.

use std::ops::Range;

/// Dots of the buffer per pixel along each side.
const DOTS: f64 = 3.0;

/// Largest number of dots along a side.
const MOST: usize = 6000;

/// Depths of the nearest triangle at dots of the picture.
pub(super) struct DepthBuffer {
    low: [f64; 2],
    /// Dots per metre.
    scale: f64,
    size: [usize; 2],
    /// Depth, m, and number of the nearest triangle, the first of equals; rows from below.
    nearest: Vec<(f64, u32)>,
}

/// Share of a triangle by which a dot may lie outside of it, so that none is lost between two triangles.
const SLACK: f64 = 1e-9;

/// The part of a range in which three linear functions are not negative.
fn nonnegative_range(whole: Range<f64>, starts: [f64; 3], slopes: [f64; 3]) -> Range<f64> {
    let mut part = whole;
    for (start, slope) in starts.into_iter().zip(slopes) {
        let zero = -(SLACK + start) / slope;
        if slope > 0.0 {
            part.start = part.start.max(zero);
        } else if slope < 0.0 {
            part.end = part.end.min(zero);
        } else if start < -SLACK {
            part.end = part.start - 1.0;
        }
    }
    part
}

/// Index of no triangle.
const NONE: u32 = u32::MAX;

impl DepthBuffer {
    /// The buffer of triangles in the axes of the view (to the right, up, to the eye, m) for a part of the picture, with a scale in pixels per metre.
    pub(super) fn new(
        seen: &[[f64; 3]],
        triangles: &[[u32; 3]],
        [low, high]: [[f64; 2]; 2],
        pixels: f64,
    ) -> Self {
        let extent = [0, 1].map(|axis| (high[axis] - low[axis]).max(f64::MIN_POSITIVE));
        let most = (MOST as f64 - 2.0) / extent[0].max(extent[1]);
        let scale = (DOTS * pixels).min(most);
        let size = extent.map(|it| (it * scale).ceil() as usize + 1);
        let mut buffer = Self {
            low,
            scale,
            size,
            nearest: vec![(f64::NEG_INFINITY, NONE); size[0] * size[1]],
        };
        for (number, corners) in (0..).zip(triangles) {
            buffer.add(number, corners.map(|it| seen[it as usize]));
        }
        buffer
    }

    /// A place in dots.
    fn dots(&self, [x, y, _]: [f64; 3]) -> [f64; 2] {
        [
            (x - self.low[0]) * self.scale,
            (y - self.low[1]) * self.scale,
        ]
    }

    fn add(&mut self, number: u32, corners: [[f64; 3]; 3]) {
        let [a, b, c] = corners.map(|it| self.dots(it));
        let twice = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
        if twice == 0.0 || !twice.is_finite() {
            return;
        }
        let span = |axis: usize| {
            let of = [a[axis], b[axis], c[axis]];
            let low = of.into_iter().fold(f64::INFINITY, f64::min).ceil().max(0.0);
            let high = of.into_iter().fold(f64::NEG_INFINITY, f64::max).floor();
            low as usize..(high + 1.0).clamp(0.0, self.size[axis] as f64) as usize
        };
        let (columns, rows) = (span(0), span(1));
        // Shares of the corners are linear over the dots, and so is the depth.
        let share = |p: [f64; 2], q: [f64; 2]| {
            let slopes = [(p[1] - q[1]) / twice, (q[0] - p[0]) / twice];
            (slopes, -slopes[0] * p[0] - slopes[1] * p[1])
        };
        let shares = [share(b, c), share(c, a), share(a, b)];
        let depths = corners.map(|it| it[2]);
        let along = (0..3).map(|it| shares[it].0[0] * depths[it]).sum::<f64>();
        for row in rows {
            let starts = shares.map(|([_, up], at)| at + up * row as f64);
            let slopes = shares.map(|it| it.0[0]);
            let whole = columns.start as f64..columns.end as f64 - 1.0;
            let inside = nonnegative_range(whole, starts, slopes);
            let depth = (0..3).map(|it| starts[it] * depths[it]).sum::<f64>();
            let first = inside.start.ceil() as usize;
            let end = (inside.end.floor() + 1.0).max(0.0) as usize;
            let start = row * self.size[0];
            let dots = self.nearest.get_mut(start + first..start + end);
            for (column, nearest) in (first..).zip(dots.unwrap_or_default()) {
                let depth = depth + along * column as f64;
                if depth > nearest.0 {
                    *nearest = (depth, number);
                }
            }
        }
    }

    /// Whether each triangle is the nearest one at some dot, or in its middle.
    pub(super) fn visible(&self, seen: &[[f64; 3]], triangles: &[[u32; 3]]) -> Vec<bool> {
        let mut visible = vec![false; triangles.len()];
        for (_, number) in self.nearest.iter().filter(|it| it.1 != NONE) {
            visible[*number as usize] = true;
        }
        for (visible, corners) in visible.iter_mut().zip(triangles) {
            let corners = corners.map(|it| seen[it as usize]);
            let middle = [0, 1, 2].map(|axis| corners.iter().map(|it| it[axis]).sum::<f64>() / 3.0);
            *visible |= self.is_visible(middle);
        }
        visible
    }

    /// Whether a place is not behind a triangle, with a tolerance of two dots.
    pub(super) fn is_visible(&self, place: [f64; 3]) -> bool {
        let [x, y] = self.dots(place).map(f64::round);
        let is_inside = x >= 0.0 && y >= 0.0 && x < self.size[0] as f64 && y < self.size[1] as f64;
        if !is_inside {
            return false;
        }
        let (depth, _) = self.nearest[y as usize * self.size[0] + x as usize];
        place[2] >= depth - 2.0 / self.scale
    }

    /// The visible pieces of a line, in steps of a pixel.
    pub(super) fn visible_pieces(&self, [from, to]: [[f64; 3]; 2]) -> Vec<[[f64; 2]; 2]> {
        let [a, b] = [from, to].map(|it| self.dots(it));
        let length = (b[0] - a[0]).hypot(b[1] - a[1]) / DOTS;
        let count = if length.is_finite() {
            (length.ceil() as usize).clamp(1, MOST)
        } else {
            1
        };
        let at = |share: f64| [0, 1, 2].map(|axis| from[axis] + share * (to[axis] - from[axis]));
        let mut pieces: Vec<[f64; 2]> = Vec::new();
        for step in 0..count {
            let [start, middle, end] = [0.0, 0.5, 1.0].map(|it| (step as f64 + it) / count as f64);
            if !self.is_visible(at(middle)) {
                continue;
            }
            match pieces.last_mut() {
                Some(piece) if piece[1] == start => piece[1] = end,
                _ => pieces.push([start, end]),
            }
        }
        let flat = |share: f64| {
            let [x, y, _] = at(share);
            [x, y]
        };
        pieces.into_iter().map(|piece| piece.map(flat)).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A small triangle behind and one before a large one: the first is hidden, and so is the part of a line behind.
    #[test]
    fn what_is_behind_is_hidden() {
        let seen = [
            [0.0, 0.0, 0.0],
            [4.0, 0.0, 0.0],
            [0.0, 4.0, 0.0],
            [0.5, 0.5, -1.0],
            [1.0, 0.5, -1.0],
            [0.5, 1.0, -1.0],
            [0.5, 0.5, 1.0],
            [1.0, 0.5, 1.0],
            [0.5, 1.0, 1.0],
        ];
        let triangles = [[0, 1, 2], [3, 4, 5], [6, 7, 8]];
        let buffer = DepthBuffer::new(&seen, &triangles, [[-4.0; 2], [4.0; 2]], 20.0);
        assert_eq!(buffer.visible(&seen, &triangles), [true, false, true]);
        let pieces = buffer.visible_pieces([[-3.0, 1.0, -1.0], [3.0, 1.0, -1.0]]);
        assert_eq!(pieces.len(), 1);
        assert_eq!(pieces[0][0], [-3.0, 1.0]);
        assert!(pieces[0][1][0].abs() < 0.2, "{pieces:?}");
    }
}
