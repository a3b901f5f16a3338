//! Text of an SVG file as outlines of its letters, so that a picture needs no fonts of the machine.

use std::fmt::Write as _;

use resvg::usvg::roxmltree::Error;
use ttf_parser::{Face, OutlineBuilder};

use super::text::{TextLine, advance, with_text_as};

/// An SVG file with a path in the place of each element `text`.
///
/// # Errors
///
/// If the text of the file is no XML.
pub(super) fn with_outlined_text(svg: &str, font: &Face<'_>) -> Result<String, Error> {
    with_text_as(svg, font, |line| path_element(&line, font))
}

/// The element `path` of a line of text.
fn path_element(line: &TextLine, font: &Face<'_>) -> String {
    let mut outline = Outline {
        data: String::new(),
        origin: line.start,
        scale: line.size / f64::from(font.units_per_em()),
    };
    for &(_, glyph) in &line.letters {
        font.outline_glyph(glyph, &mut outline);
        outline.origin[0] += advance(font, glyph, line.size);
    }
    format!("<path{} d=\"{}\"/>", line.attributes, outline.data)
}

/// Data of a path, made of the outlines of letters one after the other.
struct Outline {
    data: String,
    /// Place of the letter on the base line, pixels.
    origin: [f64; 2],
    /// Pixels to the unit of the font.
    scale: f64,
}

impl Outline {
    /// Adds a command with its points, which the font gives upwards from the base line.
    fn add(&mut self, command: char, points: &[[f32; 2]]) {
        self.data.push(command);
        let [left, base] = self.origin;
        for &[x, y] in points {
            let (x, y) = (
                left + self.scale * f64::from(x),
                base - self.scale * f64::from(y),
            );
            let _ = write!(self.data, "{x:.4} {y:.4} ");
        }
    }
}

impl OutlineBuilder for Outline {
    fn move_to(&mut self, x: f32, y: f32) {
        self.add('M', &[[x, y]]);
    }

    fn line_to(&mut self, x: f32, y: f32) {
        self.add('L', &[[x, y]]);
    }

    fn quad_to(&mut self, x1: f32, y1: f32, x: f32, y: f32) {
        self.add('Q', &[[x1, y1], [x, y]]);
    }

    fn curve_to(&mut self, x1: f32, y1: f32, x2: f32, y2: f32, x: f32, y: f32) {
        self.add('C', &[[x1, y1], [x2, y2], [x, y]]);
    }

    fn close(&mut self) {
        self.add('Z', &[]);
    }
}
