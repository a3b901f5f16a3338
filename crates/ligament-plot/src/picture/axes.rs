//! Axes beside a body, in mm.

use super::panel::Frame;
use super::svg::{Anchor, Document, text_width};
use super::units::with_decimals_of;

/// Room at the left of a body, at its right for half a number, and below it, pixels.
const LEFT: f64 = 42.0;
const RIGHT: f64 = 8.0;
const BELOW: f64 = 28.0;

/// Between the body and its axes, pixels.
const GAP: f64 = 3.0;

/// Length of a tick, and size of the numbers, pixels.
const TICK: f64 = 3.0;
const SIZE: f64 = 8.0;

/// Most intervals between the ticks of an axis.
const MOST: f64 = 6.0;

const COLOUR: &str = "#404040";

/// Room for axes at the left of a body, at its right and below it, pixels; none without axes.
pub(super) fn room(has_axes: bool) -> [f64; 3] {
    if has_axes {
        [LEFT, RIGHT, BELOW]
    } else {
        [0.0; 3]
    }
}

/// Draws axes around a frame.
pub(super) fn draw(document: &mut Document, frame: Frame) {
    let size = [0, 1].map(|axis| (frame.high[axis] - frame.low[axis]) * frame.scale);
    let [left, top] = frame.at;
    let (right, bottom) = (left + size[0], top + size[1]);
    let (x, y) = (left - GAP, bottom + GAP);
    let mut line = |from, to| document.line(from, to, COLOUR, 0.6);
    line([left, y], [right, y]);
    line([x, top], [x, bottom]);
    let places = [
        ticks(frame.low[0], frame.high[0]),
        ticks(frame.low[1], frame.high[1]),
    ];
    for (at, _) in &places[0] {
        let at = left + (at - frame.low[0]) * frame.scale;
        line([at, y], [at, y + TICK]);
    }
    for (at, _) in &places[1] {
        let at = bottom - (at - frame.low[1]) * frame.scale;
        line([x - TICK, at], [x, at]);
    }
    let below = y + TICK + 0.9 * SIZE;
    for (at, number) in &places[0] {
        let at = left + (at - frame.low[0]) * frame.scale;
        document.text([at, below], Anchor::Middle, SIZE, number);
    }
    for (at, number) in &places[1] {
        let at = bottom - (at - frame.low[1]) * frame.scale;
        let start = x - TICK - 1.5 - text_width(number, SIZE);
        document.text([start, at + 0.35 * SIZE], Anchor::Start, SIZE, number);
    }
    let middle = [0.5 * (left + right), 0.5 * (top + bottom)];
    document.text(
        [middle[0], below + 1.15 * SIZE],
        Anchor::Middle,
        SIZE,
        "x (mm)",
    );
    let start = left - LEFT + SIZE;
    document.upright_text([start, middle[1]], SIZE, "y (mm)");
}

/// Round places (m) on an axis from `low` to `high`, each with its number of mm.
fn ticks(low: f64, high: f64) -> Vec<(f64, String)> {
    let [low, high] = [1e3 * low, 1e3 * high];
    let least = (high - low) / MOST;
    if !(least > 0.0 && least.is_finite()) {
        return Vec::new();
    }
    let power = 10f64.powf(least.log10().floor());
    let step = [1.0, 2.0, 5.0, 10.0].map(|it| it * power);
    let fits = |it: &f64| *it >= least * (1.0 - 1e-9);
    let step = step.into_iter().find(fits).unwrap_or(10.0 * power);
    let within = 1e-6 * step;
    let first = ((low - within) / step).ceil() as i64;
    let last = ((high + within) / step).floor() as i64;
    let tick = |place: i64| {
        let mm = place as f64 * step;
        (1e-3 * mm, with_decimals_of(mm, step))
    };
    (first..=last).map(tick).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ticks_are_round_and_within_the_body() {
        let words = |low, high| {
            ticks(low, high)
                .into_iter()
                .map(|it| it.1)
                .collect::<Vec<_>>()
        };
        assert_eq!(words(0.0, 0.5), ["0", "100", "200", "300", "400", "500"]);
        assert_eq!(words(-0.05, 0.05), ["-40", "-20", "0", "20", "40"]);
        assert_eq!(words(0.0, 2e-3), ["0.0", "0.5", "1.0", "1.5", "2.0"]);
        assert!(ticks(1.0, 1.0).is_empty());
    }
}
