//! Why a choice of a criterion cannot be.

use std::borrow::Cow;
use std::fmt;

/// Fault of a choice, or of a material for it; all but one name the key.
#[derive(Debug, Clone, PartialEq)]
pub enum Unfit {
    /// A key, or a setting of it, that means nothing with another setting.
    NotWith {
        /// The key.
        key: &'static str,
        /// The key, or its setting.
        named: String,
        /// The setting with which it means nothing.
        setting: String,
        /// The reason.
        reason: Cow<'static, str>,
    },
    /// A key that is not there.
    Missing {
        /// The key.
        key: &'static str,
        /// The setting that makes the key necessary.
        reason: String,
    },
    /// A number outside of what makes sense.
    OutOfRange {
        /// The key.
        key: &'static str,
        /// Range of numbers that make sense, in words.
        expected: String,
        /// The number.
        found: f64,
    },
    /// A material with axes, for which only criteria with limits of their own are made.
    WithAxes {
        /// Property of the material that the criterion takes.
        property: &'static str,
        /// The word of the criterion.
        kind: &'static str,
        /// The key that spares the property.
        instead: Option<&'static str>,
    },
}

impl Unfit {
    /// The key of the criterion, or of the material, that is wrong; none where it is the material as a whole.
    pub fn key(&self) -> Option<&'static str> {
        match self {
            Self::NotWith { key, .. }
            | Self::Missing { key, .. }
            | Self::OutOfRange { key, .. } => Some(key),
            Self::WithAxes { .. } => None,
        }
    }
}

impl fmt::Display for Unfit {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::NotWith {
                named,
                setting,
                reason,
                ..
            } => write!(
                formatter,
                "`{named}` does not apply with {setting}: {reason}; remove it"
            ),
            Self::Missing { key, reason } => {
                write!(formatter, "missing key `{key}`: it is required {reason}")
            }
            Self::OutOfRange {
                expected, found, ..
            } => write!(formatter, "must be {expected}, found {found:?}"),
            Self::WithAxes {
                property,
                kind,
                instead,
            } => {
                write!(
                    formatter,
                    "`{property}` gives limits of isotropic materials only, and the criterion \"{kind}\" of [fracture] takes them \
                     from it: "
                )?;
                match instead {
                    Some(instead) => write!(formatter, "give it its own `{instead}`"),
                    None => write!(
                        formatter,
                        "take \"tension\", \"compression\" or \"sliding\" with a `limit`"
                    ),
                }
            }
        }
    }
}

impl std::error::Error for Unfit {}

/// Why bonds have no limits.
#[derive(Debug, Clone, PartialEq)]
pub enum NoLimit {
    /// A criterion in space that exists in the plane alone.
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
    /// A fracture energy of which a bond stores too much up to its limit.
    NothingLeft {
        /// Horizon of the bond, m.
        horizon: f64,
        /// Limit of the bond's measure.
        limit: f64,
        /// The measure at which a brittle bond takes the fracture energy.
        brittle: f64,
        /// Fracture energy over what a bond stores up to its limit that would be too little.
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
                 friction: calibration = \"two-point\" needs poisson < tensile_strength/compressive_strength = {:.4}; take \
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
