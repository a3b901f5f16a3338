//! The JSON schema of a case file says what the reader takes: no key more, no key less.

#![allow(clippy::unwrap_used, reason = "a failed unwrap fails the test")]

mod agreement;
mod documents;
mod python;
mod repository;

use std::path::Path;
use std::sync::LazyLock;

use boon::{Compiler, SchemaIndex, Schemas};
use ligament_case::case::{CaseError, CaseFile, Fault, schema};
use serde_json::Value;

static SCHEMA: LazyLock<Value> = LazyLock::new(schema);

static VALIDATOR: LazyLock<(Schemas, SchemaIndex)> = LazyLock::new(|| {
    let (mut schemas, mut compiler) = (Schemas::new(), Compiler::new());
    compiler.add_resource("case.json", SCHEMA.clone()).unwrap();
    let index = compiler.compile("case.json", &mut schemas).unwrap();
    (schemas, index)
});

/// What the schema has against a document.
fn objection(document: &Value) -> Option<String> {
    let (schemas, index) = &*VALIDATOR;
    let error = schemas.validate(document, *index).err()?;
    Some(format!("{error:#}"))
}

/// The document of a TOML text.
fn document(text: &str) -> Value {
    toml::from_str(text).unwrap()
}

/// The case that the reader makes of a document.
fn read(document: &Value) -> Result<CaseFile, CaseError> {
    let text = toml::to_string(document).unwrap();
    CaseFile::parse(Path::new("case.toml"), text, &[])
}

/// The fault that the reader finds in a document, with its key.
fn fault(document: &Value) -> Option<(String, Fault)> {
    match read(document).err()? {
        CaseError::Key { key, fault, .. } => Some((key, *fault)),
        other => panic!("{other}"),
    }
}
