//! Checks of single values for several sections.

use std::fmt;
use std::marker::PhantomData;

use serde::de::value::{MapAccessDeserializer, SeqAccessDeserializer};
use serde::de::{Error, IgnoredAny, MapAccess, SeqAccess, Unexpected, Visitor};
use serde::{Deserialize, Deserializer, Serialize};

use super::fault::{Fault, KeyFault};
use super::key_path::KeyPath;
use ligament::setup::{begins_as_formula, is_column_name, is_unseen};

/// A point in the plane, m.
pub type Point = [f64; 2];

/// Keyword of the schema for the description of a range, where the bounds are not sufficient.
pub(super) const RANGE: &str = "x-range";

/// Keyword of the schema for the unit of a number, or of the numbers of a table or list.
pub(super) const UNIT: &str = "x-unit";

/// Schema rule, a value of `oneOf`, that exactly one of the keys is given.
pub(super) fn exactly_one(keys: &[&str]) -> serde_json::Value {
    keys.iter()
        .map(|key| serde_json::json!({ "required": [key] }))
        .collect()
}

/// Fails at a key unless a condition is true; `expected` describes the condition.
pub fn require(
    holds: bool,
    key: impl FnOnce() -> KeyPath,
    expected: &str,
    found: impl std::fmt::Debug,
) -> Result<(), KeyFault> {
    if holds {
        return Ok(());
    }
    let fault = Fault::out_of_range(expected.to_owned(), format!("{found:?}"));
    Err(KeyFault::new(key(), fault))
}

/// The value of the given one among alternative keys of a table.
pub fn one_of<T>(
    table: &KeyPath,
    given: impl IntoIterator<Item = (&'static str, Option<T>)>,
) -> Result<T, KeyFault> {
    let given: Vec<_> = given.into_iter().collect();
    let keys: Vec<_> = (given.iter())
        .map(|(key, value)| (*key, value.is_some()))
        .collect();
    let mut values = given.into_iter().filter_map(|(_, value)| value);
    match (values.next(), values.next()) {
        (Some(only), None) => Ok(only),
        _ => Err(not_exactly_one(table, &keys)),
    }
}

/// Converts every element of a list of sections, with its key path.
pub(super) fn each<'a, Keys: 'a, Made>(
    list: &KeyPath,
    sections: impl IntoIterator<Item = &'a Keys>,
    make: impl Fn(&Keys, &KeyPath) -> Result<Made, KeyFault>,
) -> Result<Vec<Made>, KeyFault> {
    let sections = sections.into_iter().enumerate();
    sections
        .map(|(index, keys)| make(keys, &list.child(index)))
        .collect()
}

/// The fault of none or several given keys among alternatives.
pub(super) fn not_exactly_one(table: &KeyPath, keys: &[(&str, bool)]) -> KeyFault {
    let names = |wanted: &dyn Fn(bool) -> bool| {
        keys.iter()
            .filter(|(_, given)| wanted(*given))
            .map(|(key, _)| (*key).to_owned())
            .collect()
    };
    let fault = Fault::NotExactlyOne {
        valid: names(&|_| true),
        found: names(&|given| given),
    };
    KeyFault::new(table.clone(), fault)
}

/// Fails at the first given key of a section among keys that do not apply with a setting.
pub(super) fn refuse(
    table: &KeyPath,
    section: &impl Serialize,
    keys: &[&'static str],
    setting: &str,
    reason: &'static str,
) -> Result<(), KeyFault> {
    let Some(key) = first_given(section, keys) else {
        return Ok(());
    };
    let setting = setting.to_owned();
    let fault = Fault::NotWith {
        key,
        setting,
        reason,
    };
    Err(KeyFault::new(table.child(key), fault))
}

/// The first given key among optional keys of a section.
pub(super) fn first_given(section: &impl Serialize, keys: &[&'static str]) -> Option<&'static str> {
    let section = serde_json::to_value(section).unwrap_or_default();
    let mut keys = keys.iter().copied();
    keys.find(|key| !section[key].is_null())
}

/// The fault of a missing key that a table must have.
pub(super) fn missing_key(table: &KeyPath, key: &str) -> KeyFault {
    let fault = Fault::MissingKey {
        key: key.to_owned(),
        table: table.table_title(),
        unit: None,
    };
    KeyFault::new(table.child(key), fault)
}

/// The fault of a missing key that is required for a reason.
pub(super) fn required_key(table: &KeyPath, key: &'static str, reason: &str) -> KeyFault {
    let reason = reason.to_owned();
    KeyFault::new(table.child(key), Fault::Required { key, reason })
}

/// Default thickness of a body in the plane, m.
pub(super) fn metre() -> f64 {
    1.0
}

/// Refuses names that cannot head a column of a CSV table.
pub fn require_column_name(key: impl Fn() -> KeyPath, name: &str) -> Result<(), KeyFault> {
    require_no_formula(&key, "name", name)?;
    let is_seen = !name.contains(is_unseen);
    let expected = "a name without invisible characters, such as control characters";
    require(is_seen, &key, expected, name)?;
    let expected = "a name without commas, quotes or surrounding blanks";
    require(is_column_name(name), key, expected, name)
}

/// Refuses a name, label or other text of a table that begins as a formula, which a spreadsheet would compute.
pub fn require_no_formula(
    key: impl FnOnce() -> KeyPath,
    what: &str,
    text: &str,
) -> Result<(), KeyFault> {
    let expected = format!(
        "a {what} that does not begin with =, +, - or @, by which a spreadsheet knows a formula"
    );
    require(!begins_as_formula(text), key, &expected, text)
}

/// Fails where a name repeats an earlier one; `advice` is appended to the error.
pub fn require_unique<'a>(
    names: impl IntoIterator<Item = (KeyPath, &'a str)>,
    advice: &'static str,
) -> Result<(), KeyFault> {
    let mut seen: Vec<(KeyPath, &str)> = Vec::new();
    for (key, name) in names {
        if let Some((first, _)) = seen.iter().find(|(_, other)| *other == name) {
            let (name, first) = (name.to_owned(), first.to_string());
            return Err(KeyFault::new(
                key,
                Fault::NotUnique {
                    name,
                    first,
                    advice,
                },
            ));
        }
        seen.push((key, name));
    }
    Ok(())
}

/// Value of a key with several forms: a number, a word, a list, mostly of numbers, or a table.
pub(super) enum Form<Element = f64, Keys = IgnoredAny> {
    Number(f64, Option<i64>),
    Word(String),
    List(Vec<Element>),
    Table(Keys),
}

impl<'de, Element: Deserialize<'de>, Keys: Deserialize<'de>> Form<Element, Keys> {
    /// Reads a value; `expected` describes the forms that the key has.
    pub(super) fn read<D: Deserializer<'de>>(
        deserializer: D,
        expected: &'static str,
    ) -> Result<Self, D::Error> {
        deserializer.deserialize_any(FormVisitor(expected, PhantomData))
    }

    /// The error of a form that the key does not have.
    pub(super) fn wrong_form_error<E: Error>(&self, expected: &'static str) -> E {
        let found = match self {
            Self::Number(_, Some(whole)) => Unexpected::Signed(*whole),
            Self::Number(value, None) => Unexpected::Float(*value),
            Self::Word(word) => Unexpected::Str(word),
            Self::List(_) => Unexpected::Seq,
            Self::Table(_) => Unexpected::Map,
        };
        E::invalid_type(found, &expected)
    }
}

struct FormVisitor<Element, Keys>(&'static str, PhantomData<Form<Element, Keys>>);

impl<'de, Element: Deserialize<'de>, Keys: Deserialize<'de>> Visitor<'de>
    for FormVisitor<Element, Keys>
{
    type Value = Form<Element, Keys>;

    fn expecting(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.write_str(self.0)
    }

    fn visit_i64<E>(self, value: i64) -> Result<Self::Value, E> {
        Ok(Form::Number(value as f64, Some(value)))
    }

    fn visit_f64<E>(self, value: f64) -> Result<Self::Value, E> {
        Ok(Form::Number(value, None))
    }

    fn visit_str<E>(self, word: &str) -> Result<Self::Value, E> {
        Ok(Form::Word(word.to_owned()))
    }

    fn visit_seq<A: SeqAccess<'de>>(self, list: A) -> Result<Self::Value, A::Error> {
        Vec::deserialize(SeqAccessDeserializer::new(list)).map(Form::List)
    }

    fn visit_map<A: MapAccess<'de>>(self, keys: A) -> Result<Self::Value, A::Error> {
        Keys::deserialize(MapAccessDeserializer::new(keys)).map(Form::Table)
    }
}
