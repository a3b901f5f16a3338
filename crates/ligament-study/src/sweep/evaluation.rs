//! Values of the derived columns of a study for its runs.

use super::cracks::{HEIGHT, LENGTH, NAMES};
use super::derived::{DerivedColumn, Reference};
use super::study::{PlotContent, Study};
use super::table::{INPUT, Row, inputs};
use ligament_case::case::key_path::KeyPath;

/// Values of the derived columns, with remarks for the user.
#[derive(Debug, Default)]
pub(super) struct DerivedValues {
    /// Values in the order of the columns, shape (n_runs, n_columns); None where a run has none.
    pub(super) values: Vec<Vec<Option<f64>>>,
    /// Remarks about values that are missing or may mislead.
    pub(super) remarks: Vec<String>,
}

impl DerivedValues {
    /// Evaluates all columns in their order, so that a reference may be a column above.
    pub(super) fn new(study: &Study, rows: &[Row<'_>]) -> Self {
        let mut all = Self {
            values: vec![Vec::new(); rows.len()],
            remarks: Vec::new(),
        };
        for (index, derived) in study.derived.iter().enumerate() {
            let location = study.location(&KeyPath(vec!["result".to_owned(), index.to_string()]));
            let remark = |text: String| format!("{location}: `{}`: {text}", derived.name);
            let own = |row: &Row<'_>| value(row, derived).map(|it| it / derived.over);
            let own: Vec<Option<f64>> = rows.iter().map(own).collect();
            let short = rows.iter().zip(&own);
            let short = short.filter(|(row, own)| own.is_none() && row.results().is_some());
            let short: Vec<&str> = short.map(|(row, _)| row.run.name.as_str()).collect();
            if let (HEIGHT, [first, ..]) = (derived.of.as_str(), &short[..]) {
                all.remarks.push(remark(format!(
                    "no crack line leads over the whole range of x in {} runs, the first of which is {first}",
                    short.len()
                )));
            }
            let references = match &derived.reference {
                None => None,
                Some(Reference::Finest(axis)) => {
                    let (finest, unsure) = finest(rows, &own, *axis);
                    all.remarks.extend(unsure.map(remark));
                    Some(finest)
                }
                Some(other) => {
                    let of = |(row, above): (&Row<'_>, &Vec<Option<f64>>)| {
                        reference(other, study, row, above)
                    };
                    Some(rows.iter().zip(&all.values).map(of).collect())
                }
            };
            for (run, values) in all.values.iter_mut().enumerate() {
                values.push(match &references {
                    None => own[run],
                    Some(references) => relative_error(own[run], references[run]),
                });
            }
        }
        all
    }
}

/// Whether a study names a result of cracks, so that they are read.
pub(super) fn needs_cracks(study: &Study) -> bool {
    names_of_results(study).any(|name| NAMES.contains(&name))
}

/// Names of results in the derived columns and the plots of a study.
fn names_of_results(study: &Study) -> impl Iterator<Item = &str> {
    let derived = study.derived.iter().flat_map(|it| {
        let reference = match &it.reference {
            Some(Reference::Column(name)) => Some(name.as_str()),
            _ => None,
        };
        [Some(it.of.as_str()), reference]
    });
    let plots = study.plots.iter().flat_map(|it| match &it.content {
        PlotContent::Columns { x, y } => [Some(x.as_str()), Some(y.as_str())],
        PlotContent::Curves { .. } | PlotContent::CrackPaths => [None, None],
    });
    derived.chain(plots).flatten()
}

/// Whether a study names a result of cracks that solids do not have.
pub(super) fn needs_crack_lines(study: &Study) -> bool {
    names_of_results(study).any(|name| [LENGTH, HEIGHT].contains(&name))
}

/// The result of a derived column in a run, before it is divided.
fn value(row: &Row<'_>, derived: &DerivedColumn) -> Option<f64> {
    match derived.range {
        Some(range) => row.cracks.as_ref()?.height(range),
        None => row.number(&derived.of),
    }
}

/// The reference of a run; `above` has the values of the columns above.
fn reference(
    reference: &Reference,
    study: &Study,
    row: &Row<'_>,
    above: &[Option<f64>],
) -> Option<f64> {
    match reference {
        Reference::Value(value) => Some(*value),
        Reference::Table(table) => table.value(&row.run.place),
        Reference::Column(name) => {
            let of_axis = row
                .run
                .points(study)
                .find_map(|(axis, point)| axis.cell(point, name));
            if let Some(cell) = of_axis {
                return cell.as_f64();
            }
            let place = study.derived.iter().position(|it| it.name == *name);
            if let Some(value) = place.and_then(|it| above.get(it)) {
                return *value;
            }
            let input = || {
                let name = name.strip_prefix(INPUT).unwrap_or(name);
                let mut inputs = inputs(row.run).into_iter();
                inputs.find(|(it, _)| it == name)?.1.as_f64()
            };
            row.number(name).or_else(input)
        }
        Reference::Finest(_) => None,
    }
}

/// For each run, the value of the run with the most points among runs that differ only along one axis, and a remark where some of these are missing.
fn finest(
    rows: &[Row<'_>],
    own: &[Option<f64>],
    axis: usize,
) -> (Vec<Option<f64>>, Option<String>) {
    let mut others = std::collections::BTreeMap::<Vec<usize>, Vec<usize>>::new();
    let key = |row: &Row<'_>| {
        let mut key = row.run.place.clone();
        key[axis] = 0;
        key
    };
    for (index, row) in rows.iter().enumerate() {
        others.entry(key(row)).or_default().push(index);
    }
    let finest = |row: &Row<'_>| {
        let mut best: Option<(f64, Option<f64>)> = None;
        for &run in &others[&key(row)] {
            let points = rows[run].number("points");
            if let Some(points) = points.filter(|it| best.is_none_or(|best| *it > best.0)) {
                best = Some((points, own[run]));
            }
        }
        best.and_then(|it| it.1)
    };
    let missing = rows.iter().filter(|row| row.results().is_none()).count();
    let remark = (missing > 0).then(|| {
        format!("{missing} runs are not done: the reference is the finest of those that are")
    });
    (rows.iter().map(finest).collect(), remark)
}

/// Error of a value relative to a reference; None without one of them, or where the reference is 0.
fn relative_error(value: Option<f64>, reference: Option<f64>) -> Option<f64> {
    let reference = reference.filter(|it| *it != 0.0)?;
    Some(value? / reference - 1.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn errors_are_relative_to_their_reference() {
        assert_eq!(relative_error(Some(3.0), Some(2.0)), Some(0.5));
        assert_eq!(relative_error(Some(3.0), Some(-2.0)), Some(-2.5));
        assert_eq!(relative_error(Some(3.0), Some(0.0)), None);
        assert_eq!(relative_error(None, Some(2.0)), None);
    }
}
