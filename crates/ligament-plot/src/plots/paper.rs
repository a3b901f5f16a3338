//! What a plot is drawn on: its size, and how fine the pen is.

use std::fmt::Write as _;

/// Pixels of a screen that a millimetre of paper takes: text of 15 pixels has a height of 7 points in print.
const PIXELS_PER_MM: f64 = 6.0;

/// Dots to the pixel on paper: the drawing library knows whole dots alone, and curves should show none.
const FINE: i32 = 20;

/// Height over the width of the room for the curves.
const HEIGHT: f64 = 0.68;

/// Dots to a pixel of a screen.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Pen(i32);

impl Pen {
    /// A pen of a dot to the pixel.
    pub(super) const SCREEN: Self = Self(1);

    /// Dots of a length in pixels.
    pub(super) fn dots(self, pixels: i32) -> i32 {
        self.0 * pixels
    }
}

/// Width of the legend on a screen, at the right.
pub(super) const LEGEND: i32 = 190;

/// The sheet for a plot.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Paper {
    pub(super) pen: Pen,
    /// Width and height in pixels of a screen.
    size: (u32, u32),
    /// Width of the legend, a part of the whole.
    legend: i32,
    /// Width on paper, mm.
    width: Option<f64>,
}

impl Paper {
    /// A screen: 760 x 420 pixels.
    pub(super) const SCREEN: Self = Self {
        pen: Pen::SCREEN,
        size: (760, 420),
        legend: LEGEND,
        width: None,
    };

    /// A screen for plots with one scale along x and y: 760 x 600 pixels.
    pub(super) const SQUARE: Self = Self {
        size: (760, 600),
        ..Self::SCREEN
    };

    /// A sheet of paper of a width in mm, with room at the right for a legend whose longest label has so many letters.
    pub(super) fn new(width: f64, letters: Option<usize>) -> Self {
        // 8.5 pixels a letter of 15 pixels, beside the sample of the line.
        let legend = letters.map_or(0, |letters| 52 + 17 * letters as i32 / 2);
        let pixels = (width * PIXELS_PER_MM).round();
        let height = HEIGHT * (pixels - f64::from(legend)).max(0.4 * pixels);
        Self {
            pen: Pen(FINE),
            size: (pixels as u32, height.round() as u32),
            legend: legend.min((0.6 * pixels) as i32),
            width: Some(width),
        }
    }

    /// Width and height, dots.
    pub(super) fn dots(self) -> (u32, u32) {
        let dots = |pixels: u32| pixels * self.pen.0 as u32;
        (dots(self.size.0), dots(self.size.1))
    }

    /// Width of the room for the curves, dots.
    pub(super) fn plane(self) -> i32 {
        self.pen.dots(self.size.0 as i32 - self.legend)
    }

    /// The text of an SVG file with its size on paper in place of its dots.
    pub(super) fn sized(self, svg: String) -> String {
        let Some((width, end)) = self.width.zip(svg.find('>')) else {
            return svg;
        };
        let (across, up) = self.dots();
        let height = width * f64::from(up) / f64::from(across);
        let mut sized = String::with_capacity(svg.len() + 64);
        // Writing to a string cannot fail.
        let _ = write!(
            sized,
            "<svg width=\"{width:.3}mm\" height=\"{height:.3}mm\" viewBox=\"0 0 {across} {up}\" \
             xmlns=\"http://www.w3.org/2000/svg\">"
        );
        sized.push_str(&svg[end + 1..]);
        sized
    }
}
