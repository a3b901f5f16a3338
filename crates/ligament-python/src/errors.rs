//! Exceptions of the package: message and machine-readable parts.

use ligament::SetupError;
use ligament_case::case::key_path::KeyPath;
use ligament_case::case::{CaseError, CaseFile, Fault, Location};
use pyo3::prelude::*;
use pyo3::types::PyDict;

/// Machine-readable parts of an error.
#[derive(Debug, Default)]
struct Parts {
    key: Option<String>,
    path: Option<String>,
    line: Option<usize>,
    column: Option<usize>,
    hint: Option<String>,
}

/// Error of a run.
#[derive(Debug)]
pub(crate) enum Failure {
    /// Error of a key of the case, or of a field of its setup.
    Case(CaseError),
    /// Any other error.
    Other(anyhow::Error),
    /// The user stopped the run before there was a result.
    Stopped,
}

impl Failure {
    /// The failure of a computation of a case, at the responsible key.
    pub(crate) fn computing(case: &CaseFile, error: ligament::Error) -> Self {
        Self::Other(case.explained(error))
    }

    /// The failure of a setup of a case, at the responsible key.
    pub(crate) fn setup(case: &CaseFile, error: SetupError) -> Self {
        Self::Case(case.located(error))
    }

    /// The exception for the failure.
    pub(crate) fn exception(self, py: Python<'_>) -> PyErr {
        match self {
            Self::Case(error) => of_case(py, &error),
            Self::Other(error) => match error.downcast_ref::<CaseError>() {
                Some(error) => of_case(py, error),
                None => {
                    let message = format!("{error:#}");
                    raised(py, "SolutionError", &message, Parts::of_message(&message))
                }
            },
            Self::Stopped => pyo3::exceptions::PyKeyboardInterrupt::new_err(()),
        }
    }
}

impl From<CaseError> for Failure {
    fn from(error: CaseError) -> Self {
        Self::Case(error)
    }
}

impl From<anyhow::Error> for Failure {
    fn from(error: anyhow::Error) -> Self {
        Self::Other(error)
    }
}

impl Parts {
    /// The hint of a message follows its first semicolon.
    fn of_message(message: &str) -> Self {
        let hint = message.split_once("; ").map(|(_, hint)| hint.to_owned());
        Self {
            hint,
            ..Self::default()
        }
    }
}

/// The exception for an error of a case.
pub(crate) fn of_case(py: Python<'_>, error: &CaseError) -> PyErr {
    let mut message = error.to_string();
    if let CaseError::Key {
        location, fault, ..
    } = error
        && let (Location::Document { .. }, Fault::SingleBrackets { section }) = (location, &**fault)
    {
        message = format!(
            "{section}: this section may be repeated, so it is a list; write {section}=[{{...}}] instead of {section}={{...}}"
        );
    }
    let mut parts = Parts::of_message(&message);
    match error {
        CaseError::Key { location, key, .. } => {
            parts.key = Some(key.clone());
            parts.place(location);
        }
        CaseError::Syntax { location, .. } => parts.place(location),
        CaseError::Override { given, .. } => {
            let key = given.split('=').next().unwrap_or_default();
            parts.key = Some(key.trim_start_matches('-').to_owned());
        }
        CaseError::Read { path, source } => {
            parts.path = Some(path.display().to_string());
            message = format!("{message}: {source}");
        }
    }
    raised(py, "CaseError", &message, parts)
}

impl Parts {
    fn place(&mut self, location: &Location) {
        match location {
            Location::Position { path, line, column } => {
                self.path = Some(path.display().to_string());
                (self.line, self.column) = (Some(*line), Some(*column));
            }
            Location::Document { path } => self.path = Some(path.display().to_string()),
            Location::Override { .. } => {}
        }
    }
}

/// The exception for a fault at a key of sections in memory.
pub(crate) fn at_key(py: Python<'_>, key: &KeyPath, fault: &str) -> PyErr {
    let parts = Parts {
        key: Some(key.to_string()),
        ..Parts::of_message(fault)
    };
    raised(py, "CaseError", &format!("{key}: {fault}"), parts)
}

/// The exception for arrays that make no body.
pub(crate) fn of_body(py: Python<'_>, fault: &str) -> PyErr {
    raised(py, "BodyError", fault, Parts::of_message(fault))
}

/// The exception for a request that cannot be fulfilled.
pub(crate) fn of_request(py: Python<'_>, fault: &str) -> PyErr {
    raised(py, "LigamentError", fault, Parts::of_message(fault))
}

/// A message of the program in the words of Python: `--set model.law=x` as `model__law=x`, `--unset title` as `title=None`.
pub(crate) fn in_python(message: &str) -> String {
    let keyword = |key: &str| key.replace('.', "__");
    let message = message
        .replace("--force", "replace=True")
        .replace("--out", "folder");
    let mut words = String::new();
    let mut rest = message.as_str();
    while let Some((before, after)) = rest.split_once("--") {
        words.push_str(before);
        let ends = |it: char| it.is_whitespace() || [':', ',', ';', ')', '`'].contains(&it);
        if let Some(setting) = after.strip_prefix("set ") {
            let (key, value) = setting.split_once('=').unwrap_or((setting, ""));
            words.push_str(&format!("{}=", keyword(key)));
            rest = value;
        } else if let Some(key) = after.strip_prefix("unset ") {
            let end = key.find(ends).unwrap_or(key.len());
            words.push_str(&format!("{}=None", keyword(&key[..end])));
            rest = &key[end..];
        } else {
            words.push_str("--");
            rest = after;
        }
    }
    words + rest
}

fn raised(py: Python<'_>, kind: &str, message: &str, parts: Parts) -> PyErr {
    let (message, hint) = (in_python(message), parts.hint.as_deref().map(in_python));
    let made = || {
        let keywords = PyDict::new(py);
        keywords.set_item("key", parts.key)?;
        keywords.set_item("path", parts.path)?;
        keywords.set_item("line", parts.line)?;
        keywords.set_item("column", parts.column)?;
        keywords.set_item("hint", hint)?;
        let kind = py.import("ligament._errors")?.getattr(kind)?;
        kind.call((message,), Some(&keywords))
    };
    made().map_or_else(|error| error, PyErr::from_value)
}
