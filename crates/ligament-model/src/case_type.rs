//! Types that a case file reads as they are, and the ranges of their numbers.

/// A structure or a list of words that a case file reads as it is. With the feature `case` the type derives what serde and schemars need: its
/// documentation describes it to users, and `#[case(...)]` adds attributes of the two. A variant is written as its name in kebab case. A number
/// with a `#[range(...)]` lies within bounds, which stand as keywords of a JSON schema; after a semicolon words of their own may describe them.
/// The schema has the range, and [`Ranged`] checks it in memory. The unit of a number stands in its documentation.
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
        $(#[case($($of_type:tt)+)])*
        pub struct $name:ident {$(
            $(#[doc = $meaning:literal])*
            $(#[range($($bound:literal = $limit:expr),+ $(; $words:literal)?)])?
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
            $(#[cfg_attr(feature = "case", schemars(extend($($bound = $limit),+)))])?
            $(#[cfg_attr(feature = "case", $($of_key)+)])*
            pub $key: $value,
        )+}

        impl $crate::case_type::Ranged for $name {
            fn out_of_range(&self) -> Option<$crate::case_type::OutOfRange> {
                None$($(.or_else(|| {
                    let bounds = [$(($bound, f64::from($limit))),+];
                    $crate::case_type::OutOfRange::check(stringify!($key), &self.$key, &bounds, concat!($($words)?))
                }))?)+
            }
        }
    };
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

impl<T: Number> Number for Option<T> {
    fn given(&self) -> Option<(f64, String)> {
        self.as_ref()?.given()
    }
}

impl OutOfRange {
    /// The fault of the number of a key that is out of its bounds, which words of their own may describe.
    pub fn check(
        key: &'static str,
        number: &impl Number,
        bounds: &[(&str, f64)],
        words: &str,
    ) -> Option<Self> {
        let (number, found) = number.given()?;
        let bound = |keyword: &str| bounds.iter().find(|it| it.0 == keyword).map(|it| it.1);
        let expected = if number.is_infinite() {
            "a finite number".to_owned()
        } else if is_within(number, bound) {
            return None;
        } else if words.is_empty() {
            range_in_words(bound).unwrap_or("at least 0".to_owned())
        } else {
            words.to_owned()
        };
        Some(Self {
            key,
            expected,
            found,
        })
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
