//! `[correction]`: the factors alpha and Omega of the bonds.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::fault::{Fault, KeyFault};
use super::key_path::KeyPath;
use super::model::ModelSection;
use super::values::require;
use super::word::Word;
use ligament::setup::{self, Alpha, Calibration, CorrectionDomain};

/// The corrections of the bonds.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Correction {
    /// The factor alpha.
    pub alpha: Word<Alpha>,
    /// What surfaces take from the families, given back by a factor Omega.
    pub surface: Surface,
    /// How the domain correction is iterated, if it is the one.
    #[serde(flatten, skip_serializing_if = "Option::is_none")]
    pub iteration: Option<Iteration>,
    /// The body that the correction sees.
    pub domain: Word<CorrectionDomain>,
}

/// The correction of surfaces.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Surface {
    /// None.
    None,
    /// By the volumes of the families.
    Volume,
    /// NHPD's iterative domain correction.
    Domain,
}

/// How the domain correction is iterated.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Iteration {
    /// How the change of a sweep is measured.
    pub rule: CorrectionRule,
    /// Change of a sweep below which the correction has converged; none where `auto` chooses.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub tolerance: Option<f64>,
    /// Sweeps allowed.
    pub max_sweeps: u32,
}

/// How the change of a correction sweep is measured.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default, Serialize, Deserialize, JsonSchema)]
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

#[derive(Default, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(super) struct RawCorrection {
    /// The factor alpha of each bond; without it as in the paper of the law.
    alpha: Option<Word<Alpha>>,
    /// The correction of surfaces; without it as in the paper of the law.
    surface: Option<Surface>,
    /// How the change of a sweep of the domain correction is measured.
    rule: Option<CorrectionRule>,
    /// Change of a sweep below which the domain correction has converged.
    #[schemars(extend("exclusiveMinimum" = 0))]
    tolerance: Option<f64>,
    /// Sweeps of the domain correction at most.
    #[schemars(range(min = 1), extend("default" = 500))]
    max_sweeps: Option<u32>,
    /// The body that the correction sees.
    #[schemars(extend("default" = "whole"))]
    domain: Option<Word<CorrectionDomain>>,
}

impl RawCorrection {
    /// Checks the section; what it leaves open follows from the bond model.
    pub(super) fn check(self, key: &KeyPath, model: &ModelSection) -> Result<Correction, KeyFault> {
        let of_paper = setup::Correction::of_paper(&model.into());
        let surface = self.surface.unwrap_or(match of_paper.surface {
            setup::Surface::None => Surface::None,
            setup::Surface::Volume => Surface::Volume,
            setup::Surface::Domain(_) => Surface::Domain,
        });
        let is_calibrated = model.calibration == Some(Word(Calibration::Discrete));
        if is_calibrated && surface == Surface::Volume {
            return Err(KeyFault::new(
                key.child("surface"),
                "the discrete calibration has the surfaces in its sums: take \"none\", or model.calibration = \"integral\"",
            ));
        }
        let iteration = match surface {
            Surface::Domain => Some(self.iteration(key)?),
            Surface::None | Surface::Volume => {
                self.require_no_iteration(key, surface)?;
                None
            }
        };
        Ok(Correction {
            alpha: self.alpha.unwrap_or(Word(of_paper.alpha)),
            surface,
            iteration,
            domain: self.domain.unwrap_or_default(),
        })
    }

    fn iteration(&self, key: &KeyPath) -> Result<Iteration, KeyFault> {
        // A tolerance alone is the paper's, which is one for the sum.
        let with_tolerance = self.tolerance.map(|_| CorrectionRule::Sum);
        let rule = self.rule.or(with_tolerance).unwrap_or_default();
        if self.tolerance.is_some() {
            require(
                rule != CorrectionRule::Auto,
                || key.child("rule"),
                "\"sum\" or \"mean\" where a tolerance is given",
                "\"auto\"",
            )?;
        }
        Ok(Iteration {
            rule,
            tolerance: self.tolerance.or(rule.default_tolerance()),
            max_sweeps: (self.max_sweeps).unwrap_or(setup::Iteration::default().max_sweeps as u32),
        })
    }

    fn require_no_iteration(&self, key: &KeyPath, surface: Surface) -> Result<(), KeyFault> {
        let given = [
            ("rule", self.rule.is_some()),
            ("tolerance", self.tolerance.is_some()),
            ("max_sweeps", self.max_sweeps.is_some()),
        ];
        match given.into_iter().find(|(_, given)| *given) {
            None => Ok(()),
            Some((name, _)) => Err(KeyFault::new(
                key.child(name),
                Fault::NotWith {
                    key: name,
                    setting: match surface {
                        Surface::Volume => "surface = \"volume\"".to_owned(),
                        Surface::None | Surface::Domain => "surface = \"none\"".to_owned(),
                    },
                    reason: "only the domain correction is iterated",
                },
            )),
        }
    }
}
