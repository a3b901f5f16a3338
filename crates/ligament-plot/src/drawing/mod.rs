//! A drawing: filled and stroked paths, circles and lines of text, from the bottom to the top layer.
//!
//! Coordinates are pixels, 96 to the inch, from the upper left corner; the size of a file is in mm, as in print. A drawing is written as
//! SVG (`svg`), PNG (`png`) or PDF (`pdf`), several drawings as an animation ([`gif`]). All text is set in the font of the program
//! (`font`), so that a file is the same on every machine.

pub(crate) mod axes;
mod font;
pub(crate) mod frame;
pub mod gif;
mod path;
mod pdf;
pub mod png;
mod svg;
pub(crate) mod ticks;

use serde::{Deserialize, Serialize};
use tiny_skia::Transform;

pub(crate) use font::text_width;
pub(crate) use frame::Frame;
pub(crate) use path::PathData;

/// Pixels per inch.
pub(crate) const PIXELS_PER_INCH: f64 = 96.0;

/// Pixels per millimetre.
pub(crate) const PIXELS_PER_MM: f64 = PIXELS_PER_INCH / 25.4;

/// A colour by its red, green and blue.
pub(crate) type Rgb = [u8; 3];

pub(crate) const WHITE: Rgb = [255; 3];

/// Colour of text.
pub(crate) const TEXT: Rgb = [0x1e; 3];

/// Colour of outlines, axes and frames.
pub(crate) const OUTLINE: Rgb = [0x40; 3];

/// A drawing of fixed size, on white.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Drawing {
    /// Width and height, pixels.
    size: [f64; 2],
    items: Vec<Item>,
}

/// A part of a drawing.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
enum Item {
    /// Lines and outlines.
    Path(PathData, Paint),
    /// A circle by its centre and radius, pixels.
    Circle([f64; 2], f64, Paint),
    /// A line of text.
    Text(TextLine),
    /// Begin of a window: until its end only the inside of a rectangle (upper left corner and size) is drawn.
    Window([[f64; 2]; 2]),
    /// End of a window.
    WindowEnd,
}

/// A line of text.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
struct TextLine {
    /// Words with one space between two, without control characters.
    text: String,
    /// Place of the anchor on the base line, pixels.
    at: [f64; 2],
    anchor: Anchor,
    /// Size of the letters, pixels.
    size: f64,
    /// Whether the line runs upwards.
    is_upright: bool,
}

/// The part of a line of text that lies at the given place.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub(crate) enum Anchor {
    Start,
    Middle,
    End,
}

/// Paint of a path: first its inside, then its line.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
pub(crate) struct Paint {
    /// Colour of the inside.
    pub(crate) fill: Option<Rgb>,
    /// Colour and width (pixels) of the line.
    pub(crate) stroke: Option<(Rgb, f64)>,
    /// Lengths of dashes and of the gaps between them, pixels; `None` for a solid line.
    pub(crate) dashes: Option<[f64; 2]>,
}

impl Paint {
    /// A filled inside.
    pub(crate) fn fill(colour: Rgb) -> Self {
        Self {
            fill: Some(colour),
            ..Self::default()
        }
    }

    /// A line with a width in pixels.
    pub(crate) fn stroke(colour: Rgb, width: f64) -> Self {
        Self {
            stroke: Some((colour, width)),
            ..Self::default()
        }
    }
}

impl Drawing {
    /// An empty drawing of a width and a height in pixels.
    pub(crate) fn new(size: [f64; 2]) -> Self {
        let mut drawing = Self {
            size,
            items: Vec::new(),
        };
        drawing.rectangle([0.0; 2], size, Paint::fill(WHITE));
        drawing
    }

    /// Adds a rectangle by its upper left corner.
    pub(crate) fn rectangle(&mut self, [x, y]: [f64; 2], [width, height]: [f64; 2], paint: Paint) {
        let mut path = PathData::default();
        path.outline([
            [x, y],
            [x + width, y],
            [x + width, y + height],
            [x, y + height],
        ]);
        self.path(path, paint);
    }

    /// Adds a line between two places.
    pub(crate) fn line(&mut self, ends: [[f64; 2]; 2], stroke: Rgb, width: f64) {
        self.lines([ends], stroke, width);
    }

    /// Adds lines, each between two places; lines without length are left out.
    pub(crate) fn lines(
        &mut self,
        all: impl IntoIterator<Item = [[f64; 2]; 2]>,
        stroke: Rgb,
        width: f64,
    ) {
        let mut path = PathData::default();
        all.into_iter().for_each(|ends| path.line(ends));
        self.path(path, Paint::stroke(stroke, width));
    }

    /// Adds a circle.
    pub(crate) fn circle(&mut self, centre: [f64; 2], radius: f64, paint: Paint) {
        self.items.push(Item::Circle(centre, radius, paint));
    }

    /// Adds a line of text with its base line at a place.
    pub(crate) fn text(&mut self, at: [f64; 2], anchor: Anchor, size: f64, text: &str) {
        self.line_of_text(at, anchor, size, text, false);
    }

    /// Adds a line of text that runs upwards, its middle at a place.
    pub(crate) fn upright_text(&mut self, at: [f64; 2], size: f64, text: &str) {
        self.line_of_text(at, Anchor::Middle, size, text, true);
    }

    fn line_of_text(
        &mut self,
        at: [f64; 2],
        anchor: Anchor,
        size: f64,
        text: &str,
        is_upright: bool,
    ) {
        let words: Vec<&str> = text.split_whitespace().collect();
        self.items.push(Item::Text(TextLine {
            text: words.join(" ").replace(char::is_control, ""),
            at,
            anchor,
            size,
            is_upright,
        }));
    }

    /// Begins a window: until the next [`end_window`](Self::end_window) only the inside of a rectangle is drawn.
    pub(crate) fn begin_window(&mut self, at: [f64; 2], size: [f64; 2]) {
        self.items.push(Item::Window([at, size]));
    }

    /// Ends a window.
    pub(crate) fn end_window(&mut self) {
        self.items.push(Item::WindowEnd);
    }

    /// Adds a painted path; an empty one is left out.
    pub(crate) fn path(&mut self, path: PathData, paint: Paint) {
        if !path.is_empty() {
            self.items.push(Item::Path(path, paint));
        }
    }
}

impl TextLine {
    /// Distance from the start of the line to its anchor, pixels.
    fn offset(&self) -> f64 {
        match self.anchor {
            Anchor::Start => 0.0,
            Anchor::Middle => -0.5 * text_width(&self.text, self.size),
            Anchor::End => -text_width(&self.text, self.size),
        }
    }

    /// Transform from pixels along and above the base line, from the start of the line, to pixels of the drawing.
    fn placement(&self) -> Transform {
        let [x, y] = self.at.map(|it| it as f32);
        let placed = match self.is_upright {
            true => Transform::from_row(0.0, -1.0, 1.0, 0.0, x, y),
            false => Transform::from_translate(x, y),
        };
        placed
            .pre_translate(self.offset() as f32, 0.0)
            .pre_scale(1.0, -1.0)
    }
}

/// A colour as `#rrggbb`.
pub(crate) fn hex([r, g, b]: Rgb) -> String {
    format!("#{r:02x}{g:02x}{b:02x}")
}
