//! Bitwise comparison of the results of two runs of one case.

use std::collections::BTreeSet;
use std::path::Path;
use std::{fmt, fs};

use anyhow::Context;
use ligament_output::FieldLocation;
use ligament_output::csv::read::records;
use ligament_output::folder::{Kind, RESOLVED_CASE, is_derived_file};
use ligament_output::summary::SUMMARY_FILE;
use ligament_output::vtu::read::VtuFile;
use serde_json::Value;

/// Comparison of the result files of two runs.
#[derive(Debug)]
pub(crate) struct Comparison {
    /// Number of files.
    pub(crate) compared: usize,
    /// Files that differ, the most informative ones first.
    pub(crate) differing: Vec<Difference>,
}

/// A file that differs.
#[derive(Debug)]
pub(crate) struct Difference {
    file: String,
    /// Position and size of the first difference.
    words: String,
}

impl fmt::Display for Difference {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}: {}", self.file, self.words)
    }
}

/// Files whose differences are most informative, in order; all others come between these and the summary.
const FIRST: [&str; 5] = [
    "history.csv",
    "breaks.csv",
    "modes.csv",
    "iterations.csv",
    "criteria.csv",
];

impl Comparison {
    /// Compares the results in two folders, `then` and `now`. Files of others and values that may differ between equal runs are left out.
    ///
    /// # Errors
    ///
    /// If a file cannot be read.
    pub(crate) fn new(then: &Path, now: &Path, ending: FirstRunEnd) -> anyhow::Result<Self> {
        let mut names = results(then)?;
        names.extend(results(now)?);
        let mut names: Vec<String> = names.into_iter().collect();
        names.sort_by_key(|name| {
            let place = FIRST.iter().position(|it| it == name);
            (place.unwrap_or(FIRST.len()), name == SUMMARY_FILE)
        });
        let mut differing = Vec::new();
        for file in &names {
            if let Some(words) = file_difference(file, &then.join(file), &now.join(file), ending)? {
                let file = file.clone();
                differing.push(Difference { file, words });
            }
        }
        Ok(Self {
            compared: names.len(),
            differing,
        })
    }

    /// Whether no file differs.
    pub(crate) fn is_same(&self) -> bool {
        self.differing.is_empty()
    }
}

/// Names of the files in a folder that are equal in equal runs, without the case, which is an input, and without files of cracks, which are
/// derived later.
fn results(folder: &Path) -> anyhow::Result<BTreeSet<String>> {
    let listed = || format!("cannot list {}", folder.display());
    let mut names = BTreeSet::new();
    for entry in fs::read_dir(folder).with_context(listed)? {
        let name = entry.with_context(listed)?.file_name();
        let name = name.to_string_lossy().into_owned();
        let is_passing =
            [RESOLVED_CASE, "timings.csv"].contains(&&*name) || name.starts_with("checkpoint");
        if (Kind::RUN.owns)(&name) && !is_passing && !is_derived_file(&name) {
            names.insert(name);
        }
    }
    Ok(names)
}

/// Description of the first difference of a file; `None` if both are equal.
fn file_difference(
    name: &str,
    then: &Path,
    now: &Path,
    ending: FirstRunEnd,
) -> anyhow::Result<Option<String>> {
    for (path, words) in [
        (then, "only the repetition has it"),
        (now, "the repetition has none"),
    ] {
        if !path.is_file() {
            return Ok(Some(words.to_owned()));
        }
    }
    let read =
        |path: &Path| fs::read(path).with_context(|| format!("cannot read {}", path.display()));
    let (one, other) = (read(then)?, read(now)?);
    if one == other {
        return Ok(None);
    }
    if name == SUMMARY_FILE {
        return summary_difference(&one, &other, ending);
    }
    let words = match name.rsplit_once('.') {
        Some((_, "csv")) => table_difference(&one, &other),
        Some((_, "vtu")) => field_difference(then, now),
        _ => None,
    };
    let place = || one.iter().zip(&other).take_while(|(a, b)| a == b).count();
    Ok(Some(words.unwrap_or_else(|| {
        format!("differs from byte {} on", place())
    })))
}

/// End of the first of two runs.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum FirstRunEnd {
    /// End by the computation, or by the user.
    ByCourse,
    /// End by a limit of wall time, which the other run need not have.
    ByTime,
}

/// Keys of values that may differ between equal runs: times, memory, threads and the record of the program.
const KEYS_NOT_COMPARED: [&str; 4] = ["version", "provenance", "stages", "threads"];

/// Keys of the end of a run, which differ where the first run ended by a limit of wall time.
const OF_THE_END: [&str; 2] = ["termination", "termination_message"];

/// Description of the first difference of two summaries; `None` if only times, memory, threads or the program differ.
fn summary_difference(
    then: &[u8],
    now: &[u8],
    ending: FirstRunEnd,
) -> anyhow::Result<Option<String>> {
    let read = |bytes| serde_json::from_slice::<Value>(bytes).context("a summary is not JSON");
    let is_passing = |key: &str| {
        KEYS_NOT_COMPARED.contains(&key)
            || key.ends_with("seconds")
            || (ending == FirstRunEnd::ByTime && OF_THE_END.contains(&key))
    };
    Ok(first_difference("", &read(then)?, &read(now)?, &is_passing))
}

/// Description of the first difference of two values below a key.
fn first_difference(
    key: &str,
    then: &Value,
    now: &Value,
    is_passing: &dyn Fn(&str) -> bool,
) -> Option<String> {
    let below = |name: &str| match key {
        "" => name.to_owned(),
        _ => format!("{key}.{name}"),
    };
    match (then, now) {
        (Value::Object(then), Value::Object(now)) => {
            let names = then.keys();
            let added = now.keys().filter(|name| !then.contains_key(*name));
            let mut counted = names.chain(added).filter(|name| !is_passing(name));
            counted.find_map(|name| {
                let [then, now] = [then, now].map(|map| map.get(name).unwrap_or(&Value::Null));
                first_difference(&below(name), then, now, is_passing)
            })
        }
        (Value::Array(then), Value::Array(now)) if then.len() == now.len() => {
            let mut pairs = then.iter().zip(now).enumerate();
            pairs.find_map(|(k, (then, now))| {
                first_difference(&below(&k.to_string()), then, now, is_passing)
            })
        }
        _ if then == now => None,
        _ => Some(format!(
            "`{key}`: {}",
            difference_of_values(&then.to_string(), &now.to_string())
        )),
    }
}

/// Description of the first difference of two tables; `None` if it is not in a cell.
fn table_difference(then: &[u8], now: &[u8]) -> Option<String> {
    let [then, now] = [then, now].map(|bytes| records(&String::from_utf8_lossy(bytes)));
    let (header, others) = (then.first()?, now.first()?);
    if header != others {
        return Some("its columns differ".to_owned());
    }
    let mut pairs = then.iter().zip(&now).enumerate();
    let Some((line, (one, other))) = pairs.find(|(_, (one, other))| one != other) else {
        let [then, now] = [then, now].map(|table| table.len() - 1);
        return (then != now).then(|| format!("{then} rows then, {now} now"));
    };
    let mut columns = header.iter().zip(one.iter().zip(other));
    let (column, (value, another)) = columns.find(|(_, (value, another))| value != another)?;
    Some(format!(
        "line {} ({} {}), column {column}: {}",
        line + 1,
        &header[0],
        &one[0],
        difference_of_values(value, another)
    ))
}

/// Names of the components of a vector.
const AXES: [&str; 3] = ["x", "y", "z"];

/// Description of the first difference of two field files; `None` if it is not in a field.
fn field_difference(then: &Path, now: &Path) -> Option<String> {
    let (then, now) = (VtuFile::open(then).ok()?, VtuFile::open(now).ok()?);
    let locations = [FieldLocation::Point, FieldLocation::Cell];
    locations
        .into_iter()
        .find_map(|location| field_difference_at(&then, &now, location))
}

/// Description of the first difference in the fields on points or cells.
fn field_difference_at(then: &VtuFile, now: &VtuFile, location: FieldLocation) -> Option<String> {
    let [fields, others] = [then, now].map(|file| file.fields(location).collect::<Vec<_>>());
    if fields != others {
        return Some(format!("its fields on {location}s differ"));
    }
    fields.into_iter().find_map(|field| {
        let numbers = |file: &VtuFile| file.numbers(location, field).ok().flatten();
        let (then_numbers, now_numbers) = (numbers(then)?, numbers(now)?);
        if then_numbers.len() != now_numbers.len() {
            return Some(format!("field {field} has another length"));
        }
        let mut pairs = then_numbers.iter().zip(&now_numbers);
        let index = pairs.position(|(a, b)| a.to_bits() != b.to_bits())?;
        let (n_components, names) = then.components(location, field)?;
        let (place, component) = (index / n_components, index % n_components);
        let owner = match then.tags(location) {
            Ok((tagged, tags)) => format!("{tagged} {}", tags.get(place)?),
            Err(_) => format!("{location} {place}, counted from 0"),
        };
        let component = match names.get(component).map(String::as_str) {
            Some(name) => format!(" {name}"),
            None if n_components > 1 => format!(" {}", AXES.get(component).unwrap_or(&"beyond z")),
            None => String::new(),
        };
        let values = [then_numbers[index], now_numbers[index]].map(|value| format!("{value:?}"));
        let difference_of_values = difference_of_values(&values[0], &values[1]);
        Some(format!(
            "field {field}{component} at {owner}: {difference_of_values}"
        ))
    })
}

/// Description of two values and their relative difference.
fn difference_of_values(then: &str, now: &str) -> String {
    let values = then.parse::<f64>().ok().zip(now.parse::<f64>().ok());
    let relative = values.map(|(then, now)| (now - then).abs() / then.abs().max(now.abs()));
    match relative {
        Some(0.0) => format!("{then} then, {now} now, the same number in another notation"),
        Some(relative) if relative.is_finite() => {
            format!("{then} then, {now} now, relative difference {relative:.1e}")
        }
        _ => format!("{then} then, {now} now"),
    }
}
