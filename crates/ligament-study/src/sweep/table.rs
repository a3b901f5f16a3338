//! The table of a study: one row per run, a typed column for each axis, result and input.

use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

use anyhow::Context;
use ligament_output::csv::read::CsvTable;
use ligament_output::csv::{self, Value};
use serde_json::{Map, Value as Cell};

use super::cracks::{AREA, CrackResults, LENGTH};
use super::plan::{Run, short_keys};
use super::record::Status;
use super::study::Study;
use super::toml_text::words;
use crate::quantities::{Quantities, flatten};
use ligament::suggestion::hint;

/// File of the table in the folder of a sweep.
pub(super) const TABLE: &str = "table.csv";

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
pub(super) struct UnknownColumn {
    /// Name of the column.
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
    /// Cracks of the run, if the study names a result of them and they can be read.
    pub(super) cracks: Option<CrackResults>,
}

impl Row<'_> {
    /// Results of the run, if it is done.
    pub(super) fn results(&self) -> Option<&Quantities> {
        match &self.status {
            Status::Done(results) => Some(results),
            _ => None,
        }
    }

    /// The number of a result, if the run is done and has it.
    pub(super) fn number(&self, name: &str) -> Option<f64> {
        let of_cracks = || self.cracks.as_ref()?.number(name);
        let results = self.results()?;
        results.number(name).ok().or_else(of_cracks)
    }

    /// The cells of the row, by their columns, with the values of the derived columns.
    fn cells(
        &self,
        study: &Study,
        short_keys: &[Vec<String>],
        derived: &[Option<f64>],
    ) -> Map<String, Cell> {
        let mut cells = Map::new();
        let mut add = |name: &str, cell: Cell| {
            // A result with the name of an axis or a derived result gets a prefix.
            let prefix = if cells.contains_key(name) {
                "result."
            } else {
                ""
            };
            cells.insert(format!("{prefix}{name}"), cell);
        };
        add("run", Cell::from(self.run.name.as_str()));
        add("status", Cell::from(self.status.word()));
        for ((axis, point), short) in self.run.points(study).zip(short_keys) {
            for (key, cell) in axis.keys.iter().zip(&point.cells) {
                add(key, cell.clone());
            }
            if axis.is_labelled {
                add(
                    &format!("{}.label", short[0]),
                    Cell::from(point.label.as_str()),
                );
            }
        }
        let results = self.results();
        for (column, value) in study.derived.iter().zip(derived) {
            add(&column.name, Cell::from(*value));
        }
        if let Some(cracks) = &self.cracks {
            for name in [LENGTH, AREA] {
                add(name, Cell::from(cracks.number(name)));
            }
        }
        for (name, value) in results.into_iter().flat_map(Quantities::iter) {
            add(name, value.clone());
        }
        let reason = match &self.status {
            Status::Failed(reason) => Some(reason.as_str()),
            _ => None,
        };
        add("error", Cell::from(reason));
        add("folder", Cell::from(results.map(|_| self.folder.as_str())));
        let inputs = inputs(self.run).into_iter();
        cells.extend(inputs.map(|(name, cell)| (format!("{INPUT}{name}"), cell)));
        cells
    }
}

impl StudyTable {
    /// The table of some runs with the values of their derived columns, shape (n_runs, n_columns).
    pub(super) fn from_rows(study: &Study, rows: &[Row<'_>], derived: &[Vec<Option<f64>>]) -> Self {
        let keys = short_keys(&study.axes);
        let rows = rows.iter().zip(derived);
        let cells = rows.map(|(row, derived)| row.cells(study, &keys, derived));
        let rows: Vec<Map<String, Cell>> = cells.collect();
        let mut names = in_order(rows.iter().map(Map::keys));
        // An axis has a column of its own.
        let keys = study.axes.iter().flat_map(|axis| &axis.keys);
        let varied: BTreeSet<String> = keys.map(|key| format!("{INPUT}{key}")).collect();
        names.retain(|name| !varied.contains(name));
        let column = |name: String| {
            let cells = rows.iter().map(|row| row.get(&name).cloned());
            let cells = with_common_type(cells.map(Option::unwrap_or_default).collect());
            Column { name, cells }
        };
        Self {
            columns: names.into_iter().map(column).collect(),
        }
    }

    /// The numbers of a column, shape (n_runs); `None` where a run has none. Inputs may be named without their prefix.
    pub(super) fn numbers(&self, name: &str) -> Result<Vec<Option<f64>>, UnknownColumn> {
        let is_number = |column: &&Column| column.cells.iter().any(Cell::is_number);
        let by_name = |name: &str| self.columns.iter().find(|column| column.name == name);
        let found = by_name(name).or_else(|| by_name(&format!("{INPUT}{name}")));
        match found.filter(is_number) {
            Some(column) => Ok(column.cells.iter().map(Cell::as_f64).collect()),
            None => Err(UnknownColumn {
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

/// The completed runs of the table in a folder of a sweep, with labels that distinguish them. Results that a collection found in folders of
/// other machines are where the table names them.
///
/// # Errors
///
/// If there is no such table, or no run of it is done.
pub(super) fn completed_runs(folder: &Path) -> anyhow::Result<Vec<(String, PathBuf)>> {
    let path = folder.join(TABLE);
    let sheet = CsvTable::read(&path).with_context(|| {
        let folder = folder.display();
        format!("{folder} has no table of its runs yet: ligament sweep STUDY.toml --collect --out {folder} makes it")
    })?;
    let rows = sheet.rows(|row| {
        let [run, status, results] =
            ["run", "status", "folder"].map(|name| row.value::<String>(name));
        Ok((run?, status?, results?))
    })?;
    let done: Vec<(String, PathBuf)> = (rows.into_iter())
        .filter(|(_, status, _)| status == "done")
        .map(|(run, _, results)| {
            let own = folder.join("runs").join(&run);
            let results = if own.is_dir() { own } else { results.into() };
            (run, results)
        })
        .collect();
    anyhow::ensure!(!done.is_empty(), "no run of {} is done", path.display());
    let settings = done.iter().map(|(run, _)| run.split(',').collect());
    let settings: Vec<Vec<&str>> = settings.collect();
    let differs = |it: &&&str| done.len() == 1 || !settings.iter().all(|all| all.contains(*it));
    let labels = settings.iter().map(|all| {
        let shown: Vec<&str> = all.iter().filter(differs).copied().collect();
        shown.join(", ").replace('=', " = ")
    });
    let labels: Vec<String> = labels.collect();
    let folders = done.into_iter().map(|(_, folder)| folder);
    Ok(labels.into_iter().zip(folders).collect())
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
fn with_common_type(cells: Vec<Cell>) -> Vec<Cell> {
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
fn in_order<'a>(lists: impl Iterator<Item = impl Iterator<Item = &'a String>>) -> Vec<String> {
    let mut names: Vec<String> = Vec::new();
    let mut seen = BTreeSet::new();
    for list in lists {
        let mut after = 0;
        for name in list {
            if seen.insert(name) {
                names.insert(after, name.clone());
            } else if names.get(after) != Some(name) {
                after = names.iter().position(|it| it == name).unwrap_or(after);
            }
            after += 1;
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
            assert_eq!(Cell::from(with_common_type(cells)), typed);
        }
    }

    #[test]
    fn names_keep_their_neighbours() {
        let lists = [vec!["a", "c", "d"], vec!["a", "b", "c"], vec!["e", "a"]];
        let lists = lists.map(|list| list.into_iter().map(str::to_owned).collect::<Vec<_>>());
        let names = in_order(lists.iter().map(|list| list.iter()));
        assert_eq!(names, ["e", "a", "b", "c", "d"]);
    }
}
