//! Settings that messages about criteria name.

use std::fmt;

/// A setting of a criterion or of what it goes with.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Setting {
    /// A field of a [`Choice`](super::Choice).
    Field(&'static str),
    /// A criterion, by the word of its kind.
    Criterion(&'static str),
    /// A criterion among those by which bonds fail, by the word of its kind.
    OneOfCriteria(&'static str),
    /// Failure of bonds by a criterion, by the word of its kind.
    FailureBy(&'static str),
    /// Behaviour of bonds after their limit, by the word of its law.
    After(&'static str),
    /// An analysis along the exact path from breakage to breakage.
    ExactPath,
    /// An analysis in load steps.
    LoadSteps,
}

impl fmt::Display for Setting {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Field(name) => formatter.write_str(name),
            Self::Criterion(word) | Self::OneOfCriteria(word) => {
                write!(formatter, "the criterion \"{word}\"")
            }
            Self::FailureBy(word) => write!(formatter, "bonds fail by the criterion \"{word}\""),
            Self::After(word) => write!(formatter, "after \"{word}\""),
            Self::ExactPath => formatter.write_str("the exact path"),
            Self::LoadSteps => formatter.write_str("load steps"),
        }
    }
}
