//! What can be wrong with a case file, and where.

use std::borrow::Cow;
use std::path::PathBuf;

use super::key_path::KeyPath;
use super::overrides::as_option;
use ligament::error::Fault as SetupFault;
use ligament::suggestion::hint;

/// What is wrong with a key or its value.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum Fault {
    /// The table has no such key.
    #[error(
        "unknown key `{key}` in {table}{}",
        hint(key, valid, "valid keys", '`')
    )]
    UnknownKey {
        /// The key as given.
        key: String,
        /// The table, as it is written in a case file.
        table: String,
        /// The keys that the table may have.
        valid: Vec<String>,
    },
    /// A key that has no default is not there.
    #[error("missing key `{key}` in {table}{}", unit.map(|unit| format!(" (in {unit})")).unwrap_or_default())]
    MissingKey {
        /// The key that is needed.
        key: String,
        /// The table, as it is written in a case file.
        table: String,
        /// Unit of its value.
        unit: Option<&'static str>,
    },
    /// A section that every case needs is not there.
    #[error("the case has no {section} section; it needs {purpose}")]
    MissingSection {
        /// The section, with its brackets.
        section: String,
        /// What it is needed for.
        purpose: &'static str,
    },
    /// A key that is needed only because of another setting is not there.
    #[error("missing key `{key}`: it is required {reason}")]
    Required {
        /// The key that is needed.
        key: &'static str,
        /// What makes it necessary.
        reason: String,
    },
    /// A key means nothing with another setting.
    #[error("`{key}` does not apply with {setting}: {reason}; remove it")]
    NotWith {
        /// The key.
        key: &'static str,
        /// The setting that it does not go with.
        setting: String,
        /// Why not.
        reason: &'static str,
    },
    /// The value is of another type.
    #[error("expected {expected}, found {found}{}", unit_advice(found, *unit))]
    WrongType {
        /// What the key takes.
        expected: String,
        /// What was given.
        found: String,
        /// Unit of the value, for numbers.
        unit: Option<&'static str>,
    },
    /// A single table stands where a list of tables belongs.
    #[error(
        "this section may be repeated, so its name stands in double brackets: write [[{section}]] instead of [{section}]"
    )]
    SingleBrackets {
        /// Name of the section.
        section: String,
    },
    /// The value is none of the words the key takes.
    #[error("unknown value \"{found}\"{}", hint(found, valid, "valid values", '"'))]
    UnknownValue {
        /// The word as given.
        found: String,
        /// The words that the key takes.
        valid: Vec<String>,
    },
    /// A fault of the setup that the case makes: a name that does not exist, or a value out of range.
    #[error(transparent)]
    Setup(#[from] SetupFault),
    /// Keys of which exactly one is to be given.
    #[error(
        "needs exactly one of {}; found {}",
        quoted(valid, "none"),
        quoted(found, "none")
    )]
    NotExactlyOne {
        /// The keys to choose from.
        valid: Vec<String>,
        /// The keys that were given.
        found: Vec<String>,
    },
    /// Two things of the same kind have the same name.
    #[error("`{name}` is already used by {first}{advice}")]
    NotUnique {
        /// The name.
        name: String,
        /// Key path of what has it already.
        first: String,
        /// What to do about it, with its own punctuation.
        advice: &'static str,
    },
    /// Any other reason.
    #[error("{0}")]
    Other(String),
}

impl Fault {
    /// A name that does not exist where it should: `what` says of what and where
    /// ("physical group in the mesh"), `candidates` are the names that do exist.
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

    /// A value that is not as `expected` in words.
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

/// A quantity written with its unit is the likeliest cause of a string in place of a number.
fn unit_advice(found: &str, unit: Option<&'static str>) -> String {
    match unit {
        Some(unit) if found.contains("the string") => {
            format!("; values are plain numbers in SI units, here {unit}")
        }
        _ => String::new(),
    }
}

/// Where a faulty key was written.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum Location {
    /// At a place in the case file, line and column counted from 1.
    #[error("{}:{line}:{column}", path.display())]
    Position {
        /// The case file.
        path: PathBuf,
        /// Line, from 1.
        line: usize,
        /// Column in characters, from 1.
        column: usize,
    },
    /// Nowhere in particular in the case file: something is missing from it.
    #[error("{}", path.display())]
    Document {
        /// The case file.
        path: PathBuf,
    },
    /// On the command line.
    #[error("{}", as_option(given))]
    Override {
        /// The setting as it was given, `key=value` or `-key`.
        given: String,
    },
}

/// Why a case could not be read.
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
        /// Where the text stops making sense.
        location: Location,
        /// The TOML parser's reason.
        message: String,
    },
    /// A `--set` or `--unset` could not be applied.
    #[error("{}: {reason}", as_option(given))]
    Override {
        /// The setting as it was given.
        given: String,
        /// Why it could not be applied.
        reason: String,
    },
    /// A key or its value is wrong.
    #[error("{location}: {key}: {fault}")]
    Key {
        /// Where it was written.
        location: Location,
        /// Path of the key, `load.0.group`.
        key: String,
        /// What is wrong.
        fault: Box<Fault>,
    },
}

/// A fault at a key that is not yet located in the text.
#[derive(Debug, Clone, PartialEq)]
pub struct KeyFault {
    /// Path of the key.
    pub key: KeyPath,
    /// What is wrong with it.
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
