//! Part of a plane that is shown in a rectangle of a drawing.

use super::PathData;

/// A part of the plane of two quantities in a rectangle of a drawing, with the second quantity upwards.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Frame {
    /// Lower left corner of the part.
    pub(crate) low: [f64; 2],
    /// Upper right corner.
    pub(crate) high: [f64; 2],
    /// Upper left corner of the rectangle, pixels.
    pub(crate) at: [f64; 2],
    /// Pixels per unit of each quantity.
    pub(crate) scale: [f64; 2],
}

impl Frame {
    /// The part between two corners, in a rectangle given by its upper left corner and its size, pixels.
    pub(crate) fn new([low, high]: [[f64; 2]; 2], [at, size]: [[f64; 2]; 2]) -> Self {
        Self {
            low,
            high,
            at,
            scale: [0, 1].map(|axis| size[axis] / (high[axis] - low[axis])),
        }
    }

    /// Width and height of the rectangle, pixels.
    pub(crate) fn size(&self) -> [f64; 2] {
        [0, 1].map(|axis| (self.high[axis] - self.low[axis]) * self.scale[axis])
    }

    /// A place in pixels.
    pub(crate) fn to_pixels(self, [x, y]: [f64; 2]) -> [f64; 2] {
        [
            self.at[0] + (x - self.low[0]) * self.scale[0],
            self.at[1] + (self.high[1] - y) * self.scale[1],
        ]
    }

    /// Whether a place lies in the part.
    pub(crate) fn has(&self, place: [f64; 2]) -> bool {
        (0..2).all(|axis| (self.low[axis]..=self.high[axis]).contains(&place[axis]))
    }

    /// Whether a polygon may reach into the part.
    pub(crate) fn may_intersect(&self, points: &[[f64; 2]]) -> bool {
        bounds(points).is_some_and(|[low, high]| {
            (0..2).all(|axis| low[axis] <= self.high[axis] && high[axis] >= self.low[axis])
        })
    }

    /// Adds the outline of a polygon that reaches into the part.
    pub(crate) fn add(&self, path: &mut PathData, outline: &[[f64; 2]]) {
        if self.may_intersect(outline) && outline.iter().flatten().all(|it| it.is_finite()) {
            path.outline(outline.iter().map(|&point| self.to_pixels(point)));
        }
    }

    /// Adds the pieces of a curve that lie in the part; a point that is not finite ends a piece.
    pub(crate) fn add_curve(&self, path: &mut PathData, points: &[[f64; 2]]) {
        for piece in inside(points, [self.low, self.high]) {
            path.line(piece.into_iter().map(|point| self.to_pixels(point)));
        }
    }
}

/// Lower left and upper right corner of a box around finite places; None without any.
pub(crate) fn bounds(places: &[[f64; 2]]) -> Option<[[f64; 2]; 2]> {
    let finite = places.iter().filter(|p| p.iter().all(|it| it.is_finite()));
    finite.fold(None, |found: Option<[[f64; 2]; 2]>, &p| {
        let [low, high] = found.unwrap_or([p, p]);
        Some([
            [low[0].min(p[0]), low[1].min(p[1])],
            [high[0].max(p[0]), high[1].max(p[1])],
        ])
    })
}

/// The pieces of a curve inside a window; a point that is not finite ends a piece.
fn inside(points: &[[f64; 2]], window: [[f64; 2]; 2]) -> Vec<Vec<[f64; 2]>> {
    let mut pieces: Vec<Vec<[f64; 2]>> = Vec::new();
    for pair in points.windows(2) {
        let Some([from, to]) = clipped(pair[0], pair[1], window) else {
            continue;
        };
        match pieces.last_mut() {
            Some(piece) if piece.last() == Some(&from) => piece.push(to),
            _ => pieces.push(vec![from, to]),
        }
    }
    pieces
}

/// The part of a segment inside a window (Liang and Barsky).
fn clipped(from: [f64; 2], to: [f64; 2], [lower, upper]: [[f64; 2]; 2]) -> Option<[[f64; 2]; 2]> {
    if !from.iter().chain(&to).all(|it| it.is_finite()) {
        return None;
    }
    let (mut enters, mut leaves) = (0.0, 1.0);
    for axis in 0..2 {
        let along = to[axis] - from[axis];
        for (rate, room) in [
            (-along, from[axis] - lower[axis]),
            (along, upper[axis] - from[axis]),
        ] {
            if rate == 0.0 && room < 0.0 {
                return None;
            }
            if rate < 0.0 {
                enters = f64::max(enters, room / rate);
            } else if rate > 0.0 {
                leaves = f64::min(leaves, room / rate);
            }
        }
    }
    let at = |share: f64| [0, 1].map(|axis| from[axis] + share * (to[axis] - from[axis]));
    let start = if enters == 0.0 { from } else { at(enters) };
    let end = if leaves == 1.0 { to } else { at(leaves) };
    (enters <= leaves).then_some([start, end])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn curves_end_at_the_window() {
        let window = [[-1.0, -1.0], [1.0, 1.0]];
        let zigzag = [[-2.0, 0.0], [0.0, 0.0], [0.0, 3.0], [0.5, 3.0], [0.5, -0.5]];
        let expected = vec![
            vec![[-1.0, 0.0], [0.0, 0.0], [0.0, 1.0]],
            vec![[0.5, 1.0], [0.5, -0.5]],
        ];
        assert_eq!(inside(&zigzag, window), expected);
        let broken = [
            [0.0, 0.0],
            [0.5, 0.0],
            [f64::NAN, 0.0],
            [0.5, 0.5],
            [0.6, 0.5],
        ];
        assert_eq!(inside(&broken, window).len(), 2);
        assert_eq!(
            inside(&[[-3.0, 2.0], [3.0, 2.0]], window),
            Vec::<Vec<[f64; 2]>>::new()
        );
    }

    #[test]
    fn places_are_right_and_up_from_the_lower_left_corner() {
        let frame = Frame::new([[0.0, 10.0], [2.0, 20.0]], [[5.0, 7.0], [100.0, 50.0]]);
        assert_eq!(frame.to_pixels([0.0, 10.0]), [5.0, 57.0]);
        assert_eq!(frame.to_pixels([2.0, 20.0]), [105.0, 7.0]);
        assert_eq!(frame.size(), [100.0, 50.0]);
        assert!(frame.has([2.0, 10.0]) && !frame.has([2.1, 10.0]));
    }
}
