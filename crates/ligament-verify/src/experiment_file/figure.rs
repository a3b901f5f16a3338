//! Plots of an experiment that is a file: series from a table, from values of runs, or curves of load over displacement.

use std::collections::BTreeMap;

use anyhow::{Context, bail};
use ligament_plot::plots::{Colour, Mark, Plot, Series};

use super::document::{
    Choice, ExperimentFile, Figure, FileMark, FixedLine, Run, RunSeries, TableSeries,
};
use super::entry_runs::{EntryRuns, RunCache, combined_with_labels, with_labels};
use super::expression::{Expression, RunRow};
use crate::table::{Extent, Table, number};

type LabelsOfRun = BTreeMap<String, String>;

impl Figure {
    /// Notes the quantities that the plots need.
    pub(super) fn plan(&self, file: &ExperimentFile, cache: &mut RunCache) -> anyhow::Result<()> {
        let Some(of_runs) = &self.runs else {
            return Ok(());
        };
        for labels in self.labels_of_plots() {
            for labels in self.lines(&labels).into_iter().flat_map(|it| it.1) {
                match &of_runs.y {
                    Some(y) => cache.plan(&runs(file, y, labels)?)?,
                    None => cache.plan_curve(&runs(file, "0", labels)?)?,
                }
            }
        }
        Ok(())
    }

    /// The plots; in the fast subset only plots of tables.
    pub(super) fn plots(
        &self,
        file: &ExperimentFile,
        extent: Extent,
        tables: &[Table],
        cache: &mut RunCache,
    ) -> anyhow::Result<Vec<Plot>> {
        if extent == Extent::Fast && self.runs.is_some() {
            return Ok(Vec::new());
        }
        let mut plots = Vec::new();
        for labels in self.labels_of_plots() {
            let mut series = Vec::new();
            for line in &self.fixed {
                series.push(line.series(file, &labels)?);
            }
            for it in &self.table {
                series.push(it.series(tables, &labels)?);
            }
            if let Some(of_runs) = &self.runs {
                for (place, (label, points)) in self.lines(&labels).into_iter().enumerate() {
                    let name = of_runs.name.replace("{}", &label);
                    let colour = of_runs.colours.get(place).context("a line has no colour")?;
                    let (mark, points) = of_runs.points(file, points, cache)?;
                    series.push(Series::new(name, mark, colour_of(colour)?, points));
                }
            }
            let mut words = labels.clone();
            for (key, choice) in &self.words {
                let label = |key: &str| labels.get(key).cloned().context("no such label");
                words.insert(key.clone(), choice.for_labels(label)?.to_owned());
            }
            plots.push(Plot::new(
                with_labels(&self.name, &labels).replace(' ', ""),
                with_labels(&self.title, &words),
                self.axes.each_ref().map(String::as_str),
                series,
            ));
        }
        Ok(plots)
    }

    /// Labels of each plot.
    fn labels_of_plots(&self) -> Vec<LabelsOfRun> {
        let mut all = vec![self.labels.clone()];
        for (key, labels) in &self.each {
            all = combined_with_labels(&all, key, labels);
        }
        all
    }

    /// Labels of each line of a plot, and of its points.
    fn lines(&self, labels: &LabelsOfRun) -> Vec<(String, Vec<LabelsOfRun>)> {
        let Some(of_runs) = &self.runs else {
            return Vec::new();
        };
        let line = |label: &String| {
            let of_line = combined_with_labels(
                std::slice::from_ref(labels),
                &of_runs.line,
                std::slice::from_ref(label),
            );
            let points = match &of_runs.x {
                None => of_line,
                Some(key) => combined_with_labels(&of_line, key, &of_runs.xs),
            };
            (label.clone(), points)
        };
        of_runs.lines.iter().map(line).collect()
    }
}

/// The run of a point of a plot.
pub(super) fn runs<'a>(
    file: &'a ExperimentFile,
    value: &str,
    labels: LabelsOfRun,
) -> anyhow::Result<EntryRuns<'a>> {
    static OF_FILE: Run = Run {
        case: None,
        mesh: None,
        set: Vec::new(),
        set_by: None,
        stress: None,
        list: None,
    };
    EntryRuns::new(
        file,
        &OF_FILE,
        &Choice::Always(value.to_owned()),
        vec![labels],
    )
}

impl FixedLine {
    fn series(&self, file: &ExperimentFile, labels: &LabelsOfRun) -> anyhow::Result<Series> {
        let number = |text: &str| {
            let runs = runs(file, text, labels.clone())?;
            let mut of = |place: RunRow, name: &str| runs.number(place.run, name);
            Expression::parse(text)?.value(0..1, &mut of)
        };
        let points = self
            .points
            .iter()
            .map(|[x, y]| Ok([number(x)?, number(y)?]));
        let points = points.collect::<anyhow::Result<_>>()?;
        Ok(Series::dashes(&self.name, Colour::Black, points))
    }
}

impl TableSeries {
    fn series(&self, tables: &[Table], labels: &LabelsOfRun) -> anyhow::Result<Series> {
        let of = with_labels(&self.of, labels);
        let table = tables.iter().find(|it| it.heading.name == self.file);
        let table = table.with_context(|| format!("no table `{}`", self.file))?;
        let mut points = match self.known {
            true => table.known(&self.x, &of)?,
            false => table.computed(&self.x, &of)?,
        };
        if self.less_x {
            points.iter_mut().for_each(|point| point[1] -= point[0]);
        }
        let mark = match self.mark {
            FileMark::Line => Mark::Line,
            FileMark::Curve => Mark::Curve,
            FileMark::Circles => Mark::Circles,
            FileMark::Dashes => Mark::Dashes,
        };
        Ok(Series::new(
            &self.name,
            mark,
            colour_of(&self.colour)?,
            points,
        ))
    }
}

impl RunSeries {
    /// The points of a line from the labels of its points.
    fn points(
        &self,
        file: &ExperimentFile,
        points: Vec<LabelsOfRun>,
        cache: &mut RunCache,
    ) -> anyhow::Result<(Mark, Vec<[f64; 2]>)> {
        if let Some(axes) = &self.curve {
            let labels = points.into_iter().next().context("a curve has one run")?;
            let runs = runs(file, "0", labels)?;
            let axes = axes.each_ref().map(|text| Expression::parse(text));
            let [x, y] = axes;
            let (x, y) = (x?, y?);
            let curve = cache.curve(&runs)?;
            let point = |[displacement, reaction]: &[f64; 2]| {
                let mut of = |place: RunRow, name: &str| match name {
                    "displacement" => Ok(*displacement),
                    "reaction" => Ok(*reaction),
                    other => runs.number(place.run, other),
                };
                Ok([x.value(0..1, &mut of)?, y.value(0..1, &mut of)?])
            };
            let points = curve.iter().map(point).collect::<anyhow::Result<_>>()?;
            return Ok((Mark::Curve, points));
        }
        let (Some(key), Some(y)) = (&self.x, &self.y) else {
            bail!("series of runs have `x` and `y`, or a `curve`");
        };
        let point = |labels: LabelsOfRun| {
            let x = number(key, labels.get(key).context("no label along x")?)?;
            Ok([x, cache.value(&runs(file, y, labels)?)?])
        };
        let points = points.into_iter().map(point);
        let mut points = points.collect::<anyhow::Result<Vec<[f64; 2]>>>()?;
        if let Some(label) = &self.over {
            let place = self.xs.iter().position(|it| it == label);
            let [_, unit] = points[place.with_context(|| format!("no `{label}` along x"))?];
            points.iter_mut().for_each(|point| point[1] /= unit);
        }
        Ok((Mark::Line, points))
    }
}

fn colour_of(name: &str) -> anyhow::Result<Colour> {
    Ok(match name {
        "black" => Colour::Black,
        "blue" => Colour::Blue,
        "vermilion" => Colour::Vermilion,
        "green" => Colour::Green,
        "orange" => Colour::Orange,
        "purple" => Colour::Purple,
        "sky" => Colour::Sky,
        other => bail!("no colour `{other}`"),
    })
}
