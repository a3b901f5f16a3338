//! Curves of a plot: their points, marks and colours.

use crate::drawing::{Anchor, Drawing, Frame, Paint, PathData, Rgb};

/// Size of the letters of the legend and of the axes, pixels of a screen.
pub(super) const LETTERS: f64 = 15.0;

/// Lengths of dashes and of the gaps between them, pixels of a screen.
const DASHES: [f64; 2] = [7.0, 5.0];

/// Width of a curve, pixels of a screen.
const WIDTH: f64 = 2.0;

/// A curve of a plot, as a line, dots or both.
#[derive(Debug, Clone, PartialEq)]
pub struct Series {
    label: String,
    mark: Mark,
    colour: Colour,
    points: Vec<[f64; 2]>,
}

/// Style of a curve.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Mark {
    /// A line with dots, for computed values.
    Line,
    /// A line without dots, for computed values at many points.
    Curve,
    /// Open circles, for printed values.
    Circles,
    /// Crosses, for states that are not in equilibrium.
    Crosses,
    /// Triangles, for the beginning of an event.
    Triangles,
    /// A dashed line, for another theory.
    Dashes,
}

/// Colours that any colour vision can distinguish (Okabe and Ito).
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Colour {
    /// Black.
    Black,
    /// Blue.
    Blue,
    /// Vermilion.
    Vermilion,
    /// Bluish green.
    Green,
    /// Orange.
    Orange,
    /// Reddish purple.
    Purple,
    /// Sky blue.
    Sky,
}

impl Series {
    /// A curve through the points, shape (n, 2), in their order. The legend leaves out curves without a label or
    /// points.
    pub fn new(
        label: impl Into<String>,
        mark: Mark,
        colour: Colour,
        points: Vec<[f64; 2]>,
    ) -> Self {
        Self {
            label: label.into(),
            mark,
            colour,
            points,
        }
    }

    /// A line with dots.
    pub fn line(label: impl Into<String>, colour: Colour, points: Vec<[f64; 2]>) -> Self {
        Self::new(label, Mark::Line, colour, points)
    }

    /// A line without dots.
    pub fn curve(label: impl Into<String>, colour: Colour, points: Vec<[f64; 2]>) -> Self {
        Self::new(label, Mark::Curve, colour, points)
    }

    /// Open circles.
    pub fn circles(label: impl Into<String>, colour: Colour, points: Vec<[f64; 2]>) -> Self {
        Self::new(label, Mark::Circles, colour, points)
    }

    /// A dashed line.
    pub fn dashes(label: impl Into<String>, colour: Colour, points: Vec<[f64; 2]>) -> Self {
        Self::new(label, Mark::Dashes, colour, points)
    }

    /// Points of the series, shape (n, 2).
    pub fn points(&self) -> &[[f64; 2]] {
        &self.points
    }

    /// Whether the curve has an entry in the legend.
    pub(super) fn is_named(&self) -> bool {
        !self.label.is_empty() && !self.points.is_empty()
    }

    /// Words of the legend.
    pub(super) fn label(&self) -> &str {
        &self.label
    }

    /// The curve in the plane of its angles (rad) and radii.
    pub(super) fn in_plane(&self) -> Self {
        let place = |&[angle, radius]: &[f64; 2]| [radius * angle.cos(), radius * angle.sin()];
        Self {
            points: self.points.iter().map(place).collect(),
            ..self.clone()
        }
    }

    /// Draws the curve into a frame; `pen` is the number of pixels of the drawing per pixel of a screen.
    pub(super) fn draw(&self, drawing: &mut Drawing, frame: Frame, pen: f64) {
        if let Some(paint) = self.stroke(pen) {
            let mut path = PathData::default();
            frame.add_curve(&mut path, &self.points);
            drawing.path(path, paint);
        }
        for &point in self.points.iter().filter(|point| frame.has(**point)) {
            self.draw_symbol(drawing, frame.to_pixels(point), pen);
        }
    }

    /// Draws the entry of the curve in the legend from its left end.
    pub(super) fn draw_entry(&self, drawing: &mut Drawing, [x, y]: [f64; 2], pen: f64) {
        let along = |pixels: f64| x + pen * pixels;
        if let Some(paint) = self.stroke(pen) {
            let mut path = PathData::default();
            path.line([[along(4.0), y], [along(35.0), y]]);
            drawing.path(path, paint);
        }
        self.draw_symbol(drawing, [along(19.5), y], pen);
        let size = pen * LETTERS;
        let at = [along(44.0), y + 0.35 * size];
        drawing.text(at, Anchor::Start, size, &self.label);
    }

    /// Paint of the line between the points, if there is one.
    fn stroke(&self, pen: f64) -> Option<Paint> {
        let line = Paint::stroke(self.colour.rgb(), pen * WIDTH);
        match self.mark {
            Mark::Line | Mark::Curve => Some(line),
            Mark::Dashes => Some(Paint {
                dashes: Some(DASHES.map(|it| pen * it)),
                ..line
            }),
            Mark::Circles | Mark::Crosses | Mark::Triangles => None,
        }
    }

    /// Draws the symbol of a point of the curve.
    fn draw_symbol(&self, drawing: &mut Drawing, [x, y]: [f64; 2], pen: f64) {
        let colour = self.colour.rgb();
        let (line, dot) = (Paint::stroke(colour, pen * WIDTH), Paint::fill(colour));
        let at = |[right, down]: [f64; 2]| [x + pen * right, y + pen * down];
        let mut path = PathData::default();
        match self.mark {
            Mark::Curve | Mark::Dashes => {}
            Mark::Line => drawing.circle([x, y], 3.0 * pen, dot),
            Mark::Circles => drawing.circle([x, y], 6.0 * pen, line),
            Mark::Crosses => {
                for [a, b] in [[[-5.0, -5.0], [5.0, 5.0]], [[-5.0, 5.0], [5.0, -5.0]]] {
                    path.segment([at(a), at(b)]);
                }
                drawing.path(path, line);
            }
            Mark::Triangles => {
                path.outline([[0.0, -7.0], [6.06, 3.5], [-6.06, 3.5]].map(at));
                drawing.path(path, dot);
            }
        }
    }
}

impl Colour {
    /// Colours of curves beside each other, in their order.
    pub const CYCLE: [Self; 6] = [
        Self::Blue,
        Self::Vermilion,
        Self::Green,
        Self::Purple,
        Self::Orange,
        Self::Sky,
    ];

    /// Red, green and blue of the colour.
    pub(crate) fn rgb(self) -> Rgb {
        match self {
            Self::Black => [60, 60, 60],
            Self::Blue => [0, 114, 178],
            Self::Vermilion => [213, 94, 0],
            Self::Green => [0, 158, 115],
            Self::Orange => [230, 159, 0],
            Self::Purple => [204, 121, 167],
            Self::Sky => [86, 180, 233],
        }
    }
}
