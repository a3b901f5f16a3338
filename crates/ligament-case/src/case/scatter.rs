//! `[fracture.scatter]`: a strength or a fracture energy that varies at random; `[[fracture.scatter]]` for both.

use std::borrow::Cow;

use ligament_model::scatter::{self, Scattered};
use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde::de::Error;
use serde::{Deserialize, Deserializer, Serialize, Serializer};

use super::fault::KeyFault;
use super::key_path::KeyPath;
use super::values::{Form, missing, refuse};

/// Properties that vary at random: one as a table, several as a list of tables.
#[derive(Debug, Clone, PartialEq)]
pub struct Scatters(pub Vec<Scatter>);

/// A property that varies over the body at random, by a factor with the mean 1.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Scatter {
    /// What varies.
    pub of: Scattered,
    /// Distribution of the factors.
    #[serde(default)]
    pub distribution: Distribution,
    /// Weibull modulus; of `weibull`: 5 scatters by 23 %, 12 by 10 %, 25 by 5 %.
    #[schemars(range(min = 1, max = 10_000))]
    pub modulus: Option<f64>,
    /// Standard deviation over the mean; of `normal`, where it is less than 0.25, and of `lognormal`.
    #[schemars(range(max = 10), extend("exclusiveMinimum" = 0))]
    pub deviation: Option<f64>,
    /// Seed of the random numbers: another one is another specimen. Without one it is 0; that of a second property follows from the first one's.
    pub seed: Option<u64>,
    /// Distance over which the correlation exp(-(r/L)^2) of two places falls to 1/e, m; 0: each point for itself.
    #[serde(default)]
    #[schemars(range(min = 0), extend("x-unit" = "m"))]
    pub correlation_length: f64,
}

/// Distribution of the factors.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum Distribution {
    /// Weibull's with two parameters, by its `modulus`.
    #[default]
    Weibull,
    /// Normal with a `deviation`, cut off at four of them.
    Normal,
    /// Lognormal with a `deviation`.
    Lognormal,
}

impl Scatter {
    pub(super) fn setup(&self, key: &KeyPath) -> Result<scatter::Scatter, KeyFault> {
        let distribution = match self.distribution {
            Distribution::Weibull => {
                let reason = "its deviation comes from its modulus";
                refuse(
                    key,
                    self,
                    &["deviation"],
                    "distribution = \"weibull\"",
                    reason,
                )?;
                let modulus = self.modulus.ok_or_else(|| missing(key, "modulus"))?;
                scatter::Distribution::Weibull { modulus }
            }
            Distribution::Normal => {
                let deviation = self.given_deviation(key, "distribution = \"normal\"")?;
                scatter::Distribution::Normal { deviation }
            }
            Distribution::Lognormal => {
                let deviation = self.given_deviation(key, "distribution = \"lognormal\"")?;
                scatter::Distribution::Lognormal { deviation }
            }
        };
        Ok(scatter::Scatter {
            of: self.of,
            distribution,
            seed: self.seed,
            correlation_length: self.correlation_length,
        })
    }

    /// The deviation of a distribution that has no modulus, with the words for it.
    fn given_deviation(&self, key: &KeyPath, words: &'static str) -> Result<f64, KeyFault> {
        refuse(key, self, &["modulus"], words, "it has a `deviation`")?;
        self.deviation.ok_or_else(|| missing(key, "deviation"))
    }
}

impl Scatters {
    pub(super) fn setup(&self, key: &KeyPath) -> Result<Vec<scatter::Scatter>, KeyFault> {
        let of_each = self.0.iter().enumerate();
        of_each
            .map(|(place, it)| match self.0.len() {
                1 => it.setup(key),
                _ => it.setup(&key.child(place.to_string())),
            })
            .collect()
    }
}

impl<'de> Deserialize<'de> for Scatters {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let expected = "a table with the property that varies, or a list of such tables";
        let mut all = match Form::<Scatter, Scatter>::read(deserializer, expected)? {
            Form::Table(one) => vec![one],
            Form::List(all) => all,
            other => return Err(other.misfit(expected)),
        };
        match all.first_mut() {
            Some(first) => first.seed.get_or_insert_default(),
            None => return Err(D::Error::invalid_length(0, &expected)),
        };
        Ok(Self(all))
    }
}

impl Serialize for Scatters {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        match &self.0[..] {
            [one] => one.serialize(serializer),
            all => all.serialize(serializer),
        }
    }
}

impl JsonSchema for Scatters {
    fn inline_schema() -> bool {
        true
    }

    fn schema_name() -> Cow<'static, str> {
        "Scatters".into()
    }

    fn json_schema(generator: &mut SchemaGenerator) -> Schema {
        let one = generator.subschema_for::<Scatter>();
        json_schema!({ "anyOf": [one, { "type": "array", "items": one, "minItems": 1 }] })
    }
}
