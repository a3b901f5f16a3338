//! Values of a study as text, for `--set`, tables and labels.

use serde_json::Value as Cell;

use ligament_case::case::document::{Node, Value};
use ligament_case::case::fault::KeyFault;
use ligament_case::case::key_path::KeyPath;

/// A value as TOML on one line, which is parsed to the same value.
///
/// # Errors
///
/// If the value is a date or a number that is not finite, which no key takes.
pub fn toml(node: &Node, place: &KeyPath) -> Result<String, KeyFault> {
    let joined = |parts: Result<Vec<String>, KeyFault>| Ok::<_, KeyFault>(parts?.join(", "));
    Ok(match &node.value {
        Value::String(text) => quoted(text),
        Value::Integer(integer) => integer.to_string(),
        Value::Float(float) if float.is_finite() => format!("{float:?}"),
        Value::Boolean(value) => value.to_string(),
        Value::List(nodes) => {
            let parts = nodes.iter().enumerate();
            let parts = parts.map(|(index, node)| toml(node, &place.child(index)));
            format!("[{}]", joined(parts.collect())?)
        }
        Value::Table(entries) => {
            let part = |key: &str, node: &Node| {
                let name = KeyPath(vec![key.to_owned()]);
                Ok(format!("{name} = {}", toml(node, &place.child(key))?))
            };
            let parts = entries.iter().map(|entry| part(&entry.key, &entry.node));
            format!("{{ {} }}", joined(parts.collect())?)
        }
        Value::Float(_) | Value::Date => {
            let fault = "no key of a case file takes a date, inf or nan";
            return Err(KeyFault::new(place.clone(), fault));
        }
    })
}

/// A text quoted as in TOML.
pub(crate) fn quoted(text: &str) -> String {
    toml_edit::Value::from(text).to_string()
}

/// A value as a cell of a table: lists and tables as their text.
pub(crate) fn cell(node: &Node, text: &str) -> Cell {
    match &node.value {
        Value::String(text) => Cell::from(text.as_str()),
        Value::Integer(integer) => Cell::from(*integer),
        Value::Float(float) => Cell::from(*float),
        Value::Boolean(value) => Cell::from(*value),
        Value::List(_) | Value::Table(_) | Value::Date => Cell::from(text),
    }
}

/// Text of a cell, without quotes.
pub(crate) fn words(cell: &Cell) -> String {
    match cell {
        Cell::String(text) => text.clone(),
        other => other.to_string(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use ligament_case::case::document::Origin;

    /// Values passed to `--set` are read back as they were in the study.
    #[test]
    fn values_read_back() {
        for text in [
            "3",
            "2.5",
            "1e-7",
            "-0.1",
            "4690000.0",
            "true",
            "\"a \\\"b\\\"\\\\\"",
            "\"true\"",
            "[[0.0, 1.0], [2, 3e300]]",
            "{ load_fraction = 0.9, \"a b\" = [] }",
        ] {
            let node = Node::parse_value(text, Origin::File(0)).unwrap();
            let written = toml(&node, &KeyPath::default()).unwrap();
            let again = Node::parse_value(&written, Origin::File(0)).unwrap();
            assert_eq!(node, again, "{written}");
        }
        for text in ["nan", "[inf]", "2020-01-01"] {
            let node = Node::parse_value(text, Origin::File(0)).unwrap();
            assert!(toml(&node, &KeyPath::default()).is_err(), "{text}");
        }
    }
}
