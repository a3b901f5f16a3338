//! Results of a study: its table, its fits and plots, and the short text at its end.

use std::io::{self, Write};

use ligament_output::columns::aligned;
use ligament_output::csv::{self, Value};
use ligament_output::replace_file;

use super::curves::{Curve, Curves, rounded};
use super::plan::{Run, short_keys};
use super::study::Study;
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

/// Writes `table.csv`, `fits.csv` and the plots into the study's folder, and prints their main contents; returns the problems.
pub(super) fn write(
    study: &Study,
    rows: &[Row<'_>],
    folder: &StudyFolder,
    out: &mut dyn Write,
) -> anyhow::Result<Vec<String>> {
    let table = StudyTable::from_rows(study, rows);
    table.write_csv(&folder.path().join("table.csv"))?;

    let title = if study.title.is_empty() {
        study.name()
    } else {
        study.title.clone()
    };
    writeln!(out, "{title}")?;
    write_counts(rows, out)?;
    let mut done = rows
        .iter()
        .filter_map(|row| Some((row.run, row.results()?)));
    let Some((run, results)) = done.next() else {
        writeln!(out, "  no run has results to plot")?;
        return Ok(Vec::new());
    };
    let mut problems: Vec<String> = (unknown_names(study, run, results).iter())
        .map(ToString::to_string)
        .collect();
    let drawn = curves_of_plots(study, rows, &table, &mut problems);
    for curves in &drawn {
        write_pivot(study, curves, out)?;
        write_fits(curves, out)?;
        let plot = curves.drawn(&title);
        match plot.for_paper(WIDTH) {
            Ok(drawing) => write_plot(folder.path(), &curves.name, &drawing)?,
            Err(error) => problems.push(error.to_string()),
        }
    }
    if drawn.iter().any(|curves| curves.plot.fit.is_some()) {
        replace_file(&folder.path().join("fits.csv"), fits(&drawn).as_bytes())?;
    }
    Ok(problems)
}

/// The curves of the possible plots, each with a unique name; appends the reasons for the others to `problems`.
fn curves_of_plots<'a>(
    study: &'a Study,
    rows: &[Row<'_>],
    table: &StudyTable,
    problems: &mut Vec<String>,
) -> Vec<Curves<'a>> {
    let mut drawn: Vec<Curves<'_>> = Vec::new();
    for (index, plot) in study.plots.iter().enumerate() {
        match Curves::over_rows(study, plot, rows, table) {
            Ok(mut curves) => {
                let same = drawn
                    .iter()
                    .filter(|other| other.name == curves.name)
                    .count();
                if same > 0 {
                    curves.name = format!("{}-{}", curves.name, index + 1);
                }
                drawn.push(curves);
            }
            Err(UnknownColumn { name, .. })
                if problems.iter().any(|it| it.contains(&format!("`{name}`"))) => {}
            Err(missing) => {
                let place = KeyPath(vec!["plot".to_owned(), index.to_string()]);
                problems.push(study.error(place, missing.to_string()).to_string());
            }
        }
    }
    drawn
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
    }
    for (index, plot) in study.plots.iter().enumerate() {
        for (key, name) in [("x", &plot.x), ("y", &plot.y)] {
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
        let known = known.into_iter().chain(results);
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

/// Prints the plotted results: a row for each x, a column for each curve; means where several runs have the same x.
fn write_pivot(study: &Study, curves: &Curves<'_>, out: &mut dyn Write) -> io::Result<()> {
    let plot = curves.plot;
    let shown = |key: &str| {
        let axis = study
            .axes
            .iter()
            .position(|axis| axis.keys.first().is_some_and(|it| it == key));
        axis.map_or_else(
            || key.to_owned(),
            |axis| short_keys(&study.axes)[axis][0].clone(),
        )
    };
    write!(out, "{} over {}", plot.y, plot.x)?;
    match &plot.by {
        Some(by) => writeln!(out, ", by {by}")?,
        None => writeln!(out)?,
    }
    let all: Vec<(Vec<[f64; 2]>, bool)> = curves.curves.iter().map(Curve::means).collect();
    let mut lines = vec![vec![shown(&plot.x)]];
    for curve in &curves.curves {
        lines[0].push(curve.name(&plot.y).to_owned());
    }
    lines[0].extend(plot.line.iter().map(|known| known.name().to_owned()));
    for x in curves.places() {
        let mut line = vec![x.to_string()];
        for (means, _) in &all {
            let at = means.iter().find(|point| point[0] == x);
            line.push(at.map_or_else(|| "-".to_owned(), |[_, y]| rounded(*y)));
        }
        line.extend(plot.line.iter().map(|known| rounded(known.at(x))));
        lines.push(line);
    }
    write_aligned(&lines, out)?;
    if all.iter().any(|(_, repeated)| *repeated) {
        writeln!(out, "  (means of the runs that share a place)")?;
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
    for curve in &curves.curves {
        let name = curve.name("runs").to_owned();
        match &curve.fit {
            Some(Ok(fit)) => {
                let error = |error: Option<f64>| error.map_or_else(|| "-".to_owned(), rounded);
                lines.push(vec![
                    name,
                    rounded(fit.slope),
                    error(fit.slope_error),
                    rounded(fit.intercept),
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
        let (slope, intercept) = (rounded(known.slope), rounded(known.intercept));
        lines.push(vec![
            known.name().to_owned(),
            slope,
            String::new(),
            intercept,
        ]);
    }
    write_aligned(&lines, out)
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
        let by = plot.by.as_deref().map_or(Value::Missing, Value::Text);
        let [name, x, y] = [curves.name.as_str(), &plot.x, &plot.y].map(Value::Text);
        let mut push = |curve: &str, numbers: [Value<'_>; 6], remark: &str| {
            let curve = Some(curve).filter(|it| !it.is_empty());
            let curve = curve.map_or(Value::Missing, Value::Text);
            text +=
                &csv::line(&[&[name, x, y, by, curve], &numbers[..], &[remark.into()]].concat());
        };
        for Curve { label, fit, .. } in &curves.curves {
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
