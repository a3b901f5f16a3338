//! A drawing as PNG, the same bytes on every machine.

use tiny_skia::{
    Color, FillRule, LineCap, LineJoin, Mask, Paint as Ink, Path, PathBuilder, Pixmap, Rect,
    Stroke, StrokeDash, Transform,
};

use super::font::FONT;
use super::{Drawing, Item, PIXELS_PER_INCH, Paint, Rgb};

/// Largest number of dots of a picture along each side.
const MOST_PIXELS: f64 = 20_000.0;

/// Reason why a drawing cannot become a PNG.
#[derive(Debug, thiserror::Error)]
pub enum PngError {
    /// Too many dots, or none.
    #[error(
        "a picture of {width:.0} x {height:.0} pixels; 1 to {MOST_PIXELS} are possible, choose another --width or --dpi"
    )]
    Size {
        /// Width, dots.
        width: f64,
        /// Height, dots.
        height: f64,
    },
    /// The encoder failed.
    #[error("the PNG cannot be encoded: {0}")]
    Encoding(#[from] png::EncodingError),
}

/// A picture as dots.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct Pixels {
    /// Dots along x and y.
    pub(crate) size: [u32; 2],
    /// Red, green and blue of the dots, row by row from the top.
    pub(crate) colours: Vec<Rgb>,
}

impl Drawing {
    /// The drawing as PNG with a resolution in dots per inch.
    ///
    /// # Errors
    ///
    /// If it would have no or too many dots.
    pub fn to_png(&self, dpi: f64) -> Result<Vec<u8>, PngError> {
        encode(&self.pixels(dpi)?, dpi)
    }

    /// The dots of the drawing with a resolution in dots per inch.
    pub(crate) fn pixels(&self, dpi: f64) -> Result<Pixels, PngError> {
        let [width, height] = self.size.map(|it| (it * dpi / PIXELS_PER_INCH).round());
        let fits = |it: f64| (1.0..=MOST_PIXELS).contains(&it);
        let dots = (fits(width) && fits(height)).then(|| Pixmap::new(width as u32, height as u32));
        let dots = dots.flatten().ok_or(PngError::Size { width, height })?;
        let [across, down] = self.size;
        let mut canvas = Canvas {
            dots,
            scale: Transform::from_scale((width / across) as f32, (height / down) as f32),
            window: None,
        };
        canvas.dots.fill(Color::WHITE);
        for item in &self.items {
            canvas.draw(item);
        }
        // On white every dot is opaque, so that three channels hold all.
        let (dots, _) = canvas.dots.data().as_chunks::<4>();
        Ok(Pixels {
            size: [width as u32, height as u32],
            colours: dots.iter().map(|&[r, g, b, _]| [r, g, b]).collect(),
        })
    }
}

/// Canvas of dots on which a drawing is painted.
struct Canvas {
    dots: Pixmap,
    /// Transform from pixels of the drawing to dots.
    scale: Transform,
    /// The window that is painted; `None` for the whole canvas.
    window: Option<Mask>,
}

impl Canvas {
    fn draw(&mut self, item: &Item) {
        match item {
            Item::Path(path, paint) => self.paint(path.in_pixels(), paint, self.scale),
            Item::Circle(centre, radius, paint) => {
                self.paint(circle(*centre, *radius), paint, self.scale);
            }
            Item::Text(line) => {
                let transform = self.scale.pre_concat(line.placement());
                let outlines = FONT.outlines(&line.text, line.size);
                self.paint(outlines, &Paint::fill(super::TEXT), transform);
            }
            Item::Window([[x, y], [width, height]]) => {
                let [x, y, width, height] = [*x, *y, *width, *height].map(|it| it as f32);
                let area = Rect::from_xywh(x, y, width, height).map(PathBuilder::from_rect);
                let mask = Mask::new(self.dots.width(), self.dots.height());
                self.window = mask.zip(area).map(|(mut mask, area)| {
                    mask.fill_path(&area, FillRule::Winding, true, self.scale);
                    mask
                });
            }
            Item::WindowEnd => self.window = None,
        }
    }

    /// Paints a path, whose transform leads to dots.
    fn paint(&mut self, path: Option<Path>, paint: &Paint, transform: Transform) {
        let Some(path) = path else {
            return;
        };
        let ink = |[r, g, b]: Rgb| {
            let mut ink = Ink::default();
            ink.set_color_rgba8(r, g, b, 255);
            ink
        };
        let window = self.window.as_ref();
        if let Some(colour) = paint.fill {
            let rule = FillRule::Winding;
            (self.dots).fill_path(&path, &ink(colour), rule, transform, window);
        }
        if let Some((colour, width)) = paint.stroke {
            let dashes = paint.dashes.map(|it| it.map(|it| it as f32).to_vec());
            let stroke = Stroke {
                width: width as f32,
                line_join: LineJoin::Round,
                line_cap: match dashes {
                    Some(_) => LineCap::Butt,
                    None => LineCap::Round,
                },
                dash: dashes.and_then(|dashes| StrokeDash::new(dashes, 0.0)),
                ..Stroke::default()
            };
            (self.dots).stroke_path(&path, &ink(colour), &stroke, transform, window);
        }
    }
}

/// A circle as a path.
pub(super) fn circle(centre: [f64; 2], radius: f64) -> Option<Path> {
    let [x, y] = centre.map(|it| it as f32);
    PathBuilder::from_circle(x, y, radius as f32)
}

fn encode(pixels: &Pixels, dpi: f64) -> Result<Vec<u8>, PngError> {
    let [width, height] = pixels.size;
    let per_metre = (dpi / 0.0254).round() as u32;
    let mut bytes = Vec::new();
    let mut encoder = png::Encoder::new(&mut bytes, width, height);
    encoder.set_color(png::ColorType::Rgb);
    encoder.set_compression(png::Compression::High);
    encoder.set_pixel_dims(Some(png::PixelDimensions {
        xppu: per_metre,
        yppu: per_metre,
        unit: png::Unit::Meter,
    }));
    let mut writer = encoder.write_header()?;
    writer.write_image_data(pixels.colours.as_flattened())?;
    writer.finish()?;
    Ok(bytes)
}

#[cfg(test)]
mod tests {
    use super::super::Anchor;
    use super::*;

    /// An inch by half an inch: red at the left, and a letter at the right.
    fn drawing() -> Drawing {
        let mut drawing = Drawing::new([96.0, 48.0]);
        drawing.rectangle([0.0; 2], [48.0, 48.0], Paint::fill([255, 0, 0]));
        drawing.text([60.0, 30.0], Anchor::Start, 20.0, "x");
        drawing
    }

    fn decoded(bytes: &[u8]) -> (png::OutputInfo, Option<png::PixelDimensions>, Vec<u8>) {
        let decoder = png::Decoder::new(std::io::Cursor::new(bytes));
        let mut reader = decoder.read_info().unwrap();
        let mut pixels = vec![0; reader.output_buffer_size().unwrap()];
        let dimensions = reader.info().pixel_dims;
        let info = reader.next_frame(&mut pixels).unwrap();
        (info, dimensions, pixels)
    }

    /// At 100 dots per inch there are 100 x 50 dots.
    #[test]
    fn a_picture_has_its_size_its_colours_and_its_letters() {
        let (info, dimensions, pixels) = decoded(&drawing().to_png(100.0).unwrap());
        assert_eq!((info.width, info.height), (100, 50));
        assert_eq!(dimensions.map(|it| it.xppu), Some(3937));
        let at = |x: usize, y: usize| &pixels[3 * (100 * y + x)..][..3];
        assert_eq!(at(20, 25), [255, 0, 0]);
        assert_eq!(at(98, 2), [255, 255, 255]);
        let dark = pixels.chunks(3).filter(|pixel| pixel[0] < 80).count();
        assert!(dark > 10, "{dark} pixels of the letter");
        let again = drawing().to_png(100.0).unwrap();
        assert_eq!(drawing().to_png(100.0).unwrap(), again);
    }

    #[test]
    fn nothing_is_seen_outside_of_a_window() {
        let mut drawing = Drawing::new([40.0, 40.0]);
        drawing.begin_window([10.0; 2], [20.0; 2]);
        drawing.circle([20.0; 2], 19.0, Paint::fill([0; 3]));
        drawing.end_window();
        drawing.line([[0.0, 38.0], [40.0, 38.0]], [0; 3], 2.0);
        let Pixels { colours, .. } = drawing.pixels(96.0).unwrap();
        let at = |x: usize, y: usize| colours[40 * y + x];
        assert_eq!([at(20, 20), at(11, 11), at(20, 38)], [[0; 3]; 3]);
        assert_eq!([at(20, 5), at(8, 20)], [[255; 3]; 2]);
    }

    #[test]
    fn a_size_that_cannot_be_is_refused() {
        for dpi in [0.001, 1e9] {
            assert!(matches!(drawing().to_png(dpi), Err(PngError::Size { .. })));
        }
    }
}
