//! Values that are written as words in case files, and choices that may be open (`auto`).

use std::fmt;
use std::marker::PhantomData;

use schemars::{JsonSchema, Schema, json_schema};
use serde::de::{DeserializeOwned, EnumAccess, Error, VariantAccess, Visitor};
use serde::{Deserializer, Serialize};

/// A value that is written as a word.
pub trait Worded: Copy + 'static {
    /// All words.
    const WORDS: &'static [&'static str];

    /// All values, in the order of their words.
    fn all() -> impl Iterator<Item = Self>;

    /// The word of the value, and its meaning.
    fn word(&self) -> [&'static str; 2];
}

/// Reads a value by its word.
///
/// # Errors
///
/// If the value is no word, or the word is unknown.
pub fn read<'de, T: Worded, D: Deserializer<'de>>(deserializer: D) -> Result<T, D::Error> {
    deserializer.deserialize_enum("word", T::WORDS, WordVisitor(PhantomData))
}

/// A choice that a case file may leave to the program by the word `auto`; see [`case_type!`](crate::case_type!).
pub trait WithAuto: Copy {
    /// The words of the choice, and `auto`.
    type Word: From<Option<Self>> + Into<Option<Self>> + Serialize + DeserializeOwned + JsonSchema;
}

/// The words of a choice that may be left to the program, for its schema.
pub type WordOrAuto<T> = <T as WithAuto>::Word;

/// Reading and writing of choices that may be open, for serde.
pub mod open {
    use serde::{Deserialize, Deserializer, Serialize, Serializer};

    use super::{WithAuto, WordOrAuto};

    /// Writes a choice.
    ///
    /// # Errors
    ///
    /// If the word cannot be written.
    pub fn serialize<T: WithAuto, S: Serializer>(
        choice: &Option<T>,
        serializer: S,
    ) -> Result<S::Ok, S::Error> {
        WordOrAuto::<T>::from(*choice).serialize(serializer)
    }

    /// Reads a choice.
    ///
    /// # Errors
    ///
    /// If the value is no word, or the word is unknown.
    pub fn deserialize<'de, T: WithAuto, D: Deserializer<'de>>(
        deserializer: D,
    ) -> Result<Option<T>, D::Error> {
        WordOrAuto::<T>::deserialize(deserializer).map(Into::into)
    }
}

struct WordVisitor<T>(PhantomData<T>);

impl<'de, T: Worded> Visitor<'de> for WordVisitor<T> {
    type Value = T;

    fn expecting(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.write_str("a word")
    }

    fn visit_enum<A: EnumAccess<'de>>(self, access: A) -> Result<T, A::Error> {
        let (word, variant): (String, _) = access.variant()?;
        variant.unit_variant()?;
        let value = T::all().find(|value| value.word()[0] == word);
        value.ok_or_else(|| A::Error::unknown_variant(&word, T::WORDS))
    }
}

/// The schema of the words with their meanings.
pub fn schema<T: Worded>() -> Schema {
    let words = T::all().map(|value| {
        let [word, meaning] = value.word();
        json_schema!({ "description": meaning, "type": "string", "const": word })
    });
    let words: Vec<Schema> = words.collect();
    json_schema!({ "oneOf": words })
}

/// Implements [`Worded`](crate::word::Worded) for a type that has a table of its values, and with it what serde and schemars need.
#[macro_export]
macro_rules! worded_by_table {
    ($value:ty: $all:expr, $values:expr, $it:ident => $words:expr) => {
        impl $crate::word::Worded for $value {
            const WORDS: &'static [&'static str] = &{
                let mut words = [""; $all.len()];
                let mut place = 0;
                while place < words.len() {
                    let $it = &$all[place];
                    words[place] = $words[0];
                    place += 1;
                }
                words
            };

            fn all() -> impl Iterator<Item = Self> {
                $values
            }

            fn word(&self) -> [&'static str; 2] {
                let $it = self;
                $words
            }
        }

        impl serde::Serialize for $value {
            fn serialize<S: serde::Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
                serializer.serialize_str($crate::word::Worded::word(self)[0])
            }
        }

        impl<'de> serde::Deserialize<'de> for $value {
            fn deserialize<D: serde::Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
                $crate::word::read(deserializer)
            }
        }

        impl schemars::JsonSchema for $value {
            fn inline_schema() -> bool {
                true
            }

            fn schema_name() -> std::borrow::Cow<'static, str> {
                stringify!($value).into()
            }

            fn json_schema(_: &mut schemars::SchemaGenerator) -> schemars::Schema {
                $crate::word::schema::<Self>()
            }
        }
    };
}
