//! Curves around a centre: a quantity over the direction.

use std::f64::consts::PI;

use super::sheet::PageLayout;
use super::{LETTERS, PlotError, Series, TITLE};
use crate::drawing::ticks::round_number_above;
use crate::drawing::{Anchor, Drawing, Frame, Paint, Rgb};
use crate::picture::units::text_with_decimals_of;

/// Height, and room above the square for the curves, pixels.
const HEIGHT: f64 = 600.0;
const ABOVE: f64 = 30.0;

/// Radius of the outermost circle over half of the width that is shown.
const FILLED: f64 = 0.83;

/// Colour of circles and spokes, and size of their numbers, pixels.
const GRID: Rgb = [225; 3];
const NUMBERS: f64 = 13.0;

/// A polar plot.
#[derive(Debug, Clone, PartialEq)]
pub struct PolarPlot {
    /// Name of the diagram's file.
    pub name: String,
    /// Title of the polar plot.
    pub title: String,
    /// Quantity along the radius, with its unit.
    pub radius: String,
    /// The curves: angles from the x axis (rad) and radii of 0 or more.
    pub series: Vec<Series>,
}

impl PolarPlot {
    /// The plot for a screen, 600 pixels high.
    ///
    /// # Errors
    ///
    /// If there is no finite point to draw.
    pub fn for_screen(&self) -> Result<Drawing, PlotError> {
        let points = self.series.iter().flat_map(|series| series.points());
        let finite = points.filter(|point| point.iter().all(|it| it.is_finite()));
        let largest = finite.map(|point| point[1]).reduce(f64::max);
        let largest = largest.ok_or_else(|| PlotError::Empty {
            name: self.name.clone(),
        })?;
        let step = circle_step(largest);
        let circles = (largest / step).ceil().max(1.0) as u32;
        let half = step * f64::from(circles) / FILLED;
        let sheet = PageLayout::screen(HEIGHT, &self.series);
        let room = [[0.0, ABOVE], [sheet.plane; 2]];
        let frame = Frame::new([[-half; 2], [half; 2]], room);
        let mut drawing = sheet.drawing();
        let middle = 0.5 * sheet.plane;
        drawing.text([middle, 1.3 * TITLE], Anchor::Middle, TITLE, &self.title);
        draw_circles(&mut drawing, frame, step, circles);
        let below = [middle, HEIGHT - 0.5 * LETTERS];
        drawing.text(below, Anchor::Middle, LETTERS, &self.radius);
        for series in &self.series {
            series.in_plane().draw(&mut drawing, frame, sheet.pen);
        }
        sheet.draw_legend(&mut drawing, &self.series);
        Ok(drawing)
    }
}

/// Circles with their radii along a line between two spokes, and spokes every 30 degrees.
fn draw_circles(drawing: &mut Drawing, frame: Frame, step: f64, circles: u32) {
    let at =
        |angle: f64, radius: f64| frame.to_pixels([radius * angle.cos(), radius * angle.sin()]);
    let outer = step * f64::from(circles);
    let number = |[x, y]: [f64; 2], text: &str, drawing: &mut Drawing| {
        drawing.text([x, y + 0.35 * NUMBERS], Anchor::Middle, NUMBERS, text);
    };
    let angles = || (0..12).map(|spoke| f64::from(spoke) * PI / 6.0);
    let spokes = angles().map(|angle| [at(angle, 0.0), at(angle, outer)]);
    drawing.lines(spokes, GRID, 1.0);
    for angle in angles() {
        let degrees = format!("{:.0}°", angle.to_degrees());
        number(at(angle, 1.06 * outer), &degrees, drawing);
    }
    for radius in (1..=circles).map(|circle| step * f64::from(circle)) {
        let line = Paint::stroke(GRID, 1.0);
        drawing.circle(at(0.0, 0.0), radius * frame.scale[0], line);
        let label = text_with_decimals_of(radius, step);
        number(at(PI / 12.0, radius), &label, drawing);
    }
}

/// Distance of the circles: 1, 2 or 5 times a power of ten, so that there are 3 to 7.
fn circle_step(largest: f64) -> f64 {
    round_number_above(
        largest.max(f64::MIN_POSITIVE.sqrt()) / 6.0,
        &[1.0, 2.0, 5.0],
    )
}

#[cfg(test)]
mod tests {
    use super::super::{Colour, Mark};
    use super::*;

    #[test]
    fn circles_have_round_radii() {
        for (largest, step) in [
            (6.0, 1.0),
            (17.2, 5.0),
            (0.07, 0.02),
            (41.4, 10.0),
            (120.0, 20.0),
        ] {
            assert!(
                (circle_step(largest) / step - 1.0).abs() < 1e-12,
                "{largest}"
            );
        }
    }

    #[test]
    fn a_polar_plot_has_curves_and_labels_or_is_refused() {
        let plot = |points| PolarPlot {
            name: "polar".to_owned(),
            title: "Errors".to_owned(),
            radius: "error, %".to_owned(),
            series: vec![Series::new("m = 2", Mark::Curve, Colour::Blue, points)],
        };
        let points = vec![[0.0, 0.0], [0.4, 17.0], [0.8, f64::INFINITY]];
        let svg = plot(points).for_screen().unwrap().to_svg("");
        for word in ["Errors", "m = 2", "error, %", "30°", "15"] {
            assert!(svg.contains(word), "{word}");
        }
        assert!(!svg.contains("NaN"));
        assert!(
            plot(vec![[0.0, 0.0]]).for_screen().is_ok(),
            "no error at all"
        );
        let nothing = plot(vec![[0.0, f64::NAN]]).for_screen();
        assert!(matches!(nothing, Err(PlotError::Empty { .. })));
    }
}
