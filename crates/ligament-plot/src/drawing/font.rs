//! The font of all text in pictures ([its origin](https://dejavu-fonts.github.io) and licence lie beside it).

use std::sync::LazyLock;

use skrifa::charmap::Charmap;
use skrifa::instance::{LocationRef, Size};
use skrifa::metrics::{GlyphMetrics, Metrics};
use skrifa::outline::{OutlineGlyphCollection, OutlinePen};
use skrifa::{FontRef, GlyphId, MetadataProvider as _};
use tiny_skia::{Path, PathBuilder};

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

    /// How far a letter moves the next one, over the size of the letters.
    pub(super) fn advance(&self, glyph: GlyphId) -> f64 {
        let units = self.advances.advance_width(glyph).unwrap_or_default();
        f64::from(units) / f64::from(self.metrics.units_per_em)
    }

    /// The outlines of a line of text of a size, pixels along and above the base line from its start; None without any.
    pub(super) fn outlines(&self, text: &str, size: f64) -> Option<Path> {
        let mut pen = Pen {
            path: PathBuilder::new(),
            along: 0.0,
            scale: size as f32 / f32::from(self.metrics.units_per_em),
        };
        for glyph in text.chars().map(|letter| self.glyph(letter)) {
            if let Some(outline) = self.outlines.get(glyph) {
                // The font is a part of the program, and its glyphs can be drawn.
                let _ = outline.draw((Size::unscaled(), LocationRef::default()), &mut pen);
            }
            pen.along += (size * self.advance(glyph)) as f32;
        }
        pen.path.finish()
    }
}

/// A path of outlines of letters, one after the other.
struct Pen {
    path: PathBuilder,
    /// Place of the letter on the base line, pixels.
    along: f32,
    /// Pixels to the unit of the font.
    scale: f32,
}

impl Pen {
    fn place(&self, x: f32, y: f32) -> (f32, f32) {
        (self.along + self.scale * x, self.scale * y)
    }
}

impl OutlinePen for Pen {
    fn move_to(&mut self, x: f32, y: f32) {
        let (x, y) = self.place(x, y);
        self.path.move_to(x, y);
    }

    fn line_to(&mut self, x: f32, y: f32) {
        let (x, y) = self.place(x, y);
        self.path.line_to(x, y);
    }

    fn quad_to(&mut self, cx: f32, cy: f32, x: f32, y: f32) {
        let ((cx, cy), (x, y)) = (self.place(cx, cy), self.place(x, y));
        self.path.quad_to(cx, cy, x, y);
    }

    fn curve_to(&mut self, ax: f32, ay: f32, bx: f32, by: f32, x: f32, y: f32) {
        let ((ax, ay), (bx, by)) = (self.place(ax, ay), self.place(bx, by));
        let (x, y) = self.place(x, y);
        self.path.cubic_to(ax, ay, bx, by, x, y);
    }

    fn close(&mut self) {
        self.path.close();
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
