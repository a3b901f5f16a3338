//! Values of the libraries that stand as a word in a case file.

use std::borrow::Cow;
use std::fmt;
use std::marker::PhantomData;

use ligament_model::failure::softening::{LAWS, Law, brittle};
use ligament_model::failure::{Calibration, KINDS, Kind};
use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde::de::{EnumAccess, VariantAccess, Visitor};
use serde::{Deserialize, Deserializer, Serialize, Serializer};

/// A value that stands as a word.
pub(super) trait Worded: Copy + 'static {
    /// All words.
    const WORDS: &'static [&'static str];

    /// All values, in the order of their words.
    fn all() -> impl Iterator<Item = Self>;

    /// The word of the value, and what it means.
    fn word(&self) -> [&'static str; 2];
}

/// The field `word` of each element of an array.
macro_rules! words_of {
    ($all:expr) => {{
        let mut words = [""; $all.len()];
        let mut place = 0;
        while place < words.len() {
            words[place] = $all[place].word;
            place += 1;
        }
        words
    }};
}

impl Worded for Kind {
    const WORDS: &'static [&'static str] = &words_of!(KINDS);

    fn all() -> impl Iterator<Item = Self> {
        KINDS.into_iter().copied()
    }

    fn word(&self) -> [&'static str; 2] {
        [self.word, self.words]
    }
}

impl Worded for Law {
    const WORDS: &'static [&'static str] = &words_of!(LAWS);

    fn all() -> impl Iterator<Item = Self> {
        LAWS.into_iter().copied()
    }

    fn word(&self) -> [&'static str; 2] {
        [self.word, self.words]
    }
}

impl Worded for Calibration {
    const WORDS: &'static [&'static str] = &["printed", "two-point"];

    fn all() -> impl Iterator<Item = Self> {
        [Self::Printed, Self::TwoPoint].into_iter()
    }

    fn word(&self) -> [&'static str; 2] {
        match self {
            Self::Printed => ["printed", "As printed: exact without lateral strain alone."],
            Self::TwoPoint => [
                "two-point",
                "From the strains of a bar under both strengths.",
            ],
        }
    }
}

/// A value that is read and written as its word.
#[derive(Debug, Clone, Copy)]
pub(super) struct Word<T>(pub(super) T);

impl Default for Word<Law> {
    fn default() -> Self {
        Self(brittle::LAW)
    }
}

impl<T: Worded> Serialize for Word<T> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.serialize_str(self.0.word()[0])
    }
}

impl<'de, T: Worded> Deserialize<'de> for Word<T> {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_enum("word", T::WORDS, WordVisitor(PhantomData))
    }
}

struct WordVisitor<T>(PhantomData<T>);

impl<'de, T: Worded> Visitor<'de> for WordVisitor<T> {
    type Value = Word<T>;

    fn expecting(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.write_str("a word")
    }

    fn visit_enum<A: EnumAccess<'de>>(self, access: A) -> Result<Word<T>, A::Error> {
        let (word, variant): (String, _) = access.variant()?;
        variant.unit_variant()?;
        let value = T::all().find(|value| value.word()[0] == word);
        let unknown = || serde::de::Error::unknown_variant(&word, T::WORDS);
        value.map(Word).ok_or_else(unknown)
    }
}

impl<T: Worded> JsonSchema for Word<T> {
    fn inline_schema() -> bool {
        true
    }

    fn schema_name() -> Cow<'static, str> {
        "Word".into()
    }

    fn json_schema(_: &mut SchemaGenerator) -> Schema {
        let words = T::all().map(|value| {
            let [word, meaning] = value.word();
            json_schema!({ "description": meaning, "type": "string", "const": word })
        });
        let words: Vec<Schema> = words.collect();
        json_schema!({ "oneOf": words })
    }
}
