//! Types that a case file reads as they are, and the ranges of their numbers.

/// A structure or a list of words that a case file reads as it is. With the feature `case` the type derives what serde and schemars need: its
/// documentation describes it to users, and `#[case(...)]` adds attributes of the two. A variant is written as its name in kebab case. A number
/// with a `#[range(...)]` lies within bounds ([`range`](crate::range)).
/// The schema has the range, and [`Ranged`] checks it in memory. The unit of a number stands in its documentation. A list of words with
/// `#[auto(...)]` is of choices that may be open: as an `Option` a case file reads it with the word `auto` for `None`, whose meaning the attribute has
/// ([`WithAuto`](crate::word::WithAuto)).
///
/// ```text
/// ligament_model::case_type! {
///     /// Damping in proportion to masses and stiffness.
///     #[derive(Debug, Clone, Copy, PartialEq, Default)]
///     #[case(serde(default))]
///     pub struct Damping {
///         /// alpha, 1/s: slow motions are damped most.
///         #[range("minimum" = 0)]
///         pub mass: f64,
///     }
/// }
/// ```
#[macro_export]
macro_rules! case_type {
    (
        $(#[doc = $doc:literal])*
        #[derive($($derived:ident),+)]
        $(#[case($($of_type:tt)+)])*
        pub enum $name:ident {$(
            $(#[doc = $meaning:literal])*
            $(#[default $($default:tt)?])?
            $(#[case($($of_word:tt)+)])?
            $word:ident,
        )+}
    ) => {
        $(#[doc = $doc])*
        #[derive($($derived),+)]
        #[cfg_attr(feature = "case", derive(serde::Serialize, serde::Deserialize, schemars::JsonSchema), serde(rename_all = "kebab-case"))]
        $(#[cfg_attr(feature = "case", $($of_type)+)])*
        pub enum $name {$(
            $(#[doc = $meaning])*
            $(#[default $($default)?])?
            $(#[cfg_attr(feature = "case", $($of_word)+)])?
            $word,
        )+}
    };
    (
        $(#[doc = $doc:literal])*
        #[derive($($derived:ident),+)]
        #[auto($auto:literal)]
        pub enum $name:ident {$(
            $(#[doc = $meaning:literal])*
            $word:ident,
        )+}
    ) => {
        $(#[doc = $doc])*
        #[doc = ""]
        #[doc = concat!("Where it is open: ", $auto)]
        #[derive($($derived),+)]
        #[cfg_attr(feature = "case", derive(serde::Serialize), serde(rename_all = "kebab-case"))]
        pub enum $name {$(
            $(#[doc = $meaning])*
            $word,
        )+}

        #[cfg(feature = "case")]
        const _: () = {
            #[derive(serde::Serialize, serde::Deserialize, schemars::JsonSchema)]
            #[serde(rename_all = "kebab-case")]
            pub enum Word {
                #[doc = $auto]
                Auto,
                $($(#[doc = $meaning])* $word,)+
            }

            impl From<Option<$name>> for Word {
                fn from(choice: Option<$name>) -> Self {
                    match choice {
                        None => Self::Auto,
                        $(Some($name::$word) => Self::$word,)+
                    }
                }
            }

            impl From<Word> for Option<$name> {
                fn from(word: Word) -> Self {
                    match word {
                        Word::Auto => None,
                        $(Word::$word => Some($name::$word),)+
                    }
                }
            }

            impl $crate::word::WithAuto for $name {
                type Word = Word;
            }
        };
    };
    (
        $(#[doc = $doc:literal])*
        #[derive($($derived:ident),+)]
        $(#[case($($of_type:tt)+)])*
        pub struct $name:ident {$(
            $(#[doc = $meaning:literal])*
            $(#[range($($range:tt)+)])?
            $(#[case($($of_key:tt)+)])*
            pub $key:ident: $value:ty,
        )+}
    ) => {
        $(#[doc = $doc])*
        #[derive($($derived),+)]
        #[cfg_attr(feature = "case", derive(serde::Serialize, serde::Deserialize, schemars::JsonSchema), serde(deny_unknown_fields))]
        $(#[cfg_attr(feature = "case", $($of_type)+)])*
        pub struct $name {$(
            $(#[doc = $meaning])*
            $(#[cfg_attr(feature = "case", schemars(transform = $crate::range!($($range)+).keywords()))])?
            $(#[cfg_attr(feature = "case", $($of_key)+)])*
            pub $key: $value,
        )+}

        impl $crate::case_type::Ranged for $name {
            fn out_of_range(&self) -> Option<$crate::case_type::OutOfRange> {
                None$($(.or_else(|| {
                    $crate::range!($($range)+).check(stringify!($key), &self.$key)
                }))?)+
            }
        }
    };
}

/// The [`Range`](crate::case_type::Range) of a number: bounds by their keywords in a JSON schema, and after a semicolon words of their own where
/// these describe them better; or a range that has a name.
#[macro_export]
macro_rules! range {
    ($($bound:literal = $limit:expr),+ $(; $words:literal)?) => {
        $crate::case_type::Range {
            bounds: &[$(($bound, f64::from($limit))),+],
            words: concat!($($words)?),
        }
    };
    ($range:expr) => {
        $range
    };
}

/// Range of a number.
#[derive(Debug, Clone, Copy)]
pub struct Range<'a> {
    /// Bounds by their keywords in a JSON schema.
    pub bounds: &'a [(&'static str, f64)],
    /// Description of the range, where the bounds are not sufficient; otherwise empty.
    pub words: &'a str,
}

impl Range<'static> {
    /// Numbers greater than 0.
    pub const POSITIVE: Self = Self::new(&[("exclusiveMinimum", 0.0)]);

    /// Numbers from 0.
    pub const NOT_NEGATIVE: Self = Self::new(&[("minimum", 0.0)]);

    /// Numbers between 0 and 1.
    pub const SHARE: Self = Self::new(&[("exclusiveMinimum", 0.0), ("exclusiveMaximum", 1.0)]);

    /// The numbers within bounds.
    pub const fn new(bounds: &'static [(&'static str, f64)]) -> Self {
        Self { bounds, words: "" }
    }
}

impl Range<'_> {
    /// The fault of the number of a key that is out of the range.
    pub fn check(&self, key: &'static str, number: &impl Number) -> Option<OutOfRange> {
        let (number, found) = number.given()?;
        let bound = |keyword: &str| self.bounds.iter().find(|it| it.0 == keyword).map(|it| it.1);
        let expected = if number.is_infinite() {
            "a finite number".to_owned()
        } else if is_within(number, bound) {
            return None;
        } else if self.words.is_empty() {
            range_in_words(bound).unwrap_or("at least 0".to_owned())
        } else {
            self.words.to_owned()
        };
        Some(OutOfRange {
            key,
            expected,
            found,
        })
    }
}

#[cfg(feature = "case")]
impl<'a> Range<'a> {
    /// The transform of the schema of a key that has the range.
    pub fn keywords(self) -> impl Fn(&mut schemars::Schema) + 'a {
        move |schema| {
            for &(keyword, limit) in self.bounds {
                let limit = match limit.fract() == 0.0 {
                    true => (limit as i64).into(),
                    false => limit.into(),
                };
                schema.insert(keyword.to_owned(), limit);
            }
        }
    }
}

/// A number that is out of the range of its key.
#[derive(Debug, Clone, PartialEq)]
pub struct OutOfRange {
    /// Key of the number.
    pub key: &'static str,
    /// Description of the range, "greater than 0".
    pub expected: String,
    /// The number as given.
    pub found: String,
}

/// A structure whose numbers have ranges.
pub trait Ranged {
    /// The first number that is out of its range.
    fn out_of_range(&self) -> Option<OutOfRange>;
}

/// A number, or one that may be missing.
pub trait Number {
    /// The number, if there is one, and its text.
    fn given(&self) -> Option<(f64, String)>;
}

impl Number for f64 {
    fn given(&self) -> Option<(f64, String)> {
        Some((*self, format!("{self:?}")))
    }
}

impl Number for usize {
    fn given(&self) -> Option<(f64, String)> {
        Some((*self as f64, self.to_string()))
    }
}

impl Number for u32 {
    fn given(&self) -> Option<(f64, String)> {
        Some((f64::from(*self), self.to_string()))
    }
}

impl<T: Number> Number for Option<T> {
    fn given(&self) -> Option<(f64, String)> {
        self.as_ref()?.given()
    }
}

/// Comparison of a number with its bound.
type Comparison = fn(&f64, &f64) -> bool;

/// Bounds by their keywords in a JSON schema, in words, and the comparison that holds for a number within.
const BOUNDS: [(&str, &str, Comparison); 4] = [
    ("exclusiveMinimum", "greater than", f64::gt),
    ("minimum", "at least", f64::ge),
    ("exclusiveMaximum", "less than", f64::lt),
    ("maximum", "at most", f64::le),
];

/// Whether a number is within the bounds of keywords of a JSON schema.
pub fn is_within(number: f64, bound: impl Fn(&str) -> Option<f64>) -> bool {
    let mut bounds = BOUNDS.iter();
    bounds.all(|(keyword, _, holds)| bound(keyword).is_none_or(|it| holds(&number, &it)))
}

/// Description of the bounds of keywords of a JSON schema, "greater than 0"; `None` for an arbitrary number or a count from 0, which is implied
/// by its type.
pub fn range_in_words(bound: impl Fn(&str) -> Option<f64>) -> Option<String> {
    let bound = |keyword: &str| {
        let bound = bound(keyword).filter(|it| keyword != "minimum" || *it != 0.0)?;
        let text = format!("{bound:?}");
        Some(text.trim_end_matches(".0").to_owned())
    };
    if let (Some(least), Some(most)) = (bound("minimum"), bound("maximum")) {
        return Some(format!("{least} to {most}"));
    }
    let words = BOUNDS.iter();
    let words =
        words.filter_map(|(keyword, words, _)| Some(format!("{words} {}", bound(keyword)?)));
    let words: Vec<String> = words.collect();
    (!words.is_empty()).then(|| words.join(" and "))
}
