//! Results of a summary by name, such as `first_peak.reaction`.

use std::path::Path;

use serde_json::Value;

use ligament::suggestion::{hint, nearest};
use ligament_output::folder::refuse_link;
use ligament_output::summary::{SUMMARY_FILE, verdict};
use ligament_output::{Error, read_json};

/// Lists of a summary that are in a table of runs only by their lengths.
const COUNTED: [&str; 1] = ["warnings"];

/// Key of the provenance, which tables of runs do not have.
const PROVENANCE: &str = "provenance";

/// Key of the stages; tables of runs have their total time and peak memory.
const STAGES: &str = "stages";

/// The single results of a run, in the order of its summary.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Quantities(Vec<(String, Value)>);

/// Error of a missing result.
#[derive(Debug, thiserror::Error)]
pub enum QuantityError {
    /// No result has this name.
    #[error(
        "there is no result `{name}`{}",
        hint(name, known, "results with numbers", '`')
    )]
    Unknown {
        /// Name of a result that does not exist.
        name: String,
        /// Names of the existing numbers.
        known: Vec<String>,
    },
    /// The run has no value of this result, or one that is not a number.
    #[error("`{name}` has no number in this run: it is {value}")]
    NotANumber {
        /// Name of a result that is not a number.
        name: String,
        /// Value of the result.
        value: Value,
    },
}

impl Quantities {
    /// Flattens a summary: names of nested values are joined by dots, `modes.0.frequency`. Warnings become their number, stages `seconds`
    /// and `peak_bytes`; the provenance is left out.
    pub fn from_summary(summary: &Value) -> Self {
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

    /// Reads the results of a run from the summary in its folder.
    pub(crate) fn read(folder: &Path) -> Result<Self, Error> {
        let path = folder.join(SUMMARY_FILE);
        refuse_link(&path)?;
        Ok(Self::from_summary(&read_json(&path)?))
    }

    /// Names and values: numbers, texts, Booleans, or null where the run has no value.
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
            // A missing part is null as a whole: `first_break` instead of `first_break.reaction`.
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
                    known: self.suggestions(name),
                },
            });
        };
        value.as_f64().ok_or_else(|| QuantityError::NotANumber {
            name: name.to_owned(),
            value: value.clone(),
        })
    }

    /// Names of numbers to suggest for an unknown name: the names in the part that its beginning resembles, otherwise all.
    fn suggestions(&self, name: &str) -> Vec<String> {
        fn part(name: &str) -> &str {
            name.split('.').next().unwrap_or(name)
        }
        let all = self.numeric();
        let parts: Vec<String> = all.iter().map(|it| part(it).to_owned()).collect();
        match (nearest(name, &all), nearest(part(name), &parts)) {
            (None, Some(near)) => all.iter().filter(|it| part(it) == near).cloned().collect(),
            _ => all,
        }
    }

    /// Reason why the run has no result under load, or none beyond some state, if studies take it as failed.
    pub(crate) fn without_equilibrium(&self) -> Option<String> {
        let reason = self.get("termination_message").and_then(Value::as_str);
        let reason = reason.unwrap_or("no equilibrium was found");
        if self.get("without_equilibrium").is_some_and(|it| it == true) {
            return Some(format!("no result under load: {reason}"));
        }
        if self.get("unstable").is_some_and(|it| it == true) {
            return Some("the model is unstable".to_owned());
        }
        let verdict = verdict(self.get("termination")?.as_str()?);
        let end = verdict.end(false, self.ends_not_at_rest());
        end.is_failure().then(|| reason.to_owned())
    }

    /// Whether breakage continued in the last state of the run.
    pub(crate) fn ends_not_at_rest(&self) -> bool {
        self.get("last_state_not_at_rest")
            .is_some_and(|it| it == true)
    }

    fn numeric(&self) -> Vec<String> {
        let numbers = self.iter().filter(|(_, value)| value.is_number());
        numbers.map(|(name, _)| name.to_owned()).collect()
    }
}

/// Appends the scalar values within a value, by their dotted names.
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
        Quantities::from_summary(&json!({
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
