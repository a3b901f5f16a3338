//! A file of keys with its overrides, and the locations of its keys.

use std::path::{Path, PathBuf};

use super::document::{Node, Origin, line_and_column};
use super::fault::{CaseError, Fault, KeyFault, Location};
use super::key_path::KeyPath;
use super::keys::{in_sections, unit_of};
use super::mesh_section::BodyKind;
use super::overrides;

/// Ending that names of case files may have before their extension, by which editors distinguish them from other TOML files.
const KIND: &str = ".ligament";

/// The parsed text of a case or a study, with its file and overrides.
#[derive(Debug, Clone)]
pub struct Source {
    /// Path of the file as it was given.
    pub path: PathBuf,
    /// Text of the file; empty for a document in memory.
    pub text: String,
    /// Overrides, `key=value` or `-key` each, in their order.
    pub overrides: Vec<String>,
    /// Parsed text with the overrides applied.
    pub document: Node,
    /// Kind of a body in memory, which replaces the body in the document's file.
    pub body: Option<BodyKind>,
}

impl Source {
    /// Parses a text with the path of its file and applies the overrides (`key=value`, or `-key` to remove a key; later ones take
    /// precedence).
    ///
    /// # Errors
    ///
    /// If the text is not TOML, or an override cannot be applied.
    pub fn parse(path: &Path, text: String, overrides: &[String]) -> Result<Self, CaseError> {
        let document =
            Node::parse_document(&text).map_err(|error| syntax_error(path, &text, &error))?;
        let source = Self::from_document(path, document, overrides)?;
        Ok(Self { text, ..source })
    }

    /// Applies the overrides to a document in memory; `path` is the path that its file would have.
    ///
    /// # Errors
    ///
    /// If an override cannot be applied.
    pub fn from_document(
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

    /// The source with further overrides after its present ones.
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

    /// Name of the source: the name of its folder if the file has one of the `usual` names, otherwise the name of the file without its extension.
    pub fn name(&self, usual: &[&str]) -> String {
        let stem = self.path.file_stem().unwrap_or_default();
        let stem = stem.to_string_lossy();
        // `disk.ligament.toml` is the case `disk`.
        let stem = stem.strip_suffix(KIND).unwrap_or(&stem).to_owned();
        if !usual.contains(&stem.as_str()) {
            return stem;
        }
        let absolute = std::path::absolute(&self.path).unwrap_or_else(|_| self.path.clone());
        let folder = absolute.parent().and_then(Path::file_name);
        folder.map_or(stem, |name| name.to_string_lossy().into_owned())
    }

    /// The error of a fault, with its location.
    pub fn error(&self, KeyFault { key, mut fault }: KeyFault) -> CaseError {
        if let Fault::MissingKey { unit, .. } | Fault::WrongType { unit, .. } = &mut fault {
            *unit = unit_of(&key);
        }
        if let (Fault::UnknownKey { key: given, .. }, [_]) = (&fault, key.0.as_slice()) {
            let (given, known) = (given.clone(), in_sections(given));
            if !known.is_empty() {
                fault = Fault::KeyOfSection { key: given, known };
            }
        }
        let origin = match &fault {
            // An unknown key is located at the key, any other fault at the value.
            Fault::UnknownKey { .. } | Fault::KeyOfSection { .. } => {
                self.document.key_origin_of(&key)
            }
            // The error of keys that exclude each other is located at an override, if there is one.
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

    /// Location of a key, or of the table that would have it.
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
    // The parser reports `young = 15 GPa` as a string without quotes.
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
