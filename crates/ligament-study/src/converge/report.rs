//! Report of intervals of convergence: sentences, a table, JSON and plots.

use std::io::{self, Write};
use std::path::Path;

use ligament_case::case::CaseFile;
use ligament_output::columns::aligned;
use ligament_output::csv::Value;
use ligament_output::quantity::{PrefixedUnit, between};
use ligament_output::replace_file;
use ligament_plot::picture::units::AxisUnit;
use ligament_plot::plots::{Colour, Plot, Series};
use serde::Serialize;

use super::crack_paths::PathDistances;
use super::evaluation::{Evaluated, Runs, SizedRun};
use super::interval::{AGAINST_TREND, DEVIATIONS, Interval, LARGEST_CHANGE, LARGEST_SCATTER};
use crate::run_table::{WIDTH, number, table, write_plot};

/// Columns of `convergence.csv`.
const COLUMNS: &str =
    "result,unit,lower,upper,at_h,at_2h,standard_deviation,mesher,families,refused";

/// Width of the headings of lines beside the results.
const HEADING: usize = 11;

/// `convergence.json`.
#[derive(Serialize)]
struct Document<'a> {
    title: &'a str,
    /// Ratio of the spacings of the points.
    ratio: f64,
    /// Constants of the rule for intervals.
    rule: Rule,
    runs: Vec<RunInFile<'a>>,
    results: &'a [Evaluated],
    crack_paths: Option<PathDistances>,
    notes: &'a [String],
}

#[derive(Serialize)]
struct Rule {
    deviations: f64,
    against_trend: f64,
    floor: f64,
    largest_change: f64,
    largest_scatter: f64,
}

#[derive(Serialize)]
struct RunInFile<'a> {
    label: &'a str,
    mesher: &'a str,
    size: &'a str,
    points: Option<f64>,
    /// Mean spacing of the points, m.
    spacing: Option<f64>,
    /// Mean horizon, m.
    horizon: Option<f64>,
    folder: &'a str,
}

/// Writes the intervals of a case into its folder and prints them.
pub(super) fn write(
    case: &CaseFile,
    runs: &Runs<'_>,
    results: &[Evaluated],
    folder: &Path,
    out: &mut dyn Write,
) -> anyhow::Result<()> {
    let paths = PathDistances::between_runs(runs);
    let document = document(case, runs, results, paths);
    replace_file(
        &folder.join("convergence.json"),
        (serde_json::to_string_pretty(&document)? + "\n").as_bytes(),
    )?;
    replace_file(
        &folder.join("convergence.csv"),
        table(COLUMNS, results.iter().map(row)).as_bytes(),
    )?;
    for result in results {
        if let Ok(drawing) = plot(runs, result).for_paper(WIDTH) {
            write_plot(folder, &format!("{}-over-h", result.name), &drawing)?;
        }
    }
    print(case, runs, (results, paths), out)?;
    Ok(writeln!(out, "  results in {}", folder.display())?)
}

fn document<'a>(
    case: &'a CaseFile,
    runs: &'a Runs<'_>,
    results: &'a [Evaluated],
    crack_paths: Option<PathDistances>,
) -> Document<'a> {
    let in_file = runs.runs.iter().map(|run| RunInFile {
        label: &run.body.label,
        mesher: run.body.mesher,
        size: if run.body.is_fine { "h" } else { "2h" },
        points: run.results.number("points").ok(),
        spacing: runs.spacing(run),
        horizon: run.results.number("horizon.mean").ok(),
        folder: &run.folder,
    });
    Document {
        title: &case.case.title,
        ratio: runs.ratio(),
        rule: Rule {
            deviations: DEVIATIONS,
            against_trend: AGAINST_TREND,
            floor: runs.bodies.floor,
            largest_change: LARGEST_CHANGE,
            largest_scatter: LARGEST_SCATTER,
        },
        runs: in_file.collect(),
        results,
        crack_paths,
        notes: &runs.bodies.notes,
    }
}

fn row(result: &Evaluated) -> Vec<Value<'_>> {
    let of = |get: fn(&Interval) -> f64| number(result.interval.as_ref().map(get));
    vec![
        Value::Text(&result.name),
        Value::Text(&result.unit),
        of(|it| it.lower),
        of(|it| it.upper),
        of(|it| it.fine),
        of(|it| it.coarse),
        number(result.interval.and_then(|it| it.deviation)),
        number(result.mesher),
        number(result.families),
        result
            .refused
            .as_deref()
            .map_or(Value::Missing, Value::Text),
    ]
}

fn print(
    case: &CaseFile,
    runs: &Runs<'_>,
    (results, paths): (&[Evaluated], Option<PathDistances>),
    out: &mut dyn Write,
) -> io::Result<()> {
    writeln!(out, "{}", case.case.title)?;
    writeln!(
        out,
        "intervals of convergence, 95 %: the limit of each result as its points become finer"
    )?;
    let points = |is_fine: bool| {
        let counts = runs
            .by_size(is_fine)
            .filter_map(|run| run.results.number("points").ok());
        let words: Vec<String> = counts.map(|it| it.to_string()).collect();
        words.join(" and ")
    };
    let (fine, coarse, origin) = (points(true), points(false), &runs.bodies.origin);
    writeln!(
        out,
        "  sizes        {fine} points at h, {coarse} at 2h; {origin}"
    )?;
    // Rows with a reason do not widen their first column.
    let width = results.iter().map(|it| it.label.chars().count());
    let width = width.max().unwrap_or(0).max(HEADING);
    let rows = results.iter().map(|result| words(result, width));
    for line in aligned(&rows.collect::<Vec<_>>(), 2) {
        writeln!(out, "  {line}")?;
    }
    if let Some(paths) = paths {
        writeln!(out, "  crack paths  {}", paths.words())?;
    }
    print_apart(runs, results, out)?;
    for note in &runs.bodies.notes {
        writeln!(out, "  note: {note}")?;
    }
    if results.iter().any(|it| it.interval.is_some()) {
        writeln!(out, "  halve h to halve an interval")?;
    }
    Ok(())
}

/// Prints values outside of the intervals: the difference of the meshers, and the change with the number of bonds.
fn print_apart(runs: &Runs<'_>, results: &[Evaluated], out: &mut dyn Write) -> io::Result<()> {
    let shares = |get: fn(&Evaluated) -> Option<f64>| -> String {
        let known = results
            .iter()
            .filter_map(|it| Some(format!("{} {:+.1} %", it.label, 100.0 * get(it)?)));
        known.collect::<Vec<_>>().join(", ")
    };
    let (mesher, families) = (shares(|it| it.mesher), shares(|it| it.families));
    if !mesher.is_empty() {
        let names: Vec<&str> = runs.by_size(true).map(|run| run.body.mesher).collect();
        let names = format!("{} less {}", names[1], names[0]);
        writeln!(out, "  mesher       {names} at h: {mesher}")?;
    }
    if !families.is_empty() {
        writeln!(
            out,
            "  families     4/3 of the horizon factor at the same horizon: {families}; no refinement changes this, and it is not in the intervals"
        )?;
    }
    Ok(())
}

/// Text of a result for the terminal, with a width of its first column.
fn words(result: &Evaluated, width: usize) -> Vec<String> {
    let label = format!("{:<width$}", result.label);
    let Some(interval) = &result.interval else {
        let reason = result.refused.as_deref().unwrap_or_default();
        return vec![label, format!("refused: {reason}")];
    };
    let unit = PrefixedUnit::new(&result.unit, interval.fine.abs());
    let share = |deviation: f64| 100.0 * deviation / interval.fine.abs();
    let deviation = interval.deviation.map_or_else(
        || "scatter unknown: one run a size".to_owned(),
        |it| format!("scatter {:.1} %", share(it)),
    );
    vec![
        label,
        between([interval.lower, interval.upper], &result.unit),
        format!("at h {}", unit.value(interval.fine)),
        format!("at 2h {}", unit.value(interval.coarse)),
        deviation,
    ]
}

/// A result over the spacing of the points: its runs, the line through the means, and the wedge of orders that ends in the interval at h = 0.
fn plot(runs: &Runs<'_>, result: &Evaluated) -> Plot {
    let in_si = |run: &SizedRun<'_>| {
        let value = run.results.number(&result.name).ok();
        Some([runs.spacing(run)?, value?])
    };
    let largest = runs.runs.iter().filter_map(in_si);
    let largest = largest.fold([0.0; 2], |most: [f64; 2], [spacing, value]| {
        [most[0].max(spacing), most[1].max(value.abs())]
    });
    let units = [("m", largest[0]), (&result.unit, largest[1])]
        .map(|(unit, size)| AxisUnit::new(unit, size));
    let at = |run: &SizedRun<'_>| {
        let [spacing, value] = in_si(run)?;
        Some([spacing * units[0].factor, value * units[1].factor])
    };
    let mut meshers: Vec<&str> = runs.runs.iter().map(|run| run.body.mesher).collect();
    meshers.sort_unstable();
    meshers.dedup();
    let mut series = Vec::new();
    for (mesher, colour) in meshers.iter().zip([Colour::Blue, Colour::Vermilion]) {
        let of_mesher = runs.runs.iter().filter(|run| run.body.mesher == *mesher);
        let points = of_mesher.filter_map(at).collect();
        series.push(Series::circles(*mesher, colour, points));
    }
    let mean = |is_fine: bool| {
        let points: Vec<[f64; 2]> = runs.by_size(is_fine).filter_map(at).collect();
        let n = points.len() as f64;
        [0, 1].map(|axis| points.iter().map(|point| point[axis]).sum::<f64>() / n)
    };
    let words = match result.interval {
        Some(Interval { lower, upper, .. }) => {
            let ends = [lower, upper].map(|end| end * units[1].factor);
            series.extend(wedge([mean(true), mean(false)], ends));
            between([lower, upper], &result.unit)
        }
        None => "no interval".to_owned(),
    };
    Plot::new(
        format!("{}-over-h", result.name),
        format!("{}: {words}", result.label),
        [
            &units[0].label("spacing of the points"),
            &units[1].label(&result.label),
        ],
        series,
    )
}

/// The line through the means at h and 2h, and from h to the ends of the interval at h = 0.
fn wedge([fine, coarse]: [[f64; 2]; 2], ends: [f64; 2]) -> Vec<Series> {
    let at_zero = ends.map(|end| [0.0, end]);
    let to_end = |end| Series::dashes("", Colour::Green, vec![fine, end]);
    let mut series = vec![Series::curve("means", Colour::Black, vec![coarse, fine])];
    series.extend(at_zero.map(to_end));
    series.push(Series::curve("interval", Colour::Green, at_zero.to_vec()));
    series
}
