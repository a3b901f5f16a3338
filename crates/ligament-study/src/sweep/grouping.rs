//! The runs of a plot by panels and curves.
//!
//! No run is averaged unless the plot says so: an axis that a plot neither draws by, filters to one value nor averages, and whose runs would
//! fall upon one another, gets a curve for each of its values.

use std::collections::{BTreeMap, BTreeSet};

use super::axis::{Axis, axis_of_key};
use super::derived::combinations;
use super::plan::short_keys;
use super::study::{Study, StudyPlot};
use super::table::Row;

/// Runs of a panel of a plot.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct PanelRuns {
    /// Label of the axis values of the panel; empty for a single panel.
    pub(super) label: String,
    /// Curves of the panel.
    pub(super) curves: Vec<CurveRuns>,
}

/// Runs of a curve of a plot.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct CurveRuns {
    /// Label of the axis values of the curve; empty for a single curve.
    pub(super) label: String,
    /// Indices of the runs, in their order.
    pub(super) runs: Vec<usize>,
}

/// Runs of a plot in panels and curves.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Grouping {
    /// Panels of the plot, one or more.
    pub(super) panels: Vec<PanelRuns>,
    /// Axes that the plot does not name, with one curve for each value: their indices and numbers of values.
    pub(super) unnamed: Vec<(usize, usize)>,
}

/// An axis that distinguishes runs of a plot, with the indices of its drawn values.
struct DrawnAxis<'a> {
    axis: &'a Axis,
    index: usize,
    values: Vec<usize>,
    /// Shortest name of the axis in labels; None where values stand alone.
    name: Option<String>,
}

impl<'a> DrawnAxis<'a> {
    /// An axis with the values that pass the filters of a plot.
    fn new(study: &'a Study, plot: &StudyPlot, index: usize, name: Option<String>) -> Self {
        let axis = &study.axes[index];
        let is_left = |value: &usize| {
            let mut filters = plot.filters.iter().filter(|it| it.axis == index);
            filters.all(|it| it.values.contains(value))
        };
        Self {
            axis,
            index,
            values: (0..axis.points.len()).filter(is_left).collect(),
            name,
        }
    }

    fn label(&self, value: usize) -> String {
        let label = &self.axis.points[value].label;
        match &self.name {
            Some(name) if !self.axis.is_labelled => format!("{name} = {label}"),
            _ => label.clone(),
        }
    }
}

impl Grouping {
    /// Groups the runs of a plot; `place` returns the position of a run on a curve, None without one.
    pub(super) fn new(
        study: &Study,
        plot: &StudyPlot,
        rows: &[Row<'_>],
        place: &dyn Fn(usize) -> Option<f64>,
    ) -> Self {
        let is_drawn = |run: &usize| {
            let mut filters = plot.filters.iter();
            filters.all(|it| it.values.contains(&rows[*run].run.place[it.axis]))
        };
        let drawn: Vec<usize> = (0..rows.len()).filter(is_drawn).collect();
        let named = |keys: &[String]| -> Vec<usize> {
            let axes = keys.iter().map(|key| axis_of_key(&study.axes, key));
            axes.flatten().collect()
        };
        let (by, mean) = (named(&plot.by), named(&plot.mean));
        let mut unnamed = coinciding_axes(&drawn, rows, &by, place);
        unnamed.retain(|axis| !mean.contains(axis));
        let keys = short_keys(&study.axes);
        let with_name = |axis: &usize| {
            let name = Some(keys[*axis][0].clone());
            DrawnAxis::new(study, plot, *axis, name)
        };
        let (last, first) = match by.split_last() {
            Some((last, first)) => (Some(last), first),
            None => (None, &[][..]),
        };
        let panels: Vec<DrawnAxis<'_>> = first.iter().map(with_name).collect();
        let mut curves: Vec<DrawnAxis<'_>> =
            last.into_iter().chain(&unnamed).map(with_name).collect();
        if let ([only], true) = (&mut curves[..], unnamed.is_empty()) {
            only.name = None;
        }
        let has = |run: &usize, axes: &[DrawnAxis<'_>], values: &[usize]| {
            let mut pairs = axes.iter().zip(values);
            pairs.all(|(it, value)| rows[*run].run.place[it.index] == *value)
        };
        let panel = |(label, of_panel): (String, Vec<usize>)| {
            let runs = drawn.iter().filter(|run| has(run, &panels, &of_panel));
            let runs: Vec<usize> = runs.copied().collect();
            let curve = |(label, of_curve): (String, Vec<usize>)| {
                let runs = runs.iter().filter(|run| has(run, &curves, &of_curve));
                let runs = runs.copied().collect();
                CurveRuns { label, runs }
            };
            let curves = labelled_combinations(&curves)
                .into_iter()
                .map(curve)
                .collect();
            PanelRuns { label, curves }
        };
        let of_unnamed = curves.iter().filter(|it| unnamed.contains(&it.index));
        Self {
            panels: labelled_combinations(&panels)
                .into_iter()
                .map(panel)
                .collect(),
            unnamed: of_unnamed.map(|it| (it.index, it.values.len())).collect(),
        }
    }
}

/// All combinations of the values of some axes, with their labels.
fn labelled_combinations(axes: &[DrawnAxis<'_>]) -> Vec<(String, Vec<usize>)> {
    let sizes: Vec<usize> = axes.iter().map(|it| it.values.len()).collect();
    let combined = combinations(&sizes).into_iter().map(|places| {
        let values = axes.iter().zip(places).map(|(it, place)| it.values[place]);
        let values: Vec<usize> = values.collect();
        let labels = axes.iter().zip(&values).map(|(it, value)| it.label(*value));
        (labels.collect::<Vec<_>>().join(", "), values)
    });
    combined.collect()
}

/// The axes whose values differ among runs that have the same values of the axes `by` and the same place.
fn coinciding_axes(
    drawn: &[usize],
    rows: &[Row<'_>],
    by: &[usize],
    place: &dyn Fn(usize) -> Option<f64>,
) -> Vec<usize> {
    let mut first = BTreeMap::<(Vec<usize>, u64), &[usize]>::new();
    let mut found = BTreeSet::new();
    for &run in drawn {
        let Some(x) = place(run) else { continue };
        let values = &rows[run].run.place;
        let of_by = by.iter().map(|axis| values[*axis]).collect();
        // The sum makes both zeros equal.
        let other = first.entry((of_by, (x + 0.0).to_bits())).or_insert(values);
        let pairs = values.iter().zip(other.iter()).enumerate();
        found.extend(
            pairs
                .filter(|(_, (one, other))| one != other)
                .map(|(axis, _)| axis),
        );
    }
    found.into_iter().collect()
}
