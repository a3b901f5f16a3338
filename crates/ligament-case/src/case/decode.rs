//! Reads the document tree into typed sections, with faults in the words of a case file.

use std::fmt;

use serde::de::DeserializeOwned;
use serde::de::value::BorrowedStrDeserializer;
use serde::de::{
    DeserializeSeed, Deserializer, Expected, MapAccess, SeqAccess, Unexpected, Visitor,
};
use serde::forward_to_deserialize_any;

use super::document::{Entry, Node, Value};
use super::fault::{Fault, KeyFault};
use super::key_path::KeyPath;

/// Longer strings are cut in error messages.
const LONGEST_QUOTE: usize = 40;

/// Reads a typed section from the node at a key path.
pub fn decode<T: DeserializeOwned>(node: &Node, key: &KeyPath) -> Result<T, KeyFault> {
    T::deserialize(node).map_err(|error| error.finish(key))
}

/// A fault with its path, innermost part first: each level adds its part on the way out.
#[derive(Debug)]
pub struct DecodeError {
    inner_first: Vec<String>,
    fault: Fault,
}

impl DecodeError {
    fn below(mut self, segment: impl fmt::Display) -> Self {
        self.inner_first.push(segment.to_string());
        self
    }

    /// Completes what only the whole path tells: the table's title.
    fn finish(mut self, root: &KeyPath) -> KeyFault {
        let mut key = root.clone();
        key.0.extend(self.inner_first.into_iter().rev());
        match &mut self.fault {
            Fault::UnknownKey { table, .. } => *table = key.parent().table_title(),
            Fault::MissingKey {
                key: missing,
                table,
                ..
            } => {
                *table = key.table_title();
                key = key.child(missing);
            }
            Fault::WrongType {
                expected, found, ..
            } if key.is_repeated() && expected == "a list" && found == "a table" => {
                self.fault = Fault::SingleBrackets {
                    section: key.to_string(),
                };
            }
            _ => {}
        }
        KeyFault {
            key,
            fault: self.fault,
        }
    }
}

impl fmt::Display for DecodeError {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.fault.fmt(formatter)
    }
}

impl std::error::Error for DecodeError {}

impl From<Fault> for DecodeError {
    fn from(fault: Fault) -> Self {
        Self {
            inner_first: Vec::new(),
            fault,
        }
    }
}

impl serde::de::Error for DecodeError {
    fn custom<T: fmt::Display>(message: T) -> Self {
        Fault::Other(message.to_string()).into()
    }

    fn invalid_type(found: Unexpected<'_>, expected: &dyn Expected) -> Self {
        wrong_type(expected_words(expected), found_words(found))
    }

    fn invalid_value(found: Unexpected<'_>, expected: &dyn Expected) -> Self {
        Self::invalid_type(found, expected)
    }

    fn invalid_length(length: usize, expected: &dyn Expected) -> Self {
        wrong_type(expected_words(expected), format!("a list of {length}"))
    }

    fn unknown_field(key: &str, valid: &'static [&'static str]) -> Self {
        let valid = valid.iter().map(|&key| key.to_owned()).collect();
        Fault::UnknownKey {
            key: key.to_owned(),
            table: String::new(),
            valid,
        }
        .into()
    }

    fn missing_field(key: &'static str) -> Self {
        Fault::MissingKey {
            key: key.to_owned(),
            table: String::new(),
            unit: None,
        }
        .into()
    }
}

fn wrong_type(expected: String, found: String) -> DecodeError {
    let unit = None;
    Fault::WrongType {
        expected,
        found,
        unit,
    }
    .into()
}

/// What serde's visitors expect, in the words of a case file.
fn expected_words(expected: &dyn Expected) -> String {
    let text = expected.to_string();
    match text.as_str() {
        "f64" => "a number".to_owned(),
        "u32" | "u64" | "usize" => "a whole number, 0 or more".to_owned(),
        "a boolean" => "true or false".to_owned(),
        "a sequence" => "a list".to_owned(),
        "a map" => "a table".to_owned(),
        "an array of length 2" => "a list of 2".to_owned(),
        _ => text,
    }
}

fn found_words(found: Unexpected<'_>) -> String {
    match found {
        Unexpected::Str(text) => string_words(text),
        Unexpected::Signed(integer) => format!("the number {integer}"),
        Unexpected::Unsigned(integer) => format!("the number {integer}"),
        Unexpected::Float(float) => format!("the number {float:?}"),
        Unexpected::Bool(value) => value.to_string(),
        Unexpected::Seq => "a list".to_owned(),
        Unexpected::Map => "a table".to_owned(),
        other => other.to_string(),
    }
}

fn string_words(text: &str) -> String {
    if text.chars().count() > LONGEST_QUOTE {
        let start: String = text.chars().take(LONGEST_QUOTE).collect();
        return format!("the string {:?}", start + "...");
    }
    format!("the string {text:?}")
}

/// What a value is, for "found ...".
fn value_words(value: &Value) -> String {
    found_words(match value {
        Value::String(text) => Unexpected::Str(text),
        Value::Integer(integer) => Unexpected::Signed(*integer),
        Value::Float(float) => Unexpected::Float(*float),
        Value::Boolean(value) => Unexpected::Bool(*value),
        Value::Date => Unexpected::Other("a date"),
        Value::List(_) => Unexpected::Seq,
        Value::Table(_) => Unexpected::Map,
    })
}

impl<'de> Deserializer<'de> for &'de Node {
    type Error = DecodeError;

    fn deserialize_any<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, DecodeError> {
        match &self.value {
            Value::String(text) => visitor.visit_borrowed_str(text),
            Value::Integer(integer) => visitor.visit_i64(*integer),
            Value::Float(float) if float.is_finite() => visitor.visit_f64(*float),
            Value::Float(float) => {
                Err(Fault::out_of_range("a finite number", float.to_string()).into())
            }
            Value::Boolean(value) => visitor.visit_bool(*value),
            Value::Date => Err(serde::de::Error::invalid_type(
                Unexpected::Other("a date"),
                &visitor,
            )),
            Value::List(nodes) => visit_list(nodes, visitor),
            Value::Table(entries) => visitor.visit_map(Entries {
                rest: entries.iter(),
                current: None,
            }),
        }
    }

    fn deserialize_ignored_any<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, DecodeError> {
        visitor.visit_unit()
    }

    fn deserialize_option<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, DecodeError> {
        visitor.visit_some(self)
    }

    // Without this, serde would also take a section written as a list of its values.
    fn deserialize_struct<V: Visitor<'de>>(
        self,
        _name: &'static str,
        _fields: &'static [&'static str],
        visitor: V,
    ) -> Result<V::Value, DecodeError> {
        match &self.value {
            Value::Table(_) => self.deserialize_any(visitor),
            other => Err(wrong_type("a table".to_owned(), value_words(other))),
        }
    }

    fn deserialize_enum<V: Visitor<'de>>(
        self,
        _name: &'static str,
        variants: &'static [&'static str],
        visitor: V,
    ) -> Result<V::Value, DecodeError> {
        let Value::String(word) = &self.value else {
            let quoted: Vec<_> = variants
                .iter()
                .map(|variant| format!("\"{variant}\""))
                .collect();
            let expected = match quoted.as_slice() {
                [only] => only.clone(),
                _ => format!("one of {}", quoted.join(", ")),
            };
            return Err(wrong_type(expected, value_words(&self.value)));
        };
        if !variants.contains(&word.as_str()) {
            let valid = variants.iter().map(|&variant| variant.to_owned()).collect();
            return Err(Fault::UnknownValue {
                found: word.clone(),
                valid,
            }
            .into());
        }
        visitor.visit_enum(BorrowedStrDeserializer::new(word))
    }

    forward_to_deserialize_any! {
        bool i8 i16 i32 i64 i128 u8 u16 u32 u64 u128 f32 f64 char str string bytes byte_buf unit
        unit_struct newtype_struct seq tuple tuple_struct map identifier
    }
}

fn visit_list<'de, V: Visitor<'de>>(
    nodes: &'de [Node],
    visitor: V,
) -> Result<V::Value, DecodeError> {
    let mut elements = Elements { nodes, next: 0 };
    let value = visitor.visit_seq(&mut elements)?;
    if elements.next < nodes.len() {
        let [expected, found] = [elements.next, nodes.len()].map(|it| format!("a list of {it}"));
        return Err(wrong_type(expected, found));
    }
    Ok(value)
}

struct Elements<'de> {
    nodes: &'de [Node],
    next: usize,
}

impl<'de> SeqAccess<'de> for &mut Elements<'de> {
    type Error = DecodeError;

    fn next_element_seed<T: DeserializeSeed<'de>>(
        &mut self,
        seed: T,
    ) -> Result<Option<T::Value>, DecodeError> {
        let Some(node) = self.nodes.get(self.next) else {
            return Ok(None);
        };
        let index = self.next;
        self.next += 1;
        seed.deserialize(node)
            .map(Some)
            .map_err(|error| error.below(index))
    }
}

struct Entries<'de> {
    rest: std::slice::Iter<'de, Entry>,
    current: Option<&'de Entry>,
}

impl<'de> MapAccess<'de> for Entries<'de> {
    type Error = DecodeError;

    fn next_key_seed<K: DeserializeSeed<'de>>(
        &mut self,
        seed: K,
    ) -> Result<Option<K::Value>, DecodeError> {
        self.current = self.rest.next();
        let Some(entry) = self.current else {
            return Ok(None);
        };
        let key = BorrowedStrDeserializer::new(&entry.key);
        seed.deserialize(key)
            .map(Some)
            .map_err(|error: DecodeError| error.below(&entry.key))
    }

    fn next_value_seed<T: DeserializeSeed<'de>>(
        &mut self,
        seed: T,
    ) -> Result<T::Value, DecodeError> {
        let Some(entry) = self.current else {
            return Err(serde::de::Error::custom("value asked for before its key"));
        };
        seed.deserialize(&entry.node)
            .map_err(|error| error.below(&entry.key))
    }
}
