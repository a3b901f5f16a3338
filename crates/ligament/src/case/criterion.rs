//! `[[fracture.criterion]]`: when a bond fails, and what it does after.

use serde::Serialize;

/// A failure criterion.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Criterion {
    /// What fails, and where its limit comes from.
    #[serde(flatten)]
    pub kind: CriterionKind,
    /// What a bond does after its limit.
    #[serde(flatten)]
    pub after: After,
}

/// What fails, and where its limit comes from.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[serde(tag = "kind", rename_all = "kebab-case")]
pub enum CriterionKind {
    /// Stretch, from the energy at the tensile strength (NHPD).
    Strength,
    /// Stretch, from the tensile strength, or this one.
    Tension {
        /// Limit stretch.
        #[serde(skip_serializing_if = "Option::is_none")]
        limit: Option<f64>,
    },
    /// Shortening, from the compressive strength, or this one.
    Compression {
        /// Limit shortening, positive.
        #[serde(skip_serializing_if = "Option::is_none")]
        limit: Option<f64>,
    },
    /// Sliding, from the tensile strength, or this one.
    Sliding {
        /// Limit sliding.
        #[serde(skip_serializing_if = "Option::is_none")]
        limit: Option<f64>,
    },
    /// Sliding that compression makes harder, from both strengths.
    Frictional {
        /// How it comes from them.
        calibration: FrictionCalibration,
    },
    /// Stretch, from the fracture energy.
    CriticalStretch,
    /// Energy of stretch and sliding, from the fracture energy.
    BondEnergy,
}

/// How cohesion and friction come from the strengths.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum FrictionCalibration {
    /// As printed: exact without lateral strain alone.
    #[default]
    Printed,
    /// From the strains of a bar under both strengths.
    TwoPoint,
}

/// What a bond does after its limit.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[serde(tag = "after", rename_all = "kebab-case")]
pub enum After {
    /// It breaks.
    Brittle,
    /// Its force falls in a straight line to zero.
    Bilinear {
        /// Deformation there over that at the limit; none: so that the fracture energy of the material comes out.
        #[serde(skip_serializing_if = "Option::is_none")]
        end: Option<f64>,
    },
    /// Its force falls exponentially.
    Exponential {
        /// Scale of the fall over the deformation at the limit; none: so that the fracture energy of the material comes out.
        #[serde(skip_serializing_if = "Option::is_none")]
        scale: Option<f64>,
    },
    /// Its force stays.
    Plastic,
}

impl Criterion {
    /// That of a case that names none: the strength of NHPD.
    pub const DEFAULT: Self = Self {
        kind: CriterionKind::Strength,
        after: After::Brittle,
    };
}

impl CriterionKind {
    /// The word for it in a case file, and in results.
    pub fn word(&self) -> &'static str {
        match self {
            Self::Strength => "strength",
            Self::Tension { .. } => "tension",
            Self::Compression { .. } => "compression",
            Self::Sliding { .. } => "sliding",
            Self::Frictional { .. } => "frictional",
            Self::CriticalStretch => "critical-stretch",
            Self::BondEnergy => "bond-energy",
        }
    }
}
