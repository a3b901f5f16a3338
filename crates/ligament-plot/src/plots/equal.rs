//! Plots with one scale along x and y, cut off at a window: loci that are open.

use plotters::prelude::{IntoDrawingArea, SVGBackend};

use super::paper::{Paper, Pen};
use super::{DrawingError, Plot, PlotError, Series, svg_text};

/// A plot with one scale along x and y.
#[derive(Debug, Clone, PartialEq)]
pub struct EqualScales {
    /// The curves, which need not lie in the window.
    pub plot: Plot,
    /// Lower left and upper right corner of what is shown, at least.
    pub window: [[f64; 2]; 2],
}

impl EqualScales {
    /// The plot as the text of an SVG file.
    ///
    /// # Errors
    ///
    /// If the window is empty.
    pub fn to_svg(&self) -> Result<String, PlotError> {
        let [lower, upper] = self.window;
        if !(0..2).all(|axis| lower[axis] < upper[axis]) {
            let name = self.plot.name.clone();
            return Err(PlotError::Empty { name });
        }
        // Drawn into nothing once to know how many pixels there are.
        let mut pixels = [0.0; 2];
        svg_text(&self.plot.name, |nothing| {
            pixels = self.pixels(nothing)?;
            Ok(())
        })?;
        let scale = (0..2)
            .map(|axis| (upper[axis] - lower[axis]) / pixels[axis])
            .fold(0.0, f64::max);
        let ranges = [0, 1].map(|axis| {
            let middle = 0.5 * (lower[axis] + upper[axis]);
            let half = 0.5 * scale * pixels[axis];
            [middle - half, middle + half]
        });
        let [x, y] = ranges;
        let pieces = self.plot.series.iter().flat_map(|series| {
            let pieces = inside(&series.points, [[x[0], y[0]], [x[1], y[1]]]).into_iter();
            pieces.map(|points| Series {
                points,
                ..series.clone()
            })
        });
        let pieces: Vec<Series> = pieces.collect();
        svg_text(&self.plot.name, |text| {
            self.plot.draw(text, Paper::SQUARE, ranges, &pieces)
        })
    }

    /// Width and height of the room for the curves.
    fn pixels(&self, out: &mut String) -> Result<[f64; 2], DrawingError> {
        let area = SVGBackend::with_string(out, Paper::SQUARE.dots()).into_drawing_area();
        let (plane, _) = area.split_horizontally(Paper::SQUARE.plane());
        let [lower, upper] = self.window;
        let [x, y] = [0, 1].map(|axis| [lower[axis], upper[axis]]);
        let chart = self.plot.chart(&plane, Pen::SCREEN, x, y)?;
        let (width, height) = chart.plotting_area().dim_in_pixel();
        Ok([f64::from(width), f64::from(height)])
    }
}

/// The pieces of a curve inside a window; a point that is not finite ends a piece.
fn inside(points: &[[f64; 2]], window: [[f64; 2]; 2]) -> Vec<Vec<[f64; 2]>> {
    let mut pieces: Vec<Vec<[f64; 2]>> = Vec::new();
    if let [only] = points {
        return vec![vec![*only]];
    }
    for pair in points.windows(2) {
        let Some([from, to]) = clipped(pair[0], pair[1], window) else {
            continue;
        };
        match pieces.last_mut() {
            Some(piece) if piece.last() == Some(&from) => piece.push(to),
            _ => pieces.push(vec![from, to]),
        }
    }
    pieces
}

/// The part of a segment inside a window (Liang and Barsky).
fn clipped(from: [f64; 2], to: [f64; 2], [lower, upper]: [[f64; 2]; 2]) -> Option<[[f64; 2]; 2]> {
    if !from.iter().chain(&to).all(|it| it.is_finite()) {
        return None;
    }
    let (mut enters, mut leaves) = (0.0, 1.0);
    for axis in 0..2 {
        let along = to[axis] - from[axis];
        for (rate, room) in [
            (-along, from[axis] - lower[axis]),
            (along, upper[axis] - from[axis]),
        ] {
            if rate == 0.0 && room < 0.0 {
                return None;
            }
            if rate < 0.0 {
                enters = f64::max(enters, room / rate);
            } else if rate > 0.0 {
                leaves = f64::min(leaves, room / rate);
            }
        }
    }
    let at = |share: f64| [0, 1].map(|axis| from[axis] + share * (to[axis] - from[axis]));
    let start = if enters == 0.0 { from } else { at(enters) };
    let end = if leaves == 1.0 { to } else { at(leaves) };
    (enters <= leaves).then_some([start, end])
}

#[cfg(test)]
mod tests {
    use super::super::Colour;
    use super::*;

    #[test]
    fn curves_end_at_the_window() {
        let window = [[-1.0, -1.0], [1.0, 1.0]];
        let zigzag = [[-2.0, 0.0], [0.0, 0.0], [0.0, 3.0], [0.5, 3.0], [0.5, -0.5]];
        let expected = vec![
            vec![[-1.0, 0.0], [0.0, 0.0], [0.0, 1.0]],
            vec![[0.5, 1.0], [0.5, -0.5]],
        ];
        assert_eq!(inside(&zigzag, window), expected);
        let broken = [
            [0.0, 0.0],
            [0.5, 0.0],
            [f64::NAN, 0.0],
            [0.5, 0.5],
            [0.6, 0.5],
        ];
        assert_eq!(inside(&broken, window).len(), 2);
        assert_eq!(
            inside(&[[-3.0, 2.0], [3.0, 2.0]], window),
            Vec::<Vec<[f64; 2]>>::new()
        );
    }

    #[test]
    fn a_window_needs_room() {
        let line = Series::curve("line", Colour::Blue, vec![[0.0, 0.0], [9.0, 9.0]]);
        let plot = Plot::new("locus", "Locus", ["s1", "s2"], vec![line]);
        let of = |window| {
            let plot = plot.clone();
            EqualScales { plot, window }.to_svg()
        };
        assert!(of([[-1.0, -1.0], [1.0, 1.0]]).is_ok_and(|svg| svg.contains("<polyline")));
        assert!(matches!(
            of([[1.0, 0.0], [1.0, 2.0]]),
            Err(PlotError::Empty { .. })
        ));
    }
}
