//! Axes at the left of and below a frame, with round numbers and the names of the quantities.

use super::ticks::ticks;
use super::{Anchor, Drawing, Frame, OUTLINE, Rgb, text_width};

/// Room for an axis at the left of a frame, in sizes of the letters.
const LEFT: f64 = 5.25;

/// Room for half a number at the right of a frame, in sizes of the letters.
const RIGHT: f64 = 1.0;

/// Room for an axis below a frame, in sizes of the letters.
const BELOW: f64 = 3.5;

/// Length of a tick, in sizes of the letters.
const TICK: f64 = 0.375;

/// Width of the lines, in sizes of the letters.
const WIDTH: f64 = 0.075;

/// Colour of the lines across a frame.
const GRID: Rgb = [225; 3];

/// Width of the lines across a frame, in sizes of the letters.
const GRID_WIDTH: f64 = 0.06;

/// Smallest number of intervals between the ticks of an axis.
const FEWEST: f64 = 2.0;

/// Largest number of intervals between the ticks of an axis.
const MOST: f64 = 7.0;

/// Names and style of the axes of a frame.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Axes<'a> {
    /// Names of the quantities along x and y.
    pub(crate) names: [&'a str; 2],
    /// Size of the letters, pixels.
    pub(crate) letters: f64,
    /// Distance of the lines from the frame, pixels.
    pub(crate) gap: f64,
    /// Whether lines cross the frame at the numbers.
    pub(crate) has_grid: bool,
}

/// Room for axes with letters of a size at the left of a frame, at its right and below it, pixels.
pub(crate) fn room(letters: f64) -> [f64; 3] {
    [LEFT, RIGHT, BELOW].map(|it| it * letters)
}

impl Axes<'_> {
    /// Numbers along an axis of a frame.
    fn ticks(&self, frame: Frame, axis: usize) -> Vec<(f64, String)> {
        // The room that a number takes along its axis, in sizes of the letters.
        let takes = [4.0, 2.2][axis] * self.letters;
        let most = (frame.size()[axis] / takes).clamp(FEWEST, MOST).floor();
        ticks([frame.low[axis], frame.high[axis]], most)
    }

    /// Room that the numbers and the name of the second quantity take at the left of a frame, pixels.
    pub(crate) fn room_at_left(&self, frame: Frame) -> f64 {
        let numbers = self.ticks(frame, 1);
        let widths = numbers.iter().map(|it| text_width(&it.1, self.letters));
        let beside = (TICK + 2.2) * self.letters + self.gap;
        (beside + widths.fold(0.0, f64::max)).max(LEFT * self.letters)
    }

    /// Draws the axes around a frame.
    pub(crate) fn draw(&self, drawing: &mut Drawing, frame: Frame) {
        let [left, top] = frame.at;
        let [right, bottom] = [left + frame.size()[0], top + frame.size()[1]];
        let (x, y) = (left - self.gap, bottom + self.gap);
        let (letters, tick) = (self.letters, TICK * self.letters);
        let [along, up] = [0, 1].map(|axis| self.ticks(frame, axis));
        let places = |numbers: &[(f64, String)], axis: usize| -> Vec<f64> {
            let place = |value| frame.to_pixels([value; 2])[axis];
            numbers.iter().map(|it| place(it.0)).collect()
        };
        let (columns, rows) = (places(&along, 0), places(&up, 1));
        if self.has_grid {
            let upwards = columns.iter().map(|&at| [[at, top], [at, bottom]]);
            let across = rows.iter().map(|&at| [[left, at], [right, at]]);
            drawing.lines(upwards.chain(across), GRID, GRID_WIDTH * letters);
        }
        let axes = [[[left, y], [right, y]], [[x, top], [x, bottom]]];
        let below = columns.iter().map(|&at| [[at, y], [at, y + tick]]);
        let beside = rows.iter().map(|&at| [[x - tick, at], [x, at]]);
        let all = axes.into_iter().chain(below).chain(beside);
        drawing.lines(all, OUTLINE, WIDTH * letters);
        let below = y + tick + 0.9 * letters;
        for (at, (_, number)) in columns.iter().zip(&along) {
            drawing.text([*at, below], Anchor::Middle, letters, number);
        }
        let beside = x - tick - 0.2 * letters;
        for (at, (_, number)) in rows.iter().zip(&up) {
            drawing.text([beside, at + 0.35 * letters], Anchor::End, letters, number);
        }
        let middle = [0.5 * (left + right), 0.5 * (top + bottom)];
        let [name_x, name_y] = self.names;
        let below = below + 1.3 * letters;
        drawing.text([middle[0], below], Anchor::Middle, letters, name_x);
        let start = left - self.room_at_left(frame) + letters;
        drawing.upright_text([start, middle[1]], letters, name_y);
    }
}
