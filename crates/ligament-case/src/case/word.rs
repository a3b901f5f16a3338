//! Values with data from other crates that are words in a case file.

use std::borrow::Cow;

use ligament::setup::{Iteration, Surface};
use ligament_mesh::gmsh::CoordinatePlane;
use ligament_model::correction::StopRule;
use ligament_model::correction::patch::Settings;
use ligament_model::word::{self, Worded};
use schemars::{JsonSchema, Schema, SchemaGenerator};
use serde::{Deserialize, Deserializer, Serialize, Serializer};

/// Implements [`Worded`] for values of a type with words and meanings; for a word with many values, one value and the pattern of all.
macro_rules! worded {
    (@pattern [$($value:tt)+]) => { $($value)+ };
    (@pattern [$($value:tt)+] [$($pattern:tt)+]) => { $($pattern)+ };
    ($value:ty: $([$($variant:tt)+] $(in [$($pattern:tt)+])? $word:literal $meaning:literal;)+) => {
        impl Worded for Word<$value> {
            const WORDS: &'static [&'static str] = &[$($word),+];

            fn all() -> impl Iterator<Item = Self> {
                [$($($variant)+),+].into_iter().map(Word)
            }

            fn word(&self) -> [&'static str; 2] {
                match self.0 {
                    $(worded!(@pattern [$($variant)+] $([$($pattern)+])?) => [$word, $meaning],)+
                }
            }
        }
    };
}

worded! { Surface:
    [Surface::None] "none" "None.";
    [Surface::Volume] "volume" "By the volumes of the families.";
    [Surface::Domain(Iteration::default())] in [Surface::Domain(_)] "domain" "NHPD's iterative domain correction.";
    [Surface::Patch(Settings::DEFAULT)] in [Surface::Patch(_)] "patch" "Two factors a bond for which every uniform strain is an equilibrium.";
}

worded! { Option<StopRule>:
    [None] "auto" "`sum` for models of up to a million bonds, `mean` for larger ones, each with its default tolerance.";
    [Some(Iteration::SUM)] in [Some(StopRule::Sum(_))] "sum" "Summed over all bonds (the paper's): grows with the size of the model.";
    [Some(Iteration::MEAN)] in [Some(StopRule::Mean(_))] "mean" "Mean per bond: independent of the size of the model.";
}

worded! { CoordinatePlane:
    [CoordinatePlane::Xy] "xy" "The plane of x and y.";
    [CoordinatePlane::Xz] "xz" "The plane of x and z: z becomes y.";
    [CoordinatePlane::Yz] "yz" "The plane of y and z: y becomes x, and z becomes y.";
}

/// The word of a value that is written as one.
pub fn word_of(value: &impl Serialize) -> String {
    let quoted = serde_json::to_string(value).unwrap_or_default();
    quoted.trim_matches('"').to_owned()
}

/// A value that is read and written as its word.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Word<T>(pub T);

impl<T> Serialize for Word<T>
where
    Self: Worded,
{
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.serialize_str(self.word()[0])
    }
}

impl<'de, T> Deserialize<'de> for Word<T>
where
    Self: Worded,
{
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        word::read(deserializer)
    }
}

impl<T> JsonSchema for Word<T>
where
    Self: Worded,
{
    fn inline_schema() -> bool {
        true
    }

    fn schema_name() -> Cow<'static, str> {
        "Word".into()
    }

    fn json_schema(_: &mut SchemaGenerator) -> Schema {
        word::schema::<Self>()
    }
}
