//! Curves around a centre: a quantity over the direction.

use std::f64::consts::{PI, TAU};

use plotters::chart::ChartBuilder;
use plotters::prelude::{
    IntoDrawingArea, IntoTextStyle, PathElement, SVGBackend, ShapeStyle, Text, WHITE,
};
use plotters::style::Color;
use plotters::style::text_anchor::{HPos, Pos, VPos};

use super::axis::{decimals, rounded_up, tick};
use super::paper::{LEGEND, Pen};
use super::{Chart, Drawn, GRID, PlotError, Series, TEXT, draw_legends, svg_text};

/// Width and height, in pixels: the room beside the legend is square.
const SIZE: (u32, u32) = (570 + LEGEND as u32, 600);

/// Radius of the outermost circle over what the plane shows.
const FILLED: f64 = 0.85;

/// A polar plot.
#[derive(Debug, Clone, PartialEq)]
pub struct PolarPlot {
    /// Name of the diagram's file.
    pub name: String,
    /// Title.
    pub title: String,
    /// Quantity along the radius, with its unit.
    pub radius: String,
    /// The curves: angles from the x axis (rad) and radii of 0 or more.
    pub series: Vec<Series>,
}

impl PolarPlot {
    /// The plot as the text of an SVG file.
    ///
    /// # Errors
    ///
    /// If there is no finite point to draw.
    pub fn to_svg(&self) -> Result<String, PlotError> {
        let points = self.series.iter().flat_map(|series| &series.points);
        let finite = points.filter(|point| point.iter().all(|it| it.is_finite()));
        let largest = finite.map(|point| point[1]).reduce(f64::max);
        let largest = largest.ok_or_else(|| PlotError::Empty {
            name: self.name.clone(),
        })?;
        svg_text(&self.name, |text| self.draw(text, largest))
    }

    fn draw(&self, out: &mut String, largest: f64) -> Drawn {
        let area = SVGBackend::with_string(out, SIZE).into_drawing_area();
        area.fill(&WHITE)?;
        let (plane, legend) = area.split_horizontally(SIZE.0 as i32 - LEGEND);
        let step = circle_step(largest);
        let circles = (largest / step).ceil().max(1.0) as u32;
        let half = step * f64::from(circles) / FILLED;
        let mut chart = ChartBuilder::on(&plane)
            .margin(4)
            .caption(&self.title, ("sans-serif", 19, &TEXT))
            .build_cartesian_2d(-half..half, -half..half)?;
        draw_circles(&mut chart, step, circles)?;
        let style = ("sans-serif", 15, &TEXT).into_text_style(&plane);
        let bottom = Pos::new(HPos::Center, VPos::Bottom);
        let label = Text::new(self.radius.clone(), (0.0, -half), style.pos(bottom));
        chart.draw_series([label])?;
        for series in &self.series {
            let planar = |&[angle, radius]: &[f64; 2]| [radius * angle.cos(), radius * angle.sin()];
            let planar = Series {
                points: series.points.iter().map(planar).collect(),
                ..series.clone()
            };
            planar.draw(&mut chart, Pen::SCREEN)?;
        }
        draw_legends(&self.series, &legend, Pen::SCREEN)?;
        area.present()
    }
}

/// Circles with their radii along a line between two spokes, and spokes every 30 degrees.
fn draw_circles(chart: &mut Chart<'_, '_>, step: f64, circles: u32) -> Drawn {
    let at = |angle: f64, radius: f64| (radius * angle.cos(), radius * angle.sin());
    let thin: ShapeStyle = GRID.stroke_width(1);
    let outer = step * f64::from(circles);
    let small = || ("sans-serif", 13, &TEXT).into_text_style(chart.plotting_area());
    let centred = small().pos(Pos::new(HPos::Center, VPos::Center));
    let spokes = (0..12).map(|k| f64::from(k) * PI / 6.0);
    let lines = spokes
        .clone()
        .map(|it| PathElement::new([at(it, 0.0), at(it, outer)], thin));
    chart.draw_series(lines)?;
    chart.draw_series(spokes.map(|it| {
        let degrees = format!("{:.0}°", it.to_degrees());
        Text::new(degrees, at(it, 1.06 * outer), centred.clone())
    }))?;
    let decimals = decimals([0.0, outer]);
    for circle in 1..=circles {
        let radius = step * f64::from(circle);
        let round = (0..=180).map(|k| at(TAU * f64::from(k) / 180.0, radius));
        chart.draw_series([PathElement::new(round.collect::<Vec<_>>(), thin)])?;
        let label = Text::new(
            tick(radius, decimals),
            at(PI / 12.0, radius),
            centred.clone(),
        );
        chart.draw_series([label])?;
    }
    Ok(())
}

/// Distance of the circles: 1, 2 or 5 times a power of ten, so that there are 3 to 7.
fn circle_step(largest: f64) -> f64 {
    rounded_up(
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
        let svg = plot(points).to_svg().unwrap();
        for word in ["Errors", "m = 2", "error, %", "30°", "15"] {
            assert!(svg.contains(word), "{word}");
        }
        assert!(!svg.contains("NaN"));
        assert!(plot(vec![[0.0, 0.0]]).to_svg().is_ok(), "no error at all");
        let nothing = plot(vec![[0.0, f64::NAN]]).to_svg();
        assert!(matches!(nothing, Err(PlotError::Empty { .. })));
    }
}
