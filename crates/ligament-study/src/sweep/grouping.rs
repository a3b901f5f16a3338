//! The runs of a plot by panels and curves.
//!
//! No run is averaged unless the plot says so: an axis that a plot neither draws by, filters to one value nor averages, and whose runs would
//! fall upon one another, gets a curve for each of its values.

use std::collections::BTreeMap;

use super::axis::{Axis, axis_of_key};
use super::derived::combinations;
use super::plan::short_keys;
use super::study::{Study, StudyPlot};
use super::table::Row;

/// Runs of a panel of a plot.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct PanelRuns {
    /// Label of the values that all runs of the panel have; empty where one panel has all.
    pub(super) label: String,
    /// Curves of the panel.
    pub(super) curves: Vec<CurveRuns>,
}

/// Runs of a curve of a plot.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct CurveRuns {
    /// Label of the values that all runs of the curve have; empty where one curve has all.
    pub(super) label: String,
    /// Indices of the runs, in their order.
    pub(super) runs: Vec<usize>,
}

/// Runs of a plot in panels and curves.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Grouping {
    /// Panels of the plot, one or more.
    pub(super) panels: Vec<PanelRuns>,
    /// Axes that the plot does not name, each value of which has a curve, by their index and number of values.
    pub(super) unnamed: Vec<(usize, usize)>,
}

/// An axis that tells runs of a plot apart, with the indices of its values that are drawn.
struct Part<'a> {
    axis: &'a Axis,
    index: usize,
    values: Vec<usize>,
    /// Shortest name of the axis in labels; None where values stand alone.
    name: Option<String>,
}

impl<'a> Part<'a> {
    /// An axis with the values that the filters of a plot leave.
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
    /// The runs of a plot; `coincide` says of two runs whether one curve would have both at one place.
    pub(super) fn new(
        study: &Study,
        plot: &StudyPlot,
        rows: &[Row<'_>],
        coincide: &dyn Fn(usize, usize) -> bool,
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
        let is_unnamed = |axis: &usize| {
            let is_named = by.contains(axis) || mean.contains(axis);
            !is_named && would_coincide(*axis, &drawn, rows, coincide)
        };
        let unnamed: Vec<usize> = (0..study.axes.len()).filter(is_unnamed).collect();
        let (last, first) = by
            .split_last()
            .map_or((None, &[][..]), |(last, first)| (Some(*last), first));
        let keys = short_keys(&study.axes);
        let part = |axis: usize, has_name: bool| {
            let name = has_name.then(|| keys[axis][0].clone());
            Part::new(study, plot, axis, name)
        };
        let panels: Vec<Part<'_>> = first.iter().map(|axis| part(*axis, true)).collect();
        let curves: Vec<Part<'_>> = (last.iter().map(|axis| part(*axis, !unnamed.is_empty())))
            .chain(unnamed.iter().map(|axis| part(*axis, true)))
            .collect();
        let has = |run: &usize, parts: &[Part<'_>], values: &[usize]| {
            let mut pairs = parts.iter().zip(values);
            pairs.all(|(part, value)| rows[*run].run.place[part.index] == *value)
        };
        let panel = |(label, of_panel): (String, Vec<usize>)| {
            let runs = drawn.iter().filter(|run| has(run, &panels, &of_panel));
            let runs: Vec<usize> = runs.copied().collect();
            let curve = |(label, of_curve): (String, Vec<usize>)| {
                let runs = runs.iter().filter(|run| has(run, &curves, &of_curve));
                let runs = runs.copied().collect();
                CurveRuns { label, runs }
            };
            let curves = labelled(&curves).into_iter().map(curve).collect();
            PanelRuns { label, curves }
        };
        let n_values = |axis: usize| Part::new(study, plot, axis, None).values.len();
        Self {
            panels: labelled(&panels).into_iter().map(panel).collect(),
            unnamed: unnamed.iter().map(|&axis| (axis, n_values(axis))).collect(),
        }
    }
}

/// All combinations of the values of some axes, with their labels.
fn labelled(parts: &[Part<'_>]) -> Vec<(String, Vec<usize>)> {
    let sizes: Vec<usize> = parts.iter().map(|part| part.values.len()).collect();
    let combined = combinations(&sizes).into_iter().map(|places| {
        let values = parts
            .iter()
            .zip(places)
            .map(|(part, place)| part.values[place]);
        let values: Vec<usize> = values.collect();
        let labels = parts
            .iter()
            .zip(&values)
            .map(|(part, value)| part.label(*value));
        (labels.collect::<Vec<_>>().join(", "), values)
    });
    combined.collect()
}

/// Whether two runs that differ along one axis alone would be at one place of one curve.
fn would_coincide(
    axis: usize,
    drawn: &[usize],
    rows: &[Row<'_>],
    coincide: &dyn Fn(usize, usize) -> bool,
) -> bool {
    let mut groups = BTreeMap::<Vec<usize>, Vec<usize>>::new();
    for &run in drawn {
        let mut key = rows[run].run.place.clone();
        key[axis] = 0;
        groups.entry(key).or_default().push(run);
    }
    groups.values().any(|runs| {
        let others = |place: usize| runs[place + 1..].iter();
        let mut numbered = runs.iter().enumerate();
        numbered.any(|(place, run)| others(place).any(|other| coincide(*run, *other)))
    })
}
