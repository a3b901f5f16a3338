//! Values of the libraries that are words in a case file.

use std::borrow::Cow;
use std::fmt;
use std::marker::PhantomData;

use ligament::setup::{self, Iteration, Surface};
use ligament_analysis::modal::Rotations;
use ligament_analysis::probe::PointField;
use ligament_analysis::solver::{FactorKind, Method, Ordering, Update};
use ligament_model::correction::StopRule;
use ligament_model::correction::patch::Settings;
use ligament_model::failure::softening::{LAWS, Law};
use ligament_model::failure::{KINDS, Kind};
use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde::de::{EnumAccess, VariantAccess, Visitor};
use serde::{Deserialize, Deserializer, Serialize, Serializer};

/// A value that is written as a word.
pub trait Worded: Copy + 'static {
    /// All words.
    const WORDS: &'static [&'static str];

    /// All values, in the order of their words.
    fn all() -> impl Iterator<Item = Self>;

    /// The word of the value, and its meaning.
    fn word(&self) -> [&'static str; 2];
}

/// Implements [`Worded`] for a type that has a table of its values.
macro_rules! worded_by_table {
    ($value:ty: $all:expr, $values:expr, $it:ident => $words:expr) => {
        impl Worded for $value {
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
    };
}

worded_by_table! { Kind: KINDS, KINDS.into_iter().copied(), it => [it.word, it.words] }
worded_by_table! { Law: LAWS, LAWS.into_iter().copied(), it => [it.word, it.words] }
worded_by_table! { PointField: PointField::ALL, PointField::ALL.into_iter(), it => [it.word, it.meaning] }
worded_by_table! { setup::Law: setup::Law::ALL, setup::Law::ALL.into_iter(), it => [it.row.word, it.row.sentence] }

/// Implements [`Worded`] for values of a type with words and meanings; for a word with many values, one value and the pattern of all.
macro_rules! worded {
    (@pattern [$($value:tt)+]) => { $($value)+ };
    (@pattern [$($value:tt)+] [$($pattern:tt)+]) => { $($pattern)+ };
    ($value:ty: $([$($variant:tt)+] $(in [$($pattern:tt)+])? $word:literal $meaning:literal;)+) => {
        impl Worded for $value {
            const WORDS: &'static [&'static str] = &[$($word),+];

            fn all() -> impl Iterator<Item = Self> {
                [$($($variant)+),+].into_iter()
            }

            fn word(&self) -> [&'static str; 2] {
                match self {
                    $(worded!(@pattern [$($variant)+] $([$($pattern)+])?) => [$word, $meaning],)+
                }
            }
        }
    };
}

worded! { Surface:
    [Self::None] "none" "None.";
    [Self::Volume] "volume" "By the volumes of the families.";
    [Self::Domain(Iteration::default())] in [Self::Domain(_)] "domain" "NHPD's iterative domain correction.";
    [Self::Patch(Settings::DEFAULT)] in [Self::Patch(_)] "patch" "Two factors a bond for which every uniform strain is an equilibrium.";
}

worded! { Option<StopRule>:
    [None] "auto" "`sum` for models of up to a million bonds, `mean` for larger ones, each with its default tolerance.";
    [Some(Iteration::SUM)] in [Some(StopRule::Sum(_))] "sum" "Summed over all bonds (the paper's): grows with the size of the model.";
    [Some(Iteration::MEAN)] in [Some(StopRule::Mean(_))] "mean" "Mean per bond: independent of the size of the model.";
}

worded! { Option<Method>:
    [None] "auto" "`direct` in the plane as long as the factor fits into memory and in space up to 5,000 points, and where the iteration cannot; `iterative` beyond.";
    [Some(Method::Direct)] "direct" "With a factor of the matrix.";
    [Some(Method::Iterative)] "iterative" "By conjugate gradients without a matrix, for positive definite stiffness.";
}

worded! { Option<FactorKind>:
    [None] "auto" "`llt` where every bond has a positive shear stiffness, `ldlt` otherwise.";
    [Some(FactorKind::Llt)] "llt" "L L^T, for positive definite stiffness.";
    [Some(FactorKind::Ldlt)] "ldlt" "L D L^T, also for indefinite stiffness.";
}

worded! { Option<Ordering>:
    [None] "auto" "`nested-dissection` from 10,000 points on, `minimum-degree` below.";
    [Some(Ordering::NestedDissection)] "nested-dissection" "Nested dissection of the points.";
    [Some(Ordering::MinimumDegree)] "minimum-degree" "Approximate minimum degree of the unknowns.";
}

worded! { Option<Update>:
    [None] "auto" "`incremental`.";
    [Some(Update::Incremental)] "incremental" "The factor is changed in place, unless so many bonds break at once that making it anew costs less.";
    [Some(Update::Refactor)] "refactor" "The factor is made anew every time.";
}

worded! { Option<Rotations>:
    [None] "auto" "`inertia` where no bond has a negative shear stiffness, `massless` otherwise.";
    [Some(Rotations::Inertia)] "inertia" "Rotations have the inertia of a square with the point's volume.";
    [Some(Rotations::Massless)] "massless" "Rotations have no inertia and follow the displacements.";
}

/// The word of a value that is written as one.
pub fn word_of(value: &impl Serialize) -> String {
    let quoted = serde_json::to_string(value).unwrap_or_default();
    quoted.trim_matches('"').to_owned()
}

/// A value that is read and written as its word.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Word<T>(pub T);

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
