//! The colour bar beside the bodies.

use super::panel::Scale;
use super::units::{AxisUnit, text_with_decimals_of};
use crate::drawing::{Anchor, Drawing, OUTLINE, Paint, text_width};

/// Width of the bar, pixels.
const WIDTH: f64 = 11.0;

/// Size of the labels of a colour bar, pixels.
const SIZE: f64 = 8.5;

/// Length of a tick, and room on both sides of a text.
const TICK: f64 = 3.0;

/// A bar with its labels.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct ColourBar<'a> {
    scale: &'a Scale,
    /// Texts of the labels, from the bottom, with the number of their level.
    labels: Vec<(usize, String)>,
    /// Title of the bar: the quantity with its unit.
    title: String,
}

impl<'a> ColourBar<'a> {
    /// The bar of a quantity whose values go from `range[0]` to `range[1]`; an end beyond which there are values is marked.
    pub(super) fn new(scale: &'a Scale, quantity: &str, unit: &str, range: [f64; 2]) -> Self {
        let levels = &scale.levels;
        let [low, high] = levels.range();
        let shown = AxisUnit::new(unit, low.abs().max(high.abs()));
        let labelled = &levels.labelled;
        let spacing = match labelled.as_slice() {
            [first, second, ..] => levels.bounds[*second] - levels.bounds[*first],
            _ => high - low,
        };
        let label = |&place: &usize| {
            let value = levels.bounds[place];
            let number = text_with_decimals_of(value * shown.factor, spacing * shown.factor);
            let rounding = 1e-9 * (high - low);
            let sign = match place {
                0 if range[0] < low - rounding => "≤ ",
                _ if place == levels.n_bands() && range[1] > high + rounding => "≥ ",
                _ => "",
            };
            (place, format!("{sign}{number}"))
        };
        Self {
            scale,
            labels: labelled.iter().map(label).collect(),
            title: shown.label(quantity),
        }
    }

    /// Width with labels and title, pixels.
    pub(super) fn width(&self) -> f64 {
        WIDTH + 2.0 * TICK + self.label_width() + TICK + 1.2 * SIZE
    }

    fn label_width(&self) -> f64 {
        let widths = self.labels.iter().map(|(_, text)| text_width(text, SIZE));
        widths.fold(0.0, f64::max)
    }

    /// Height that the title needs, pixels.
    pub(super) fn least_height(&self) -> f64 {
        text_width(&self.title, SIZE).max(90.0)
    }

    /// Draws the colour bar with its upper left corner at a place, pixels.
    pub(super) fn draw(&self, drawing: &mut Drawing, [x, y]: [f64; 2], height: f64) {
        let colours = &self.scale.colours;
        let n_bands = colours.len() as f64;
        let up = |level: f64| y + height * (1.0 - level / n_bands);
        for (band, &colour) in colours.iter().enumerate() {
            // Each band reaches to the top, under the bands that follow: no seam is left between two.
            let size = [WIDTH, up(band as f64) - y];
            drawing.rectangle([x, y], size, Paint::fill(colour));
        }
        drawing.rectangle([x, y], [WIDTH, height], Paint::stroke(OUTLINE, 0.6));
        for (level, text) in &self.labels {
            let at = up(*level as f64);
            drawing.line([[x + WIDTH, at], [x + WIDTH + TICK, at]], OUTLINE, 0.6);
            let start = x + WIDTH + 2.0 * TICK;
            drawing.text([start, at + 0.36 * SIZE], Anchor::Start, SIZE, text);
        }
        let end = x + self.width() - 0.2 * SIZE;
        drawing.upright_text([end, y + 0.5 * height], SIZE, &self.title);
    }
}
