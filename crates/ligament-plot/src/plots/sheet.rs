//! Sheet of a plot: its size, the room for the legend, and the scale of its lines and letters.

use super::series::{LETTERS, Series};
use crate::drawing::{Drawing, PIXELS_PER_MM, text_width};

/// Pixels of a screen per millimetre of paper: text of 15 pixels has a height of 7 points in print.
const SCREEN_PIXELS_PER_MM: f64 = 6.0;

/// Height over the width of the room for the curves on paper.
const HEIGHT: f64 = 0.68;

/// Height over width of one of several plots.
const HEIGHT_OF_PANEL: f64 = 0.85;

/// Width of the room for the curves on a screen, and least width of the legend beside it, pixels.
const PLANE: f64 = 570.0;
const LEGEND: f64 = 190.0;

/// Largest share of the legend in the width of a sheet.
const LARGEST_LEGEND: f64 = 0.6;

/// Place of the first entry of the legend, and distance of the entries, pixels of a screen.
const FIRST_ENTRY: f64 = 52.0;
const ENTRY: f64 = 22.0;

/// Width of an entry of the legend without its label, pixels of a screen.
const BESIDE_LABEL: f64 = 58.0;

/// The sheet for a plot.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct PageLayout {
    /// Pixels of the drawing per pixel of a screen.
    pub(super) pen: f64,
    /// Width and height, pixels.
    size: [f64; 2],
    /// Width of the room for the curves, pixels; the rest of the width is for the legend.
    pub(super) plane: f64,
}

/// A part of the sheet for one plot.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Room {
    /// Upper left corner, pixels.
    pub(super) at: [f64; 2],
    /// Width and height, pixels.
    pub(super) size: [f64; 2],
}

/// Largest number of plots beside each other.
const MOST_COLUMNS: usize = 3;

impl PageLayout {
    /// A screen of a height in pixels, whose legend is at the right of a room of 570 pixels.
    pub(super) fn screen(height: f64, series: &[Series]) -> Self {
        Self {
            pen: 1.0,
            size: [PLANE + legend_width(series).max(LEGEND), height],
            plane: PLANE,
        }
    }

    /// A sheet of paper of a width in mm, with room for the legend at the right where a curve has a label.
    pub(super) fn paper(width: f64, series: &[Series]) -> Self {
        let pen = PIXELS_PER_MM / SCREEN_PIXELS_PER_MM;
        let width = width * PIXELS_PER_MM;
        let legend = (pen * legend_width(series)).min(LARGEST_LEGEND * width);
        let plane = width - legend;
        let sheet = Self {
            pen,
            size: [width, HEIGHT * plane],
            plane,
        };
        let size = [width, sheet.height_with_legend(sheet.size[1], series)];
        Self { size, ..sheet }
    }

    /// A sheet of paper of a width in mm with a line above several plots of equal size, and the rooms of these in rows.
    pub(super) fn for_panels(width: f64, series: &[Series], count: usize) -> (Self, Vec<Room>) {
        let sheet = Self::paper(width, series);
        // Up to four plots are in pairs, so that they are not small.
        let columns = match count {
            0..=4 => count.clamp(1, 2),
            _ => MOST_COLUMNS,
        };
        let rows = count.div_ceil(columns) as f64;
        let side = sheet.plane / columns as f64;
        let size = [side, HEIGHT_OF_PANEL * side];
        let above = sheet.pen * ENTRY;
        let room = |place: usize| {
            let [column, row] = [place % columns, place / columns].map(|it| it as f64);
            let at = [column * size[0], above + row * size[1]];
            Room { at, size }
        };
        let rooms = (0..count).map(room).collect();
        let height = sheet.height_with_legend(above + rows * size[1], series);
        let size = [sheet.size[0], height];
        (Self { size, ..sheet }, rooms)
    }

    /// The part of the sheet for a single plot.
    pub(super) fn whole(&self) -> Room {
        Room {
            at: [0.0; 2],
            size: [self.plane, self.size[1]],
        }
    }

    /// A height, enlarged if the legend of curves needs it.
    fn height_with_legend(&self, height: f64, series: &[Series]) -> f64 {
        let entries = series.iter().filter(|it| it.is_named()).count();
        height.max(self.pen * (FIRST_ENTRY + ENTRY * entries as f64))
    }

    /// An empty drawing of the size of the sheet.
    pub(super) fn drawing(&self) -> Drawing {
        Drawing::new(self.size)
    }

    /// Draws the entries of the curves that have a label and points, below each other.
    pub(super) fn draw_legend(&self, drawing: &mut Drawing, series: &[Series]) {
        let named = series.iter().filter(|series| series.is_named());
        for (place, series) in named.enumerate() {
            let y = self.pen * (FIRST_ENTRY + ENTRY * place as f64);
            series.draw_entry(drawing, [self.plane, y], self.pen);
        }
    }
}

/// Width of the legend of curves, pixels of a screen; 0 without labels.
fn legend_width(series: &[Series]) -> f64 {
    let labels = series.iter().filter(|it| it.is_named());
    let widths = labels.map(|it| BESIDE_LABEL + text_width(it.label(), LETTERS));
    widths.fold(0.0, f64::max)
}
