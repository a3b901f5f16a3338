//! The curves of a study's plots: points from its table, and fitted lines.

use super::grouping::{CurveRuns, Grouping, PanelRuns};
use super::plan::safe_file_name;
use super::study::{Study, StudyPlot};
use super::table::{Row, StudyTable, UnknownColumn};
use crate::line_fit::{FitError, LineFit};
use ligament_case::case::key_path::KeyPath;
use ligament_case::case::keys::unit_of;
use ligament_plot::plots::{Colour, Panels, Plot, Series};

/// Colours of curves, used again with dashes; black is for known lines.
const COLOURS: [Colour; 6] = [
    Colour::Blue,
    Colour::Vermilion,
    Colour::Green,
    Colour::Orange,
    Colour::Purple,
    Colour::Sky,
];

/// The curves of a plot of a study.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Curves<'a> {
    /// Section of the study for the plot.
    pub(super) plot: &'a StudyPlot,
    /// The column along x.
    pub(super) x: &'a str,
    /// The column along y.
    pub(super) y: &'a str,
    /// Name of the plot's file, without the extension.
    pub(super) name: String,
    /// The panels in the order of their axes.
    pub(super) panels: Vec<Panel>,
    /// Axes that the plot does not name, with one curve for each value: their indices and numbers of values.
    pub(super) unnamed: Vec<(usize, usize)>,
}

/// Curves of the runs with the same values of all axes of `by` but the last.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Panel {
    /// Label of the values; empty where one panel has all runs.
    pub(super) label: String,
    /// The curves in the order of their axes.
    pub(super) curves: Vec<Curve>,
}

/// Curve of the runs with one value of the last axis of `by`.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Curve {
    /// Label of the value; empty where one curve has all runs.
    pub(super) label: String,
    /// Points in the order of x, shape (n, 2); runs without numbers are left out.
    pub(super) points: Vec<[f64; 2]>,
    /// Line fitted to the points in the range of the plot's fit, if it has one.
    pub(super) fit: Option<Result<LineFit, FitError>>,
}

impl<'a> Curves<'a> {
    /// The curves of columns of a table over its runs.
    pub(super) fn over_rows(
        study: &Study,
        plot: &'a StudyPlot,
        [x, y]: [&'a str; 2],
        rows: &[Row<'_>],
        table: &StudyTable,
    ) -> Result<Self, UnknownColumn> {
        let (of_x, of_y) = (table.numbers(x)?, table.numbers(y)?);
        let point = |run: usize| Some([of_x[run]?, of_y[run]?]);
        let place = |run: usize| Some(point(run)?[0]);
        let grouping = Grouping::new(study, plot, rows, &place);
        let curve = |CurveRuns { label, runs }: CurveRuns| {
            let points = runs.into_iter().filter_map(point);
            let mut points: Vec<[f64; 2]> = points.collect();
            points.sort_by(|a, b| a[0].total_cmp(&b[0]));
            let fit = plot.fit.map(|range| {
                let inside = points.iter().copied().filter(|[x, _]| range.contains(*x));
                LineFit::through(&inside.collect::<Vec<_>>())
            });
            Curve { label, points, fit }
        };
        let panel = |PanelRuns { label, curves }: PanelRuns| Panel {
            label,
            curves: curves.into_iter().map(curve).collect(),
        };
        Ok(Self {
            plot,
            x,
            y,
            name: format!("{}-over-{}", safe_file_name(y), safe_file_name(x)),
            panels: grouping.panels.into_iter().map(panel).collect(),
            unnamed: grouping.unnamed,
        })
    }

    /// Values of x at which any curve has a point, ascending.
    pub(super) fn places(&self) -> Vec<f64> {
        let mut places: Vec<f64> = self.points().map(|[x, _]| *x).collect();
        places.sort_by(f64::total_cmp);
        places.dedup();
        places
    }

    /// The curves of all panels.
    pub(super) fn curves(&self) -> impl Iterator<Item = &Curve> {
        self.panels.iter().flat_map(|panel| &panel.curves)
    }

    fn points(&self) -> impl Iterator<Item = &[f64; 2]> {
        self.curves().flat_map(|curve| &curve.points)
    }

    /// Text on the mean of runs at the same place of a curve.
    pub(super) fn mean_words(&self) -> String {
        match self.plot.mean.as_slice() {
            [] => "mean at equal x".to_owned(),
            keys => format!("mean over {}", keys.join(", ")),
        }
    }

    /// The plot with the runs, the known line dashed, and fitted lines in the colours of their curves.
    pub(super) fn panels(&self, title: &str) -> Panels {
        let plot = self.plot;
        let label =
            |given: &Option<String>, name: &str| given.clone().unwrap_or_else(|| with_unit(name));
        let axes = [label(&plot.x_label, self.x), label(&plot.y_label, self.y)];
        let panel = |panel: &Panel| {
            let [x, y] = [&axes[0], &axes[1]];
            Plot::new(&*self.name, &*panel.label, [x, y], self.series(panel))
        };
        Panels {
            name: self.name.clone(),
            title: plot.title.clone().unwrap_or_else(|| title.to_owned()),
            plots: self.panels.iter().map(panel).collect(),
        }
    }

    fn series(&self, panel: &Panel) -> Vec<Series> {
        let plot = self.plot;
        let places = self.places();
        let ends = places.first().zip(places.last());
        let mut series = Vec::new();
        if let (Some(line), Some((&from, &to))) = (&plot.line, ends) {
            let points = fitted_line([from, to], |x| line.at(x));
            series.push(Series::dashes(line.name(), Colour::Black, points));
        }
        for (place, curve) in panel.curves.iter().enumerate() {
            let colour = COLOURS[place % COLOURS.len()];
            let (means, repeated) = curve.means();
            let label = curve.name("runs");
            let circles = || Series::circles(label, colour, curve.points.clone());
            match &curve.fit {
                Some(Ok(fit)) => {
                    let mut inside = curve.points.iter().map(|[x, _]| *x);
                    let is_inside = |x: &f64| plot.fit.is_some_and(|range| range.contains(*x));
                    let ends = [inside.clone().find(is_inside), inside.rfind(is_inside)];
                    let points = fitted_line(ends.map(Option::unwrap_or_default), |x| fit.at(x));
                    series.push(circles());
                    // The one legend of several panels has no room for all equations.
                    let equation = match self.panels.len() {
                        1 => equation(fit),
                        _ => String::new(),
                    };
                    series.push(Series::curve(equation, colour, points));
                }
                _ if repeated => {
                    series.push(circles());
                    series.push(Series::curve(self.mean_words(), colour, means));
                }
                _ if place >= COLOURS.len() => series.push(Series::dashes(label, colour, means)),
                _ => series.push(Series::line(label, colour, means)),
            }
        }
        series
    }
}

impl Curve {
    /// The label, or `other` where it is empty.
    pub(super) fn name<'a>(&'a self, other: &'a str) -> &'a str {
        match self.label.as_str() {
            "" => other,
            label => label,
        }
    }

    /// The mean of y at each x, and whether some x has several points.
    pub(super) fn means(&self) -> (Vec<[f64; 2]>, bool) {
        let groups = self.points.chunk_by(|a, b| a[0] == b[0]);
        let mean = |group: &[[f64; 2]]| {
            let sum: f64 = group.iter().map(|[_, y]| y).sum();
            [group[0][0], sum / group.len() as f64]
        };
        let means: Vec<[f64; 2]> = groups.map(mean).collect();
        let repeated = means.len() < self.points.len();
        (means, repeated)
    }
}

fn fitted_line(ends: [f64; 2], y: impl Fn(f64) -> f64) -> Vec<[f64; 2]> {
    ends.map(|x| [x, y(x)]).to_vec()
}

/// Equation of a fitted line for the legend.
fn equation(fit: &LineFit) -> String {
    let sign = if fit.intercept < 0.0 { '-' } else { '+' };
    format!(
        "{} x {sign} {}",
        four_digits(fit.slope),
        four_digits(fit.intercept.abs())
    )
}

/// A number with four digits; whole numbers up to 1e5 unrounded.
pub(super) fn four_digits(value: f64) -> String {
    let size = value.abs();
    if size == 0.0 || ((100.0..1e5).contains(&size) && value.fract() == 0.0) {
        return value.to_string();
    }
    if !(1e-3..1e5).contains(&size) {
        return format!("{value:.3e}");
    }
    let decimals = (3 - size.log10().floor() as i32).max(0) as usize;
    format!("{value:.decimals$}")
}

fn with_unit(name: &str) -> String {
    let unit = KeyPath::parse(name).and_then(|key| unit_of(&key));
    unit.map_or_else(|| name.to_owned(), |unit| format!("{name}, {unit}"))
}
