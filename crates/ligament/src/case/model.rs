//! `[model]` and `[correction]`: the bond model.

use serde::{Deserialize, Serialize};

use super::fault::KeyFault;
use super::key_path::KeyPath;
use super::values::{require, require_at_least_one, require_positive};

/// The bond model.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct ModelSection {
    /// The bond law.
    pub law: Law,
    /// The factor lambda: a point's horizon over the distance to its nearest neighbour; at least 1.
    pub horizon_factor: f64,
}

/// A bond law.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Law {
    /// Beam-like bonds with non-unified horizons: normal, shear and rotational stiffness.
    Nhpd,
}

impl ModelSection {
    pub(super) fn check(self, key: &KeyPath) -> Result<Self, KeyFault> {
        let factor = self.horizon_factor;
        require(
            factor >= 1.0,
            || key.child("horizon_factor"),
            "at least 1",
            factor,
        )?;
        Ok(self)
    }
}

/// The iterative domain correction of the bonds.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Correction {
    /// How the change of a sweep is measured.
    pub rule: CorrectionRule,
    /// Change of a sweep below which the correction has converged; none where `auto` chooses.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub tolerance: Option<f64>,
    /// Sweeps allowed.
    pub max_sweeps: u32,
    /// The body that the correction sees.
    pub domain: CorrectionDomain,
}

/// How the change of a correction sweep is measured.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum CorrectionRule {
    /// `sum` for models of up to a million bonds, `mean` for larger ones, each with its default tolerance.
    #[default]
    Auto,
    /// Summed over all bonds (the paper's): grows with the size of the model.
    Sum,
    /// Mean per bond: independent of the size of the model.
    Mean,
}

impl CorrectionRule {
    /// Tolerance where none is given: the paper's for the sum; the mean's makes the energies of a large model as right
    /// as the sum does those of a small one. `auto` has that of the rule it chooses.
    pub fn default_tolerance(self) -> Option<f64> {
        match self {
            Self::Auto => None,
            Self::Sum => Some(1e-3),
            Self::Mean => Some(1e-7),
        }
    }
}

/// The body that the correction sees.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum CorrectionDomain {
    /// Before the pre-cracks cut bonds.
    #[default]
    Whole,
    /// After the pre-cracks cut bonds.
    Cracked,
}

#[derive(Default, Deserialize)]
#[serde(deny_unknown_fields)]
pub(super) struct RawCorrection {
    rule: Option<CorrectionRule>,
    tolerance: Option<f64>,
    max_sweeps: Option<u32>,
    domain: Option<CorrectionDomain>,
}

impl RawCorrection {
    pub(super) fn check(self, key: &KeyPath) -> Result<Correction, KeyFault> {
        // A tolerance alone is the paper's, which is one for the sum.
        let with_tolerance = self.tolerance.map(|_| CorrectionRule::Sum);
        let rule = self.rule.or(with_tolerance).unwrap_or_default();
        if let Some(tolerance) = self.tolerance {
            require_positive(key, "tolerance", tolerance)?;
            require(
                rule != CorrectionRule::Auto,
                || key.child("rule"),
                "\"sum\" or \"mean\" where a tolerance is given",
                "\"auto\"",
            )?;
        }
        let max_sweeps = self.max_sweeps.unwrap_or(500);
        require_at_least_one(key, "max_sweeps", max_sweeps)?;
        Ok(Correction {
            rule,
            tolerance: self.tolerance.or(rule.default_tolerance()),
            max_sweeps,
            domain: self.domain.unwrap_or_default(),
        })
    }
}
