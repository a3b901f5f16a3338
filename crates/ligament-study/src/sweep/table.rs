//! The table of a study: one row per run, a typed column for each axis, result and input.

use std::collections::BTreeSet;
use std::path::Path;

use ligament_output::csv::{self, Value};
use serde_json::Value as Cell;

use super::plan::{Run, short_keys};
use super::record::Status;
use super::study::Study;
use super::written::words;
use crate::quantities::{Quantities, flatten};
use ligament::suggestion::hint;

/// Prefix of the keys of inputs, which distinguishes them from results.
pub(super) const INPUT: &str = "case.";

/// Table with one row per run, in the order of the study.
#[derive(Debug, Clone, PartialEq, Default)]
pub(super) struct StudyTable {
    columns: Vec<Column>,
}

/// A column, whose cells have one type or are null.
#[derive(Debug, Clone, PartialEq)]
struct Column {
    name: String,
    /// One cell per run.
    cells: Vec<Cell>,
}

/// Error of a missing column of numbers.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[error(
    "no column of numbers is called `{name}`{}",
    hint(name, known, "there are", '`')
)]
pub(super) struct NoColumn {
    /// The name.
    pub(super) name: String,
    /// The columns of numbers.
    pub(super) known: Vec<String>,
}

/// A run as a row.
pub(super) struct Row<'a> {
    /// The run.
    pub(super) run: &'a Run,
    /// Status of the run.
    pub(super) status: Status,
    /// Folder of the run's results.
    pub(super) folder: String,
}

impl StudyTable {
    /// The table of some runs.
    pub(super) fn from_rows(study: &Study, rows: &[Row<'_>]) -> Self {
        let mut table = Self::default();
        table.add("run", rows, |row| Cell::from(row.run.name.as_str()));
        table.add("status", rows, |row| Cell::from(row.status.word()));
        table.add_axes(study, rows);
        for derived in &study.derived {
            table.add(&derived.name, rows, |row| {
                let value = results(row).and_then(|it| it.number(&derived.of).ok());
                value.map_or(Cell::Null, |value| Cell::from(value / derived.over))
            });
        }
        let known = rows.iter().filter_map(results);
        let names = in_order(known.map(|it| it.iter().map(|(name, _)| name.to_owned())));
        for name in names {
            let cell = |row: &Row<'_>| results(row).and_then(|it| it.get(&name).cloned());
            table.add(&name, rows, |row| cell(row).unwrap_or_default());
        }
        table.add("error", rows, |row| match &row.status {
            Status::Failed(reason) => Cell::from(reason.as_str()),
            _ => Cell::Null,
        });
        table.add("folder", rows, |row| match &row.status {
            Status::Done(_) => Cell::from(row.folder.as_str()),
            _ => Cell::Null,
        });
        table.add_inputs(study, rows);
        table
    }

    fn add_axes(&mut self, study: &Study, rows: &[Row<'_>]) {
        let names = short_keys(&study.axes);
        for (index, axis) in study.axes.iter().enumerate() {
            let point = |row: &Row<'_>| axis.points[row.run.place[index]].clone();
            for (k, key) in axis.keys.iter().enumerate() {
                self.add(key, rows, |row| point(row).cells[k].clone());
            }
            if axis.is_labelled {
                let name = format!("{}.label", names[index][0]);
                self.add(&name, rows, |row| Cell::from(point(row).label));
            }
        }
    }

    /// Adds columns of all inputs that no axis varies.
    fn add_inputs(&mut self, study: &Study, rows: &[Row<'_>]) {
        let inputs: Vec<Vec<(String, Cell)>> = rows.iter().map(|row| inputs(row.run)).collect();
        let names = in_order(
            inputs
                .iter()
                .map(|of| of.iter().map(|(name, _)| name.clone())),
        );
        let keys: BTreeSet<&String> = study.axes.iter().flat_map(|axis| &axis.keys).collect();
        for name in names.iter().filter(|name| !keys.contains(name)) {
            let cell = |of: &Vec<(String, Cell)>| {
                let found = of.iter().find(|(other, _)| other == name);
                found.map_or(Cell::Null, |(_, cell)| cell.clone())
            };
            self.push(format!("{INPUT}{name}"), inputs.iter().map(cell).collect());
        }
    }

    fn add(&mut self, name: &str, rows: &[Row<'_>], cell: impl Fn(&Row<'_>) -> Cell) {
        // A result with the name of an axis or a derived result gets a prefix.
        let is_taken = self.columns.iter().any(|column| column.name == name);
        let name = if is_taken {
            format!("result.{name}")
        } else {
            name.to_owned()
        };
        self.push(name, rows.iter().map(cell).collect());
    }

    fn push(&mut self, name: String, cells: Vec<Cell>) {
        let cells = of_one_type(cells);
        self.columns.push(Column { name, cells });
    }

    /// The numbers of a column, shape (n_runs); `None` where a run has none. Inputs may be named without their prefix.
    pub(super) fn numbers(&self, name: &str) -> Result<Vec<Option<f64>>, NoColumn> {
        let is_number = |column: &&Column| column.cells.iter().any(Cell::is_number);
        let by_name = |name: &str| self.columns.iter().find(|column| column.name == name);
        let found = by_name(name).or_else(|| by_name(&format!("{INPUT}{name}")));
        match found.filter(is_number) {
            Some(column) => Ok(column.cells.iter().map(Cell::as_f64).collect()),
            None => Err(NoColumn {
                name: name.to_owned(),
                known: (self.columns.iter().filter(is_number))
                    .map(|column| column.name.clone())
                    .collect(),
            }),
        }
    }

    /// Writes the table as CSV, with empty fields for missing values.
    pub(super) fn write_csv(&self, path: &Path) -> Result<(), ligament_output::Error> {
        let names = self.columns.iter().map(|column| Value::Text(&column.name));
        let mut text = csv::line(&names.collect::<Vec<_>>());
        let n_rows = self.columns.first().map_or(0, |column| column.cells.len());
        for row in 0..n_rows {
            let cells: Vec<Value<'_>> = self
                .columns
                .iter()
                .map(|it| value(&it.cells[row]))
                .collect();
            text += &csv::line(&cells);
        }
        ligament_output::replace_file(path, text.as_bytes())
    }
}

fn value(cell: &Cell) -> Value<'_> {
    match cell {
        Cell::Null => Value::Missing,
        Cell::Bool(true) => Value::Text("true"),
        Cell::Bool(false) => Value::Text("false"),
        Cell::String(text) => Value::Text(text),
        number => match number.as_i64() {
            Some(integer) => Value::Integer(integer),
            None => Value::Float(number.as_f64().unwrap_or(f64::NAN)),
        },
    }
}

/// The cells of a column in their narrowest common type: integers of 64 bits, numbers, Booleans or texts, with null in any.
fn of_one_type(cells: Vec<Cell>) -> Vec<Cell> {
    let all = |is: fn(&Cell) -> bool| cells.iter().all(|cell| cell.is_null() || is(cell));
    if all(Cell::is_i64) || all(Cell::is_boolean) {
        return cells;
    }
    let are_numbers = all(Cell::is_number);
    let cell = |cell: &Cell| match cell {
        Cell::Null => Cell::Null,
        number if are_numbers => Cell::from(number.as_f64()),
        other => Cell::from(words(other)),
    };
    cells.iter().map(cell).collect()
}

fn results<'a>(row: &'a Row<'_>) -> Option<&'a Quantities> {
    match &row.status {
        Status::Done(results) => Some(results),
        _ => None,
    }
}

/// The inputs of a run by their keys.
pub(super) fn inputs(run: &Run) -> Vec<(String, Cell)> {
    let mut all = Vec::new();
    // A case whose paths are not UTF-8 has no inputs in the table, and cannot be run.
    let case = serde_json::to_value(&run.case.case).unwrap_or_default();
    for (name, value) in case.as_object().into_iter().flatten() {
        flatten(name.clone(), value, &mut all);
    }
    // Keys without a value are not inputs.
    all.retain(|(_, cell)| !cell.is_null());
    all
}

/// Union of several lists of names, in the order of the first list; further names follow their predecessor.
fn in_order(lists: impl Iterator<Item = impl Iterator<Item = String>>) -> Vec<String> {
    let mut names: Vec<String> = Vec::new();
    let mut seen = BTreeSet::new();
    for list in lists {
        let mut after = 0;
        for name in list {
            if seen.insert(name.clone()) {
                names.insert(after, name);
                after += 1;
            } else if let Some(place) = names.iter().position(|other| *other == name) {
                after = place + 1;
            }
        }
    }
    names
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::json;

    #[test]
    fn columns_have_the_narrowest_type() {
        for (cells, typed) in [
            (json!([1, null]), json!([1, null])),
            (json!([1, 2.5]), json!([1.0, 2.5])),
            (json!([u64::MAX]), json!([u64::MAX as f64])),
            (json!([true, false]), json!([true, false])),
            (json!([1, true, "a"]), json!(["1", "true", "a"])),
            (json!([null]), json!([null])),
        ] {
            let cells = cells.as_array().unwrap().clone();
            assert_eq!(Cell::from(of_one_type(cells)), typed);
        }
    }

    #[test]
    fn names_keep_their_neighbours() {
        let lists = [vec!["a", "c", "d"], vec!["a", "b", "c"], vec!["e", "a"]];
        let lists = lists
            .iter()
            .map(|list| list.iter().map(|name| (*name).to_owned()));
        assert_eq!(in_order(lists), ["e", "a", "b", "c", "d"]);
    }
}
