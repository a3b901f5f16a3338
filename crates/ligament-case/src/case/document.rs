//! The parsed text of a case file: a tree of TOML values with their origins.

use serde::de::Error as _;
use toml::Spanned;
use toml::de::{DeTable, DeValue};

use super::key_path::KeyPath;

/// Origin of a value.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Origin {
    /// A byte offset in the file.
    File(usize),
    /// The override with this index.
    Override(usize),
    /// A program that created the value in memory.
    Memory,
}

/// A value with its origin.
#[derive(Debug, Clone, PartialEq)]
pub struct Node {
    /// Start of the value; of a table the start of its header or brace.
    pub origin: Origin,
    /// The value.
    pub value: Value,
}

/// A TOML value.
#[derive(Debug, Clone, PartialEq)]
pub enum Value {
    /// A text.
    String(String),
    /// A whole number.
    Integer(i64),
    /// A number with a point or an exponent.
    Float(f64),
    /// `true` or `false`.
    Boolean(bool),
    /// A date or a time, which no key takes.
    Date,
    /// Values in brackets, or tables of one name.
    List(Vec<Node>),
    /// Keys with their values.
    Table(Vec<Entry>),
}

/// A key of a table with its value.
#[derive(Debug, Clone, PartialEq)]
pub struct Entry {
    /// The key.
    pub key: String,
    /// Origin of the key (the first one, if a table has several headers).
    pub key_origin: Origin,
    /// Value of the key.
    pub node: Node,
}

impl Node {
    /// Parses the text of a case file.
    pub fn parse_document(text: &str) -> Result<Self, toml::de::Error> {
        let table = DeTable::parse(text)?;
        let origin = &Origin::File;
        Ok(Self {
            origin: Origin::File(0),
            value: table_value(table.into_inner(), origin)?,
        })
    }

    /// Parses the value of an override.
    pub fn parse_value(text: &str, origin: Origin) -> Result<Self, toml::de::Error> {
        node(DeValue::parse(text)?, &|_| origin)
    }

    /// The entries, if this is a table.
    pub fn entries(&self) -> &[Entry] {
        match &self.value {
            Value::Table(entries) => entries,
            _ => &[],
        }
    }

    /// The value of a key, if this is a table that has it.
    pub fn get(&self, key: &str) -> Option<&Node> {
        self.entries()
            .iter()
            .find(|entry| entry.key == key)
            .map(|entry| &entry.node)
    }

    /// The value of a key to change, if this is a table that has it.
    pub fn get_mut(&mut self, key: &str) -> Option<&mut Node> {
        let Value::Table(entries) = &mut self.value else {
            return None;
        };
        let mut entries = entries.iter_mut();
        entries.find(|it| it.key == key).map(|it| &mut it.node)
    }

    /// The value for one path segment: a key of a table or an index of a list.
    pub fn step(&self, segment: &str) -> Option<&Node> {
        match &self.value {
            Value::List(nodes) => nodes.get(segment.parse::<usize>().ok()?),
            _ => self.get(segment),
        }
    }

    /// The value at a path, if there is one.
    pub fn at(&self, path: &KeyPath) -> Option<&Node> {
        let mut segments = path.0.iter();
        segments.try_fold(self, |node, segment| node.step(segment))
    }

    /// The value, if it is a number.
    pub fn number(&self) -> Option<f64> {
        match self.value {
            Value::Integer(integer) => Some(integer as f64),
            Value::Float(float) => Some(float),
            _ => None,
        }
    }

    /// Origin of the value at a path or, if it does not exist, of the innermost existing table above it.
    ///
    /// `None` where not even the path's first key exists.
    pub fn origin_of(&self, path: &KeyPath) -> Option<Origin> {
        let mut node = self;
        let mut origin = None;
        for segment in &path.0 {
            let Some(next) = node.step(segment) else {
                break;
            };
            node = next;
            origin = Some(node.origin);
        }
        origin
    }

    /// Origin of the key at a path, not of its value.
    pub fn key_origin_of(&self, path: &KeyPath) -> Option<Origin> {
        let parent = self.at(&path.parent())?;
        parent
            .entries()
            .iter()
            .find(|entry| entry.key == path.last())
            .map(|entry| entry.key_origin)
    }
}

/// Converts a parsed value; `origin` returns the origin for a byte offset.
fn node(
    value: Spanned<DeValue<'_>>,
    origin: &dyn Fn(usize) -> Origin,
) -> Result<Node, toml::de::Error> {
    let start = value.span().start;
    let value = match value.into_inner() {
        DeValue::String(text) => Value::String(text.into_owned()),
        DeValue::Integer(integer) => integer_value(integer.as_str(), integer.radix())?,
        DeValue::Float(float) => float_value(float.as_str())?,
        DeValue::Boolean(value) => Value::Boolean(value),
        DeValue::Datetime(_) => Value::Date,
        DeValue::Array(values) => Value::List(
            values
                .into_iter()
                .map(|value| node(value, origin))
                .collect::<Result<_, _>>()?,
        ),
        DeValue::Table(table) => table_value(table, origin)?,
    };
    Ok(Node {
        origin: origin(start),
        value,
    })
}

/// Converts a table, with entries in the order of the text, so that the first of several faults is reported.
fn table_value(
    table: DeTable<'_>,
    origin: &dyn Fn(usize) -> Origin,
) -> Result<Value, toml::de::Error> {
    let mut entries = table
        .into_iter()
        .map(|(key, value)| {
            let start = key.span().start;
            let entry = Entry {
                key: key.into_inner().into_owned(),
                key_origin: origin(start),
                node: node(value, origin)?,
            };
            Ok((start, entry))
        })
        .collect::<Result<Vec<_>, toml::de::Error>>()?;
    entries.sort_by_key(|(start, _)| *start);
    Ok(Value::Table(
        entries.into_iter().map(|(_, entry)| entry).collect(),
    ))
}

/// Converts an integer; beyond 64 bits to a float.
fn integer_value(text: &str, radix: u32) -> Result<Value, toml::de::Error> {
    match i64::from_str_radix(text, radix) {
        Ok(integer) => Ok(Value::Integer(integer)),
        Err(_) => float_value(text),
    }
}

fn float_value(text: &str) -> Result<Value, toml::de::Error> {
    let float = text
        .parse()
        .map_err(|_| toml::de::Error::custom(format!("`{text}` is not a number")))?;
    Ok(Value::Float(float))
}

/// Line and column, both from 1, of a byte offset; columns count characters.
pub fn line_and_column(text: &str, offset: usize) -> (usize, usize) {
    let before = text.get(..offset).unwrap_or(text);
    let line_start = before.rfind('\n').map_or(0, |newline| newline + 1);
    (
        before.matches('\n').count() + 1,
        before[line_start..].chars().count() + 1,
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    const TEXT: &str = "title = \"é\"\n[a]\nb = 1\n[[c]]\nd = { e = 2.0 }\n[[c]]\nd = 3\n[m.x]\nk = 1\n[m.y]\nk = 2\n";

    fn at(path: &str) -> Option<(usize, usize)> {
        let document = Node::parse_document(TEXT).unwrap();
        match document.origin_of(&KeyPath::parse(path).unwrap())? {
            Origin::File(offset) => Some(line_and_column(TEXT, offset)),
            Origin::Override(_) | Origin::Memory => None,
        }
    }

    #[test]
    fn values_are_found_by_path() {
        assert_eq!(at("a.b"), Some((3, 5)));
        assert_eq!(at("c.0.d.e"), Some((5, 11)));
        assert_eq!(at("c.1.d"), Some((7, 5)));
        assert_eq!(at("m.y.k"), Some((11, 5)));
    }

    #[test]
    fn a_missing_key_is_at_its_table() {
        assert_eq!(at("a.z"), Some((2, 1)));
        assert_eq!(at("c.1.z"), Some((6, 1)));
        assert_eq!(at("m.y.z"), Some((10, 1)));
        assert_eq!(at("z"), None);
    }

    #[test]
    fn columns_count_characters() {
        assert_eq!(line_and_column("é = é", "é = ".len()), (1, 5));
    }
}
