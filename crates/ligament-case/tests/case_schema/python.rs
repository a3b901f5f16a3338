//! The types of the sections of a case in the Python package, made of the schema.

use std::fmt::Write as _;

use serde_json::Value;

use super::SCHEMA;
use super::repository::root;

/// The module of the types.
const MODULE: &str = "crates/ligament-python/python/ligament/_sections.py";

const HEAD: &str = r#""""The sections of a case as types, by which editors complete keys and mypy finds wrong ones.

Made of the schema of a case file: LIGAMENT_WRITE_KEYS=1 cargo test --release -p ligament-case --test integration case_schema
"""

# ruff: noqa: E501
from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from os import PathLike
from typing import Any, Literal, TypedDict

from numpy.typing import NDArray

Numbers = Sequence[float] | NDArray[Any]
Function = Callable[..., Any]
"#;

/// Sections of a body, which `Setup` has in memory.
const BODIES: [&str; 3] = ["mesh", "lattice", "solid_lattice"];

/// Keys that may be functions of the position in Python.
const FUNCTIONS: [&str; 2] = ["TemperatureChange", "LoadProfile"];

/// The types with their names, each before those that use it.
#[derive(Default)]
struct Types(String);

impl Types {
    /// Adds the type of a table with these keys.
    fn add(&mut self, name: &str, base: &str, schema: &Value, keys: &[(&String, &Value)]) {
        let typed: Vec<String> = keys
            .iter()
            .map(|(key, value)| {
                let table = if name.starts_with("Sections") {
                    ""
                } else {
                    name
                };
                let of_key = format!("{table}{}", camel(key));
                let mut kind = self.kind(&of_key, value);
                if FUNCTIONS.contains(&of_key.as_str()) {
                    kind.push_str(" | Function");
                }
                format!("    {key}: {kind}\n{}", docs(value))
            })
            .collect();
        let meaning = schema["description"].as_str().unwrap_or("A table.");
        let _ = write!(
            self.0,
            "\n\nclass {name}({base}, total=False):\n    \"\"\"{}\"\"\"\n\n{}",
            plain(meaning),
            typed.concat()
        );
    }

    /// The type of a value; tables are added under a name.
    fn kind(&mut self, name: &str, schema: &Value) -> String {
        if let Some(words) = schema["enum"].as_array() {
            let words: Vec<String> = words.iter().map(Value::to_string).collect();
            return format!("Literal[{}]", words.join(", "));
        }
        if let Some(word) = schema.get("const") {
            return format!("Literal[{word}]");
        }
        if let (None, Some(forms)) = (schema["type"].as_str(), schema["anyOf"].as_array()) {
            let mut kinds: Vec<String> = Vec::new();
            for form in forms {
                let kind = self.kind(name, form);
                if !kinds.contains(&kind) {
                    kinds.push(kind);
                }
            }
            return kinds.join(" | ");
        }
        match schema["type"].as_str().unwrap_or_default() {
            "string" if name.ends_with("File") => "str | PathLike[str]".to_owned(),
            "string" => "str".to_owned(),
            "number" => "float".to_owned(),
            "integer" => "int".to_owned(),
            "boolean" => "bool".to_owned(),
            "array" => match self.kind(name, &schema["items"]).as_str() {
                "float" => "Numbers".to_owned(),
                each => format!("Sequence[{each}]"),
            },
            "object" => self.table(name, schema),
            other => panic!("{name}: a value of the type `{other}`"),
        }
    }

    /// The type of a table: of keys, by names of the user, or both.
    fn table(&mut self, name: &str, schema: &Value) -> String {
        let mut kinds = Vec::new();
        if let Some(keys) = schema["properties"].as_object() {
            // A table that may stand alone or in a list is one type.
            if !self.0.contains(&format!("\nclass {name}(")) {
                self.add(name, "TypedDict", schema, &keys.iter().collect::<Vec<_>>());
            }
            kinds.push(name.to_owned());
        }
        if schema["additionalProperties"].is_object() {
            let named = if kinds.is_empty() {
                name.to_owned()
            } else {
                format!("{name}Part")
            };
            let each = self.kind(&named, &schema["additionalProperties"]);
            kinds.push(format!("Mapping[str, {each}]"));
        }
        assert!(!kinds.is_empty(), "{name}: a table without keys");
        kinds.join(" | ")
    }
}

/// What a key means, with its unit and default, as a text below it.
fn docs(schema: &Value) -> String {
    let items = schema["items"]["description"].as_str();
    let Some(meaning) = schema["description"].as_str().or(items) else {
        return String::new();
    };
    let default = schema
        .get("default")
        .map_or_else(String::new, |it| format!(" Default {it}."));
    let text = plain(&format!("{meaning}{default}"));
    format!("    \"\"\"{text}\"\"\"\n")
}

/// A text that can stand in a text of Python.
fn plain(text: &str) -> String {
    let text = text.replace('\\', "\\\\").replace("\"\"\"", "'''");
    match text.strip_suffix('"') {
        Some(start) => format!("{start}\\\""),
        None => text,
    }
}

/// `force_per_length` as `ForcePerLength`.
fn camel(key: &str) -> String {
    let parts = key.split(['_', '-']);
    let capital = |part: &str| {
        let mut letters = part.chars();
        let first = letters.next().map(|it| it.to_ascii_uppercase());
        first.into_iter().chain(letters).collect::<String>()
    };
    parts.map(capital).collect()
}

/// The module, from the schema.
fn made() -> String {
    let mut types = Types::default();
    let sections = SCHEMA["properties"].as_object().unwrap();
    let (bodies, others): (Vec<_>, Vec<_>) = sections
        .iter()
        .partition(|(key, _)| BODIES.contains(&key.as_str()));
    let on_body = serde_json::json!({ "description": "The sections of a case without its body." });
    types.add("SectionsOnBody", "TypedDict", &on_body, &others);
    let whole = serde_json::json!({ "description": "The sections of a case." });
    types.add("Sections", "SectionsOnBody", &whole, &bodies);
    format!("{HEAD}{}", types.0)
}

/// The types of the Python package are those of the schema. With `LIGAMENT_WRITE_KEYS` in the environment they are written first.
#[test]
fn the_types_of_the_python_package_are_those_of_the_schema() {
    let path = root().join(MODULE);
    let made = made();
    if std::env::var_os("LIGAMENT_WRITE_KEYS").is_some() {
        std::fs::write(&path, &made).unwrap();
    }
    let again = "make it anew: LIGAMENT_WRITE_KEYS=1 cargo test --release -p ligament-case --test integration case_schema";
    let found = std::fs::read_to_string(&path).unwrap_or_default();
    assert!(found == made, "{MODULE} is not what the keys say; {again}");
}
