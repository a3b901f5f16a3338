//! Decoder of the document tree into typed sections, with faults in the terms of a case file.

use std::fmt;

use serde::de::value::{BorrowedStrDeserializer, MapDeserializer, SeqDeserializer};
use serde::de::{
    DeserializeOwned, Deserializer, Error as _, Expected, IntoDeserializer, Unexpected, Visitor,
};
use serde::forward_to_deserialize_any;
use serde_path_to_error::Segment;

use super::document::{Node, Value};
use super::fault::{Fault, KeyFault};
use super::key_path::KeyPath;

/// Length above which strings are truncated in error messages.
const LONGEST_QUOTE: usize = 40;

/// Reads a typed section from the node at a key path.
pub fn decode<T: DeserializeOwned>(node: &Node, key: &KeyPath) -> Result<T, KeyFault> {
    serde_path_to_error::deserialize(node).map_err(|error| {
        let below = error.path().iter().filter_map(|segment| match segment {
            Segment::Seq { index } => Some(index.to_string()),
            Segment::Map { key } => Some(key.clone()),
            Segment::Enum { .. } | Segment::Unknown => None,
        });
        let key = below.fold(key.clone(), |key, part| key.child(part));
        complete(key, error.into_inner())
    })
}

/// Completes a fault by the title of its table, from the whole key path.
fn complete(mut key: KeyPath, mut fault: Fault) -> KeyFault {
    match &mut fault {
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
            let section = key.to_string();
            fault = Fault::SingleBrackets { section };
        }
        _ => {}
    }
    KeyFault { key, fault }
}

impl serde::de::Error for Fault {
    fn custom<T: fmt::Display>(message: T) -> Self {
        Self::Other(message.to_string())
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

    fn unknown_variant(word: &str, valid: &'static [&'static str]) -> Self {
        Self::UnknownValue {
            found: word.to_owned(),
            valid: valid.iter().map(|&word| word.to_owned()).collect(),
        }
    }

    fn unknown_field(key: &str, valid: &'static [&'static str]) -> Self {
        let valid = valid.iter().map(|&key| key.to_owned()).collect();
        Self::UnknownKey {
            key: key.to_owned(),
            table: String::new(),
            valid,
        }
    }

    fn missing_field(key: &'static str) -> Self {
        Self::MissingKey {
            key: key.to_owned(),
            table: String::new(),
            unit: None,
        }
    }
}

fn wrong_type(expected: String, found: String) -> Fault {
    let unit = None;
    Fault::WrongType {
        expected,
        found,
        unit,
    }
}

/// Description of the type that serde's visitors expect, in the terms of a case file.
fn expected_words(expected: &dyn Expected) -> String {
    let text = expected.to_string();
    match text.as_str() {
        "f64" => "a number".to_owned(),
        "u32" | "u64" | "usize" => "a whole number, 0 or more".to_owned(),
        "a boolean" => "true or false".to_owned(),
        "a sequence" => "a list".to_owned(),
        "a map" => "a table".to_owned(),
        "an array of length 2" => "a list of 2".to_owned(),
        _ => match text.split_once(" element") {
            Some((count, _in_sequence)) => format!("a list of {count}"),
            None => text,
        },
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

/// Type of a value for "found ...".
fn unexpected(value: &Value) -> Unexpected<'_> {
    match value {
        Value::String(text) => Unexpected::Str(text),
        Value::Integer(integer) => Unexpected::Signed(*integer),
        Value::Float(float) => Unexpected::Float(*float),
        Value::Boolean(value) => Unexpected::Bool(*value),
        Value::Date => Unexpected::Other("a date"),
        Value::List(_) => Unexpected::Seq,
        Value::Table(_) => Unexpected::Map,
    }
}

impl<'de> IntoDeserializer<'de, Fault> for &'de Node {
    type Deserializer = Self;

    fn into_deserializer(self) -> Self {
        self
    }
}

impl<'de> Deserializer<'de> for &'de Node {
    type Error = Fault;

    fn deserialize_any<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, Fault> {
        match &self.value {
            Value::String(text) => visitor.visit_borrowed_str(text),
            Value::Integer(integer) => visitor.visit_i64(*integer),
            Value::Float(float) if float.is_finite() => visitor.visit_f64(*float),
            Value::Float(float) => Err(Fault::out_of_range("a finite number", float.to_string())),
            Value::Boolean(value) => visitor.visit_bool(*value),
            Value::Date => Err(Fault::invalid_type(unexpected(&self.value), &visitor)),
            Value::List(nodes) => {
                let mut elements = SeqDeserializer::new(nodes.iter());
                let value = visitor.visit_seq(&mut elements)?;
                elements.end()?;
                Ok(value)
            }
            Value::Table(entries) => {
                let entries = entries.iter().map(|it| (it.key.as_str(), &it.node));
                visitor.visit_map(MapDeserializer::new(entries))
            }
        }
    }

    fn deserialize_ignored_any<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, Fault> {
        visitor.visit_unit()
    }

    fn deserialize_option<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, Fault> {
        visitor.visit_some(self)
    }

    // Accepts tables only; serde would also accept a section as a list of its values.
    fn deserialize_struct<V: Visitor<'de>>(
        self,
        _name: &'static str,
        _fields: &'static [&'static str],
        visitor: V,
    ) -> Result<V::Value, Fault> {
        match &self.value {
            Value::Table(_) => self.deserialize_any(visitor),
            other => Err(Fault::invalid_type(unexpected(other), &"a table")),
        }
    }

    fn deserialize_enum<V: Visitor<'de>>(
        self,
        _name: &'static str,
        variants: &'static [&'static str],
        visitor: V,
    ) -> Result<V::Value, Fault> {
        let Value::String(word) = &self.value else {
            let quoted: Vec<_> = variants
                .iter()
                .map(|variant| format!("\"{variant}\""))
                .collect();
            let expected = match quoted.as_slice() {
                [only] => only.clone(),
                _ => format!("one of {}", quoted.join(", ")),
            };
            return Err(wrong_type(expected, found_words(unexpected(&self.value))));
        };
        if !variants.contains(&word.as_str()) {
            return Err(Fault::unknown_variant(word, variants));
        }
        visitor.visit_enum(BorrowedStrDeserializer::new(word))
    }

    forward_to_deserialize_any! {
        bool i8 i16 i32 i64 i128 u8 u16 u32 u64 u128 f32 f64 char str string bytes byte_buf unit
        unit_struct newtype_struct seq tuple tuple_struct map identifier
    }
}
