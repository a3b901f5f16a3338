//! Pictures of the runs of a study: their curves, and their crack paths over one another.

use std::path::PathBuf;

use ligament_plot::drawing::Drawing;
use ligament_plot::picture::curve::{CurveRequest, panels_of_curves};
use ligament_plot::picture::{PathPanel, PictureError, Target, drawing_of_crack_paths};
use ligament_plot::plots::PlotError;

use super::grouping::Grouping;
use super::study::{PlotContent, Study, StudyPlot};
use super::table::Row;

/// Name of the file of a plot of runs.
pub(super) fn name(plot: &StudyPlot) -> &'static str {
    match plot.content {
        PlotContent::CrackPaths => "crack-paths",
        PlotContent::Curves { .. } | PlotContent::Columns { .. } => "curves",
    }
}

/// The picture of the completed runs of a plot, of a width in mm; `by` makes panels and labels, and every run has a curve.
///
/// # Errors
///
/// If the results of a run cannot be drawn so.
pub(super) fn drawing(
    study: &Study,
    plot: &StudyPlot,
    rows: &[Row<'_>],
    width: f64,
) -> Result<Drawing, PictureError> {
    let panels = panels(study, plot, rows);
    if panels.is_empty() {
        let name = name(plot).to_owned();
        return Err(PlotError::Empty { name }.into());
    }
    let title = plot.title.clone().unwrap_or_else(|| study.heading());
    let PlotContent::Curves { x, y } = &plot.content else {
        return drawing_of_crack_paths(&title, &panels, width);
    };
    let runs = panels.iter().flat_map(|panel| &panel.runs).cloned();
    let (labels, folders): (Vec<String>, Vec<PathBuf>) = runs.unzip();
    let request = CurveRequest {
        folders,
        labels,
        x: x.clone(),
        y: vec![y.clone().unwrap_or_else(|| "reaction".to_owned())],
        target: Target::default(),
    };
    let sizes = panels
        .into_iter()
        .map(|panel| (panel.title, panel.runs.len()));
    let mut drawn = panels_of_curves(&request, &sizes.collect::<Vec<_>>())?;
    drawn.title = title;
    Ok(drawn.for_paper(width)?)
}

/// The completed runs in panels with a label for each run; panels without runs are left out.
fn panels(study: &Study, plot: &StudyPlot, rows: &[Row<'_>]) -> Vec<PathPanel> {
    // All runs are at one place, so that each has a curve.
    let grouping = Grouping::new(study, plot, rows, &|_| Some(0.0));
    let panels = grouping.panels.into_iter().map(|panel| {
        let curves = panel.curves.into_iter();
        let runs = curves.flat_map(|curve| {
            let done = curve
                .runs
                .into_iter()
                .filter(|run| rows[*run].results().is_some());
            done.map(move |run| (curve.label.clone(), PathBuf::from(&rows[run].folder)))
        });
        PathPanel {
            title: panel.label,
            runs: runs.collect(),
        }
    });
    panels.filter(|panel| !panel.runs.is_empty()).collect()
}
