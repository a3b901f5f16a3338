//! How a case file writes a law of softening: by its word, or by a curve.

use std::borrow::Cow;
use std::fmt;

use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde::de::value::MapAccessDeserializer;
use serde::de::{Error, MapAccess, Visitor};
use serde::{Deserialize, Deserializer, Serialize, Serializer};

use super::{Curve, LAWS, Law};
use crate::word::{self, Worded};

/// A softening law in a case file by its name.
#[derive(Clone, Copy)]
struct Named(&'static Law);

impl Worded for Named {
    const WORDS: &'static [&'static str] = &{
        let mut words = [""; LAWS.len()];
        let mut place = 0;
        while place < words.len() {
            words[place] = LAWS[place].word;
            place += 1;
        }
        words
    };

    fn all() -> impl Iterator<Item = Self> {
        LAWS.into_iter().map(Named)
    }

    fn word(&self) -> [&'static str; 2] {
        [self.0.word, self.0.words]
    }
}

/// A law by a curve of stress over the opening of a crack; one of the keys.
#[derive(Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct ByCurve {
    /// Opening and stress of each corner, from the opening 0 and the strength to the stress 0. Units do not matter: the curve is scaled so
    /// that the `fracture_energy` comes out.
    #[serde(skip_serializing_if = "Option::is_none")]
    curve: Option<Vec<[f64; 2]>>,
    /// Point at which two straight lines meet: opening over the opening at the end, and stress over the strength.
    #[serde(skip_serializing_if = "Option::is_none")]
    kink: Option<[f64; 2]>,
    /// A table (`.csv`) of the corners with the columns `opening` and `stress`, from the folder of the case file.
    #[serde(skip_serializing_if = "Option::is_none")]
    table: Option<String>,
}

impl Serialize for Law {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        match self.given_curve() {
            None => serializer.serialize_str(self.word),
            Some(curve) => ByCurve {
                curve: Some(curve.points().collect()),
                kink: None,
                table: None,
            }
            .serialize(serializer),
        }
    }
}

impl<'de> Deserialize<'de> for Law {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_any(LawVisitor)
    }
}

struct LawVisitor;

impl<'de> Visitor<'de> for LawVisitor {
    type Value = Law;

    fn expecting(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.write_str("a word")
    }

    fn visit_str<E: Error>(self, word: &str) -> Result<Law, E> {
        let law = LAWS.into_iter().find(|it| it.word == word);
        law.cloned()
            .ok_or_else(|| E::unknown_variant(word, Named::WORDS))
    }

    fn visit_map<A: MapAccess<'de>>(self, map: A) -> Result<Law, A::Error> {
        let curve = match ByCurve::deserialize(MapAccessDeserializer::new(map))? {
            ByCurve {
                curve: Some(points),
                kink: None,
                table: None,
            } => Curve::new(&points),
            ByCurve {
                curve: None,
                kink: Some(at),
                table: None,
            } => Curve::kinked(at),
            _ => {
                let reason = "a curve is given by one of `curve`, `kink` and `table`";
                return Err(A::Error::custom(reason));
            }
        };
        curve.map(Law::by_curve).map_err(A::Error::custom)
    }
}

impl JsonSchema for Law {
    fn inline_schema() -> bool {
        true
    }

    fn schema_name() -> Cow<'static, str> {
        "Law".into()
    }

    fn json_schema(generator: &mut SchemaGenerator) -> Schema {
        json_schema!({ "anyOf": [word::schema::<Named>(), ByCurve::json_schema(generator)] })
    }
}
