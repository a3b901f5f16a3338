//! Bodies side by side at one scale, with titles above, the colour bar at the right and the legend below.

use super::colour_bar::ColourBar;
use super::panel::{Panel, Scale};
use crate::drawing::axes::{self, Axes};
use crate::drawing::{Anchor, Drawing, Frame, OUTLINE, Paint, Rgb, text_width};

/// Size of the text, pixels.
const SIZE: f64 = 9.0;

/// Height of a line of text, pixels.
const LINE: f64 = 12.0;

/// Size of the numbers along axes, and distance of the axes from the body, pixels.
const AXIS_SIZE: f64 = 8.0;
const AXIS_GAP: f64 = 3.0;

/// Width of the line around a window, pixels.
const FRAME_WIDTH: f64 = 0.6;

/// Room at the rim and between bodies, pixels.
const MARGIN: f64 = 6.0;

/// Width of the rim around a body in which lines that lead out of it are still drawn, pixels.
const RIM: f64 = 0.5;

/// Largest height over width of a picture.
const TALLEST: f64 = 1.25;

/// Ratio of width to height above which bodies are placed below each other.
const WIDE: f64 = 2.2;

/// A line of the legend.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct LegendEntry {
    /// Colour of the sample line; None for text alone.
    pub(super) colour: Option<Rgb>,
    /// Text of the entry.
    pub(super) words: String,
}

/// Room for the sample of a line in the legend, pixels.
const SAMPLE: f64 = 18.0;

/// Largest height of a colour bar, pixels.
const LONGEST_BAR: f64 = 420.0;

/// Extent over all pictures of a series, for which each of them has room, so that nothing moves from one to the next.
#[derive(Debug)]
pub(super) struct SeriesExtent {
    /// Lower left and upper right corner of all bodies in all pictures, m.
    pub(super) extent: Option<[[f64; 2]; 2]>,
    /// Titles of all pictures.
    pub(super) titles: Vec<Vec<[String; 2]>>,
}

/// Contents of a picture: bodies, colour bar and legend.
#[derive(Debug)]
pub(super) struct Strip<'a> {
    /// The bodies; one or more.
    pub(super) panels: &'a [Panel],
    /// Colours of the field.
    pub(super) scale: Option<&'a Scale>,
    /// Colour bar of the field.
    pub(super) bar: Option<ColourBar<'a>>,
    /// Legend below the bodies.
    pub(super) legend: Vec<LegendEntry>,
    /// Part of the plane to draw, lower left and upper right corner, m; `None`: all.
    pub(super) window: Option<[[f64; 2]; 2]>,
    /// Bodies in a row.
    pub(super) columns: Option<usize>,
    /// Whether axes in mm stand at the left of and below each body.
    pub(super) has_axes: bool,
    /// Extent over all pictures of a series; None for a single picture.
    pub(super) room: Option<&'a SeriesExtent>,
}

/// Positions and sizes of the parts of a picture, pixels.
#[derive(Debug)]
struct Layout {
    /// Bodies in a row.
    columns: usize,
    /// Pixels per metre.
    scale: f64,
    /// Room for a body.
    cell: [f64; 2],
    /// Lines of the titles.
    titles: Vec<Vec<String>>,
    title_height: f64,
    /// Upper left corner of the first title, and the size of all bodies from there.
    start: [f64; 2],
    bodies: [f64; 2],
    /// Height without margins and legend.
    inner: f64,
}

impl Strip<'_> {
    /// The picture, with a width in pixels.
    pub(super) fn draw(&self, width: f64) -> Drawing {
        let legend = self.legend_lines(width - 2.0 * MARGIN);
        let below = LINE * legend.len() as f64 + if legend.is_empty() { 0.0 } else { 4.0 };
        let layout = self.layout(width, below);
        let height = 2.0 * MARGIN + layout.inner + below;
        let mut drawing = Drawing::new([width, height]);
        for place in 0..self.panels.len() {
            self.draw_panel(&mut drawing, &layout, place);
        }
        if let Some(bar) = &self.bar {
            // Beside the bodies, without the titles of the first row.
            let room = layout.inner - layout.title_height;
            let height = room.clamp(60.0, LONGEST_BAR);
            let x = layout.start[0] + layout.bodies[0] + 2.0 * MARGIN;
            let y = MARGIN + layout.title_height + 0.5 * (room - height);
            bar.draw(&mut drawing, [x, y], height);
        }
        for (line, entries) in legend.iter().enumerate() {
            let y = MARGIN + layout.inner + 4.0 + LINE * (line as f64 + 0.8);
            for (x, LegendEntry { colour, words }) in entries {
                let mut start = MARGIN + x;
                if let Some(colour) = colour {
                    let ends = [[start, y - 3.0], [start + 14.0, y - 3.0]];
                    drawing.line(ends, *colour, 1.5);
                    start += SAMPLE;
                }
                drawing.text([start, y], Anchor::Start, SIZE, words);
            }
        }
        drawing
    }

    /// Lower left and upper right corner of the part of a body that is drawn, m.
    fn extent(&self, panel: &Panel) -> Option<[[f64; 2]; 2]> {
        let of_series = self.room.and_then(|room| room.extent);
        (self.window.or(of_series)).or_else(|| panel.bounds())
    }

    fn layout(&self, width: f64, below: f64) -> Layout {
        let extents: Vec<[[f64; 2]; 2]> = (self.panels.iter())
            .filter_map(|panel| self.extent(panel))
            .collect();
        let body = [0, 1].map(|axis| {
            let sizes = extents.iter().map(|[low, high]| high[axis] - low[axis]);
            sizes.fold(f64::MIN_POSITIVE, f64::max)
        });
        let count = self.panels.len();
        let columns = self
            .columns
            .unwrap_or_else(|| self.columns_for(body))
            .clamp(1, count);
        let rows = count.div_ceil(columns) as f64;
        let bar = self
            .bar
            .as_ref()
            .map_or(0.0, |bar| 2.0 * MARGIN + bar.width());
        let gaps = 2.0 * MARGIN * (columns as f64 - 1.0);
        let room = width - 2.0 * MARGIN - bar - gaps;
        let widest_cell = (room / columns as f64).max(1.0);
        let titles: Vec<Vec<String>> = (self.panels.iter())
            .map(|panel| wrapped(&panel.title, widest_cell))
            .collect();
        let of_series = self.room.iter().flat_map(|room| &room.titles);
        let roomy: Vec<Vec<String>> = (titles.iter().cloned())
            .chain(of_series.map(|title| wrapped(title, widest_cell)))
            .collect();
        let n_lines = roomy.iter().map(Vec::len).max().unwrap_or(0);
        let title_height = LINE * n_lines as f64 + if n_lines > 0 { 3.0 } else { 0.0 };
        let row_gaps = MARGIN * (rows - 1.0);
        let fixed = 2.0 * MARGIN + below + title_height * rows + row_gaps;
        let tallest_cell = (TALLEST * width - fixed).max(1.0) / rows;
        let [left, right, bottom] = self.axes_room();
        let scale = ((widest_cell - left - right).max(1.0) / body[0])
            .min((tallest_cell - bottom).max(1.0) / body[1]);
        // Bodies that do not fill the width stand together in its middle.
        let cell_width = widest_cell.min((body[0] * scale + left + right).max(widest(&roomy)));
        let cell = [cell_width, body[1] * scale + bottom];
        let bodies = [
            cell[0] * columns as f64 + gaps,
            (title_height + cell[1]) * rows + row_gaps,
        ];
        let inner = bodies[1].max(self.bar.as_ref().map_or(0.0, ColourBar::least_height));
        Layout {
            columns,
            scale,
            cell,
            titles,
            title_height,
            start: [
                MARGIN + 0.5 * (room + gaps - bodies[0]),
                MARGIN + 0.5 * (inner - bodies[1]),
            ],
            bodies,
            inner,
        }
    }

    fn draw_panel(&self, drawing: &mut Drawing, layout: &Layout, place: usize) {
        let (panel, cell, scale) = (&self.panels[place], layout.cell, layout.scale);
        let (row, column) = (place / layout.columns, place % layout.columns);
        let x = layout.start[0] + (cell[0] + 2.0 * MARGIN) * column as f64;
        let y = layout.start[1] + (layout.title_height + cell[1] + MARGIN) * row as f64;
        for (line, words) in layout.titles[place].iter().enumerate() {
            let at = [x + 0.5 * cell[0], y + LINE * (line as f64 + 0.8)];
            drawing.text(at, Anchor::Middle, SIZE, words);
        }
        let Some([low, high]) = self.extent(panel) else {
            return;
        };
        let own = [0, 1].map(|axis| (high[axis] - low[axis]) * scale);
        let [left, right, bottom] = self.axes_room();
        let at = [
            x + left + 0.5 * (cell[0] - left - right - own[0]),
            y + layout.title_height + 0.5 * (cell[1] - bottom - own[1]),
        ];
        let frame = Frame::new([low, high], [at, own]);
        if self.has_axes {
            draw_axes(drawing, [low, high], [at, own]);
        }
        if self.window.is_none() && !self.has_axes {
            panel.draw(drawing, frame, self.scale);
            return;
        }
        // Outlines at the rim keep their width.
        let rim = if self.window.is_none() { RIM } else { 0.0 };
        let (from, size) = (at.map(|it| it - rim), own.map(|it| it + 2.0 * rim));
        drawing.begin_window(from, size);
        panel.draw(drawing, frame, self.scale);
        drawing.end_window();
        if self.window.is_some() {
            drawing.rectangle(at, own, Paint::stroke(OUTLINE, FRAME_WIDTH));
        }
    }

    /// Room for axes at the left of a body, at its right and below it, pixels.
    fn axes_room(&self) -> [f64; 3] {
        match self.has_axes {
            true => axes::room(AXIS_SIZE),
            false => [0.0; 3],
        }
    }

    fn columns_for(&self, [width, height]: [f64; 2]) -> usize {
        let count = self.panels.len();
        match count {
            0..=4 if width > WIDE * height => 1,
            0..=5 => count,
            6 => 3,
            _ => 4,
        }
    }

    /// The entries of the legend with their places in lines of a width.
    fn legend_lines(&self, width: f64) -> Vec<Vec<(f64, &LegendEntry)>> {
        let mut lines: Vec<Vec<_>> = Vec::new();
        let mut at = 0.0;
        for entry in &self.legend {
            let sample = if entry.colour.is_some() { SAMPLE } else { 0.0 };
            let needs = sample + text_width(&entry.words, SIZE);
            if lines.is_empty() || at + needs > width {
                lines.push(Vec::new());
                at = 0.0;
            }
            if let Some(line) = lines.last_mut() {
                line.push((at, entry));
            }
            at += needs + 14.0;
        }
        lines
    }
}

/// Draws axes in mm around a part of the plane (m) in a rectangle of the drawing.
fn draw_axes(drawing: &mut Drawing, corners: [[f64; 2]; 2], rectangle: [[f64; 2]; 2]) {
    let axes = Axes {
        names: ["x (mm)", "y (mm)"],
        letters: AXIS_SIZE,
        gap: AXIS_GAP,
        has_grid: false,
    };
    let in_mm = corners.map(|corner| corner.map(|it| 1e3 * it));
    axes.draw(drawing, Frame::new(in_mm, rectangle));
}

fn widest(titles: &[Vec<String>]) -> f64 {
    let lines = titles.iter().flatten();
    lines.map(|line| text_width(line, SIZE)).fold(0.0, f64::max)
}

/// Words broken into lines of a width: several words in one line where they fit, and the short form of a word that does not fit alone.
fn wrapped(words: &[[String; 2]], width: f64) -> Vec<String> {
    let fits = |text: &str| text_width(text, SIZE) <= width;
    let mut lines: Vec<String> = Vec::new();
    for [long, short] in words {
        let word = if fits(long) { long } else { short };
        let joined = lines.last().map(|line| format!("{line}, {word}"));
        match joined {
            Some(joined) if fits(&joined) => {
                lines.pop();
                lines.push(joined);
            }
            _ => lines.push(word.clone()),
        }
    }
    lines
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn titles_are_wrapped_and_shortened_to_the_room() {
        let words = [
            ["step 44", "step 44"],
            ["displacement 0.1800 mm", "0.1800 mm"],
        ]
        .map(|pair| pair.map(str::to_owned));
        assert_eq!(wrapped(&words, 400.0), ["step 44, displacement 0.1800 mm"]);
        assert_eq!(
            wrapped(&words, 120.0),
            ["step 44", "displacement 0.1800 mm"]
        );
        assert_eq!(wrapped(&words, 60.0), ["step 44", "0.1800 mm"]);
    }
}
