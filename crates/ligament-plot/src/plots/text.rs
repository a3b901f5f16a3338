//! Lines of text of an SVG file, laid out in the font of the program.

use std::fmt::Write as _;

use resvg::usvg::roxmltree::{Document, Error, Node};
use ttf_parser::{Face, FaceParsingError, GlyphId};

/// The font of all text in pictures ([its origin](https://dejavu-fonts.github.io) and licence lie beside it).
pub(super) const FONT: &[u8] = include_bytes!("font/DejaVuSans-subset.ttf");

/// Name of the font.
pub(crate) const FAMILY: &str = "DejaVu Sans";

/// A line of text.
///
/// Letters stand at the advances of the font. Size and anchor may stand at an element around the text, as SVG has it. Letters that
/// the font lacks become its box for missing ones.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct TextLine {
    /// Letters with their outlines in the font.
    pub(super) letters: Vec<(char, GlyphId)>,
    /// Start of the line on its base line, pixels.
    pub(super) start: [f64; 2],
    /// Size of the letters, pixels.
    pub(super) size: f64,
    /// Attributes of the element that hold for what is drawn in its place.
    pub(super) attributes: String,
}

/// An SVG file with another element in the place of each element `text`.
///
/// # Errors
///
/// If the text of the file is no XML.
pub(super) fn with_text_as(
    svg: &str,
    font: &Face<'_>,
    mut element: impl FnMut(TextLine) -> String,
) -> Result<String, Error> {
    let document = Document::parse(svg)?;
    let mut replaced = String::with_capacity(svg.len());
    let mut done = 0;
    let lines = document
        .descendants()
        .filter(|node| node.has_tag_name("text"));
    for line in lines {
        let place = line.range();
        replaced.push_str(&svg[done..place.start]);
        replaced.push_str(&element(TextLine::laid_out(line, font)));
        done = place.end;
    }
    replaced.push_str(&svg[done..]);
    Ok(replaced)
}

/// The font of the program.
pub(super) fn font() -> Result<Face<'static>, FaceParsingError> {
    Face::parse(FONT, 0)
}

impl TextLine {
    fn laid_out(line: Node<'_, '_>, font: &Face<'_>) -> Self {
        let size = inherited(line, "font-size").map_or(16.0, |text| length(text, 16.0));
        let place = |name: &str| line.attribute(name).map_or(0.0, |text| length(text, size));
        let text: String = line
            .descendants()
            .filter_map(|node| node.is_text().then(|| node.text())?)
            .collect();
        let words: Vec<&str> = text.split_whitespace().collect();
        let glyph = |letter: char| (letter, font.glyph_index(letter).unwrap_or_default());
        let letters: Vec<(char, GlyphId)> = words.join(" ").chars().map(glyph).collect();
        let width: f64 = (letters.iter())
            .map(|(_, glyph)| advance(font, *glyph, size))
            .sum();
        let start = match inherited(line, "text-anchor") {
            Some("middle") => -0.5 * width,
            Some("end") => -width,
            _ => 0.0,
        };
        let mut attributes = String::new();
        for name in ["transform", "fill", "opacity"] {
            if let Some(value) = line.attribute(name) {
                // Writing to a string cannot fail.
                let _ = write!(attributes, " {name}=\"{value}\"");
            }
        }
        Self {
            letters,
            start: [place("x") + start, place("y") + place("dy")],
            size,
            attributes,
        }
    }
}

/// How far a letter moves the next one, pixels.
pub(super) fn advance(font: &Face<'_>, glyph: GlyphId, size: f64) -> f64 {
    let units = font.glyph_hor_advance(glyph).unwrap_or_default();
    size * f64::from(units) / f64::from(font.units_per_em())
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
