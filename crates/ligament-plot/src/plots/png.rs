//! SVG to PNG, the same bytes on every machine: the font is part of the program.

use resvg::tiny_skia::{Pixmap, Transform};
use resvg::usvg::{Options, Tree};

use super::outlines::with_outlined_text;
use super::text::font;

/// Pixels of SVG to the inch.
pub const PIXELS_PER_INCH: f64 = 96.0;

/// Most pixels of a picture along each side.
const MOST_PIXELS: f64 = 20_000.0;

/// A picture that cannot become a PNG.
#[derive(Debug, thiserror::Error)]
pub enum PngError {
    /// The SVG is not one.
    #[error("the SVG cannot be read: {0}")]
    Svg(#[from] resvg::usvg::Error),
    /// The font of the program is none.
    #[error("the font of the program cannot be read: {0}")]
    Font(#[from] ttf_parser::FaceParsingError),
    /// Too many pixels, or none.
    #[error(
        "a picture of {width:.0} x {height:.0} pixels; 1 to {MOST_PIXELS} are possible, choose another --width or --dpi"
    )]
    Size {
        /// Width, pixels.
        width: f64,
        /// Height, pixels.
        height: f64,
    },
    /// The encoder failed.
    #[error("the PNG cannot be encoded: {0}")]
    Encoding(#[from] png::EncodingError),
}

/// Draws the text of an SVG file on white, with so many dots per inch of its size, and encodes it as PNG with that density.
///
/// # Errors
///
/// If it is no SVG, or would have no or too many pixels.
pub fn to_png(svg: &str, dpi: f64) -> Result<Vec<u8>, PngError> {
    encode(&Pixels::drawn(svg, dpi)?, dpi)
}

/// A picture as its dots.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct Pixels {
    /// Dots along x and y.
    pub(crate) size: [u32; 2],
    /// Red, green and blue of the dots, row by row from the top.
    pub(crate) colours: Vec<[u8; 3]>,
}

impl Pixels {
    /// The dots of the text of an SVG file on white, so many to the inch of its size.
    pub(crate) fn drawn(svg: &str, dpi: f64) -> Result<Self, PngError> {
        let outlined = with_outlined_text(svg, &font()?).map_err(resvg::usvg::Error::from)?;
        let tree = Tree::from_str(&outlined, &Options::default())?;
        let scale = dpi / PIXELS_PER_INCH;
        let size = [tree.size().width(), tree.size().height()];
        let [width, height] = size.map(|it| (f64::from(it) * scale).round());
        let fits = |it: f64| (1.0..=MOST_PIXELS).contains(&it);
        let pixmap =
            (fits(width) && fits(height)).then(|| Pixmap::new(width as u32, height as u32));
        let mut pixmap = pixmap.flatten().ok_or(PngError::Size { width, height })?;
        pixmap.fill(resvg::tiny_skia::Color::WHITE);
        let transform = Transform::from_scale(
            width as f32 / tree.size().width(),
            height as f32 / tree.size().height(),
        );
        resvg::render(&tree, transform, &mut pixmap.as_mut());
        // On white every pixel is opaque, so that three channels hold all.
        let (pixels, _) = pixmap.data().as_chunks::<4>();
        Ok(Self {
            size: [pixmap.width(), pixmap.height()],
            colours: pixels.iter().map(|&[r, g, b, _]| [r, g, b]).collect(),
        })
    }
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
    use super::*;

    const SVG: &str = "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"25.4mm\" height=\"12.7mm\" viewBox=\"0 0 96 48\">\
        <rect x=\"0\" y=\"0\" width=\"48\" height=\"48\" fill=\"#ff0000\"/><text x=\"60\" y=\"30\" font-size=\"20\">x</text></svg>";

    fn decoded(bytes: &[u8]) -> (png::OutputInfo, Option<png::PixelDimensions>, Vec<u8>) {
        let decoder = png::Decoder::new(std::io::Cursor::new(bytes));
        let mut reader = decoder.read_info().unwrap();
        let mut pixels = vec![0; reader.output_buffer_size().unwrap()];
        let dimensions = reader.info().pixel_dims;
        let info = reader.next_frame(&mut pixels).unwrap();
        (info, dimensions, pixels)
    }

    /// An inch by half an inch at 100 dots per inch: 100 x 50 pixels, red at the left and a letter on white at the right.
    #[test]
    fn a_picture_has_its_size_its_colours_and_its_letters() {
        let (info, dimensions, pixels) = decoded(&to_png(SVG, 100.0).unwrap());
        assert_eq!((info.width, info.height), (100, 50));
        assert_eq!(dimensions.map(|it| it.xppu), Some(3937));
        let at = |x: usize, y: usize| &pixels[3 * (100 * y + x)..][..3];
        assert_eq!(at(20, 25), [255, 0, 0]);
        assert_eq!(at(98, 2), [255, 255, 255]);
        let dark = pixels.chunks(3).filter(|pixel| pixel[0] < 80).count();
        assert!(dark > 10, "{dark} pixels of the letter");
        assert_eq!(to_png(SVG, 100.0).unwrap(), to_png(SVG, 100.0).unwrap());
    }

    #[test]
    fn a_size_that_cannot_be_is_refused() {
        for dpi in [0.001, 1e9] {
            assert!(matches!(to_png(SVG, dpi), Err(PngError::Size { .. })));
        }
        assert!(matches!(to_png("<svg", 96.0), Err(PngError::Svg(_))));
    }
}
