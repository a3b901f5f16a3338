//! Errors of a case file and their locations.

use std::borrow::Cow;
use std::path::PathBuf;

use super::key_path::KeyPath;
use super::overrides::command_line_form;
use ligament::error::Fault as SetupFault;
use ligament::suggestion::hint;

/// End of an error about a word: the nearest valid word, or all of them.
fn hint_of_values(found: &str, valid: &[String]) -> String {
    match hint(found, valid, "valid values", '"') {
        nothing if nothing.is_empty() => format!("; valid values: \"{}\"", valid.join("\", \"")),
        text => text,
    }
}

/// Advice for an error on the place of a key that other programs have.
fn place_for_foreign_key(key: &str) -> Option<&'static str> {
    ["critical_stretch", "epsilon_c"].contains(&key).then_some(
        "; a critical stretch is the `limit` of a [[fracture.criterion]] with kind = \"critical-stretch\"",
    )
}

/// Fault of a key or its value.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum Fault {
    /// The table has no such key.
    #[error(
        "unknown key `{key}` in {table}{}{}",
        place_for_foreign_key(key).unwrap_or_default(),
        hint(key, valid, "valid keys", '`')
    )]
    UnknownKey {
        /// The key as given.
        key: String,
        /// Title of the table, as written in a case file.
        table: String,
        /// The keys that the table may have.
        valid: Vec<String>,
    },
    /// A key of sections that is given outside of them.
    #[error("unknown key `{key}`; did you mean `{}`?", known.join("` or `"))]
    KeyOfSection {
        /// The key as given.
        key: String,
        /// Paths of the keys of this name.
        known: Vec<String>,
    },
    /// A key without a default is missing.
    #[error("missing key `{key}` in {table}{}", unit.map(|unit| format!(" (in {unit})")).unwrap_or_default())]
    MissingKey {
        /// The missing key.
        key: String,
        /// Title of the table, as written in a case file.
        table: String,
        /// Unit of the key's value.
        unit: Option<&'static str>,
    },
    /// A required section is missing.
    #[error("the case has no {section} section; it needs {purpose}")]
    MissingSection {
        /// The section, with its brackets.
        section: String,
        /// Purpose of the section.
        purpose: &'static str,
    },
    /// A key that another setting requires is missing.
    #[error("missing key `{key}`: it is required {reason}")]
    Required {
        /// The missing key.
        key: &'static str,
        /// Reason why the key is required.
        reason: String,
    },
    /// A key does not apply with another setting.
    #[error("`{key}` does not apply with {setting}: {reason}; remove it")]
    NotWith {
        /// The key.
        key: &'static str,
        /// The other setting.
        setting: String,
        /// Reason why the key does not apply.
        reason: &'static str,
    },
    /// The value has the wrong type.
    #[error("expected {expected}, found {found}{}", unit_advice(found, *unit))]
    WrongType {
        /// Description of the expected type.
        expected: String,
        /// Description of the given value.
        found: String,
        /// Unit of the value, for a number.
        unit: Option<&'static str>,
    },
    /// A single table is given for a list of tables.
    #[error(
        "this section may be repeated, so its name stands in double brackets: write [[{section}]] instead of [{section}]"
    )]
    SingleBrackets {
        /// Name of the section.
        section: String,
    },
    /// The value is not one of the key's words.
    #[error("unknown value \"{found}\"{}", hint_of_values(found, valid))]
    UnknownValue {
        /// The word as given.
        found: String,
        /// Valid words.
        valid: Vec<String>,
    },
    /// A fault of the setup: a name that does not exist, or a value out of range.
    #[error(transparent)]
    Setup(#[from] SetupFault),
    /// Alternative keys: exactly one must be given.
    #[error(
        "needs exactly one of {}; found {}",
        quoted(valid, "none"),
        quoted(found, "none")
    )]
    NotExactlyOne {
        /// The alternative keys.
        valid: Vec<String>,
        /// The given keys.
        found: Vec<String>,
    },
    /// Two elements of the same kind have the same name.
    #[error("`{name}` is already used by {first}{advice}")]
    NotUnique {
        /// The name.
        name: String,
        /// Key path of the element that has the name first.
        first: String,
        /// Advice, with its punctuation.
        advice: &'static str,
    },
    /// Any other fault, as a message.
    #[error("{0}")]
    Other(String),
}

impl Fault {
    /// The fault of a name that does not exist: `what` is the kind and place of the name ("physical group in the mesh"), `candidates` are
    /// the existing names.
    pub fn unknown_name<N: Into<String>>(
        what: &'static str,
        found: impl Into<String>,
        candidates: impl IntoIterator<Item = N>,
    ) -> Self {
        Self::Setup(SetupFault::UnknownName {
            what,
            found: found.into(),
            candidates: candidates.into_iter().map(Into::into).collect(),
        })
    }

    /// The fault of a value out of range; `expected` describes the range.
    pub fn out_of_range(expected: impl Into<Cow<'static, str>>, found: String) -> Self {
        let expected = expected.into();
        Self::Setup(SetupFault::OutOfRange { expected, found })
    }
}

impl From<String> for Fault {
    fn from(reason: String) -> Self {
        Self::Other(reason)
    }
}

impl From<&str> for Fault {
    fn from(reason: &str) -> Self {
        Self::Other(reason.to_owned())
    }
}

fn quoted(names: &[String], none: &str) -> String {
    if names.is_empty() {
        return none.to_owned();
    }
    let names: Vec<_> = names.iter().map(|name| format!("`{name}`")).collect();
    names.join(", ")
}

/// Advice about units where a string is given for a number, probably a quantity with its unit.
fn unit_advice(found: &str, unit: Option<&'static str>) -> String {
    match unit {
        Some(unit) if found.contains("the string") => {
            format!("; values are plain numbers in SI units, here {unit}")
        }
        _ => String::new(),
    }
}

/// Location of a faulty key.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum Location {
    /// A position in the case file, line and column from 1.
    #[error("{}:{line}:{column}", path.display())]
    Position {
        /// The case file.
        path: PathBuf,
        /// Line, from 1.
        line: usize,
        /// Column in characters, from 1.
        column: usize,
    },
    /// The case file as a whole, where a part is missing.
    #[error("{}", path.display())]
    Document {
        /// The case file.
        path: PathBuf,
    },
    /// An override on the command line.
    #[error("{}", command_line_form(given))]
    Override {
        /// The override as given, `key=value` or `-key`.
        given: String,
    },
}

/// Error of reading a case.
#[derive(Debug, thiserror::Error)]
pub enum CaseError {
    /// The file could not be read.
    #[error("cannot read the case file {}", path.display())]
    Read {
        /// The case file.
        path: PathBuf,
        /// The system's reason.
        source: std::io::Error,
    },
    /// The file is not TOML.
    #[error("{location}: not valid TOML: {message}")]
    Syntax {
        /// Location of the syntax error.
        location: Location,
        /// The TOML parser's reason.
        message: String,
    },
    /// A `--set` or `--unset` could not be applied.
    #[error("{}: {reason}", command_line_form(given))]
    Override {
        /// The override as given.
        given: String,
        /// Reason why it could not be applied.
        reason: String,
    },
    /// A key or its value is wrong.
    #[error("{location}: {key}: {fault}")]
    Key {
        /// Location of the key.
        location: Location,
        /// Path of the key, `load.0.group`.
        key: String,
        /// Fault of the key.
        fault: Box<Fault>,
    },
}

/// A fault at a key without a location in the text.
#[derive(Debug, Clone, PartialEq)]
pub struct KeyFault {
    /// Path of the key.
    pub key: KeyPath,
    /// Fault of the key.
    pub fault: Fault,
}

impl KeyFault {
    /// A fault at a key.
    pub fn new(key: KeyPath, fault: impl Into<Fault>) -> Self {
        Self {
            key,
            fault: fault.into(),
        }
    }
}
