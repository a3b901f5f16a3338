//! The font of all text in pictures ([its origin](https://dejavu-fonts.github.io) and licence are in the same folder).

use std::sync::LazyLock;

use skrifa::charmap::Charmap;
use skrifa::instance::{LocationRef, Size};
use skrifa::metrics::{GlyphMetrics, Metrics};
use skrifa::outline::OutlineGlyphCollection;
use skrifa::outline::pen::PathElement;
use skrifa::{FontRef, GlyphId, MetadataProvider as _};
use tiny_skia::{Path, PathBuilder, Transform};

/// The file of the font.
pub(super) const FILE: &[u8] = include_bytes!("font/DejaVuSans-subset.ttf");

/// Name of the font.
pub(super) const FAMILY: &str = "DejaVu Sans";

/// The font of the program.
pub(super) static FONT: LazyLock<Font> = LazyLock::new(Font::new);

/// A font in its own units.
pub(super) struct Font {
    pub(super) metrics: Metrics,
    letters: Charmap<'static>,
    advances: GlyphMetrics<'static>,
    outlines: OutlineGlyphCollection<'static>,
}

/// Width of a line of text, pixels.
pub(crate) fn text_width(text: &str, size: f64) -> f64 {
    size * text
        .chars()
        .map(|it| FONT.advance(FONT.glyph(it)))
        .sum::<f64>()
}

impl Font {
    #[expect(clippy::expect_used, reason = "the file is a part of the program")]
    fn new() -> Self {
        let font = FontRef::new(FILE).expect("the font of the program can be read");
        let (size, location) = (Size::unscaled(), LocationRef::default());
        Self {
            metrics: font.metrics(size, location),
            letters: font.charmap(),
            advances: font.glyph_metrics(size, location),
            outlines: font.outline_glyphs(),
        }
    }

    /// The glyph of a letter; a box where the font lacks it.
    pub(super) fn glyph(&self, letter: char) -> GlyphId {
        self.letters.map(letter).unwrap_or(GlyphId::NOTDEF)
    }

    /// Advance width of a glyph, relative to the size of the letters.
    pub(super) fn advance(&self, glyph: GlyphId) -> f64 {
        let units = self.advances.advance_width(glyph).unwrap_or_default();
        f64::from(units) / f64::from(self.metrics.units_per_em)
    }

    /// The outlines of a line of text of a size, pixels along and above the base line from its start; None without any.
    pub(super) fn outlines(&self, text: &str, size: f64) -> Option<Path> {
        let scale = size as f32 / f32::from(self.metrics.units_per_em);
        let (mut all, mut along) = (PathBuilder::new(), 0.0);
        for glyph in text.chars().map(|letter| self.glyph(letter)) {
            let place = Transform::from_row(scale, 0.0, 0.0, scale, along, 0.0);
            let outline = self.outline(glyph).and_then(|it| it.transform(place));
            outline.iter().for_each(|it| all.push_path(it));
            along += (size * self.advance(glyph)) as f32;
        }
        all.finish()
    }

    /// The outline of a glyph in units of the font; None where there is nothing to see.
    fn outline(&self, glyph: GlyphId) -> Option<Path> {
        let unscaled = (Size::unscaled(), LocationRef::default());
        let mut elements: Vec<PathElement> = Vec::new();
        (self.outlines.get(glyph)?.draw(unscaled, &mut elements)).ok()?;
        let mut path = PathBuilder::new();
        for element in elements {
            match element {
                PathElement::MoveTo { x, y } => path.move_to(x, y),
                PathElement::LineTo { x, y } => path.line_to(x, y),
                PathElement::QuadTo { cx0, cy0, x, y } => path.quad_to(cx0, cy0, x, y),
                PathElement::CurveTo {
                    cx0,
                    cy0,
                    cx1,
                    cy1,
                    x,
                    y,
                } => path.cubic_to(cx0, cy0, cx1, cy1, x, y),
                PathElement::Close => path.close(),
            }
        }
        path.finish()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Widths in the tables of the font, of 2048 units to its size: m has 1995, a space 651.
    #[test]
    fn letters_have_widths_and_outlines() {
        assert!((text_width("mm", 10.0) - 20.0 * 1995.0 / 2048.0).abs() < 1e-9);
        assert!(FONT.outlines("m²", 10.0).is_some() && FONT.outlines(" ", 10.0).is_none());
        let bounds = FONT.outlines("Il", 10.0).unwrap().bounds();
        assert!(
            bounds.top() >= 0.0 && (7.0..8.0).contains(&bounds.bottom()),
            "{bounds:?}"
        );
        let missing = FONT.glyph('\u{4e00}');
        assert_eq!(
            (missing, FONT.advance(missing) > 0.0),
            (GlyphId::NOTDEF, true)
        );
    }
}
