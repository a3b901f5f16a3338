//! `[correction]`: the factors alpha and Omega of the bonds.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::fault::KeyFault;
use super::key_path::KeyPath;
use super::values::{refuse, require};
use super::word::{Word, word_of};
use ligament::setup::{self, Alpha, CorrectionDomain, Iteration, Law, Surface};
use ligament_model::correction::StopRule;
use ligament_model::correction::patch::{Reference, Settings};

/// The corrections of the bonds.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Correction {
    /// The factor alpha of each bond; without it as in the paper of the law.
    pub alpha: Option<Alpha>,
    /// The correction of surfaces; without it as in the paper of the law.
    pub surface: Option<Word<Surface>>,
    /// How the change of a sweep of the domain correction is measured.
    pub rule: Option<Word<Option<StopRule>>>,
    /// Change of a sweep below which the domain correction has converged.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub tolerance: Option<f64>,
    /// Sweeps of the domain correction at most.
    #[schemars(range(min = 1), extend("default" = Iteration::default().max_sweeps))]
    pub max_sweeps: Option<usize>,
    /// The factors that those of the patch correction are the nearest to; without it `body` in the plane and `families` in space.
    pub reference: Option<Reference>,
    /// Smallest factor of the patch correction over the uncorrected one.
    #[schemars(extend("exclusiveMinimum" = 0, "exclusiveMaximum" = 1, "default" = Settings::DEFAULT.lowest))]
    pub smallest_factor: Option<f64>,
    /// Largest factor of the patch correction over the uncorrected one.
    #[schemars(extend("exclusiveMinimum" = 1, "default" = Settings::DEFAULT.highest))]
    pub largest_factor: Option<f64>,
    /// Weight of the equations of moments against those of forces in the patch correction.
    #[schemars(extend("exclusiveMinimum" = 0, "default" = Settings::DEFAULT.moment_weight))]
    pub moment_weight: Option<f64>,
    /// Regularisation of the patch correction, which lets go where its equations cannot be met.
    #[schemars(extend("exclusiveMinimum" = 0, "exclusiveMaximum" = 1, "default" = Settings::DEFAULT.regularisation))]
    pub regularisation: Option<f64>,
    /// The body that the correction sees.
    #[serde(default)]
    pub domain: CorrectionDomain,
}

impl Correction {
    /// Fills in missing keys, partly from the law.
    pub(super) fn complete(&mut self, key: &KeyPath, law: &Law) -> Result<(), KeyFault> {
        let of_paper = setup::Correction::of_paper(law);
        self.alpha.get_or_insert(of_paper.alpha);
        let surface = self.surface.get_or_insert(Word(of_paper.surface)).0;
        let of_domain = ["rule", "tolerance", "max_sweeps"];
        let of_patch = [
            "reference",
            "smallest_factor",
            "largest_factor",
            "moment_weight",
            "regularisation",
        ];
        let setting = format!("surface = \"{}\"", word_of(&Word(surface)));
        let is_iterated = "only the domain correction is iterated";
        let is_patch = "only the patch correction has it";
        match surface {
            Surface::Domain(_) => {
                refuse(key, self, &of_patch, &setting, is_patch)?;
                self.surface = Some(Word(Surface::Domain(self.iteration(key)?)));
            }
            Surface::Patch(_) => {
                refuse(key, self, &of_domain, &setting, is_iterated)?;
                self.surface = Some(Word(Surface::Patch(self.patch())));
            }
            Surface::None | Surface::Volume => {
                refuse(key, self, &of_domain, &setting, is_iterated)?;
                refuse(key, self, &of_patch, &setting, is_patch)?;
            }
        }
        Ok(())
    }

    fn patch(&mut self) -> Settings {
        let default = Settings::DEFAULT;
        Settings {
            reference: self.reference,
            lowest: *self.smallest_factor.get_or_insert(default.lowest),
            highest: *self.largest_factor.get_or_insert(default.highest),
            moment_weight: *self.moment_weight.get_or_insert(default.moment_weight),
            regularisation: *self.regularisation.get_or_insert(default.regularisation),
        }
    }

    fn iteration(&mut self, key: &KeyPath) -> Result<Iteration, KeyFault> {
        // A tolerance without a rule is that of the paper's rule, the sum.
        let with_tolerance = self.tolerance.map(|_| Iteration::SUM);
        let rule = self.rule.get_or_insert(Word(with_tolerance)).0;
        let stop = match (rule, self.tolerance) {
            (Some(StopRule::Sum(_)), Some(tolerance)) => Some(StopRule::Sum(tolerance)),
            (Some(StopRule::Mean(_)), Some(tolerance)) => Some(StopRule::Mean(tolerance)),
            (rule, tolerance) => {
                require(
                    rule.is_some() || tolerance.is_none(),
                    || key.child("rule"),
                    "\"sum\" or \"mean\" where a tolerance is given",
                    "auto",
                )?;
                rule
            }
        };
        if let Some(StopRule::Sum(tolerance) | StopRule::Mean(tolerance)) = stop {
            self.tolerance = Some(tolerance);
        }
        let default = Iteration::default().max_sweeps;
        let max_sweeps = *self.max_sweeps.get_or_insert(default);
        Ok(Iteration { stop, max_sweeps })
    }

    pub(super) fn setup(&self, law: &Law) -> setup::Correction {
        let of_paper = setup::Correction::of_paper(law);
        setup::Correction {
            alpha: self.alpha.unwrap_or(of_paper.alpha),
            surface: self.surface.map_or(of_paper.surface, |it| it.0),
            domain: self.domain,
        }
    }
}
