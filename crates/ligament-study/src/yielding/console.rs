//! Printed results.

use std::io::{self, Write};

use ligament_post::yielding::PrincipalStretches;

use super::diagrams::{Comparison, PATHS};
use super::subject::Subject;

/// Prints the errors of all paths, one column per family, as MPPD Tables 7 to 9, and the measure of those tables.
pub(super) fn write(out: &mut dyn Write, comparison: &Comparison) -> anyhow::Result<()> {
    let Comparison {
        criterion,
        subjects,
    } = comparison;
    writeln!(
        out,
        "{criterion}: largest error of first yield over the orientation, %"
    )?;
    write_table(out, subjects, |subject, path| {
        Ok(subject.family().worst(path).map(|it| it.error))
    })?;
    let has_table = |subject: &Subject| {
        let mut printed = PATHS.into_iter().map(|path| subject.printed_measure(path));
        printed.any(|it| matches!(it, Ok(Some(_))))
    };
    if subjects.iter().all(has_table) {
        writeln!(
            out,
            "  the measure of the MPPD paper's tables (101 orientations, atan at s0t = 0.1), %"
        )?;
        write_table(out, subjects, |subject, path| {
            Ok(subject.printed_measure(path)?.map(|it| it.error))
        })?;
    }
    Ok(writeln!(out)?)
}

fn write_table(
    out: &mut dyn Write,
    subjects: &[Subject],
    error: impl Fn(&Subject, PrincipalStretches) -> anyhow::Result<Option<f64>>,
) -> anyhow::Result<()> {
    let width = subjects.iter().map(|it| it.name.chars().count() + 2);
    let width = width.fold(10, usize::max);
    let names = subjects.iter().map(|it| it.name.clone());
    write_row(out, width, ["s1", "s2"].map(str::to_owned), names)?;
    let bonds = subjects.iter().map(|it| format!("{} bonds", it.size));
    write_row(out, width, ["at yield".to_owned(), String::new()], bonds)?;
    for path in PATHS {
        let theory = subjects[0].family().theoretical_utilisation(path);
        let errors = subjects.iter().map(|subject| error(subject, path));
        let errors: Vec<Option<f64>> = errors.collect::<Result<_, _>>()?;
        if errors.iter().all(Option::is_none) {
            continue;
        }
        let at_yield = path.scaled(1.0 / theory);
        let strains = [at_yield.first, at_yield.second].map(short);
        let percent =
            |it: Option<f64>| it.map_or("-".to_owned(), |it| format!("{:.2}", 100.0 * it));
        write_row(out, width, strains, errors.into_iter().map(percent))?;
    }
    Ok(())
}

/// A number with three decimals, or in exponential notation: strains may be of order one or 1e-4.
fn short(value: f64) -> String {
    if value == 0.0 || (0.01..1000.0).contains(&value.abs()) {
        format!("{:.3}", value + 0.0)
    } else {
        format!("{value:.3e}")
    }
}

fn write_row(
    out: &mut dyn Write,
    width: usize,
    [first, second]: [String; 2],
    cells: impl Iterator<Item = String>,
) -> io::Result<()> {
    let cells: Vec<String> = cells.map(|cell| format!("{cell:>width$}")).collect();
    writeln!(out, "  {first:>10}{second:>10}{}", cells.concat())
}
