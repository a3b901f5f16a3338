//! Types that a case file reads as they are.

/// A structure or a list of words that a case file reads as it is. With the feature `case` the type derives what serde and schemars need: its
/// documentation describes it to users, and `#[case(...)]` adds attributes of the two. A variant is written as its name in kebab case.
///
/// ```text
/// ligament_model::case_type! {
///     /// Damping in proportion to masses and stiffness.
///     #[derive(Debug, Clone, Copy, PartialEq, Default)]
///     #[case(serde(default))]
///     pub struct Damping {
///         /// alpha, 1/s: slow motions are damped most.
///         #[case(schemars(range(min = 0), extend("x-unit" = "1/s")))]
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
            $(#[cfg_attr(feature = "case", $($of_key)+)])*
            pub $key: $value,
        )+}
    };
}
