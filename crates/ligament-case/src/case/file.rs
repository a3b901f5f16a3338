//! A case file on disk: loading it, and locating its keys.

use std::path::{Path, PathBuf};

use super::document::{Node, Origin, line_and_column};
use super::fault::{CaseError, Fault, KeyFault, Location};
use super::key_path::KeyPath;
use super::keys::{check_ranges, unit_of};
use super::sections::Case;
use super::{overrides, resolved};

/// A case with the text it was read from, so that faults found later can still be located.
#[derive(Debug, Clone)]
pub struct CaseFile {
    /// The case file, as it was given.
    pub path: PathBuf,
    /// The text of the file.
    pub text: String,
    /// The overrides, `key=value` each, in their order.
    pub overrides: Vec<String>,
    /// The checked case.
    pub case: Case,
    document: Node,
}

/// What is needed to turn a key path into a location.
pub struct Source<'a> {
    /// The file.
    pub path: &'a Path,
    /// Text of the file.
    pub text: &'a str,
    /// The settings on top of it.
    pub overrides: &'a [String],
    /// All of it, parsed.
    pub document: &'a Node,
}

impl CaseFile {
    /// Reads a case file, applies the overrides (`key=value`, the later wins) and checks the whole.
    ///
    /// # Errors
    ///
    /// If the file cannot be read, is not TOML, or a key or value of it or of an override is wrong.
    pub fn load(path: &Path, overrides: &[String]) -> Result<Self, CaseError> {
        let read = std::fs::read_to_string(path);
        let text = read.map_err(|source| CaseError::Read {
            path: path.to_owned(),
            source,
        })?;
        Self::parse(path, text, overrides)
    }

    /// Like [`load`](Self::load), from text that is already there; `path` says where it would be.
    ///
    /// # Errors
    ///
    /// If the text is not TOML, or a key or value of it or of an override is wrong.
    pub fn parse(path: &Path, text: String, overrides: &[String]) -> Result<Self, CaseError> {
        let mut document =
            Node::parse_document(&text).map_err(|error| syntax_error(path, &text, &error))?;
        for (index, given) in overrides.iter().enumerate() {
            overrides::apply(&mut document, given, index).map_err(|reason| {
                CaseError::Override {
                    given: given.clone(),
                    reason,
                }
            })?;
        }
        let folder = path.parent().unwrap_or(Path::new(""));
        let case = check_ranges(&document).and_then(|()| Case::read(&document, folder));
        let case = case.map_err(|fault| {
            let document = &document;
            Source {
                path,
                text: &text,
                overrides,
                document,
            }
            .error(fault)
        })?;
        let (path, overrides) = (path.to_owned(), overrides.to_vec());
        let file = Self {
            path,
            text,
            overrides,
            case,
            document,
        };
        let setup = file.case.stand_in().and_then(|body| file.case.setup(body));
        let setup = setup.map_err(|fault| file.source().error(fault))?;
        setup.check().map_err(|error| file.located(error))?;
        Ok(file)
    }

    /// Line and column (both from 1) of the value at a key path such as `load.0.group`.
    ///
    /// A key that is not there is at the table that would have it. `None` if that is not there
    /// either, or if the value is from an override.
    pub fn locate(&self, key: &str) -> Option<(usize, usize)> {
        match self.document.origin_of(&KeyPath::parse(key)?)? {
            Origin::File(offset) => Some(line_and_column(&self.text, offset)),
            Origin::Override(_) => None,
        }
    }

    /// The error for a fault found after loading, located at its key.
    ///
    /// For a name that the mesh does not have, [`Fault::unknown_name`] adds the nearest one.
    pub fn error(&self, key: &str, fault: impl Into<Fault>) -> CaseError {
        let key = KeyPath::parse(key).unwrap_or_else(|| KeyPath(vec![key.to_owned()]));
        self.source().error(KeyFault::new(key, fault))
    }

    pub(crate) fn source(&self) -> Source<'_> {
        Source {
            path: &self.path,
            text: &self.text,
            overrides: &self.overrides,
            document: &self.document,
        }
    }

    /// The number at a key path such as `material.young`: as given, or else its default; `None` where neither is a number.
    ///
    /// # Errors
    ///
    /// If the case cannot be written as TOML.
    pub fn number(&self, key: &str) -> Result<Option<f64>, toml_edit::ser::Error> {
        let Some(path) = KeyPath::parse(key) else {
            return Ok(None);
        };
        if let Some(number) = self.document.at(&path).and_then(Node::number) {
            return Ok(Some(number));
        }
        let resolved = Node::parse_document(&self.resolved_toml()?);
        Ok(resolved.ok().and_then(|it| it.at(&path)?.number()))
    }

    /// The case as TOML with every default filled in and the mesh given by its absolute path.
    ///
    /// # Errors
    ///
    /// If the path of the mesh is not UTF-8, which TOML cannot hold.
    pub fn resolved_toml(&self) -> Result<String, toml_edit::ser::Error> {
        resolved::to_toml(&self.case)
    }

    /// The case's own name: that of its folder if the file is called `case.toml` (or
    /// `case.resolved.toml`), else the file's own without its extension.
    pub fn name(&self) -> String {
        let stem = self
            .path
            .file_stem()
            .unwrap_or_default()
            .to_string_lossy()
            .into_owned();
        if stem != "case" && stem != "case.resolved" {
            return stem;
        }
        let absolute = std::path::absolute(&self.path).unwrap_or_else(|_| self.path.clone());
        let folder = absolute.parent().and_then(Path::file_name);
        folder.map_or(stem, |name| name.to_string_lossy().into_owned())
    }
}

impl Source<'_> {
    /// The error of a fault, with its place.
    pub fn error(&self, KeyFault { key, mut fault }: KeyFault) -> CaseError {
        if let Fault::MissingKey { unit, .. } | Fault::WrongType { unit, .. } = &mut fault {
            *unit = unit_of(&key);
        }
        let origin = match &fault {
            // An unknown key is wrong itself; anything else is wrong about the value.
            Fault::UnknownKey { .. } => self.document.key_origin_of(&key),
            // Of keys that exclude each other, one that was set on top is to blame.
            Fault::NotExactlyOne { found, .. } => found
                .iter()
                .filter_map(|name| self.document.origin_of(&key.child(name)))
                .find(|origin| matches!(origin, Origin::Override(_)))
                .or_else(|| self.document.origin_of(&key)),
            _ => self.document.origin_of(&key),
        };
        CaseError::Key {
            location: self.location(origin),
            key: key.to_string(),
            fault: Box::new(fault),
        }
    }

    /// The place of what was written.
    pub fn location(&self, origin: Option<Origin>) -> Location {
        let path = self.path.to_owned();
        match origin {
            None => Location::Document { path },
            Some(Origin::File(offset)) => {
                let (line, column) = line_and_column(self.text, offset);
                Location::Position { path, line, column }
            }
            Some(Origin::Override(index)) => Location::Override {
                given: self.overrides[index].clone(),
            },
        }
    }
}

/// The error of a text that is not TOML.
pub fn syntax_error(path: &Path, text: &str, error: &toml::de::Error) -> CaseError {
    let path = path.to_owned();
    let mut message = error.message().trim().replace('\n', "; ");
    let Some(span) = error.span() else {
        return CaseError::Syntax {
            location: Location::Document { path },
            message,
        };
    };
    // `young = 15 GPa` is taken for a string without its quotes, which is not what was meant.
    let is_number = |text: &str| {
        text.starts_with(|first: char| first.is_ascii_digit() || "+-.".contains(first))
    };
    if message.contains("must be quoted") && text.get(span.start..).is_some_and(is_number) {
        message = "a number stands alone, without its unit; values are in SI units".to_owned();
    }
    let (line, column) = line_and_column(text, span.start);
    CaseError::Syntax {
        location: Location::Position { path, line, column },
        message,
    }
}
