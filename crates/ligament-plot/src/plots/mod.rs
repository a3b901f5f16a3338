//! Curves as SVG, and any SVG as PNG ([`png`]) or PDF ([`pdf`]), several as an animation ([`gif`]).
//!
//! A [`Plot`] has scales of its own along x and y; [`equal`] draws one with the same scale along both, [`polar`] draws
//! curves around a centre.

mod axis;
pub mod equal;
pub mod gif;
mod outlines;
mod paper;
pub mod pdf;
pub mod png;
pub mod polar;
pub(crate) mod text;

pub(crate) use axis::rounded_up;
use axis::{decimals, range, tick};
use paper::{Paper, Pen};

use plotters::chart::{ChartBuilder, ChartContext};
use plotters::coord::Shift;
use plotters::coord::types::RangedCoordf64;
use plotters::drawing::DrawingAreaErrorKind;
use plotters::prelude::{
    Cartesian2d, Circle, Color, Cross, DashedLineSeries, DrawingArea, IntoDrawingArea,
    IntoTextStyle, LineSeries, PathElement, RGBColor, SVGBackend, ShapeStyle, Text, TriangleMarker,
    WHITE,
};

/// Height of a line of the legend.
const LINE: i32 = 22;

/// Length of dashes and of the gaps between them.
const DASH: (i32, i32) = (7, 5);

const GRID: RGBColor = RGBColor(225, 225, 225);
const AXES: RGBColor = RGBColor(90, 90, 90);
const TEXT: RGBColor = RGBColor(30, 30, 30);

/// A plot: several curves over one quantity.
#[derive(Debug, Clone, PartialEq)]
pub struct Plot {
    /// Name of the plot's file.
    pub name: String,
    /// Title.
    pub title: String,
    /// The quantity along x, with its unit.
    pub x: String,
    /// The quantity along y, with its unit.
    pub y: String,
    /// The curves.
    pub series: Vec<Series>,
}

/// A curve.
#[derive(Debug, Clone, PartialEq)]
pub struct Series {
    label: String,
    mark: Mark,
    colour: Colour,
    points: Vec<[f64; 2]>,
}

/// How a curve is drawn.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Mark {
    /// A line with dots: what the program computes.
    Line,
    /// A line alone: the same at many points.
    Curve,
    /// Open circles: what is printed.
    Circles,
    /// Crosses: what is no answer.
    Crosses,
    /// Triangles: where something begins.
    Triangles,
    /// A dashed line: another theory.
    Dashes,
}

/// Colours that any colour vision can distinguish (Okabe and Ito).
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Colour {
    /// Black.
    Black,
    /// Blue.
    Blue,
    /// Vermilion.
    Vermilion,
    /// Bluish green.
    Green,
    /// Orange.
    Orange,
    /// Reddish purple.
    Purple,
    /// Sky blue.
    Sky,
}

/// A plot that cannot be drawn.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum PlotError {
    /// No curve has a point.
    #[error("plot {name} has no points")]
    Empty {
        /// Name of the plot.
        name: String,
    },
    /// The drawing library refused.
    #[error("plot {name} cannot be drawn: {reason}")]
    Drawing {
        /// Name of the plot.
        name: String,
        /// Why.
        reason: String,
    },
}

impl Series {
    /// A curve through the points, shape (n, 2), in their order. The legend leaves out curves without a label or
    /// points.
    pub fn new(
        label: impl Into<String>,
        mark: Mark,
        colour: Colour,
        points: Vec<[f64; 2]>,
    ) -> Self {
        Self {
            label: label.into(),
            mark,
            colour,
            points,
        }
    }

    /// A line with dots.
    pub fn line(label: impl Into<String>, colour: Colour, points: Vec<[f64; 2]>) -> Self {
        Self::new(label, Mark::Line, colour, points)
    }

    /// A line without dots.
    pub fn curve(label: impl Into<String>, colour: Colour, points: Vec<[f64; 2]>) -> Self {
        Self::new(label, Mark::Curve, colour, points)
    }

    /// Open circles.
    pub fn circles(label: impl Into<String>, colour: Colour, points: Vec<[f64; 2]>) -> Self {
        Self::new(label, Mark::Circles, colour, points)
    }

    /// A dashed line.
    pub fn dashes(label: impl Into<String>, colour: Colour, points: Vec<[f64; 2]>) -> Self {
        Self::new(label, Mark::Dashes, colour, points)
    }

    /// Points of the series, shape (n, 2).
    pub fn points(&self) -> &[[f64; 2]] {
        &self.points
    }
}

impl Plot {
    /// A plot of curves, with the name of its file, its title and the quantities along x and y.
    pub fn new(
        name: impl Into<String>,
        title: impl Into<String>,
        [x, y]: [&str; 2],
        series: Vec<Series>,
    ) -> Self {
        Self {
            name: name.into(),
            title: title.into(),
            x: x.to_owned(),
            y: y.to_owned(),
            series,
        }
    }

    /// The plot as the text of an SVG file for a screen.
    ///
    /// # Errors
    ///
    /// If there is no finite point to draw.
    pub fn to_svg(&self) -> Result<String, PlotError> {
        self.on(Paper::SCREEN)
    }

    /// The plot as the text of an SVG file for a sheet of paper of a width in mm.
    ///
    /// # Errors
    ///
    /// If there is no finite point to draw.
    pub fn for_paper(&self, width: f64) -> Result<String, PlotError> {
        let labels = self.series.iter().filter(|it| it.is_named());
        let letters = labels.map(|it| it.label.chars().count()).max();
        self.on(Paper::new(width, letters))
    }

    fn on(&self, paper: Paper) -> Result<String, PlotError> {
        let points = || self.series.iter().flat_map(|series| &series.points);
        let range = |axis: usize| range(points().map(|point| point[axis]));
        let Some((x, y)) = range(0).zip(range(1)) else {
            let name = self.name.clone();
            return Err(PlotError::Empty { name });
        };
        let draw = |text: &mut String| self.draw(text, paper, [x, y], &self.series);
        Ok(paper.sized(svg_text(&self.name, draw)?))
    }

    /// Draws pieces of the curves, and the legend of the curves as wholes.
    fn draw(
        &self,
        out: &mut String,
        paper: Paper,
        [x, y]: [[f64; 2]; 2],
        pieces: &[Series],
    ) -> Drawn {
        let area = SVGBackend::with_string(out, paper.dots()).into_drawing_area();
        area.fill(&WHITE)?;
        let (plane, legend) = area.split_horizontally(paper.plane());
        let mut chart = self.chart(&plane, paper.pen, x, y)?;
        self.draw_axes(&mut chart, paper.pen, x, y)?;
        for piece in pieces {
            piece.draw(&mut chart, paper.pen)?;
        }
        draw_legends(&self.series, &legend, paper.pen)?;
        area.present()
    }

    /// The room for the curves, in ranges of x and y.
    fn chart<'a, 'b>(
        &self,
        plane: &'a DrawingArea<Backend<'b>, Shift>,
        pen: Pen,
        x: [f64; 2],
        y: [f64; 2],
    ) -> Result<Chart<'a, 'b>, DrawingError> {
        let mut builder = ChartBuilder::on(plane);
        builder
            .margin(pen.dots(14))
            .x_label_area_size(pen.dots(46))
            .y_label_area_size(pen.dots(68));
        if !self.title.is_empty() {
            builder.caption(&self.title, ("sans-serif", pen.dots(19), &TEXT));
        }
        builder.build_cartesian_2d(x[0]..x[1], y[0]..y[1])
    }

    fn draw_axes(&self, chart: &mut Chart<'_, '_>, pen: Pen, x: [f64; 2], y: [f64; 2]) -> Drawn {
        let (x_decimals, y_decimals) = (decimals(x), decimals(y));
        chart
            .configure_mesh()
            .x_desc(&self.x)
            .y_desc(&self.y)
            .x_labels(8)
            .y_labels(7)
            .x_label_formatter(&|value| tick(*value, x_decimals))
            .y_label_formatter(&|value| tick(*value, y_decimals))
            .axis_desc_style(("sans-serif", pen.dots(17), &TEXT))
            .label_style(("sans-serif", pen.dots(15), &TEXT))
            .light_line_style(WHITE.stroke_width(pen.dots(1) as u32))
            .bold_line_style(GRID.stroke_width(pen.dots(1) as u32))
            .axis_style(AXES.stroke_width(pen.dots(1) as u32))
            .set_all_tick_mark_size(pen.dots(5))
            .draw()
    }
}

/// The text of the SVG file of a plot, from what draws it.
fn svg_text(name: &str, draw: impl FnOnce(&mut String) -> Drawn) -> Result<String, PlotError> {
    let mut text = String::new();
    draw(&mut text).map_err(|error| PlotError::Drawing {
        name: name.to_owned(),
        reason: error.to_string(),
    })?;
    Ok(text)
}

/// The legends of the curves that have a name and points, below each other.
fn draw_legends(series: &[Series], area: &DrawingArea<Backend<'_>, Shift>, pen: Pen) -> Drawn {
    let named = series.iter().filter(|series| series.is_named());
    for (place, series) in named.enumerate() {
        series.draw_legend(area, 52 + LINE * place as i32, pen)?;
    }
    Ok(())
}

type Backend<'a> = SVGBackend<'a>;
type Chart<'a, 'b> = ChartContext<'a, Backend<'b>, Cartesian2d<RangedCoordf64, RangedCoordf64>>;
type DrawingError = DrawingAreaErrorKind<std::io::Error>;
type Drawn = Result<(), DrawingError>;

impl Series {
    fn draw(&self, chart: &mut Chart<'_, '_>, pen: Pen) -> Drawn {
        let points = || {
            let points = self.points.iter().map(|&[x, y]| (x, y));
            points.filter(|(x, y)| x.is_finite() && y.is_finite())
        };
        let (stroke, dot) = (self.stroke(pen), self.dot());
        match self.mark {
            Mark::Line => {
                chart.draw_series(LineSeries::new(points(), stroke))?;
                chart.draw_series(points().map(|point| Circle::new(point, pen.dots(3), dot)))?;
            }
            Mark::Curve => {
                chart.draw_series(LineSeries::new(points(), stroke))?;
            }
            Mark::Circles => {
                chart.draw_series(points().map(|point| Circle::new(point, pen.dots(6), stroke)))?;
            }
            Mark::Crosses => {
                chart.draw_series(points().map(|point| Cross::new(point, pen.dots(5), stroke)))?;
            }
            Mark::Triangles => {
                let triangle = |point| TriangleMarker::new(point, pen.dots(7), dot);
                chart.draw_series(points().map(triangle))?;
            }
            Mark::Dashes => {
                let (dash, gap) = (pen.dots(DASH.0), pen.dots(DASH.1));
                chart.draw_series(DashedLineSeries::new(points(), dash, gap, stroke))?;
            }
        }
        Ok(())
    }

    /// Draws the entry of the series in the legend at a height, in pixels of a screen.
    fn draw_legend(&self, area: &DrawingArea<Backend<'_>, Shift>, y: i32, pen: Pen) -> Drawn {
        let at = |x: i32, y: i32| (pen.dots(x), pen.dots(y));
        let line =
            |from: i32, to: i32| PathElement::new([at(from, y), at(to, y)], self.stroke(pen));
        match self.mark {
            Mark::Line => {
                area.draw(&line(4, 32))?;
                area.draw(&Circle::new(at(18, y), pen.dots(3), self.dot()))?;
            }
            Mark::Curve => area.draw(&line(4, 32))?,
            Mark::Circles => {
                area.draw(&Circle::new(at(18, y), pen.dots(6), self.stroke(pen)))?;
            }
            Mark::Crosses => {
                area.draw(&Cross::new(at(18, y), pen.dots(5), self.stroke(pen)))?;
            }
            Mark::Triangles => {
                area.draw(&TriangleMarker::new(at(18, y), pen.dots(7), self.dot()))?;
            }
            Mark::Dashes => {
                for start in [4, 16, 28] {
                    area.draw(&line(start, start + DASH.0))?;
                }
            }
        }
        let style = ("sans-serif", pen.dots(15), &TEXT).into_text_style(area);
        area.draw(&Text::new(self.label.as_str(), at(42, y - 6), style))
    }

    fn is_named(&self) -> bool {
        !self.label.is_empty() && !self.points.is_empty()
    }

    fn stroke(&self, pen: Pen) -> ShapeStyle {
        self.colour.rgb().stroke_width(pen.dots(2) as u32)
    }

    fn dot(&self) -> ShapeStyle {
        self.colour.rgb().filled()
    }
}

impl Colour {
    /// Colours of curves beside each other, in their order.
    pub const CYCLE: [Self; 6] = [
        Self::Blue,
        Self::Vermilion,
        Self::Green,
        Self::Purple,
        Self::Orange,
        Self::Sky,
    ];

    fn rgb(self) -> RGBColor {
        match self {
            Self::Black => RGBColor(60, 60, 60),
            Self::Blue => RGBColor(0, 114, 178),
            Self::Vermilion => RGBColor(213, 94, 0),
            Self::Green => RGBColor(0, 158, 115),
            Self::Orange => RGBColor(230, 159, 0),
            Self::Purple => RGBColor(204, 121, 167),
            Self::Sky => RGBColor(86, 180, 233),
        }
    }

    /// The colour as `#rrggbb`.
    pub(crate) fn hex(self) -> String {
        let RGBColor(r, g, b) = self.rgb();
        format!("#{r:02x}{g:02x}{b:02x}")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn plot(series: Vec<Series>) -> Plot {
        Plot::new("peak", "Peak & strength", ["lambda", "F, N"], series)
    }

    #[test]
    fn a_plot_has_its_curves_labels_and_units_as_text() {
        let points = vec![[2.0, 0.6], [f64::NAN, 1.0], [4.0, 1.4]];
        let svg = plot(vec![
            Series::new("printed", Mark::Circles, Colour::Black, points.clone()),
            Series::new("computed", Mark::Line, Colour::Blue, points),
            Series::new("left out", Mark::Line, Colour::Orange, Vec::new()),
        ])
        .to_svg()
        .unwrap();
        for word in [
            "lambda",
            "F, N",
            "printed",
            "computed",
            "Peak &amp; strength",
        ] {
            assert!(svg.contains(word), "{word}");
        }
        assert!(!svg.contains("left out"), "a curve without points");
        // Two open circles and one in the legend, two dots and one in the legend: no point that is not finite.
        assert_eq!(svg.matches("<circle").count(), 6);
        assert!(svg.starts_with("<svg") && svg.ends_with("</svg>\n"));
    }

    #[test]
    fn a_level_curve_and_a_single_point_have_room() {
        for points in [vec![[0.0, 5.0], [1.0, 5.0]], vec![[0.0, 0.0]]] {
            let svg = plot(vec![Series::new("level", Mark::Line, Colour::Blue, points)]).to_svg();
            assert!(svg.is_ok_and(|svg| !svg.contains("NaN")));
        }
    }

    #[test]
    fn a_plot_without_points_is_refused() {
        let points = vec![[f64::NAN, 1.0]];
        let empty = plot(vec![Series::line("none", Colour::Blue, points)]);
        let name = "peak".to_owned();
        assert_eq!(empty.to_svg(), Err(PlotError::Empty { name }));
    }

    #[test]
    fn paper_has_its_width_and_room_for_the_legend() {
        let points = vec![[0.0, 0.0], [1.0, 1.0]];
        let series = Series::curve("a long name", Colour::Blue, points);
        let with = Paper::new(120.0, Some(11));
        let without = Paper::new(120.0, None);
        assert!(with.plane() < without.plane() && with.dots().0 == without.dots().0);
        let plot = Plot::new("p", "", ["x", "y"], vec![series]);
        let svg = plot.for_paper(120.0).unwrap();
        assert!(
            svg.starts_with("<svg width=\"120.000mm\" height=\""),
            "{}",
            &svg[..60]
        );
        assert_eq!(svg.matches("<svg").count(), 1);
        assert!(
            plot.to_svg()
                .unwrap()
                .starts_with("<svg width=\"760\" height=\"420\"")
        );
    }
}
