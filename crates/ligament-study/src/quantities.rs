//! Results by their names: the numbers and words of a summary, such as `first_peak.reaction`.

use std::io;
use std::path::{Path, PathBuf};

use serde_json::Value;

use ligament::suggestion::hint;
use ligament_case::input_file;
use ligament_output::folder::refuse_link;
use ligament_run::end::NO_EQUILIBRIUM;

/// What a summary has and no table of runs wants one by one: lists whose length is all that matters, ...
const COUNTED: [&str; 1] = ["warnings"];

/// ... what the results came from, ...
const PROVENANCE: &str = "provenance";

/// ... and the stages, of which time and memory of the whole run are left.
const STAGES: &str = "stages";

/// The single results of a run, in the order of its summary.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Quantities(Vec<(String, Value)>);

/// Why a result is not there.
#[derive(Debug, thiserror::Error)]
pub enum QuantityError {
    /// The summary could not be read.
    #[error("cannot read {}", path.display())]
    Read {
        /// The summary.
        path: PathBuf,
        /// The system's reason.
        source: io::Error,
    },
    /// The summary lies elsewhere.
    #[error(transparent)]
    Link(#[from] ligament_output::Error),
    /// The summary is not JSON.
    #[error("{} is no summary of a run", path.display())]
    Parse {
        /// The summary.
        path: PathBuf,
        /// The parser's reason.
        source: serde_json::Error,
    },
    /// There is no result of this name.
    #[error(
        "there is no result `{name}`{}",
        hint(name, known, "results with numbers", '`')
    )]
    Unknown {
        /// The name.
        name: String,
        /// The names of the numbers that there are.
        known: Vec<String>,
    },
    /// The run has no value of this result, or one that is no number.
    #[error("`{name}` has no number in this run: it is {value}")]
    NotANumber {
        /// The name.
        name: String,
        /// What is there instead.
        value: Value,
    },
}

impl Quantities {
    /// Flattens a summary: parts of tables and lists are joined by dots, `modes.0.frequency`. Of the warnings their number
    /// is left, of the stages `seconds` and `peak_bytes`; of the provenance nothing.
    pub fn of_summary(summary: &Value) -> Self {
        let mut all = Vec::new();
        for (name, value) in summary.as_object().into_iter().flatten() {
            match value {
                _ if name == PROVENANCE => {}
                Value::Array(list) if COUNTED.contains(&name.as_str()) => {
                    all.push((name.clone(), list.len().into()));
                }
                Value::Array(stages) if name == STAGES => {
                    let numbers = |key: &'static str| {
                        stages.iter().filter_map(move |stage| stage[key].as_f64())
                    };
                    all.push(("seconds".to_owned(), numbers("seconds").sum::<f64>().into()));
                    let bytes = stages
                        .iter()
                        .filter_map(|stage| stage["peak_bytes"].as_u64());
                    all.push(("peak_bytes".to_owned(), bytes.max().into()));
                }
                value => flatten(name.clone(), value, &mut all),
            }
        }
        Self(all)
    }

    /// Reads those of a run from the summary in its folder.
    pub(crate) fn read(folder: &Path) -> Result<Self, QuantityError> {
        let path = folder.join("summary.json");
        refuse_link(&path)?;
        let text = input_file::read_text(&path).map_err(|source| QuantityError::Read {
            path: path.clone(),
            source,
        })?;
        let summary =
            serde_json::from_str(&text).map_err(|source| QuantityError::Parse { path, source })?;
        Ok(Self::of_summary(&summary))
    }

    /// Names and values: numbers, words, truth values, or null where a run has none.
    pub fn iter(&self) -> impl Iterator<Item = (&str, &Value)> {
        self.0.iter().map(|(name, value)| (name.as_str(), value))
    }

    /// The value of a result; `None` where there is no such name.
    pub fn get(&self, name: &str) -> Option<&Value> {
        self.iter()
            .find_map(|(other, value)| (other == name).then_some(value))
    }

    /// The number of a result.
    pub fn number(&self, name: &str) -> Result<f64, QuantityError> {
        let Some(value) = self.get(name) else {
            // A part of a run that has none is null as a whole: `first_break` instead of `first_break.reaction`.
            let above = self.iter().find(|(other, value)| {
                value.is_null()
                    && name
                        .strip_prefix(other)
                        .is_some_and(|it| it.starts_with('.'))
            });
            return Err(match above {
                Some((above, value)) => QuantityError::NotANumber {
                    name: above.to_owned(),
                    value: value.clone(),
                },
                None => QuantityError::Unknown {
                    name: name.to_owned(),
                    known: self.numeric(),
                },
            });
        };
        value.as_f64().ok_or_else(|| QuantityError::NotANumber {
            name: name.to_owned(),
            value: value.clone(),
        })
    }

    /// Why the run has no result under load, or none beyond some load, where it ended without equilibrium.
    pub(crate) fn without_equilibrium(&self) -> Option<String> {
        let reason = self.get("termination_message").and_then(Value::as_str);
        let reason = reason.unwrap_or("no equilibrium was found");
        if self.get("without_equilibrium").is_some_and(|it| it == true) {
            return Some(format!("no result under load: {reason}"));
        }
        (self.get("termination")? == NO_EQUILIBRIUM).then(|| reason.to_owned())
    }

    /// Whether the last state of the run is none in which it could stay.
    pub(crate) fn ends_not_at_rest(&self) -> bool {
        self.get("last_state_not_at_rest")
            .is_some_and(|it| it == true)
    }

    fn numeric(&self) -> Vec<String> {
        let numbers = self.iter().filter(|(_, value)| value.is_number());
        numbers.map(|(name, _)| name.to_owned()).collect()
    }
}

/// Adds the single values below one, by their dotted names.
pub(crate) fn flatten(name: String, value: &Value, out: &mut Vec<(String, Value)>) {
    match value {
        Value::Object(parts) => {
            for (part, value) in parts {
                flatten(format!("{name}.{part}"), value, out);
            }
        }
        Value::Array(list) => {
            for (index, value) in list.iter().enumerate() {
                flatten(format!("{name}.{index}"), value, out);
            }
        }
        single => out.push((name, single.clone())),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::json;

    fn sample() -> Quantities {
        Quantities::of_summary(&json!({
            "title": "disk",
            "first_peak": { "reaction": 6e5, "displacement": 1e-4 },
            "first_break": null,
            "modes": [{ "frequency": 10.0 }],
            "warnings": ["a", "b"],
            "stages": [
                { "name": "bonds", "seconds": 0.5, "peak_bytes": 10 },
                { "name": "solution", "seconds": 1.5, "peak_bytes": 30 },
            ],
        }))
    }

    #[test]
    fn results_have_dotted_names() {
        let quantities = sample();
        assert_eq!(quantities.number("first_peak.reaction").unwrap(), 6e5);
        assert_eq!(quantities.number("modes.0.frequency").unwrap(), 10.0);
        assert_eq!(quantities.number("warnings").unwrap(), 2.0);
        assert_eq!(quantities.number("seconds").unwrap(), 2.0);
        assert_eq!(quantities.number("peak_bytes").unwrap(), 30.0);
        assert_eq!(quantities.get("title"), Some(&json!("disk")));
    }

    #[test]
    fn a_missing_result_is_told_from_a_misspelt_one() {
        let error = |name| sample().number(name).unwrap_err().to_string();
        assert!(error("first_peak.reacton").contains("did you mean `first_peak.reaction`?"));
        assert!(error("first_break.reaction").contains("`first_break` has no number"));
        assert!(error("title").contains("\"disk\""));
    }
}
