//! SVG to PDF of one page: paths as paths, and text as text in the font of the program, which is embedded.

use std::collections::BTreeMap;

use miniz_oxide::deflate::compress_to_vec_zlib;
use pdf_writer::types::{
    CidFontType, FontFlags, LineCapStyle, LineJoinStyle, SystemInfo, UnicodeCmap,
};
use pdf_writer::{Content, Filter, Finish, Name, Pdf, Rect, Ref, Str, TextStr};
use resvg::tiny_skia::{PathSegment, Transform};
use resvg::usvg::{ClipPath, FillRule, Group, LineCap, LineJoin, Node, Options, Paint, Path, Tree};
use ttf_parser::Face;

use super::png::PIXELS_PER_INCH;
use super::text::{FONT, TextLine, advance, font, with_text_as};

/// Points, the unit of a page, to the pixel of an SVG.
const POINTS_PER_PIXEL: f32 = (72.0 / PIXELS_PER_INCH) as f32;

/// Effort of compression, 0 to 10.
const COMPRESSION: u8 = 8;

/// Name of the font in the content of the page, and in the file.
const FONT_NAME: Name<'_> = Name(b"F");
const BASE_FONT: Name<'_> = Name(b"LIGAME+DejaVuSans");

/// What the identifier of a path starts with that stands in the place of a line of text.
const LINE: &str = "line-of-text-";

/// The objects of the file.
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

/// A picture that cannot become a PDF.
#[derive(Debug, thiserror::Error)]
pub enum PdfError {
    /// The SVG is not one.
    #[error("the SVG cannot be read: {0}")]
    Svg(#[from] resvg::usvg::Error),
    /// The font of the program is none.
    #[error("the font of the program cannot be read: {0}")]
    Font(#[from] ttf_parser::FaceParsingError),
}

/// The text of an SVG file, one of opaque paths, windows and text as the pictures of this program are, as a PDF of a page of its
/// size.
///
/// # Errors
///
/// If it is no SVG.
pub fn to_pdf(svg: &str, title: &str) -> Result<Vec<u8>, PdfError> {
    let font = font()?;
    let mut lines: Vec<TextLine> = Vec::new();
    let marked = with_text_as(svg, &font, |line| {
        let place = lines.len();
        let attributes = line.attributes.clone();
        lines.push(line);
        format!("<path id=\"{LINE}{place}\"{attributes} d=\"M0 0h1v1z\"/>")
    });
    let marked = marked.map_err(resvg::usvg::Error::from)?;
    let tree = Tree::from_str(&marked, &Options::default())?;
    let [width, height] =
        [tree.size().width(), tree.size().height()].map(|it| it * POINTS_PER_PIXEL);
    // The y axis of a page points upwards.
    let to_page = Transform::from_row(POINTS_PER_PIXEL, 0.0, 0.0, -POINTS_PER_PIXEL, 0.0, height);
    let mut page = Page {
        content: Content::new(),
        lines: &lines,
    };
    page.group(tree.root(), to_page);

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
    let content = compress_to_vec_zlib(page.content.finish().as_slice(), COMPRESSION);
    pdf.stream(CONTENT, &content).filter(Filter::FlateDecode);
    embed(&mut pdf, &font, &lines);
    Ok(pdf.finish())
}

/// The content of the page.
struct Page<'a> {
    content: Content,
    lines: &'a [TextLine],
}

impl Page<'_> {
    /// Draws a group, whose coordinates become those of the page by a transform.
    fn group(&mut self, group: &Group, transform: Transform) {
        let transform = transform.pre_concat(group.transform());
        self.content.save_state();
        if let Some(clip) = group.clip_path() {
            self.clip(clip, transform);
        }
        for child in group.children() {
            match child {
                Node::Group(inner) => self.group(inner, transform),
                Node::Path(path) => self.node(path, transform),
                Node::Image(_) | Node::Text(_) => {}
            }
        }
        self.content.restore_state();
    }

    /// Draws nothing from here on that lies outside of the paths.
    fn clip(&mut self, clip: &ClipPath, transform: Transform) {
        let transform = transform.pre_concat(clip.transform());
        for child in clip.root().children() {
            if let Node::Path(path) = child {
                self.outline(path, transform);
            }
        }
        self.content.clip_nonzero().end_path();
    }

    /// Draws a path, or the line of text that it stands for.
    fn node(&mut self, path: &Path, transform: Transform) {
        if let Some(fill) = path.fill().and_then(|fill| rgb(fill.paint())) {
            let [r, g, b] = fill;
            self.content.set_fill_rgb(r, g, b);
        }
        let place = path.id().strip_prefix(LINE);
        let line = place.and_then(|place| self.lines.get(place.parse::<usize>().ok()?));
        if let Some(line) = line {
            self.line(line, transform);
            return;
        }
        let stroke = path.stroke().filter(|it| rgb(it.paint()).is_some());
        if let Some(stroke) = stroke {
            // Strokes are as wide as the transform makes them, which scales both axes alike.
            let scale = (transform.sx * transform.sy - transform.kx * transform.ky)
                .abs()
                .sqrt();
            let [r, g, b] = rgb(stroke.paint()).unwrap_or_default();
            self.content
                .set_stroke_rgb(r, g, b)
                .set_line_width(stroke.width().get() * scale)
                .set_line_cap(cap(stroke.linecap()))
                .set_line_join(join(stroke.linejoin()));
            let dashes = stroke.dasharray().unwrap_or_default();
            let dashes = dashes.iter().map(|it| it * scale);
            self.content
                .set_dash_pattern(dashes, stroke.dashoffset() * scale);
        }
        self.outline(path, transform);
        match (path.fill(), stroke) {
            (Some(fill), Some(_)) if fill.rule() == FillRule::EvenOdd => {
                self.content.fill_even_odd_and_stroke()
            }
            (Some(_), Some(_)) => self.content.fill_nonzero_and_stroke(),
            (Some(fill), None) if fill.rule() == FillRule::EvenOdd => self.content.fill_even_odd(),
            (Some(_), None) => self.content.fill_nonzero(),
            (None, Some(_)) => self.content.stroke(),
            (None, None) => self.content.end_path(),
        };
    }

    /// Adds the outline of a path.
    fn outline(&mut self, path: &Path, transform: Transform) {
        let Some(data) = path.data().clone().transform(transform) else {
            return;
        };
        let mut last = [0.0, 0.0];
        for segment in data.segments() {
            match segment {
                PathSegment::MoveTo(p) => {
                    self.content.move_to(p.x, p.y);
                    last = [p.x, p.y];
                }
                PathSegment::LineTo(p) => {
                    self.content.line_to(p.x, p.y);
                    last = [p.x, p.y];
                }
                PathSegment::QuadTo(c, p) => {
                    // A parabola as a cubic, whose inner points lie two thirds of the way to its own.
                    let towards = |from: [f32; 2]| {
                        [
                            from[0] + 2.0 / 3.0 * (c.x - from[0]),
                            from[1] + 2.0 / 3.0 * (c.y - from[1]),
                        ]
                    };
                    let ([x1, y1], [x2, y2]) = (towards(last), towards([p.x, p.y]));
                    self.content.cubic_to(x1, y1, x2, y2, p.x, p.y);
                    last = [p.x, p.y];
                }
                PathSegment::CubicTo(a, b, p) => {
                    self.content.cubic_to(a.x, a.y, b.x, b.y, p.x, p.y);
                    last = [p.x, p.y];
                }
                PathSegment::Close => {
                    self.content.close_path();
                }
            }
        }
    }

    /// Writes a line of text.
    fn line(&mut self, line: &TextLine, transform: Transform) {
        let [x, y] = line.start.map(|it| it as f32);
        // The letters of a font point upwards.
        let upright = transform.pre_concat(Transform::from_row(1.0, 0.0, 0.0, -1.0, x, y));
        let glyphs = line.letters.iter().flat_map(|it| it.1.0.to_be_bytes());
        let glyphs: Vec<u8> = glyphs.collect();
        let Transform {
            sx,
            ky,
            kx,
            sy,
            tx,
            ty,
        } = upright;
        self.content
            .begin_text()
            .set_font(FONT_NAME, line.size as f32)
            .set_text_matrix([sx, ky, kx, sy, tx, ty])
            .show(Str(&glyphs))
            .end_text();
    }
}

/// A colour in parts of one; None where it is none.
fn rgb(paint: &Paint) -> Option<[f32; 3]> {
    match paint {
        Paint::Color(colour) => {
            let parts = [colour.red, colour.green, colour.blue];
            Some(parts.map(|part| f32::from(part) / 255.0))
        }
        Paint::LinearGradient(_) | Paint::RadialGradient(_) | Paint::Pattern(_) => None,
    }
}

fn cap(cap: LineCap) -> LineCapStyle {
    match cap {
        LineCap::Butt => LineCapStyle::ButtCap,
        LineCap::Round => LineCapStyle::RoundCap,
        LineCap::Square => LineCapStyle::ProjectingSquareCap,
    }
}

fn join(join: LineJoin) -> LineJoinStyle {
    match join {
        LineJoin::Miter | LineJoin::MiterClip => LineJoinStyle::MiterJoin,
        LineJoin::Round => LineJoinStyle::RoundJoin,
        LineJoin::Bevel => LineJoinStyle::BevelJoin,
    }
}

/// Adds the font, with the characters that its letters in the lines stand for, so that text can be found and copied.
fn embed(pdf: &mut Pdf, font: &Face<'_>, lines: &[TextLine]) {
    let letters = lines.iter().flat_map(|line| &line.letters);
    let used: BTreeMap<u16, char> = letters.map(|&(letter, glyph)| (glyph.0, letter)).collect();
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
        let width = advance(font, ttf_parser::GlyphId(glyph), 1000.0) as f32;
        widths.same(glyph, glyph, width);
    }
    widths.finish();
    cid.finish();
    // A font's own units to a thousandth of its size.
    let thousandths = |units: i16| 1000.0 * f32::from(units) / f32::from(font.units_per_em());
    let bounds = font.global_bounding_box();
    let [left, low, right, high] =
        [bounds.x_min, bounds.y_min, bounds.x_max, bounds.y_max].map(thousandths);
    pdf.font_descriptor(DESCRIPTOR)
        .name(BASE_FONT)
        .flags(FontFlags::SYMBOLIC)
        .bbox(Rect::new(left, low, right, high))
        .italic_angle(0.0)
        .ascent(thousandths(font.ascender()))
        .descent(thousandths(font.descender()))
        .cap_height(thousandths(font.capital_height().unwrap_or(0)))
        .stem_v(80.0)
        .font_file2(FONT_FILE);
    let file = compress_to_vec_zlib(FONT, COMPRESSION);
    pdf.stream(FONT_FILE, &file)
        .filter(Filter::FlateDecode)
        .pair(Name(b"Length1"), FONT.len() as i32);
    let mut characters = UnicodeCmap::<u16>::new(Name(b"Characters"), system);
    for (glyph, letter) in used {
        characters.pair(glyph, letter);
    }
    pdf.cmap(CHARACTERS, characters.finish().as_slice());
}

#[cfg(test)]
mod tests {
    use super::*;

    const SVG: &str = "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"25.4mm\" height=\"12.7mm\" viewBox=\"0 0 96 48\" fill=\"#1e1e1e\">\
        <clipPath id=\"a\"><rect x=\"0\" y=\"0\" width=\"48\" height=\"48\"/></clipPath><g clip-path=\"url(#a)\">\
        <rect x=\"0\" y=\"0\" width=\"90\" height=\"48\" fill=\"#ff0000\"/></g>\
        <text x=\"60\" y=\"30\" font-size=\"20\">mm²</text></svg>";

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

    /// An inch by half an inch are 72 x 36 points.
    #[test]
    fn a_page_has_its_size_its_paths_its_window_and_text_in_its_font() {
        let pdf = to_pdf(SVG, "A picture").unwrap();
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
        // The window is 48 pixels wide, 36 points; the y axis points upwards.
        assert!(
            content.contains("0 36 m\n36 36 l\n36 0 l\n0 0 l\nh\nW\nn"),
            "{content}"
        );
        assert!(content.contains("1 0 0 rg"), "{content}");
        assert!(content.contains("0.75 0 0 0.75 45 13.5 Tm"), "{content}");
        assert_eq!(content.matches("Tj").count(), 1);
        assert_eq!(streams[1], FONT);
        // The characters that the three letters stand for: m, m and the raised two.
        let characters = String::from_utf8(streams[2].clone()).unwrap();
        assert!(
            characters.contains("<006D>") && characters.contains("<00B2>"),
            "{characters}"
        );
        assert_eq!(to_pdf(SVG, "A picture").unwrap(), pdf);
    }

    #[test]
    fn what_is_no_svg_is_refused() {
        assert!(matches!(to_pdf("<svg", ""), Err(PdfError::Svg(_))));
    }
}
