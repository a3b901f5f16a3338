//! Bodies side by side at one scale, with titles above, the colour bar at the right and the legend below.

use super::body::bounds;
use super::colour_bar::ColourBar;
use super::panel::{Frame, Panel, Scale};
use super::svg::{Anchor, Document, text_width};

/// Size of the text, pixels.
const SIZE: f64 = 9.0;

/// Height of a line of text, pixels.
const LINE: f64 = 12.0;

/// Room at the rim and between bodies, pixels.
const MARGIN: f64 = 6.0;

/// Largest height over width of a picture.
const TALLEST: f64 = 1.25;

/// Bodies wider than so many heights are put below each other.
const WIDE: f64 = 2.2;

/// A line of the legend.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct Entry {
    /// Colour of its sample; None: words alone.
    pub(super) colour: Option<&'static str>,
    /// Its words.
    pub(super) words: String,
}

/// What a picture consists of.
#[derive(Debug)]
pub(super) struct Strip<'a> {
    /// The bodies; one or more.
    pub(super) panels: &'a [Panel],
    /// Colours of the field.
    pub(super) scale: Option<&'a Scale>,
    /// The bar of the field.
    pub(super) bar: Option<ColourBar<'a>>,
    /// What is below the bodies.
    pub(super) legend: Vec<Entry>,
    /// Part of the plane to draw, lower left and upper right corner, m; None: all.
    pub(super) window: Option<[[f64; 2]; 2]>,
    /// Bodies in a row.
    pub(super) columns: Option<usize>,
    /// Words for the file.
    pub(super) title: String,
}

impl Strip<'_> {
    /// The picture as the text of an SVG file, so many pixels wide.
    pub(super) fn to_svg(&self, width: f64) -> String {
        let extents: Vec<[[f64; 2]; 2]> = (self.panels.iter())
            .filter_map(|panel| self.window.or_else(|| bounds(&panel.positions)))
            .collect();
        let largest = |axis: usize| {
            let sizes = extents.iter().map(|[low, high]| high[axis] - low[axis]);
            sizes.fold(f64::MIN_POSITIVE, f64::max)
        };
        let body = [largest(0), largest(1)];
        let columns = self
            .columns
            .unwrap_or_else(|| self.columns_for(body))
            .clamp(1, self.panels.len());
        let rows = self.panels.len().div_ceil(columns);
        let bar_width = self
            .bar
            .as_ref()
            .map_or(0.0, |bar| 2.0 * MARGIN + bar.width());
        let between = 2.0 * MARGIN;
        let room = width - 2.0 * MARGIN - bar_width - between * (columns as f64 - 1.0);
        let cell_width = (room / columns as f64).max(1.0);
        let titles: Vec<Vec<String>> = self
            .panels
            .iter()
            .map(|panel| wrapped(&panel.title, cell_width))
            .collect();
        let n_lines = titles.iter().map(Vec::len).max().unwrap_or(0);
        let title_height = LINE * n_lines as f64 + if n_lines > 0 { 3.0 } else { 0.0 };
        let legend = self.legend_lines(width - 2.0 * MARGIN);
        let legend_height = LINE * legend.len() as f64 + if legend.is_empty() { 0.0 } else { 4.0 };
        let gaps = MARGIN * (rows as f64 - 1.0);
        let fixed = 2.0 * MARGIN + legend_height + title_height * rows as f64 + gaps;
        let tallest = (TALLEST * width - fixed).max(1.0) / rows as f64;
        let scale = (cell_width / body[0]).min(tallest / body[1]);
        let cell_height = body[1] * scale;
        let bodies_height = (title_height + cell_height) * rows as f64 + gaps;
        let least = self.bar.as_ref().map_or(0.0, ColourBar::least_height);
        // A body that keeps its height from filling the width leaves no empty room beside it.
        let cell_width = cell_width.min((body[0] * scale).max(widest(&titles)));
        let used = cell_width * columns as f64 + between * (columns as f64 - 1.0);
        let left = MARGIN + 0.5 * (room + between * (columns as f64 - 1.0) - used);
        let inner = bodies_height.max(least);
        let top = MARGIN + 0.5 * (inner - bodies_height);
        let mut document = Document::new([width, 2.0 * MARGIN + inner + legend_height]);
        for (place, (panel, title)) in self.panels.iter().zip(&titles).enumerate() {
            let (row, column) = (place / columns, place % columns);
            let x = left + (cell_width + between) * column as f64;
            let y = top + (title_height + cell_height + MARGIN) * row as f64;
            for (line, words) in title.iter().enumerate() {
                let at = [x + 0.5 * cell_width, y + LINE * (line as f64 + 0.8)];
                document.text(at, Anchor::Middle, SIZE, words);
            }
            let Some([low, high]) = self.window.or_else(|| bounds(&panel.positions)) else {
                continue;
            };
            let own = [0, 1].map(|axis| (high[axis] - low[axis]) * scale);
            let at = [
                x + 0.5 * (cell_width - own[0]),
                y + title_height + 0.5 * (cell_height - own[1]),
            ];
            let frame = Frame {
                low,
                high,
                at,
                scale,
            };
            if self.window.is_some() {
                document.begin_window(&format!("window-{place}"), at, frame.size());
                panel.draw(&mut document, frame, self.scale);
                document.end_window();
                document.frame(at, frame.size());
            } else {
                panel.draw(&mut document, frame, self.scale);
            }
        }
        if let Some(bar) = &self.bar {
            let (x, y) = (left + used + 2.0 * MARGIN, MARGIN + title_height);
            // In one row beside the bodies, without their titles.
            let height = (inner - title_height).clamp(60.0, 420.0);
            bar.draw(
                &mut document,
                [x, y + 0.5 * (inner - title_height - height)],
                height,
            );
        }
        for (line, entries) in legend.iter().enumerate() {
            let y = MARGIN + inner + 4.0 + LINE * (line as f64 + 0.8);
            for (x, Entry { colour, words }) in entries {
                let mut start = MARGIN + x;
                if let Some(colour) = colour {
                    document.line([start, y - 3.0], [start + 14.0, y - 3.0], colour, 1.5);
                    start += 18.0;
                }
                document.text([start, y], Anchor::Start, SIZE, words);
            }
        }
        document.finish(&self.title)
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
    fn legend_lines(&self, width: f64) -> Vec<Vec<(f64, &Entry)>> {
        let mut lines: Vec<Vec<_>> = Vec::new();
        let mut at = 0.0;
        for entry in &self.legend {
            let swatch = if entry.colour.is_some() { 18.0 } else { 0.0 };
            let needs = swatch + text_width(&entry.words, SIZE);
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

fn widest(titles: &[Vec<String>]) -> f64 {
    let lines = titles.iter().flatten();
    lines.map(|line| text_width(line, SIZE)).fold(0.0, f64::max)
}

/// Words in lines of a width: together where they fit, in their short form where one alone does not.
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
