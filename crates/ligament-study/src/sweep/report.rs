//! Results of a study: its table, its fits and plots, and the short text at its end.

use std::io::{self, Write};

use ligament_output::columns::aligned;
use ligament_output::csv::{self, Value};
use ligament_output::replace_file;
use ligament_plot::drawing::Drawing;

use super::axis::axis_of_key;
use super::cracks;
use super::curves::{Curve, Curves, Panel, four_digits};
use super::evaluation::DerivedValues;
use super::pictures;
use super::plan::{Run, short_keys};
use super::study::{PlotContent, Reference, Study};
use super::table;
use super::table::{Row, StudyTable, UnknownColumn};
use crate::quantities::{Quantities, QuantityError};
use crate::run_table::folder::StudyFolder;
use crate::run_table::{WIDTH, number, write_plot};
use ligament_case::case::key_path::KeyPath;
use ligament_case::case::{CaseError, Fault};

/// Largest number of missing runs that are listed by name at the end.
const LISTED: usize = 20;

/// Columns of `fits.csv`.
const FIT_COLUMNS: &str =
    "plot,x,y,by,curve,slope,slope_error,intercept,intercept_error,r_squared,points,remark";

/// Problems and remarks about the tables and plots of a study.
#[derive(Debug, Default)]
pub(super) struct Findings {
    /// Reasons why some tables or plots could not be made.
    pub(super) problems: Vec<String>,
    /// Remarks about the contents of the tables and plots.
    pub(super) remarks: Vec<String>,
}

/// Writes `table.csv`, `fits.csv` and the plots into the study's folder, and prints their main contents.
pub(super) fn write(
    study: &Study,
    rows: &[Row<'_>],
    folder: &StudyFolder,
    out: &mut dyn Write,
) -> anyhow::Result<Findings> {
    let derived = DerivedValues::new(study, rows);
    let table = StudyTable::from_rows(study, rows, &derived.values);
    table.write_csv(&folder.path().join(table::TABLE))?;

    let title = study.heading();
    writeln!(out, "{title}")?;
    write_counts(rows, out)?;
    let mut findings = Findings {
        problems: Vec::new(),
        remarks: derived.remarks,
    };
    let mut done = rows
        .iter()
        .filter_map(|row| Some((row.run, row.results()?)));
    let Some((run, results)) = done.next() else {
        writeln!(out, "  no run has results to plot")?;
        return Ok(Findings::default());
    };
    let unknown = unknown_names(study, run, results);
    findings.problems = unknown.iter().map(ToString::to_string).collect();
    let mut names = FileNames::default();
    let mut drawn = Vec::new();
    for (index, plot) in study.plots.iter().enumerate() {
        let problem = match &plot.content {
            PlotContent::Columns { x, y } => {
                match Curves::over_rows(study, plot, [x, y], rows, &table) {
                    Ok(mut curves) => {
                        curves.name = names.unique(curves.name, index);
                        findings.remarks.extend(unnamed_axes(study, &curves, index));
                        write_pivots(study, &curves, out)?;
                        write_fits(&curves, out)?;
                        let drawing = curves.panels(&title).for_paper(WIDTH);
                        let name = curves.name.clone();
                        drawn.push(curves);
                        write_drawing(folder, &name, drawing)?
                    }
                    Err(missing) => missing_column(study, index, &missing, &findings.problems),
                }
            }
            PlotContent::Curves { .. } | PlotContent::CrackPaths => {
                let name = names.unique(pictures::name(plot).to_owned(), index);
                let drawing = pictures::drawing(study, plot, rows, WIDTH);
                write_drawing(folder, &name, drawing)?
            }
        };
        findings.problems.extend(problem);
    }
    if drawn.iter().any(|curves| curves.plot.fit.is_some()) {
        replace_file(&folder.path().join("fits.csv"), fits(&drawn).as_bytes())?;
    }
    Ok(findings)
}

/// Names of the files of plots.
#[derive(Debug, Default)]
struct FileNames(Vec<String>);

impl FileNames {
    /// A name that no other plot has, with the number of the plot where it is needed.
    fn unique(&mut self, name: String, index: usize) -> String {
        let name = match self.0.contains(&name) {
            true => format!("{name}-{}", index + 1),
            false => name,
        };
        self.0.push(name.clone());
        name
    }
}

/// Writes a drawing, or returns the reason why there is none.
fn write_drawing<Reason: ToString>(
    folder: &StudyFolder,
    name: &str,
    drawing: Result<Drawing, Reason>,
) -> anyhow::Result<Option<String>> {
    match drawing {
        Ok(drawing) => write_plot(folder.path(), name, &drawing).map(|()| None),
        Err(reason) => Ok(Some(reason.to_string())),
    }
}

/// The error of a missing column of a plot, unless it was reported before.
fn missing_column(
    study: &Study,
    index: usize,
    missing: &UnknownColumn,
    told: &[String],
) -> Option<String> {
    let quoted = format!("`{}`", missing.name);
    let is_told = told.iter().any(|it| it.contains(&quoted));
    (!is_told).then(|| {
        let place = KeyPath(vec!["plot".to_owned(), index.to_string()]);
        study.error(place, missing.to_string()).to_string()
    })
}

/// The remark about axes that a plot does not name.
fn unnamed_axes(study: &Study, curves: &Curves<'_>, index: usize) -> Option<String> {
    let [(first, _), ..] = curves.unnamed[..] else {
        return None;
    };
    let key = |axis: usize| &study.axes[axis].keys[0];
    let axes = curves.unnamed.iter();
    let axes = axes.map(|(axis, count)| format!("each of the {count} values of {}", key(*axis)));
    let place = study.location(&KeyPath(vec!["plot".to_owned(), index.to_string()]));
    Some(format!(
        "{place}: the plot does not name all axes: {} has a curve; choose by `by`, pick values by `where`, or average by `mean = \"{}\"`",
        axes.collect::<Vec<_>>().join(" and "),
        key(first)
    ))
}

/// Errors of results in the study that a run does not have, each at its position in the study.
pub(super) fn unknown_names(study: &Study, run: &Run, results: &Quantities) -> Vec<CaseError> {
    let keys = study.axes.iter().flat_map(|axis| &axis.keys);
    let own = keys.chain(study.derived.iter().map(|derived| &derived.name));
    let own: Vec<String> = own.cloned().collect();
    let inputs = table::inputs(run);
    let is_column = |name: &str| {
        let input = name.strip_prefix(table::INPUT).unwrap_or(name);
        own.iter().any(|it| it == name) || inputs.iter().any(|(it, _)| it == input)
    };
    let mut named = Vec::new();
    for (index, derived) in study.derived.iter().enumerate() {
        named.push((
            ["result", &index.to_string(), "of"].map(str::to_owned),
            &derived.of,
            Vec::new(),
        ));
        if let Some(Reference::Column(name)) = &derived.reference
            && !is_column(name)
        {
            named.push((
                ["result", &index.to_string(), "reference"].map(str::to_owned),
                name,
                own.clone(),
            ));
        }
    }
    for (index, plot) in study.plots.iter().enumerate() {
        let PlotContent::Columns { x, y } = &plot.content else {
            continue;
        };
        for (key, name) in [("x", x), ("y", y)] {
            if !is_column(name) {
                named.push((
                    ["plot", &index.to_string(), key].map(str::to_owned),
                    name,
                    own.clone(),
                ));
            }
        }
    }
    let error = |(place, name, known): ([String; 3], &String, Vec<String>)| {
        let Err(QuantityError::Unknown { known: results, .. }) = results.number(name) else {
            return None;
        };
        if cracks::NAMES.contains(&name.as_str()) {
            return None;
        }
        let known = known.into_iter().chain(results);
        let known = known.chain(cracks::NAMES.map(str::to_owned));
        let fault = Fault::unknown_name("result of the runs", name, known);
        Some(study.error(KeyPath(place.to_vec()), fault))
    };
    named.into_iter().filter_map(error).collect()
}

fn write_counts(rows: &[Row<'_>], out: &mut dyn Write) -> io::Result<()> {
    let named = |is_it: &dyn Fn(&Row<'_>) -> bool| -> Vec<&str> {
        let rows = rows.iter().filter(|row| is_it(row));
        rows.map(|row| row.run.name.as_str()).collect()
    };
    let of_word = |word| named(&|row| row.status.word() == word);
    let [done, failed, missing] = ["done", "failed", "missing"].map(of_word);
    let unsettled = named(&|row| row.results().is_some_and(Quantities::ends_not_at_rest));
    writeln!(
        out,
        "  {} runs: {} done, {} failed, {} missing",
        rows.len(),
        done.len(),
        failed.len(),
        missing.len()
    )?;
    for (word, names) in [
        ("failed", failed),
        ("missing", missing),
        ("not converged at the end", unsettled),
    ] {
        for name in names.iter().take(LISTED) {
            writeln!(out, "  {word}: {name}")?;
        }
        if names.len() > LISTED {
            writeln!(
                out,
                "  {word}: {} more, see table.csv",
                names.len() - LISTED
            )?;
        }
    }
    Ok(())
}

/// Prints the plotted results of each panel: a row for each x, a column for each curve; means where several runs have the same x.
fn write_pivots(study: &Study, curves: &Curves<'_>, out: &mut dyn Write) -> io::Result<()> {
    let shown = |key: &str| {
        let axis = axis_of_key(&study.axes, key);
        let axis = axis.filter(|axis| study.axes[*axis].keys[0] == key);
        axis.map_or_else(
            || key.to_owned(),
            |axis| short_keys(&study.axes)[axis][0].clone(),
        )
    };
    for panel in &curves.panels {
        write!(out, "{} over {}", curves.y, curves.x)?;
        match curves.plot.by.as_slice() {
            [] => {}
            [.., last] if !panel.label.is_empty() => write!(out, ", by {last}, {}", panel.label)?,
            keys => write!(out, ", by {}", keys.join(", "))?,
        }
        writeln!(out)?;
        write_pivot(&shown(curves.x), curves, panel, out)?;
    }
    Ok(())
}

fn write_pivot(x: &str, curves: &Curves<'_>, panel: &Panel, out: &mut dyn Write) -> io::Result<()> {
    let line = &curves.plot.line;
    let all: Vec<(Vec<[f64; 2]>, bool)> = panel.curves.iter().map(Curve::means).collect();
    let mut lines = vec![vec![x.to_owned()]];
    for curve in &panel.curves {
        lines[0].push(curve.name(curves.y).to_owned());
    }
    lines[0].extend(line.iter().map(|known| known.name().to_owned()));
    for x in curves.places() {
        let mut row = vec![x.to_string()];
        for (means, _) in &all {
            let at = means.iter().find(|point| point[0] == x);
            row.push(at.map_or_else(|| "-".to_owned(), |[_, y]| four_digits(*y)));
        }
        row.extend(line.iter().map(|known| four_digits(known.at(x))));
        lines.push(row);
    }
    write_aligned(&lines, out)?;
    if all.iter().any(|(_, repeated)| *repeated) {
        writeln!(out, "  ({})", curves.mean_words())?;
    }
    Ok(())
}

fn write_fits(curves: &Curves<'_>, out: &mut dyn Write) -> io::Result<()> {
    let Some(range) = curves.plot.fit else {
        return Ok(());
    };
    let words = match (range.from, range.to) {
        (Some(from), Some(to)) => format!(", {from} <= x <= {to}"),
        (Some(from), None) => format!(", x >= {from}"),
        (None, Some(to)) => format!(", x <= {to}"),
        (None, None) => String::new(),
    };
    writeln!(out, "lines of least squares{words}")?;
    let heads = ["", "slope", "+-", "intercept", "+-", "R^2", "points"];
    let mut lines = vec![heads.map(str::to_owned).to_vec()];
    for (panel, curve) in with_panels(curves) {
        let name = joined_label(panel, curve.name("runs"));
        match &curve.fit {
            Some(Ok(fit)) => {
                let error = |error: Option<f64>| error.map_or_else(|| "-".to_owned(), four_digits);
                lines.push(vec![
                    name,
                    four_digits(fit.slope),
                    error(fit.slope_error),
                    four_digits(fit.intercept),
                    error(fit.intercept_error),
                    format!("{:.5}", fit.r_squared),
                    fit.points.to_string(),
                ]);
            }
            Some(Err(error)) => lines.push(vec![name, error.to_string()]),
            None => {}
        }
    }
    if let Some(known) = &curves.plot.line {
        let (slope, intercept) = (four_digits(known.slope), four_digits(known.intercept));
        lines.push(vec![
            known.name().to_owned(),
            slope,
            String::new(),
            intercept,
        ]);
    }
    write_aligned(&lines, out)
}

/// The curves of all panels, with the labels of these.
fn with_panels<'a>(curves: &'a Curves<'_>) -> impl Iterator<Item = (&'a str, &'a Curve)> {
    let panels = curves.panels.iter();
    panels.flat_map(|panel| panel.curves.iter().map(|curve| (&*panel.label, curve)))
}

/// Joined label of a panel, if it has one, and a curve.
fn joined_label(panel: &str, curve: &str) -> String {
    let labels = [panel, curve].into_iter().filter(|it| !it.is_empty());
    labels.collect::<Vec<_>>().join(", ")
}

fn write_aligned(lines: &[Vec<String>], out: &mut dyn Write) -> io::Result<()> {
    let mut lines = aligned(lines, 1).into_iter();
    lines.try_for_each(|line| writeln!(out, "  {line}"))
}

/// Text of `fits.csv`: all fitted lines, and the known lines.
fn fits(all: &[Curves<'_>]) -> String {
    let mut text = format!("{FIT_COLUMNS}\n");
    for curves in all.iter().filter(|curves| curves.plot.fit.is_some()) {
        let plot = curves.plot;
        let by = plot.by.join(", ");
        let by = match by.as_str() {
            "" => Value::Missing,
            by => Value::Text(by),
        };
        let [name, x, y] = [curves.name.as_str(), curves.x, curves.y].map(Value::Text);
        let mut push = |curve: &str, numbers: [Value<'_>; 6], remark: &str| {
            let curve = Some(curve).filter(|it| !it.is_empty());
            let curve = curve.map_or(Value::Missing, Value::Text);
            text +=
                &csv::line(&[&[name, x, y, by, curve], &numbers[..], &[remark.into()]].concat());
        };
        for (panel, Curve { label, fit, .. }) in with_panels(curves) {
            let label = &joined_label(panel, label);
            match fit {
                Some(Ok(fit)) => {
                    let numbers = [
                        fit.slope.into(),
                        number(fit.slope_error),
                        fit.intercept.into(),
                        number(fit.intercept_error),
                        fit.r_squared.into(),
                        fit.points.into(),
                    ];
                    push(label, numbers, "fitted");
                }
                Some(Err(error)) => push(label, [Value::Missing; 6], &error.to_string()),
                None => {}
            }
        }
        if let Some(known) = &plot.line {
            let mut numbers = [Value::Missing; 6];
            (numbers[0], numbers[2]) = (known.slope.into(), known.intercept.into());
            push(known.name(), numbers, "known");
        }
    }
    text
}
