//! Reasons why a choice of a criterion is refused.

use std::fmt;

use crate::advice::Advice;

/// Fault of a choice, or of a material for it.
#[derive(Debug, Clone, PartialEq)]
pub enum Unfit {
    /// A setting without effect beside another one.
    NotWith {
        /// The field.
        field: &'static str,
        /// The field or its value.
        named: Setting,
        /// The other setting.
        setting: Setting,
        /// The reason.
        reason: Advice<Setting>,
    },
    /// A field without a value.
    Missing {
        /// The field.
        field: &'static str,
        /// The setting that makes the field necessary.
        reason: Advice<Setting>,
    },
    /// A number outside of its range.
    OutOfRange {
        /// The field.
        field: &'static str,
        /// Description of the range.
        expected: String,
        /// The number.
        found: f64,
    },
    /// A material with axes, for which only criteria with given limits exist.
    WithAxes {
        /// Property of the material that the criterion takes.
        property: &'static str,
        /// The word of the criterion.
        kind: &'static str,
        /// The field of the criterion that replaces the property.
        instead: Option<&'static str>,
    },
}

impl Unfit {
    /// The field of the criterion, or of the material, that is wrong; none where it is the material as a whole.
    pub fn field(&self) -> Option<&'static str> {
        match self {
            Self::NotWith { field, .. }
            | Self::Missing { field, .. }
            | Self::OutOfRange { field, .. } => Some(field),
            Self::WithAxes { .. } => None,
        }
    }

    /// The fault with the words of a layer for each setting.
    pub fn said(&self, words: impl Fn(&Setting) -> String) -> String {
        match self {
            Self::NotWith {
                named,
                setting,
                reason,
                ..
            } => format!(
                "`{}` does not apply with {}: {}; remove it",
                words(named),
                words(setting),
                reason.said(words)
            ),
            Self::Missing { field, reason } => {
                format!("missing {field}: it is required {}", reason.said(words))
            }
            Self::OutOfRange {
                expected, found, ..
            } => format!("must be {expected}, found {found:?}"),
            Self::WithAxes {
                property,
                kind,
                instead,
            } => format!(
                "`{property}` gives limits of isotropic materials only, and {} takes them from it: {}",
                words(&Setting::OneOfCriteria(kind)),
                match instead {
                    Some(instead) => format!("give it its own `{instead}`"),
                    None =>
                        "take \"tension\", \"compression\" or \"sliding\" with a `limit`".to_owned(),
                }
            ),
        }
    }
}

impl fmt::Display for Unfit {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.write_str(&self.said(Setting::to_string))
    }
}

impl std::error::Error for Unfit {}

/// Reason why bonds have no limits.
#[derive(Debug, Clone, PartialEq)]
pub enum NoLimit {
    /// A criterion for the plane alone, requested in space.
    PlaneOnly {
        /// Word of its kind.
        kind: &'static str,
        /// Words of the kinds that exist in space.
        in_space: Vec<&'static str>,
    },
    /// Strengths that leave no angle of friction.
    NoFriction {
        /// Poisson's ratio of the bar; in plane strain nu/(1 - nu).
        poisson: f64,
        /// Tensile strength, Pa.
        tensile: f64,
        /// Compressive strength, Pa.
        compressive: f64,
    },
    /// A fracture energy that is too small for the energy stored in a bond at its limit.
    NothingLeft {
        /// Horizon of the bond, m.
        horizon: f64,
        /// Limit of the bond's measure.
        limit: f64,
        /// The measure at which a brittle bond has the fracture energy.
        brittle: f64,
        /// Ratio of the fracture energy to the energy stored at the limit that must be exceeded.
        least: f64,
    },
}

impl fmt::Display for NoLimit {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::PlaneOnly { kind, in_space } => write!(
                formatter,
                "the criterion \"{kind}\" exists in the plane alone; in space take one of \"{}\"",
                in_space.join("\", \"")
            ),
            Self::NoFriction {
                poisson,
                tensile,
                compressive,
            } => write!(
                formatter,
                "a bar with Poisson's ratio {poisson:.4} (in plane strain nu/(1 - nu)) and strengths {tensile:.4e} and {compressive:.4e} Pa fits no \
                 friction: the calibration \"two-point\" needs poisson < tensile_strength/compressive_strength = {:.4}; take \
                 \"printed\", or strengths that lie closer together",
                tensile / compressive
            ),
            Self::NothingLeft {
                horizon,
                limit,
                brittle,
                least,
            } => write!(
                formatter,
                "too little is left of the fracture energy after the limit: a bond of horizon {horizon:.3e} m begins to soften at \
                 {limit:.3e}, and has stored all of it at {brittle:.3e}; take a horizon below {:.3e} m, a larger \
                 fracture_energy or a smaller strength",
                horizon * (brittle / limit).powi(2) / least
            ),
        }
    }
}

impl std::error::Error for NoLimit {}

/// A setting of a criterion, or of the analysis beside it.
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
