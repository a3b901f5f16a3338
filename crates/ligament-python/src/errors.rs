//! Exceptions of the package: message and machine-readable parts.

use std::error::Error;
use std::iter::successors;

use ligament_case::case::key_path::KeyPath;
use ligament_case::case::{CaseError, Fault, Location, override_parts};
use ligament_output::remedy::{Terms, causes};
use pyo3::prelude::*;
use pyo3::types::PyDict;

/// Arguments that remedies name; every function has one for the path.
const TERMS: Terms = Terms {
    elsewhere: "",
    replace: " with replace=True",
    setting: |key, value| format!("{}={value}", key.replace('.', "__")),
    option: argument,
};

/// An option of the command line as an argument: `at=(X, Y)`; only its name where it has no value.
fn argument(option: &str, value: &str) -> String {
    let name = match option {
        "iso" => "level",
        other => other,
    };
    let parts: Vec<&str> = value.split(',').collect();
    match parts.as_slice() {
        [""] => format!("`{name}`"),
        [_] => format!("`{name}={value}`"),
        several => format!("`{name}=({})`", several.join(", ")),
    }
}

/// Machine-readable parts of an error.
#[derive(Debug, Default)]
struct ErrorParts {
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
    /// The exception for the failure.
    pub(crate) fn exception(self, py: Python<'_>) -> PyErr {
        match self {
            Self::Case(error) => case_error(py, &error),
            Self::Other(error) => match error.downcast_ref::<CaseError>() {
                Some(error) => case_error(py, error),
                None => {
                    let message = causes(error.chain(), &TERMS).join(": ");
                    exception_named(
                        py,
                        "SolutionError",
                        &message,
                        ErrorParts::from_message(&message),
                    )
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

impl ErrorParts {
    /// The hint of a message follows its first semicolon.
    fn from_message(message: &str) -> Self {
        let hint = message.split_once("; ").map(|(_, hint)| hint.to_owned());
        Self {
            hint,
            ..Self::default()
        }
    }
}

/// The exception for an error of a case.
pub(crate) fn case_error(py: Python<'_>, error: &CaseError) -> PyErr {
    let message = sections_message(error);
    let mut parts = ErrorParts::from_message(&message);
    match error {
        CaseError::Key { location, key, .. } => {
            parts.key = Some(key.clone());
            parts.place(location);
        }
        CaseError::Syntax { location, .. } => parts.place(location),
        CaseError::Override { given, .. } => {
            parts.key = Some(override_parts(given).0.to_owned());
        }
        CaseError::Read { path, .. } => parts.path = Some(path.display().to_string()),
    }
    exception_named(py, "CaseError", &message, parts)
}

/// Message of an error of a case, in which overrides are keyword arguments and sections are values.
fn sections_message(error: &CaseError) -> String {
    match error {
        CaseError::Override { given, reason } => format!("{}: {reason}", keyword(given)),
        CaseError::Key {
            location,
            key,
            fault,
        } => match (location, &**fault) {
            (Location::Override { given }, _) => format!("{}: {key}: {fault}", keyword(given)),
            (Location::Document { .. }, Fault::SingleBrackets { section }) => format!(
                "{section}: this section may be repeated, so it is a list; write {section}=[{{...}}] instead of {section}={{...}}"
            ),
            (Location::Position { .. } | Location::Document { .. }, _) => error.to_string(),
        },
        CaseError::Read { source, .. } => format!("{error}: {source}"),
        CaseError::Syntax { .. } => error.to_string(),
    }
}

/// An override as a keyword argument: `model__law=x`, or `title=None` where it removes a key.
fn keyword(given: &str) -> String {
    let (key, value) = override_parts(given);
    format!("{}={}", key.replace('.', "__"), value.unwrap_or("None"))
}

impl ErrorParts {
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
    let parts = ErrorParts {
        key: Some(key.to_string()),
        ..ErrorParts::from_message(fault)
    };
    exception_named(py, "CaseError", &format!("{key}: {fault}"), parts)
}

/// The exception for arrays that make no body.
pub(crate) fn body_error(py: Python<'_>, fault: &str) -> PyErr {
    exception_named(py, "BodyError", fault, ErrorParts::from_message(fault))
}

/// The exception for an error of the program, with its causes.
pub(crate) fn program_error(py: Python<'_>, error: &(dyn Error + 'static)) -> PyErr {
    let chain = successors(Some(error), |it| (*it).source());
    request_error(py, &causes(chain, &TERMS).join(": "))
}

/// The exception for a request that cannot be fulfilled.
pub(crate) fn request_error(py: Python<'_>, fault: &str) -> PyErr {
    exception_named(py, "LigamentError", fault, ErrorParts::from_message(fault))
}

fn exception_named(py: Python<'_>, kind: &str, message: &str, parts: ErrorParts) -> PyErr {
    let made = || {
        let keywords = PyDict::new(py);
        keywords.set_item("key", parts.key)?;
        keywords.set_item("path", parts.path)?;
        keywords.set_item("line", parts.line)?;
        keywords.set_item("column", parts.column)?;
        keywords.set_item("hint", parts.hint)?;
        let kind = py.import("ligament._errors")?.getattr(kind)?;
        kind.call((message,), Some(&keywords))
    };
    made().map_or_else(|error| error, PyErr::from_value)
}
