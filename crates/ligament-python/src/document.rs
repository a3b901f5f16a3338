//! Conversion of Python objects to sections of a case.

use ligament_case::case::document::{Entry, Node, Origin, Value};
use ligament_case::case::key_path::KeyPath;
use ligament_study::sweep::toml_text;
use pyo3::prelude::*;
use pyo3::types::{PyBool, PyDict, PyFloat, PyInt, PyList, PyString, PyTuple};

use crate::errors;

/// Largest nesting of lists and dictionaries; no case has more than six, and a cyclic object exceeds any limit.
const DEEPEST: usize = 32;

/// Largest number of values of a case; lists that share others repeatedly could exceed the memory.
const MOST_VALUES: usize = 1_000_000;

/// The document of a dictionary of sections, without entries that are `None`.
///
/// # Errors
///
/// If an object is not a value of a case, is nested too deeply or cyclic, or there are too many values.
pub(crate) fn document(sections: &Bound<'_, PyDict>) -> PyResult<Node> {
    Reading::default().table(sections, &KeyPath::default())
}

/// Overrides in the form of the command line: `key=value`, or `-key` where the value is `None`.
pub(crate) fn overrides(changes: &Bound<'_, PyDict>) -> PyResult<Vec<String>> {
    let mut all = Vec::new();
    for (key, value) in changes {
        let key: String = key.extract()?;
        if value.is_none() {
            all.push(ligament_case::case::unset(&key));
            continue;
        }
        let place = KeyPath::parse(&key).unwrap_or_else(|| KeyPath(vec![key.clone()]));
        let node = Reading::default().node(&value, &place)?;
        let text = toml_text::toml(&node, &place);
        let text = text.map_err(|it| errors::at_key(value.py(), &place, &it.fault.to_string()))?;
        all.push(format!("{key}={text}"));
    }
    Ok(all)
}

/// The text of a document in TOML, a line for each section.
pub(crate) fn text(py: Python<'_>, document: &Node) -> PyResult<String> {
    let line = |entry: &Entry| {
        let place = KeyPath(vec![entry.key.clone()]);
        let value = toml_text::toml(&entry.node, &place);
        let value = value.map_err(|it| errors::at_key(py, &place, &it.fault.to_string()))?;
        Ok(format!("{place} = {value}\n"))
    };
    document.entries().iter().map(line).collect()
}

fn in_memory(value: Value) -> Node {
    Node {
        origin: Origin::Memory,
        value,
    }
}

/// Converter of objects, with limits for cyclic ones.
#[derive(Debug, Default)]
struct Reading {
    /// Number of objects that enclose the present one.
    depth: usize,
    /// Number of values so far.
    n_values: usize,
}

impl Reading {
    fn table(&mut self, sections: &Bound<'_, PyDict>, place: &KeyPath) -> PyResult<Node> {
        let mut entries = Vec::new();
        for (key, value) in sections {
            let key: String = key.extract()?;
            if !value.is_none() {
                let node = self.node(&value, &place.child(&key))?;
                entries.push(Entry {
                    key,
                    key_origin: Origin::Memory,
                    node,
                });
            }
        }
        Ok(in_memory(Value::Table(entries)))
    }

    /// Converts a value at a key, within the limits of a case.
    fn node(&mut self, value: &Bound<'_, PyAny>, place: &KeyPath) -> PyResult<Node> {
        self.n_values += 1;
        let fault = if self.depth == DEEPEST {
            format!(
                "lists and dicts are nested more than {DEEPEST} deep here, or hold themselves; a case has no such value"
            )
        } else if self.n_values > MOST_VALUES {
            format!(
                "a case has {MOST_VALUES} values at most; lists and dicts that hold others many times over have more"
            )
        } else {
            String::new()
        };
        if !fault.is_empty() {
            // The key of a deeply nested object is shortened.
            let at = KeyPath(place.0.iter().take(3).cloned().collect());
            return Err(errors::at_key(value.py(), &at, &fault));
        }
        self.depth += 1;
        let node = self.value(value, place);
        self.depth -= 1;
        node
    }

    /// Converts a value at a key; arrays and numbers of NumPy become lists and numbers, paths their text.
    fn value(&mut self, value: &Bound<'_, PyAny>, place: &KeyPath) -> PyResult<Node> {
        if value.is_instance_of::<PyBool>() {
            return Ok(in_memory(Value::Boolean(value.extract()?)));
        }
        if value.is_instance_of::<PyInt>() {
            let whole = value.extract::<i64>().map(Value::Integer);
            return whole
                .or_else(|_| Ok(Value::Float(value.extract()?)))
                .map(in_memory);
        }
        if value.is_instance_of::<PyFloat>() {
            return Ok(in_memory(Value::Float(value.extract()?)));
        }
        if value.is_instance_of::<PyString>() {
            return Ok(in_memory(Value::String(value.extract()?)));
        }
        if let Ok(sections) = value.cast::<PyDict>() {
            return self.table(sections, place);
        }
        if value.is_instance_of::<PyList>() || value.is_instance_of::<PyTuple>() {
            let mut nodes = Vec::new();
            for (index, element) in value.try_iter()?.enumerate() {
                nodes.push(self.node(&element?, &place.child(index))?);
            }
            return Ok(in_memory(Value::List(nodes)));
        }
        for method in ["tolist", "__fspath__"] {
            if value.hasattr(method)? {
                return self.node(&value.call_method0(method)?, place);
            }
        }
        let kind = value.get_type().name()?;
        let fault = format!("expected a number, text, truth value, list or dict, found {kind}");
        Err(errors::at_key(value.py(), place, &fault))
    }
}
