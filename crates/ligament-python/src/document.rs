//! Objects of Python as sections of a case.

use ligament_case::case::document::{Entry, Node, Origin, Value};
use ligament_case::case::key_path::KeyPath;
use ligament_study::sweep::written;
use pyo3::prelude::*;
use pyo3::types::{PyBool, PyDict, PyFloat, PyInt, PyList, PyString, PyTuple};

use crate::errors;

/// Lists and dictionaries within each other; no case has more than six. Something that holds itself has more than any.
const DEEPEST: usize = 32;

/// Values of a case at most: lists that are shared by others many times over have more than any memory.
const MOST_VALUES: usize = 1_000_000;

/// The document of a dictionary of sections; an entry that is `None` is left out.
///
/// # Errors
///
/// If something in it is no value of a case, is nested too deep, as what holds itself is, or there is too much of it.
pub(crate) fn document(sections: &Bound<'_, PyDict>) -> PyResult<Node> {
    Reading::default().table(sections, &KeyPath::default())
}

/// Overrides as the command line has them, `key=value`, or `-key` where the value is `None`.
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
        let text = written::toml(&node, &place);
        let text = text.map_err(|it| errors::at_key(value.py(), &place, &it.fault.to_string()))?;
        all.push(format!("{key}={text}"));
    }
    Ok(all)
}

fn in_memory(value: Value) -> Node {
    Node {
        origin: Origin::Memory,
        value,
    }
}

/// A reading of objects, which goes on for ever in what holds itself.
#[derive(Debug, Default)]
struct Reading {
    /// Objects around the present one.
    depth: usize,
    /// Values so far.
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

    /// A value at a place, within the bounds of a case.
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
            // The place of something deep within itself would fill pages.
            let at = KeyPath(place.0.iter().take(3).cloned().collect());
            return Err(errors::at_key(value.py(), &at, &fault));
        }
        self.depth += 1;
        let node = self.value(value, place);
        self.depth -= 1;
        node
    }

    /// A value at a place; arrays and numbers of NumPy are taken as lists and numbers, paths as their text.
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
