//! The axes of a study: keys and their values.

use serde::Deserialize;
use serde::de::IgnoredAny;
use serde_json::Value as Cell;

use super::toml_text;
use ligament_case::case::Fault;
use ligament_case::case::decode::decode;
use ligament_case::case::document::{Node, Value};
use ligament_case::case::fault::KeyFault;
use ligament_case::case::key_path::KeyPath;
use ligament_case::case::values::{one_of, require, require_no_formula, require_unique};

/// Largest number of values of an axis.
const MOST_VALUES: usize = 10_000;

/// Significant digits of the values of a range, few enough for 1.5 + 3 * 0.1 to be 1.8.
const DIGITS: usize = 12;

/// A setting of a run in the form of `--set`.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Setting {
    /// Text `key=value`.
    pub(crate) given: String,
    /// Place of the setting in the study.
    pub(crate) place: KeyPath,
}

/// A key, or keys that vary together, with their values.
#[derive(Debug, Clone, PartialEq)]
pub struct Axis {
    /// The keys of the case file, or the one number of the geometry.
    pub keys: Vec<String>,
    /// Whether the key is a number of the geometry.
    pub of_geometry: bool,
    /// Whether the study gives labels.
    pub is_labelled: bool,
    /// Values of the axis, in their order.
    pub points: Vec<AxisPoint>,
}

/// A value of an axis.
#[derive(Debug, Clone, PartialEq)]
pub struct AxisPoint {
    /// A value for each key, for tables.
    pub cells: Vec<Cell>,
    /// The values of the keys as TOML.
    pub(crate) texts: Vec<String>,
    /// Label of the value in plots and texts.
    pub label: String,
    /// Place of the value in the study.
    pub(crate) place: KeyPath,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct RawAxis {
    key: Option<String>,
    keys: Option<Vec<String>>,
    number: Option<String>,
    values: Option<IgnoredAny>,
    range: Option<RawRange>,
    labels: Option<Vec<String>>,
}

#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct RawRange {
    from: f64,
    to: f64,
    step: Option<f64>,
    count: Option<usize>,
    #[serde(default)]
    log: bool,
}

impl RawAxis {
    /// Checks the axis at a place of the study.
    pub(super) fn check(self, document: &Node, place: &KeyPath) -> Result<Axis, KeyFault> {
        let (paired, of_geometry) = (self.keys.is_some(), self.number.is_some());
        let [key, number] = [self.key, self.number].map(|it| it.map(|name| vec![name]));
        let keys = [("key", key), ("keys", self.keys), ("number", number)];
        let mut keys = one_of(place, keys)?;
        for (k, key) in keys.iter_mut().enumerate().filter(|_| !of_geometry) {
            *key = match paired {
                true => canonical(key, &place.child("keys").child(k))?,
                false => canonical(key, &place.child("key"))?,
            };
        }
        require(
            !keys.is_empty(),
            || place.child("keys"),
            "one key or more",
            &keys,
        )?;
        let [values, range] = [self.values.map(|_| None), self.range.map(Some)];
        let points = match one_of(place, [("values", values), ("range", range)])? {
            None => values_of_list(document, place, &keys, paired, of_geometry)?,
            Some(range) if !paired => values_of_range(document, place, &range)?,
            Some(_) => {
                let fault =
                    "a range has one number a value: give `values = [[..], ..]` for several `keys`";
                return Err(KeyFault::new(place.child("range"), fault));
            }
        };
        let mut axis = Axis {
            keys,
            of_geometry,
            is_labelled: self.labels.is_some(),
            points,
        };
        if let Some(labels) = self.labels {
            axis.take_labels(labels, &place.child("labels"))?;
        }
        let list = place.child(if axis.is_labelled { "labels" } else { "values" });
        let labels = axis.points.iter().enumerate();
        require_unique(
            labels.map(|(k, point)| (list.child(k), point.label.as_str())),
            ": the runs of an axis are told apart by their values, or by the labels where there are some",
        )?;
        Ok(axis)
    }
}

impl Axis {
    fn take_labels(&mut self, labels: Vec<String>, place: &KeyPath) -> Result<(), KeyFault> {
        if labels.len() != self.points.len() {
            let (expected, found) = (self.points.len(), labels.len());
            let fault = format!("there are {expected} values, but {found} labels");
            return Err(KeyFault::new(place.clone(), fault));
        }
        for (k, (point, label)) in self.points.iter_mut().zip(labels).enumerate() {
            let fits = !label.trim().is_empty() && !label.chars().any(char::is_control);
            require(fits, || place.child(k), "a label on one line", &label)?;
            require_no_formula(|| place.child(k), "label", &label)?;
            point.label = label;
        }
        Ok(())
    }

    /// Whether a text is the label of a value of the axis, or its value of a key.
    pub(super) fn is_value(&self, point: &AxisPoint, key: &str, words: &str) -> bool {
        let number = |text: &str| text.parse::<f64>().ok();
        let is_cell = |cell: &Cell| match (cell.as_f64(), number(words)) {
            (Some(cell), Some(number)) => cell == number,
            _ => toml_text::words(cell) == words,
        };
        point.label == words || self.cell(point, key).is_some_and(is_cell)
    }

    /// Words for a value of the axis in texts: its label, or its value of a key.
    pub(super) fn value_words(&self, point: &AxisPoint, key: &str) -> String {
        match self.cell(point, key).filter(|_| !self.is_labelled) {
            Some(cell) => short_words(cell),
            None => point.label.clone(),
        }
    }

    /// The value of a key.
    pub(super) fn cell<'a>(&self, point: &'a AxisPoint, key: &str) -> Option<&'a Cell> {
        let place = self.keys.iter().position(|it| it == key)?;
        point.cells.get(place)
    }

    /// The settings of a value of the axis, `key=value` each.
    pub(super) fn settings<'a>(&'a self, point: &'a AxisPoint) -> impl Iterator<Item = Setting> {
        self.keys
            .iter()
            .zip(&point.texts)
            .map(|(key, text)| Setting {
                given: format!("{key}={text}"),
                place: point.place.clone(),
            })
    }
}

/// One name or a list of names at a place of a study; empty without any.
pub(super) fn names(document: &Node, place: &KeyPath) -> Result<Vec<String>, KeyFault> {
    match document.at(place) {
        None => Ok(Vec::new()),
        Some(node) if matches!(node.value, Value::List(_)) => decode(node, place),
        Some(node) => Ok(vec![decode(node, place)?]),
    }
}

/// Index of the axis with a key.
pub(super) fn axis_of_key(axes: &[Axis], key: &str) -> Option<usize> {
    axes.iter()
        .position(|axis| axis.keys.iter().any(|it| it == key))
}

/// Index of the axis with a key, which must be one.
pub(super) fn require_axis(
    axes: &[Axis],
    key: &str,
    place: impl FnOnce() -> KeyPath,
) -> Result<usize, KeyFault> {
    axis_of_key(axes, key).ok_or_else(|| {
        let keys = axes.iter().flat_map(|axis| axis.keys.iter().cloned());
        KeyFault::new(place(), Fault::unknown_name("key of an axis", key, keys))
    })
}

/// The canonical form of a key.
fn canonical(key: &str, place: &KeyPath) -> Result<String, KeyFault> {
    match KeyPath::parse(key) {
        Some(path) if !path.0.is_empty() => Ok(path.to_string()),
        _ => {
            let fault = format!("`{key}` is not a key path such as load.0.displacement.y");
            Err(KeyFault::new(place.clone(), fault))
        }
    }
}

/// The values of a list.
fn values_of_list(
    document: &Node,
    place: &KeyPath,
    keys: &[String],
    paired: bool,
    of_geometry: bool,
) -> Result<Vec<AxisPoint>, KeyFault> {
    let place = place.child("values");
    let values = list(document, &place)?;
    let size = values.len();
    let expected = format!("a list of 1 to {MOST_VALUES} values");
    require(
        (1..=MOST_VALUES).contains(&size),
        || place.clone(),
        &expected,
        size,
    )?;
    let mut points = Vec::new();
    for (index, value) in values.iter().enumerate() {
        let place = place.child(index);
        let of_keys = if paired {
            list(document, &place)?
        } else {
            std::slice::from_ref(value)
        };
        if of_keys.len() != keys.len() {
            let fault = Fault::WrongType {
                expected: format!("a list of {}, a value for each of the keys", keys.len()),
                found: format!("a list of {}", of_keys.len()),
                unit: None,
            };
            return Err(KeyFault::new(place, fault));
        }
        if of_geometry {
            decode::<f64>(value, &place)?;
        }
        for node in of_keys {
            if let Value::String(text) = &node.value {
                require_no_formula(|| place.clone(), "text", text)?;
            }
        }
        let texts = of_keys.iter().map(|node| toml_text::toml(node, &place));
        let texts: Vec<String> = texts.collect::<Result<_, _>>()?;
        let cells = of_keys.iter().zip(&texts);
        let cells: Vec<Cell> = cells
            .map(|(node, text)| toml_text::cell(node, text))
            .collect();
        points.push(AxisPoint {
            label: label(&cells),
            cells,
            texts,
            place,
        });
    }
    Ok(points)
}

/// Default label of values.
fn label(cells: &[Cell]) -> String {
    let words: Vec<String> = cells.iter().map(short_words).collect();
    words.join(", ")
}

/// Short text of a value: for a path the file's stem, for a large or small number exponential notation.
pub(super) fn short_words(cell: &Cell) -> String {
    match cell {
        Cell::String(text) if text.contains('/') => {
            let stem = std::path::Path::new(text).file_stem();
            stem.map_or(text.clone(), |stem| stem.to_string_lossy().into_owned())
        }
        Cell::Number(number) => match number.as_f64() {
            Some(float)
                if number.is_f64() && float != 0.0 && !(1e-3..1e5).contains(&float.abs()) =>
            {
                format!("{float:e}")
            }
            _ => number.to_string(),
        },
        other => toml_text::words(other),
    }
}

fn list<'a>(document: &'a Node, place: &KeyPath) -> Result<&'a [Node], KeyFault> {
    match document.at(place).map(|node| &node.value) {
        Some(Value::List(nodes)) => Ok(nodes),
        _ => Err(KeyFault::new(place.clone(), "expected a list")),
    }
}

/// The values of a range.
fn values_of_range(
    document: &Node,
    place: &KeyPath,
    range: &RawRange,
) -> Result<Vec<AxisPoint>, KeyFault> {
    let place = place.child("range");
    let values = numbers(range, &place)?;
    let is_whole = |key: &str| {
        let node = document.at(&place.child(key));
        node.is_none_or(|node| matches!(node.value, Value::Integer(_)))
    };
    // A range of whole numbers has integer values, for keys that require integers.
    let are_whole = ["from", "to", "step"].iter().all(|key| is_whole(key))
        && values.iter().all(|value| value.fract() == 0.0);
    let point = |value: &f64| {
        let cell = if are_whole {
            Cell::from(*value as i64)
        } else {
            Cell::from(*value)
        };
        AxisPoint {
            label: short_words(&cell),
            texts: vec![cell.to_string()],
            cells: vec![cell],
            place: place.clone(),
        }
    };
    Ok(values.iter().map(point).collect())
}

fn numbers(range: &RawRange, place: &KeyPath) -> Result<Vec<f64>, KeyFault> {
    let RawRange { from, to, log, .. } = *range;
    if log {
        let both = from > 0.0 && to > 0.0;
        require(
            both,
            || place.clone(),
            "between numbers greater than 0 with `log`",
            (from, to),
        )?;
    }
    let step = range.step.map(Spacing::Step);
    let count = range.count.map(Spacing::Count);
    match one_of(place, [("step", step), ("count", count)])? {
        Spacing::Step(_) if log => {
            let fault = Fault::NotWith {
                key: "log",
                setting: "`step`".to_owned(),
                reason: "its steps are factors; give their `count`",
            };
            Err(KeyFault::new(place.child("log"), fault))
        }
        Spacing::Step(step) => values_by_step(range, step, || place.child("step")),
        Spacing::Count(count) => values_by_count(range, count, || place.child("count")),
    }
}

/// Spacing of the values of a range.
enum Spacing {
    /// Difference of neighbours.
    Step(f64),
    /// Number of values.
    Count(usize),
}

/// The values of a range with a given step.
fn values_by_step(
    range: &RawRange,
    step: f64,
    place: impl Fn() -> KeyPath,
) -> Result<Vec<f64>, KeyFault> {
    let RawRange { from, to, .. } = *range;
    let leads = step != 0.0 && (to - from) * step >= 0.0;
    require(
        leads,
        &place,
        "other than 0 and lead from `from` to `to`",
        step,
    )?;
    // The end is included where the steps reach it within rounding.
    let steps = ((to - from) / step + 1e-9).floor();
    let few = format!("so large that there are {MOST_VALUES} values at most");
    require(steps < MOST_VALUES as f64, &place, &few, step)?;
    Ok((0..=steps as usize)
        .map(|k| rounded_to_digits(from + k as f64 * step))
        .collect())
}

/// The values of a range with a given count, at equal steps or, with `log`, equal ratios.
fn values_by_count(
    range: &RawRange,
    count: usize,
    place: impl Fn() -> KeyPath,
) -> Result<Vec<f64>, KeyFault> {
    let RawRange { from, to, log, .. } = *range;
    let possible = (2..=MOST_VALUES).contains(&count);
    require(possible, &place, &format!("2 to {MOST_VALUES}"), count)?;
    let single = "1 value where `from` is `to`: give it by `values`";
    require(from != to, &place, single, count)?;
    let share = |k: usize| k as f64 / (count - 1) as f64;
    let value = |k: usize| match log {
        true => from * (to / from).powf(share(k)),
        false => from + (to - from) * share(k),
    };
    Ok((0..count).map(|k| rounded_to_digits(value(k))).collect())
}

/// A number rounded to [`DIGITS`] significant digits.
fn rounded_to_digits(value: f64) -> f64 {
    let digits = DIGITS - 1;
    // The formatted text is always a number.
    format!("{value:.digits$e}").parse().unwrap_or(value)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn range(from: f64, to: f64, step: Option<f64>, count: Option<usize>, log: bool) -> Vec<f64> {
        let range = RawRange {
            from,
            to,
            step,
            count,
            log,
        };
        numbers(&range, &KeyPath::default()).unwrap()
    }

    #[test]
    fn ranges_have_tidy_numbers_and_their_ends() {
        let tenths = range(0.1, 0.7, Some(0.1), None, false);
        assert_eq!(tenths, [0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7]);
        assert_eq!(
            range(3.0, 1.5, Some(-0.5), None, false),
            [3.0, 2.5, 2.0, 1.5]
        );
        assert_eq!(
            range(0.0, 1.0, Some(0.3), None, false),
            [0.0, 0.3, 0.6, 0.9]
        );
        assert_eq!(
            range(1.5, 4.0, None, Some(6), false),
            [1.5, 2.0, 2.5, 3.0, 3.5, 4.0]
        );
        assert_eq!(
            range(1e-3, 10.0, None, Some(5), true),
            [1e-3, 1e-2, 0.1, 1.0, 10.0]
        );
        assert_eq!(range(2.0, 2.0, Some(1.0), None, false), [2.0]);
    }
}
