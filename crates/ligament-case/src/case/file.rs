//! Loading of case files, and locations of their keys.

use std::path::Path;

use ligament::SetupError;

use super::document::{Node, Origin, line_and_column};
use super::fault::{CaseError, Fault, KeyFault};
use super::fracture;
use super::key_path::KeyPath;
use super::keys::check_ranges;
use super::mesh_section::BodyKind;
use super::resolved;
use super::sections::Case;
use super::source::Source;

use crate::input_file;

/// A case with its text, so that faults found later can be located.
#[derive(Debug, Clone)]
pub struct CaseFile {
    /// The file with its overrides.
    pub source: Source,
    /// The checked case.
    pub case: Case,
}

impl CaseFile {
    /// Reads a case file, applies the overrides (`key=value`, or `-key` to remove a key; later ones take precedence) and checks the result.
    ///
    /// # Errors
    ///
    /// If the file cannot be read, is not TOML, or a key or value of the file or an override is wrong.
    pub fn load(path: &Path, overrides: &[String]) -> Result<Self, CaseError> {
        let read = input_file::read_text(path);
        let text = read.map_err(|source| CaseError::Read {
            path: path.to_owned(),
            source,
        })?;
        Self::parse(path, text, overrides)
    }

    /// Parses a text as [`load`](Self::load) does a file; `path` is the path that its file would have.
    ///
    /// # Errors
    ///
    /// If the text is not TOML, or a key or value of the text or an override is wrong.
    pub fn parse(path: &Path, text: String, overrides: &[String]) -> Result<Self, CaseError> {
        Self::read(Source::parse(path, text, overrides)?)
    }

    /// Reads a document in memory as [`parse`](Self::parse) does a text; `path` is the path that its file would have.
    ///
    /// # Errors
    ///
    /// If a key or value of the document or an override is wrong.
    pub fn from_document(
        path: &Path,
        document: Node,
        overrides: &[String],
    ) -> Result<Self, CaseError> {
        Self::read(Source::from_document(path, document, overrides)?)
    }

    /// Reads a document as [`from_document`](Self::from_document) does, for a body in memory of a kind in place of the document's body.
    ///
    /// # Errors
    ///
    /// If a key or value of the document or an override is wrong.
    pub fn on_body(
        path: &Path,
        document: Node,
        overrides: &[String],
        kind: BodyKind,
    ) -> Result<Self, CaseError> {
        let source = Source::from_document(path, document, overrides)?;
        let body = Some(kind);
        Self::read(Source { body, ..source })
    }

    /// The case with further overrides after its present ones.
    ///
    /// # Errors
    ///
    /// If an override cannot be applied, or a key or value becomes wrong.
    pub fn with_overrides(&self, more: &[String]) -> Result<Self, CaseError> {
        Self::read(self.source.with_overrides(more)?)
    }

    fn read(mut source: Source) -> Result<Self, CaseError> {
        let folder = source.path.parent().unwrap_or(Path::new("")).to_owned();
        let read = fracture::read_curves(&mut source.document, &folder);
        read.map_err(|fault| source.error(fault))?;
        let document = &source.document;
        let case = check_ranges(document).and_then(|()| Case::read(document, &folder, source.body));
        let case = case.map_err(|fault| source.error(fault))?;
        let file = Self { source, case };
        file.case.check_kind(&file.source)?;
        Ok(file)
    }

    /// Line and column (both from 1) of the value at a key path such as `load.0.group`.
    ///
    /// For a missing key, the position of the table that would have it. `None` if the table is missing too, or if the value is from an
    /// override.
    pub fn locate(&self, key: &str) -> Option<(usize, usize)> {
        match self.source.document.origin_of(&KeyPath::parse(key)?)? {
            Origin::File(offset) => Some(line_and_column(&self.source.text, offset)),
            Origin::Override(_) | Origin::Memory => None,
        }
    }

    /// The error of a faulty field of the setup, at the responsible key.
    pub fn error_at_key(&self, error: SetupError) -> CaseError {
        self.case.error_at_key(&self.source, error)
    }

    /// The error for a fault found after loading, located at its key.
    ///
    /// For a name that the mesh does not have, [`Fault::unknown_name`] adds the most similar one.
    pub fn error(&self, key: &str, fault: impl Into<Fault>) -> CaseError {
        let key = KeyPath::parse(key).unwrap_or_else(|| KeyPath(vec![key.to_owned()]));
        self.source.error(KeyFault::new(key, fault))
    }

    /// The number at a key path such as `material.young`, as given or by default; `None` where neither is a number.
    ///
    /// # Errors
    ///
    /// If the case cannot be written as TOML.
    pub fn number(&self, key: &str) -> Result<Option<f64>, toml_edit::ser::Error> {
        let Some(path) = KeyPath::parse(key) else {
            return Ok(None);
        };
        if let Some(number) = self.source.document.at(&path).and_then(Node::number) {
            return Ok(Some(number));
        }
        let resolved = Node::parse_document(&self.resolved_toml()?);
        Ok(resolved.ok().and_then(|it| it.at(&path)?.number()))
    }

    /// The case as TOML with all defaults and the absolute path of the mesh.
    ///
    /// # Errors
    ///
    /// If the path of the mesh is not UTF-8, which TOML requires.
    pub fn resolved_toml(&self) -> Result<String, toml_edit::ser::Error> {
        resolved::to_toml(&self.case)
    }

    /// Name of the case: the name of its folder if the file is `case.toml` or `case.resolved.toml`, otherwise the name of the file without its
    /// extension.
    pub fn name(&self) -> String {
        self.source.name(&["case", "case.resolved"])
    }
}
