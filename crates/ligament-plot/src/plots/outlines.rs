//! Text of an SVG file as outlines of its letters, so that a picture needs no fonts of the machine.

use std::fmt::Write as _;

use resvg::usvg::roxmltree::{Document, Error, Node};
use ttf_parser::{Face, FaceParsingError, GlyphId, OutlineBuilder};

/// An SVG file with a path in the place of each element `text`.
///
/// Lines of text are laid out by the advances of the font (units of the em over the size of the letters); size and anchor may
/// stand at an element around the text, as SVG has it. Letters that the font lacks become its box for missing ones.
///
/// # Errors
///
/// If the text of the file is no XML.
pub(super) fn with_outlined_text(svg: &str, font: &Face<'_>) -> Result<String, Error> {
    let document = Document::parse(svg)?;
    let mut outlined = String::with_capacity(svg.len());
    let mut done = 0;
    let lines = document
        .descendants()
        .filter(|node| node.has_tag_name("text"));
    for line in lines {
        let place = line.range();
        outlined.push_str(&svg[done..place.start]);
        outlined.push_str(&path_element(line, font));
        done = place.end;
    }
    outlined.push_str(&svg[done..]);
    Ok(outlined)
}

/// The font in a file of letters.
pub(super) fn font(bytes: &[u8]) -> Result<Face<'_>, FaceParsingError> {
    Face::parse(bytes, 0)
}

/// The element `path` of a line of text.
fn path_element(line: Node<'_, '_>, font: &Face<'_>) -> String {
    let size = inherited(line, "font-size").map_or(16.0, |text| length(text, 16.0));
    let place = |name: &str| line.attribute(name).map_or(0.0, |text| length(text, size));
    let text: String = line
        .descendants()
        .filter_map(|node| node.is_text().then(|| node.text())?)
        .collect();
    let letters: Vec<GlyphId> = (text
        .split_whitespace()
        .collect::<Vec<_>>()
        .join(" ")
        .chars())
    .map(|letter| font.glyph_index(letter).unwrap_or_default())
    .collect();
    let scale = size / f64::from(font.units_per_em());
    let advance =
        |&letter: &GlyphId| scale * f64::from(font.glyph_hor_advance(letter).unwrap_or_default());
    let width: f64 = letters.iter().map(advance).sum();
    let start = match inherited(line, "text-anchor") {
        Some("middle") => -0.5 * width,
        Some("end") => -width,
        _ => 0.0,
    };
    let mut outline = Outline {
        data: String::new(),
        origin: [place("x") + start, place("y") + place("dy")],
        scale,
    };
    for letter in &letters {
        font.outline_glyph(*letter, &mut outline);
        outline.origin[0] += advance(letter);
    }
    let mut element = "<path".to_owned();
    for name in ["transform", "fill", "opacity"] {
        if let Some(value) = line.attribute(name) {
            let _ = write!(element, " {name}=\"{value}\"");
        }
    }
    let _ = write!(element, " d=\"{}\"/>", outline.data);
    element
}

/// An attribute of an element, or of the nearest one around it.
fn inherited<'a>(node: Node<'a, '_>, name: &str) -> Option<&'a str> {
    node.ancestors().find_map(|around| around.attribute(name))
}

/// A length, pixels, as a number alone, in `px` or in `em` of a size of letters.
fn length(text: &str, size: f64) -> f64 {
    let number = |text: &str| text.trim().parse().unwrap_or(0.0);
    match text.strip_suffix("em") {
        Some(em) => size * number(em),
        None => number(text.trim_end_matches("px")),
    }
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
