//! A drawing as PDF of one page: paths as paths, and text as text in the font of the program, which is embedded.

use std::collections::BTreeMap;

use miniz_oxide::deflate::compress_to_vec_zlib;
use pdf_writer::types::{
    CidFontType, FontFlags, LineCapStyle, LineJoinStyle, SystemInfo, UnicodeCmap,
};
use pdf_writer::{Content, Filter, Finish, Name, Pdf, Rect, Ref, Str, TextStr};
use skrifa::GlyphId;
use tiny_skia::{Path, PathSegment};

use super::font::{FILE, FONT};
use super::png::circle;
use super::{Drawing, Item, PIXELS_PER_INCH, Paint, Rgb, TEXT, TextLine};

/// PDF points, the unit of a page, per pixel.
const POINTS_PER_PIXEL: f32 = (72.0 / PIXELS_PER_INCH) as f32;

/// Effort of compression, 0 to 10.
const COMPRESSION: u8 = 8;

/// Name of the font in the content of the page, and in the file.
const FONT_NAME: Name<'_> = Name(b"F");
const BASE_FONT: Name<'_> = Name(b"LIGAME+DejaVuSans");

/// Numbers of the objects of the file.
const CATALOGUE: Ref = Ref::new(1);
const PAGES: Ref = Ref::new(2);
const PAGE: Ref = Ref::new(3);
const CONTENT: Ref = Ref::new(4);
const COMPOSITE_FONT: Ref = Ref::new(5);
const CID_FONT: Ref = Ref::new(6);
const DESCRIPTOR: Ref = Ref::new(7);
const FONT_FILE: Ref = Ref::new(8);
const CHARACTERS: Ref = Ref::new(9);
const INFORMATION: Ref = Ref::new(10);

impl Drawing {
    /// The drawing as a PDF of a page of its size, with a title.
    pub fn to_pdf(&self, title: &str) -> Vec<u8> {
        let [width, height] = self.size.map(|it| it as f32 * POINTS_PER_PIXEL);
        let mut pdf = Pdf::new();
        pdf.catalog(CATALOGUE).pages(PAGES);
        pdf.document_info(INFORMATION)
            .title(TextStr(title))
            .producer(TextStr("Ligament"));
        pdf.pages(PAGES).kids([PAGE]).count(1);
        let mut leaf = pdf.page(PAGE);
        leaf.media_box(Rect::new(0.0, 0.0, width, height));
        leaf.parent(PAGES).contents(CONTENT);
        leaf.resources().fonts().pair(FONT_NAME, COMPOSITE_FONT);
        leaf.finish();
        let mut content = Content::new();
        // The y axis of a page points upwards.
        content.transform([POINTS_PER_PIXEL, 0.0, 0.0, -POINTS_PER_PIXEL, 0.0, height]);
        for item in &self.items {
            write_item(&mut content, item);
        }
        let content = compress_to_vec_zlib(content.finish().as_slice(), COMPRESSION);
        pdf.stream(CONTENT, &content).filter(Filter::FlateDecode);
        let lines = self.items.iter().filter_map(|item| match item {
            Item::Text(line) => Some(line.text.as_str()),
            Item::Path(..) | Item::Circle(..) | Item::Window(_) | Item::WindowEnd => None,
        });
        embed(&mut pdf, lines);
        pdf.finish()
    }
}

fn write_item(content: &mut Content, item: &Item) {
    match item {
        Item::Path(path, paint) => write_path(content, path.in_pixels(), paint),
        Item::Circle(centre, radius, paint) => write_path(content, circle(*centre, *radius), paint),
        Item::Text(line) => write_text(content, line),
        Item::Window([[x, y], [width, height]]) => {
            let [x, y, width, height] = [*x, *y, *width, *height].map(|it| it as f32);
            content.save_state().rect(x, y, width, height);
            content.clip_nonzero().end_path();
        }
        Item::WindowEnd => {
            content.restore_state();
        }
    }
}

fn write_path(content: &mut Content, path: Option<Path>, paint: &Paint) {
    let Some(path) = path else {
        return;
    };
    if let Some(fill) = paint.fill {
        let [r, g, b] = shares(fill);
        content.set_fill_rgb(r, g, b);
    }
    if let Some((stroke, width)) = paint.stroke {
        let ([r, g, b], width) = (shares(stroke), width as f32);
        let cap = match paint.dashes {
            Some(_) => LineCapStyle::ButtCap,
            None => LineCapStyle::RoundCap,
        };
        let dashes = paint.dashes.into_iter().flatten().map(|it| it as f32);
        content
            .set_stroke_rgb(r, g, b)
            .set_line_width(width)
            .set_line_cap(cap)
            .set_line_join(LineJoinStyle::RoundJoin)
            .set_dash_pattern(dashes, 0.0);
    }
    write_outline(content, &path);
    match (paint.fill, paint.stroke) {
        (Some(_), Some(_)) => content.fill_nonzero_and_stroke(),
        (Some(_), None) => content.fill_nonzero(),
        (None, Some(_)) => content.stroke(),
        (None, None) => content.end_path(),
    };
}

fn write_outline(content: &mut Content, path: &Path) {
    let mut last = [0.0, 0.0];
    for segment in path.segments() {
        match segment {
            PathSegment::MoveTo(p) => {
                content.move_to(p.x, p.y);
                last = [p.x, p.y];
            }
            PathSegment::LineTo(p) => {
                content.line_to(p.x, p.y);
                last = [p.x, p.y];
            }
            PathSegment::QuadTo(c, p) => {
                // A parabola as a cubic, whose inner points lie two thirds of the way to its own.
                let towards =
                    |[x, y]: [f32; 2]| [x + 2.0 / 3.0 * (c.x - x), y + 2.0 / 3.0 * (c.y - y)];
                let ([x1, y1], [x2, y2]) = (towards(last), towards([p.x, p.y]));
                content.cubic_to(x1, y1, x2, y2, p.x, p.y);
                last = [p.x, p.y];
            }
            PathSegment::CubicTo(a, b, p) => {
                content.cubic_to(a.x, a.y, b.x, b.y, p.x, p.y);
                last = [p.x, p.y];
            }
            PathSegment::Close => {
                content.close_path();
            }
        }
    }
}

fn write_text(content: &mut Content, line: &TextLine) {
    let letters = line.text.chars();
    let glyphs: Vec<u8> = letters.flat_map(|it| number(it).to_be_bytes()).collect();
    let placed = line.placement();
    let [r, g, b] = shares(TEXT);
    content
        .set_fill_rgb(r, g, b)
        .begin_text()
        .set_font(FONT_NAME, line.size as f32)
        .set_text_matrix([
            placed.sx, placed.ky, placed.kx, placed.sy, placed.tx, placed.ty,
        ])
        .show(Str(&glyphs))
        .end_text();
}

/// The number of the glyph of a letter in the file of the font.
fn number(letter: char) -> u16 {
    FONT.glyph(letter).to_u32() as u16
}

/// Red, green and blue of a colour as fractions of one.
fn shares(colour: Rgb) -> [f32; 3] {
    colour.map(|part| f32::from(part) / 255.0)
}

/// Embeds the font with the characters of its glyphs in the lines, so that text can be found and copied.
fn embed<'a>(pdf: &mut Pdf, lines: impl Iterator<Item = &'a str>) {
    let letters = lines.flat_map(str::chars);
    let used: BTreeMap<u16, char> = letters.map(|it| (number(it), it)).collect();
    let system = SystemInfo {
        registry: Str(b"Adobe"),
        ordering: Str(b"Identity"),
        supplement: 0,
    };
    pdf.type0_font(COMPOSITE_FONT)
        .base_font(BASE_FONT)
        .encoding_predefined(Name(b"Identity-H"))
        .descendant_font(CID_FONT)
        .to_unicode(CHARACTERS);
    let mut cid = pdf.cid_font(CID_FONT);
    cid.subtype(CidFontType::Type2)
        .base_font(BASE_FONT)
        .system_info(system)
        .font_descriptor(DESCRIPTOR)
        .default_width(0.0)
        .cid_to_gid_map_predefined(Name(b"Identity"));
    let mut widths = cid.widths();
    for &glyph in used.keys() {
        let width = 1000.0 * FONT.advance(GlyphId::new(glyph.into()));
        widths.same(glyph, glyph, width as f32);
    }
    widths.finish();
    cid.finish();
    // Factor from the font's own units to thousandths of its size.
    let metrics = &FONT.metrics;
    let thousandths = |units: f32| 1000.0 * units / f32::from(metrics.units_per_em);
    let bounds = metrics.bounds.unwrap_or_default();
    let [left, low, right, high] =
        [bounds.x_min, bounds.y_min, bounds.x_max, bounds.y_max].map(thousandths);
    pdf.font_descriptor(DESCRIPTOR)
        .name(BASE_FONT)
        .flags(FontFlags::SYMBOLIC)
        .bbox(Rect::new(left, low, right, high))
        .italic_angle(0.0)
        .ascent(thousandths(metrics.ascent))
        .descent(thousandths(metrics.descent))
        .cap_height(thousandths(metrics.cap_height.unwrap_or_default()))
        .stem_v(80.0)
        .font_file2(FONT_FILE);
    let file = compress_to_vec_zlib(FILE, COMPRESSION);
    pdf.stream(FONT_FILE, &file)
        .filter(Filter::FlateDecode)
        .pair(Name(b"Length1"), FILE.len() as i32);
    let mut characters = UnicodeCmap::<u16>::new(Name(b"Characters"), system);
    for (glyph, letter) in used {
        characters.pair(glyph, letter);
    }
    pdf.cmap(CHARACTERS, characters.finish().as_slice());
}

#[cfg(test)]
mod tests {
    use super::super::Anchor;
    use super::*;

    /// An inch by half an inch: a red window, and words at the right.
    fn drawing() -> Drawing {
        let mut drawing = Drawing::new([96.0, 48.0]);
        drawing.begin_window([0.0; 2], [48.0; 2]);
        drawing.rectangle([0.0; 2], [90.0, 48.0], Paint::fill([255, 0, 0]));
        drawing.end_window();
        drawing.text([60.0, 30.0], Anchor::Start, 20.0, "mm²");
        drawing
    }

    /// The contents of the streams of a file, in their order, uncompressed.
    fn streams(pdf: &[u8]) -> Vec<Vec<u8>> {
        let find = |from: usize, what: &[u8]| {
            let mut places = pdf[from..].windows(what.len());
            places.position(|it| it == what).map(|place| from + place)
        };
        let (mut found, mut at) = (Vec::new(), 0);
        while let Some(start) = find(at, b"\nstream\n") {
            let end = find(start, b"\nendstream").unwrap();
            let raw = &pdf[start + 8..end];
            let whole = miniz_oxide::inflate::decompress_to_vec_zlib(raw);
            found.push(whole.unwrap_or_else(|_| raw.to_vec()));
            at = end;
        }
        found
    }

    /// An inch by half an inch are 72 x 36 points, and a pixel has three quarters of a point.
    #[test]
    fn a_page_has_its_size_its_paths_its_window_and_text_in_its_font() {
        let pdf = drawing().to_pdf("A picture");
        let whole = String::from_utf8_lossy(&pdf);
        assert!(pdf.starts_with(b"%PDF-1.") && pdf.trim_ascii_end().ends_with(b"%%EOF"));
        for part in [
            "/MediaBox [0 0 72 36]",
            "/Count 1",
            "/Identity-H",
            "(A picture)",
        ] {
            assert!(whole.contains(part), "{part} in {whole}");
        }
        let streams = streams(&pdf);
        let content = String::from_utf8(streams[0].clone()).unwrap();
        // The y axis points upwards.
        assert!(content.starts_with("0.75 0 0 -0.75 0 36 cm"), "{content}");
        assert!(content.contains("q\n0 0 48 48 re\nW\nn"), "{content}");
        assert!(content.contains("1 0 0 rg"), "{content}");
        assert!(content.contains("1 0 0 -1 60 30 Tm"), "{content}");
        assert_eq!(content.matches("Tj").count(), 1);
        assert_eq!(streams[1], FILE);
        // The characters that the three letters stand for: m, m and the raised two.
        let characters = String::from_utf8(streams[2].clone()).unwrap();
        assert!(
            characters.contains("<006D>") && characters.contains("<00B2>"),
            "{characters}"
        );
        assert_eq!(drawing().to_pdf("A picture"), pdf);
    }
}
