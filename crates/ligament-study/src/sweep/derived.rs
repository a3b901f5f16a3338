//! The section `[[result]]` of a study: derived columns, as values or as errors relative to a reference.

use std::collections::BTreeMap;
use std::path::Path;

use serde::Deserialize;
use serde::de::IgnoredAny;

use super::axis::{Axis, names, require_axis};
use super::cracks::HEIGHT;
use ligament::suggestion::hint;
use ligament_case::case::decode::decode;
use ligament_case::case::document::{Node, Value};
use ligament_case::case::fault::KeyFault;
use ligament_case::case::key_path::KeyPath;
use ligament_case::case::values::{require, require_column_name, require_unique};
use ligament_output::csv::read::CsvTable;

/// Word for the run with the most points as the reference.
const FINEST: &str = "finest";

/// A column derived from a result.
#[derive(Debug, Clone, PartialEq)]
pub struct DerivedColumn {
    /// Name of the column.
    pub name: String,
    /// The result by its name (see `crate::quantities`), or a result of the cracks (`crack.length`, `crack.area`, `crack.height`).
    pub of: String,
    /// Divisor of the result.
    pub over: f64,
    /// Range of x of a height of the crack path, m; both ends are the same for the height at one x.
    pub range: Option<[f64; 2]>,
    /// Reference for the relative error; None for a column of values.
    pub reference: Option<Reference>,
}

/// A reference of a derived column.
#[derive(Debug, Clone, PartialEq)]
pub enum Reference {
    /// One number for all runs.
    Value(f64),
    /// A column of the table: a key of an axis, a derived column above, or a result.
    Column(String),
    /// The run with the most points along an axis, by the index of the axis.
    Finest(usize),
    /// A number for each combination of values of some axes.
    Table(ReferenceTable),
}

/// References from a table.
#[derive(Debug, Clone, PartialEq)]
pub struct ReferenceTable {
    /// Indices of the axes whose values select the row.
    axes: Vec<usize>,
    /// Reference by the indices of the values on these axes.
    values: BTreeMap<Vec<usize>, f64>,
}

impl ReferenceTable {
    /// The reference of a run by the indices of its values on all axes.
    pub(super) fn value(&self, place: &[usize]) -> Option<f64> {
        let key: Vec<usize> = self.axes.iter().map(|axis| place[*axis]).collect();
        self.values.get(&key).copied()
    }
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct RawDerived {
    name: String,
    of: String,
    over: Option<f64>,
    at: Option<f64>,
    from: Option<f64>,
    to: Option<f64>,
    #[serde(rename = "reference")]
    _reference: Option<IgnoredAny>,
    along: Option<String>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct RawTable {
    file: String,
    column: String,
    #[serde(rename = "key")]
    _key: IgnoredAny,
}

/// The parts of a study that its derived columns need.
#[derive(Clone, Copy)]
pub(super) struct Surroundings<'a> {
    /// Parsed text of the study.
    pub(super) document: &'a Node,
    /// Axes of the study.
    pub(super) axes: &'a [Axis],
    /// Folder of the study file.
    pub(super) folder: &'a Path,
}

/// Checks all derived columns of a study.
pub(super) fn check_columns(
    raw: Vec<RawDerived>,
    study: Surroundings<'_>,
    root: &KeyPath,
) -> Result<Vec<DerivedColumn>, KeyFault> {
    let place = |index: usize| root.child("result").child(index);
    let raw = raw.into_iter().enumerate();
    let derived: Vec<DerivedColumn> = raw
        .map(|(index, it)| it.check(study, &place(index)))
        .collect::<Result<_, _>>()?;
    let names = derived.iter().enumerate();
    require_unique(
        names.map(|(index, it)| (place(index).child("name"), it.name.as_str())),
        "",
    )?;
    Ok(derived)
}

impl RawDerived {
    fn check(self, study: Surroundings<'_>, place: &KeyPath) -> Result<DerivedColumn, KeyFault> {
        let over = self.over.unwrap_or(1.0);
        require_column_name(|| place.child("name"), &self.name)?;
        require(over != 0.0, || place.child("over"), "other than 0", over)?;
        let range = self.range(place)?;
        let reference = reference(study, self.along.as_deref(), place)?;
        Ok(DerivedColumn {
            name: self.name,
            of: self.of,
            over,
            range,
            reference,
        })
    }

    /// The range of x of a height.
    fn range(&self, place: &KeyPath) -> Result<Option<[f64; 2]>, KeyFault> {
        let given = [("at", self.at), ("from", self.from), ("to", self.to)];
        let first = given.iter().find(|it| it.1.is_some());
        match (self.of == HEIGHT, self.at, self.from, self.to) {
            (false, ..) => match first {
                Some((key, _)) => {
                    let fault = format!("`{key}` is a place along x of `of = \"{HEIGHT}\"`");
                    Err(KeyFault::new(place.child(key), fault))
                }
                None => Ok(None),
            },
            (true, Some(at), None, None) => Ok(Some([at, at])),
            (true, None, Some(from), Some(to)) => {
                let range = || place.child("from");
                require(from < to, range, "less than `to`", from)?;
                Ok(Some([from, to]))
            }
            (true, ..) => {
                let fault = "the height of a crack path is that at one x or the mean over a range: give `at`, or `from` and `to`, m";
                Err(KeyFault::new(place.child("of"), fault))
            }
        }
    }
}

/// Reads the reference of the derived column at a place of the study, if there is one.
fn reference(
    study: Surroundings<'_>,
    along: Option<&str>,
    place: &KeyPath,
) -> Result<Option<Reference>, KeyFault> {
    let at = place.child("reference");
    let node = study.document.at(&at);
    let is_finest = node.is_some_and(|it| it.value == Value::String(FINEST.to_owned()));
    if along.is_some() && !is_finest {
        let fault = format!("`along` is the axis of `reference = \"{FINEST}\"`");
        return Err(KeyFault::new(place.child("along"), fault));
    }
    let Some(node) = node else { return Ok(None) };
    Ok(Some(match &node.value {
        Value::String(_) if is_finest => Reference::Finest(refined_axis(study.axes, along, place)?),
        Value::String(name) => Reference::Column(name.clone()),
        Value::Table(_) => Reference::Table(table(study, node, &at)?),
        Value::Integer(_) | Value::Float(_) => {
            let value: f64 = decode(node, &at)?;
            let is_possible = value.is_finite() && value != 0.0;
            require(is_possible, || at.clone(), "a number other than 0", value)?;
            Reference::Value(value)
        }
        _ => {
            let fault = format!(
                "expected a number, the name of a column, \"{FINEST}\", or {{ file = \"..\", column = \"..\", key = \"..\" }}"
            );
            return Err(KeyFault::new(at, fault));
        }
    }))
}

/// The axis along which the body is refined: the given one, or the only one of meshes, of the lattice or of the geometry.
fn refined_axis(axes: &[Axis], along: Option<&str>, place: &KeyPath) -> Result<usize, KeyFault> {
    if let Some(along) = along {
        return require_axis(axes, along, || place.child("along"));
    }
    let refines = |axis: &Axis| {
        let of_body = |key: &String| key.starts_with("mesh.") || key.starts_with("lattice.");
        axis.of_geometry || axis.keys.iter().any(of_body)
    };
    let mut found = (0..axes.len()).filter(|axis| refines(&axes[*axis]));
    match (found.next(), found.next()) {
        (Some(only), None) => Ok(only),
        _ => {
            let fault = format!(
                "`reference = \"{FINEST}\"` is the run with the most points along one axis, and which one is not clear: name it, \
                 `along = \"mesh.file\"`"
            );
            Err(KeyFault::new(place.child("reference"), fault))
        }
    }
}

/// Reads the table of references; every combination of values of its axes must have a row.
fn table(
    study: Surroundings<'_>,
    node: &Node,
    place: &KeyPath,
) -> Result<ReferenceTable, KeyFault> {
    let raw: RawTable = decode(node, place)?;
    let keys = names(study.document, &place.child("key"))?;
    let path = study.folder.join(&raw.file);
    let sheet = CsvTable::read(&path)
        .map_err(|error| KeyFault::new(place.child("file"), error.to_string()))?;
    let column = |key: &str, name: &str| -> Result<Vec<String>, KeyFault> {
        let texts = sheet.texts(name).ok_or_else(|| {
            let known = hint(name, sheet.columns(), "columns", '`');
            let fault = format!("{} has no column `{name}`{known}", path.display());
            KeyFault::new(place.child(key), fault)
        })?;
        Ok(texts.map(|it| it.trim().to_owned()).collect())
    };
    let numbers = column("column", &raw.column)?;
    let (mut axes, mut selectors) = (Vec::new(), Vec::new());
    for key in &keys {
        let axis = require_axis(study.axes, key, || place.child("key"))?;
        axes.push(axis);
        selectors.push(Selector {
            axis: &study.axes[axis],
            key,
            texts: column("key", key)?,
        });
    }
    let sizes: Vec<usize> = axes.iter().map(|it| study.axes[*it].points.len()).collect();
    let mut values = BTreeMap::new();
    for indices in combinations(&sizes) {
        let value = only_number(&selectors, &indices, &numbers).map_err(|reason| {
            let fault = format!("{} {reason}", path.display());
            KeyFault::new(place.child("file"), fault)
        })?;
        values.insert(indices, value);
    }
    Ok(ReferenceTable { axes, values })
}

/// A column of a table of references that selects rows by the values of an axis.
struct Selector<'a> {
    axis: &'a Axis,
    key: &'a str,
    texts: Vec<String>,
}

/// The number in the only row with these values of the axes, or the reason why there is none.
fn only_number(
    selectors: &[Selector<'_>],
    indices: &[usize],
    numbers: &[String],
) -> Result<f64, String> {
    let chosen = || {
        let all = selectors.iter().zip(indices);
        all.map(|(it, index)| (it, &it.axis.points[*index]))
    };
    let is_row = |row: &usize| {
        let mut all = chosen();
        all.all(|(it, point)| it.axis.is_value(point, it.key, &it.texts[*row]))
    };
    let reason = |what: String| {
        let values = chosen().map(|(it, point)| {
            let words = it.axis.value_words(point, it.key);
            format!("{} = {words}", it.key)
        });
        let values: Vec<String> = values.collect();
        format!("has {what} for the runs with {}", values.join(", "))
    };
    let rows: Vec<usize> = (0..numbers.len()).filter(is_row).collect();
    let [row] = rows[..] else {
        return Err(reason(match rows.len() {
            0 => "no row".to_owned(),
            count => format!("{count} rows"),
        }));
    };
    let number = numbers[row].parse::<f64>().ok();
    let number = number.filter(|it| it.is_finite() && *it != 0.0);
    number.ok_or_else(|| reason(format!("`{}`, no number other than 0,", numbers[row])))
}

/// All combinations of indices below some sizes, the last index varying fastest.
pub(super) fn combinations(sizes: &[usize]) -> Vec<Vec<usize>> {
    let mut all = vec![Vec::new()];
    for &size in sizes {
        let longer = |it: &Vec<usize>| {
            let it = it.clone();
            (0..size).map(move |index| [it.clone(), vec![index]].concat())
        };
        all = all.iter().flat_map(longer).collect();
    }
    all
}
