//! Plots of numbers.
//!
//! A [`Plot`] has separate scales along x and y; [`Panels`] are several with the same scales; [`equal_scales`] draws one with the same scale
//! along both, [`polar`] draws curves around a centre.

pub mod equal_scales;
mod panels;
pub mod polar;
mod series;
mod sheet;

use crate::drawing::axes::{self, Axes};
use crate::drawing::ticks::range;
use crate::drawing::{Anchor, Drawing, Frame};

pub use panels::Panels;
use series::LETTERS;
pub use series::{Colour, Mark, Series};
use sheet::{PageLayout, Room};

/// Size of the title, and room around the plot, pixels of a screen.
const TITLE: f64 = 19.0;
const MARGIN: f64 = 14.0;

/// A plot: several curves over one quantity.
#[derive(Debug, Clone, PartialEq)]
pub struct Plot {
    /// Name of the plot's file.
    pub name: String,
    /// Title of the plot.
    pub title: String,
    /// The quantity along x, with its unit.
    pub x: String,
    /// The quantity along y, with its unit.
    pub y: String,
    /// Curves of the plot.
    pub series: Vec<Series>,
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

    /// The plot for a screen, 420 pixels high.
    ///
    /// # Errors
    ///
    /// If there is no finite point to draw.
    pub fn for_screen(&self) -> Result<Drawing, PlotError> {
        self.on_page(PageLayout::screen(420.0, &self.series))
    }

    /// The plot for a sheet of paper of a width in mm.
    ///
    /// # Errors
    ///
    /// If there is no finite point to draw.
    pub fn for_paper(&self, width: f64) -> Result<Drawing, PlotError> {
        self.on_page(PageLayout::paper(width, &self.series))
    }

    fn on_page(&self, sheet: PageLayout) -> Result<Drawing, PlotError> {
        let corners = corners(&self.series).ok_or_else(|| self.empty_error())?;
        let frame = self.frame(sheet, sheet.whole(), corners);
        Ok(self.draw(sheet, frame))
    }

    fn empty_error(&self) -> PlotError {
        let name = self.name.clone();
        PlotError::Empty { name }
    }

    /// The part of a room of the sheet for the curves between two corners, in their quantities.
    fn frame(&self, sheet: PageLayout, room: Room, corners: [[f64; 2]; 2]) -> Frame {
        let [_, _, below] = axes::room(LETTERS);
        let title = if self.title.is_empty() { 0.0 } else { TITLE };
        let above = sheet.pen * (MARGIN + title);
        let height = room.size[1] - sheet.pen * (MARGIN + below) - above;
        // The room for numbers along y follows from their range and the height.
        let all = Frame::new(corners, [[0.0; 2], [1.0, height]]);
        let left = sheet.pen * MARGIN + self.axes(sheet).room_at_left(all);
        let right = room.size[0] - sheet.pen * (MARGIN + 0.5 * LETTERS);
        let at = [room.at[0] + left, room.at[1] + above];
        Frame::new(corners, [at, [right - left, height]])
    }

    fn axes(&self, sheet: PageLayout) -> Axes<'_> {
        Axes {
            names: [&self.x, &self.y],
            letters: sheet.pen * LETTERS,
            gap: 0.0,
            has_grid: true,
        }
    }

    fn draw(&self, sheet: PageLayout, frame: Frame) -> Drawing {
        let mut drawing = sheet.drawing();
        self.draw_into(&mut drawing, sheet, frame);
        sheet.draw_legend(&mut drawing, &self.series);
        drawing
    }

    /// Draws title, axes and curves.
    fn draw_into(&self, drawing: &mut Drawing, sheet: PageLayout, frame: Frame) {
        let size = sheet.pen * TITLE;
        let middle = frame.at[0] + 0.5 * frame.size()[0];
        let at = [middle, frame.at[1] - 0.5 * size];
        drawing.text(at, Anchor::Middle, size, &self.title);
        self.axes(sheet).draw(drawing, frame);
        for series in &self.series {
            series.draw(drawing, frame, sheet.pen);
        }
    }
}

/// Lower left and upper right corner of the room for curves; None without finite points.
fn corners<'a>(series: impl IntoIterator<Item = &'a Series> + Clone) -> Option<[[f64; 2]; 2]> {
    let points = || {
        series
            .clone()
            .into_iter()
            .flat_map(|series| series.points())
    };
    let range = |axis: usize| range(points().map(|point| point[axis]));
    let ([left, right], [low, high]) = range(0).zip(range(1))?;
    Some([[left, low], [right, high]])
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::drawing::text_width;

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
        .for_screen()
        .unwrap()
        .to_svg("");
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
            let level = Series::new("level", Mark::Line, Colour::Blue, points);
            let svg = plot(vec![level]).for_screen().unwrap().to_svg("");
            assert!(svg.contains("<circle") && !svg.contains("NaN"));
        }
    }

    #[test]
    fn a_plot_without_points_is_refused() {
        let points = vec![[f64::NAN, 1.0]];
        let empty = plot(vec![Series::line("none", Colour::Blue, points)]);
        let name = "peak".to_owned();
        assert_eq!(empty.for_screen(), Err(PlotError::Empty { name }));
    }

    #[test]
    fn paper_has_its_width_and_room_for_the_legend() {
        let points = vec![[0.0, 0.0], [1.0, 1.0]];
        let series = Series::curve("a long name", Colour::Blue, points);
        let named = [series.clone()];
        let (with, without) = (
            PageLayout::paper(120.0, &named),
            PageLayout::paper(120.0, &[]),
        );
        assert!(with.plane < without.plane);
        let plot = Plot::new("p", "", ["x", "y"], vec![series]);
        let svg = plot.for_paper(120.0).unwrap().to_svg("");
        assert!(
            svg.starts_with("<svg width=\"120.000mm\" height=\""),
            "{}",
            &svg[..60]
        );
        assert_eq!(svg.matches("<svg").count(), 1);
        // 760 by 420 pixels.
        let svg = plot.for_screen().unwrap().to_svg("");
        let size = "<svg width=\"201.083mm\" height=\"111.125mm\" viewBox=\"0 0 760.00 420.00\"";
        assert!(svg.starts_with(size), "{}", &svg[..80]);
    }

    #[test]
    fn a_long_label_widens_the_legend_of_a_screen() {
        let points = vec![[0.0, 0.0], [1.0, 1.0]];
        let label = "a label of many words that says much of its curve";
        let series = Series::curve(label, Colour::Blue, points);
        let drawn = Plot::new("p", "", ["x", "y"], vec![series]).for_screen();
        let svg = drawn.unwrap().to_svg("");
        let width = svg.split("viewBox=\"0 0 ").nth(1).unwrap();
        let width: f64 = width.split(' ').next().unwrap().parse().unwrap();
        assert!(width > 570.0 + 44.0 + text_width(label, LETTERS), "{width}");
    }
}
