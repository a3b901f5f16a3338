//! A file of keys with the settings on top of it, and where each of its keys stands.

use std::path::{Path, PathBuf};

use super::body_kind::BodyKind;
use super::document::{Node, Origin, line_and_column};
use super::fault::{CaseError, Fault, KeyFault, Location};
use super::key_path::KeyPath;
use super::keys::unit_of;
use super::overrides;

/// The text of a case or a study, parsed, with what it was read from.
#[derive(Debug, Clone)]
pub struct Source {
    /// The file, as it was given.
    pub path: PathBuf,
    /// The text of the file; empty where a program handed the document over.
    pub text: String,
    /// The overrides, `key=value` or `-key` each, in their order.
    pub overrides: Vec<String>,
    /// All of it, parsed.
    pub document: Node,
    /// The kind of a body in memory, which stands in the place of the one in the file that the document names.
    pub body: Option<BodyKind>,
}

impl Source {
    /// Parses a text and applies the overrides (`key=value`, or `-key` to take a key away; the later wins); `path` says where it is.
    ///
    /// # Errors
    ///
    /// If the text is not TOML, or an override cannot be applied.
    pub fn parse(path: &Path, text: String, overrides: &[String]) -> Result<Self, CaseError> {
        let document =
            Node::parse_document(&text).map_err(|error| syntax_error(path, &text, &error))?;
        let source = Self::of_document(path, document, overrides)?;
        Ok(Self { text, ..source })
    }

    /// Takes a document from memory and applies the overrides; `path` says where a file of it would be.
    ///
    /// # Errors
    ///
    /// If an override cannot be applied.
    pub fn of_document(
        path: &Path,
        document: Node,
        overrides: &[String],
    ) -> Result<Self, CaseError> {
        let source = Self {
            path: path.to_owned(),
            text: String::new(),
            overrides: Vec::new(),
            document,
            body: None,
        };
        source.with_overrides(overrides)
    }

    /// The source with further overrides on top of those that it has.
    ///
    /// # Errors
    ///
    /// If an override cannot be applied.
    pub fn with_overrides(&self, more: &[String]) -> Result<Self, CaseError> {
        let mut source = self.clone();
        for given in more {
            let index = source.overrides.len();
            overrides::apply(&mut source.document, given, index).map_err(|reason| {
                CaseError::Override {
                    given: given.clone(),
                    reason,
                }
            })?;
            source.overrides.push(given.clone());
        }
        Ok(source)
    }

    /// The file's own name: that of its folder if the file has one of the `usual` names, else the file's own without its
    /// extension.
    pub fn name(&self, usual: &[&str]) -> String {
        let stem = self.path.file_stem().unwrap_or_default();
        let stem = stem.to_string_lossy().into_owned();
        if !usual.contains(&stem.as_str()) {
            return stem;
        }
        let absolute = std::path::absolute(&self.path).unwrap_or_else(|_| self.path.clone());
        let folder = absolute.parent().and_then(Path::file_name);
        folder.map_or(stem, |name| name.to_string_lossy().into_owned())
    }

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

    /// The place of a key, or of the table that would have it.
    pub fn location_of(&self, key: &KeyPath) -> Location {
        self.location(self.document.origin_of(key))
    }

    fn location(&self, origin: Option<Origin>) -> Location {
        let path = self.path.clone();
        match origin {
            None | Some(Origin::Memory) => Location::Document { path },
            Some(Origin::File(offset)) => {
                let (line, column) = line_and_column(&self.text, offset);
                Location::Position { path, line, column }
            }
            Some(Origin::Override(index)) => Location::Override {
                given: self.overrides[index].clone(),
            },
        }
    }
}

/// The error of a text that is not TOML.
fn syntax_error(path: &Path, text: &str, error: &toml::de::Error) -> CaseError {
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
