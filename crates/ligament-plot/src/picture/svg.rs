//! SVG documents of filled paths and text.
//!
//! Coordinates are pixels, 96 to the inch; the size of a document is in mm, as a paper wants it.

use std::fmt::Write as _;

use crate::plots::png::PIXELS_PER_INCH;
use crate::plots::text::FAMILY;

/// Pixels of a millimetre.
pub(super) const PIXELS_PER_MM: f64 = PIXELS_PER_INCH / 25.4;

/// Whole numbers in the data of paths to the pixel: 2.6 micrometres on paper.
const UNITS_PER_PIXEL: f64 = 100.0;

/// Widths of the letters from space to tilde over the size of the font, in hundredths.
#[rustfmt::skip]
const LETTER_WIDTHS: [u8; 95] = [
    32, 40, 46, 84, 64, 95, 78, 28, 39, 39, 50, 84, 32, 36, 32, 34, 64, 64, 64, 64, 64, 64, 64, 64, 64, 64, 34, 34, 84, 84, 84, 53,
    100, 68, 69, 70, 77, 63, 58, 78, 75, 30, 30, 66, 56, 86, 75, 79, 60, 79, 70, 64, 61, 73, 68, 99, 69, 61, 69, 39, 34, 39, 84, 50,
    50, 61, 64, 55, 64, 62, 35, 64, 63, 28, 28, 58, 28, 97, 63, 61, 64, 64, 41, 52, 39, 63, 59, 82, 59, 59, 53, 64, 34, 64, 84,
];

/// Width of a line of text, pixels.
pub(super) fn text_width(text: &str, size: f64) -> f64 {
    let width = |letter: char| {
        let place = (letter as usize).checked_sub(32);
        let width = place.and_then(|it| LETTER_WIDTHS.get(it));
        usize::from(width.copied().unwrap_or(64))
    };
    let hundredths: usize = text.chars().map(width).sum();
    size * hundredths as f64 / 100.0
}

/// A document, written from the bottom to the top layer.
#[derive(Debug)]
pub(super) struct Document {
    size: [f64; 2],
    body: String,
}

/// Where a line of text is anchored.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Anchor {
    /// At its start.
    Start,
    /// In its middle.
    Middle,
}

/// How a path is painted.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(super) struct Paint<'a> {
    /// Colour of the inside.
    pub(super) fill: Option<&'a str>,
    /// Colour and width (pixels) of the line.
    pub(super) stroke: Option<(&'a str, f64)>,
}

impl Document {
    /// An empty white document of a width and a height in pixels.
    pub(super) fn new(size: [f64; 2]) -> Self {
        let mut document = Self {
            size,
            body: String::new(),
        };
        document.rectangle([0.0, 0.0], size, "#ffffff");
        document
    }

    /// A filled rectangle from its upper left corner.
    pub(super) fn rectangle(&mut self, at: [f64; 2], size: [f64; 2], fill: &str) {
        let area = area(at, size);
        // Writing to a string cannot fail.
        let _ = writeln!(self.body, "<rect {area} fill=\"{fill}\"/>");
    }

    /// A rectangle of thin grey lines.
    pub(super) fn frame(&mut self, at: [f64; 2], size: [f64; 2]) {
        let area = area(at, size);
        let _ = writeln!(
            self.body,
            "<rect {area} fill=\"none\" stroke=\"#404040\" stroke-width=\"0.6\"/>"
        );
    }

    /// A line.
    pub(super) fn line(&mut self, from: [f64; 2], to: [f64; 2], stroke: &str, width: f64) {
        let ([x1, y1], [x2, y2]) = (from, to);
        let _ = writeln!(
            self.body,
            "<line x1=\"{x1:.2}\" y1=\"{y1:.2}\" x2=\"{x2:.2}\" y2=\"{y2:.2}\" stroke=\"{stroke}\" stroke-width=\"{width}\"/>"
        );
    }

    /// A filled circle.
    pub(super) fn circle(&mut self, [x, y]: [f64; 2], radius: f64, fill: &str) {
        let _ = writeln!(
            self.body,
            "<circle cx=\"{x:.2}\" cy=\"{y:.2}\" r=\"{radius}\" fill=\"{fill}\"/>"
        );
    }

    /// A line of text with its base line at a place.
    pub(super) fn text(&mut self, [x, y]: [f64; 2], anchor: Anchor, size: f64, text: &str) {
        let anchor = anchor.word();
        let text = escape(text);
        let _ = writeln!(
            self.body,
            "<text x=\"{x:.2}\" y=\"{y:.2}\" font-size=\"{size}\"{anchor}>{text}</text>"
        );
    }

    /// A line of text that runs upwards, its middle at a place.
    pub(super) fn upright_text(&mut self, [x, y]: [f64; 2], size: f64, text: &str) {
        let (anchor, text) = (Anchor::Middle.word(), escape(text));
        let _ = writeln!(
            self.body,
            "<text transform=\"translate({x:.2} {y:.2}) rotate(-90)\" font-size=\"{size}\"{anchor}>{text}</text>"
        );
    }

    /// Begins what is seen in a rectangle alone, to the matching [`end_window`](Self::end_window).
    pub(super) fn begin_window(&mut self, name: &str, at: [f64; 2], size: [f64; 2]) {
        let area = area(at, size);
        let _ = writeln!(
            self.body,
            "<clipPath id=\"{name}\"><rect {area}/></clipPath>\n<g clip-path=\"url(#{name})\">"
        );
    }

    /// Ends a window.
    pub(super) fn end_window(&mut self) {
        self.body.push_str("</g>\n");
    }

    /// Paints a path; an empty one is left out.
    pub(super) fn path(&mut self, data: &PathData, paint: Paint<'_>) {
        if data.text.is_empty() {
            return;
        }
        let fill = paint.fill.unwrap_or("none");
        let unit = 1.0 / UNITS_PER_PIXEL;
        let _ = write!(
            self.body,
            "<path transform=\"scale({unit})\" fill=\"{fill}\""
        );
        if let Some((stroke, width)) = paint.stroke {
            let width = width * UNITS_PER_PIXEL;
            let _ = write!(
                self.body,
                " stroke=\"{stroke}\" stroke-width=\"{width:.0}\" stroke-linejoin=\"round\" stroke-linecap=\"round\""
            );
        }
        let _ = writeln!(self.body, " d=\"{}\"/>", data.text);
    }

    /// The text of the file.
    pub(super) fn finish(self, title: &str) -> String {
        let [width, height] = self.size;
        let mm = |pixels: f64| pixels / PIXELS_PER_MM;
        format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{:.3}mm\" height=\"{:.3}mm\" \
             viewBox=\"0 0 {width:.2} {height:.2}\" font-family=\"{FAMILY}, Verdana, sans-serif\" fill=\"#1e1e1e\">\n\
             <title>{}</title>\n{}</svg>\n",
            mm(width),
            mm(height),
            escape(title),
            self.body
        )
    }
}

/// The attributes of a rectangle from its upper left corner.
fn area([x, y]: [f64; 2], [width, height]: [f64; 2]) -> String {
    format!("x=\"{x:.2}\" y=\"{y:.2}\" width=\"{width:.2}\" height=\"{height:.2}\"")
}

impl Anchor {
    fn word(self) -> &'static str {
        match self {
            Self::Start => "",
            Self::Middle => " text-anchor=\"middle\"",
        }
    }
}

/// The text as content of an element; what XML cannot hold is left out.
fn escape(text: &str) -> String {
    let text = text.replace(char::is_control, "").replace('&', "&amp;");
    text.replace('<', "&lt;").replace('>', "&gt;")
}

/// The data of a path: pieces in whole hundredths of a pixel, each relative to the point before.
#[derive(Debug, Default, Clone, PartialEq, Eq)]
pub(super) struct PathData {
    text: String,
    at: [i64; 2],
}

impl PathData {
    /// Adds a closed outline; one without extent is left out.
    pub(super) fn outline(&mut self, points: impl IntoIterator<Item = [f64; 2]>) {
        let mut rounded: Vec<[i64; 2]> = points.into_iter().map(units).collect();
        rounded.dedup();
        while rounded.len() > 1 && rounded.first() == rounded.last() {
            rounded.pop();
        }
        if rounded.len() < 3 {
            return;
        }
        let start = rounded[0];
        self.piece(&rounded);
        self.text.push('z');
        self.at = start;
    }

    /// Adds lines from each point to the next.
    pub(super) fn line(&mut self, points: impl IntoIterator<Item = [f64; 2]>) {
        let mut rounded: Vec<[i64; 2]> = points.into_iter().map(units).collect();
        rounded.dedup();
        if rounded.len() > 1 {
            self.piece(&rounded);
        }
    }

    /// Adds a line between two points.
    pub(super) fn segment(&mut self, ends: [[f64; 2]; 2]) {
        self.piece(&ends.map(units));
    }

    fn piece(&mut self, points: &[[i64; 2]]) {
        for (place, point) in points.iter().enumerate() {
            match place {
                0 => self.text.push('m'),
                1 => self.text.push('l'),
                _ => {}
            }
            let step = [point[0] - self.at[0], point[1] - self.at[1]];
            self.number(step[0], place > 1);
            self.number(step[1], true);
            self.at = *point;
        }
    }

    fn number(&mut self, number: i64, follows: bool) {
        if follows && number >= 0 {
            self.text.push(' ');
        }
        let _ = write!(self.text, "{number}");
    }
}

fn units(point: [f64; 2]) -> [i64; 2] {
    point.map(|it| (it * UNITS_PER_PIXEL).round() as i64)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn paths_are_relative_whole_numbers() {
        let mut path = PathData::default();
        path.outline([[1.0, 1.0], [2.0, 1.0], [2.0, 0.5], [2.0, 0.501], [1.0, 1.0]]);
        path.segment([[0.0, 0.0], [-0.5, 0.25]]);
        assert_eq!(path.text, "m100 100l100 0 0-50zm-100-100l-50 25");
        path.outline([[0.0, 0.0], [0.001, 0.0], [5.0, 5.0]]);
        assert!(
            path.text.ends_with("25"),
            "an outline without area: {}",
            path.text
        );
    }

    #[test]
    fn text_is_escaped_and_measured() {
        let mut document = Document::new([96.0, 48.0]);
        document.text([1.0, 2.0], Anchor::Middle, 9.0, "a<b & \u{7}c");
        let svg = document.finish("<t>");
        assert!(svg.contains(">a&lt;b &amp; c</text>") && svg.contains("<title>&lt;t&gt;</title>"));
        assert!(svg.contains("width=\"25.400mm\" height=\"12.700mm\" viewBox=\"0 0 96.00 48.00\""));
        assert!((text_width("mm", 10.0) - 19.4).abs() < 1e-9);
    }
}
