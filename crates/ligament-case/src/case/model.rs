//! `[model]` and `[correction]`: the bond model, and the factors alpha and Omega of its bonds.

use ligament::setup::{
    self, Alpha, Calibration, CorrectionDomain, Form, Horizon, Iteration, Law, Options,
    PoissonForm, Setup, Strains, Surface,
};
use ligament_model::correction::StopRule;
use ligament_model::correction::patch::{Reference, Settings};
use ligament_model::law::rotational::{RotationalScale, RotationalStiffness};
use ligament_model::law::{BondLaw, LAWS};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::fault::{Fault, KeyFault};
use super::key_path::KeyPath;
use super::values::{exactly_one, one_of, refuse, require};
use super::word::{Word, word_of};

/// The bond model.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(extend("oneOf" = exactly_one(&["horizon_factor", "horizon"])))]
pub struct ModelSection {
    /// The bond law.
    pub law: Law,
    /// Horizon of each point over the distance to its nearest neighbour, lambda; 3 is usual.
    #[schemars(transform = Horizon::FACTOR.keywords())]
    pub horizon_factor: Option<f64>,
    /// One horizon for all points, m, in the place of `horizon_factor`.
    #[schemars(transform = Horizon::LENGTH.keywords())]
    pub horizon: Option<f64>,
    /// Whether bonds run through holes, slots and notches of a mesh, as if these were filled.
    #[serde(default)]
    pub bonds_through_voids: bool,
    /// Whether the faces of cracks carry pressure again where they close; of laws whose points turn.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    #[schemars(extend("default" = false))]
    pub closing: bool,
    /// Coefficient of friction on faces that close; not along the exact path.
    #[serde(default, skip_serializing_if = "is_zero")]
    #[schemars(transform = Setup::CLOSING_FRICTION.keywords(), extend("default" = 0.0))]
    pub closing_friction: f64,
    /// Whether a run goes on where the intact model is unstable, with more negative eigenvalues than its rotations explain; its results are
    /// then not to be trusted.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    #[schemars(extend("default" = false))]
    pub allow_unstable: bool,
    /// What carries the stiffness that bonds cannot have above the Poisson's ratio of central forces (1/3 in plane stress, else 1/4).
    #[serde(default, skip_serializing_if = "by_cells")]
    #[schemars(extend("description" = laws_text("Carrier of the stiffness that bonds cannot have above a Poisson's ratio of 1/4 (in plane stress 1/3)", |it| it.options.poisson.is_some())))]
    pub poisson: Option<PoissonForm>,
    /// Origin of the constants of the law.
    #[schemars(extend("description" = laws_text("Origin of the constants of the law", |it| it.options.calibration.is_some())))]
    pub calibration: Option<Calibration>,
    /// Stiffness against relative rotation.
    #[schemars(extend("description" = laws_text("Stiffness against relative rotation", |it| it.options.rotational_stiffness.is_some())))]
    pub rotational_stiffness: Option<RotationalStiffness>,
    /// Rotational stiffness over the stiffness of the law; 1 without the key.
    #[schemars(transform = RotationalScale::FACTOR.keywords(), extend("description" = laws_text("Rotational stiffness over the stiffness of the law; 1 without the \
        key", |it| it.shear_form.is_some())))]
    pub rotational_factor: Option<f64>,
    /// Stiffness against relative rotation of a Cosserat continuum with this characteristic length in bending, m; in the place of
    /// `rotational_factor`.
    #[schemars(transform = RotationalScale::LENGTH.keywords())]
    pub cosserat_length: Option<f64>,
    /// Strains that the bonds of `mbb-pd` resist.
    pub form: Option<Form>,
    /// Distances in the denominators of the strains of `mbb-pd`.
    pub strains: Option<Strains>,
}

fn by_cells(form: &Option<PoissonForm>) -> bool {
    *form != Some(PoissonForm::Bonds)
}

fn is_zero(value: &f64) -> bool {
    *value == 0.0
}

impl ModelSection {
    /// Sets the options of the law from the case, and missing keys of the case from the law.
    pub(super) fn complete(&mut self, key: &KeyPath) -> Result<(), KeyFault> {
        let law = self.law.with(Options {
            calibration: self.calibration,
            rotational_stiffness: self.rotational_stiffness,
            form: self.form,
            strains: self.strains,
            poisson: self.poisson,
        });
        let reasons = [
            ("calibration", "its constants are those of the paper"),
            ("rotational_stiffness", "the law determines it"),
            ("form", "only \"mbb-pd\" has several"),
            ("strains", "only \"mbb-pd\" has true strains"),
            ("poisson", "its cells carry no stiffness"),
        ];
        let settled = law.misplaced_option();
        let settled = settled.and_then(|name| reasons.iter().find(|(key, _)| *key == name));
        if let Some(&(name, reason)) = settled {
            let fault = Fault::NotWith {
                key: name,
                setting: format!("law = \"{}\"", law.name()),
                reason,
            };
            return Err(KeyFault::new(key.child(name), fault));
        }
        self.law = law;
        self.calibration = law.options.calibration;
        self.rotational_stiffness = law.options.rotational_stiffness;
        self.form = law.options.form;
        self.strains = law.options.strains;
        self.poisson = law.options.poisson;
        self.check_rotational_scale(key, &law)
    }

    /// Refuses keys for the size of the rotational stiffness where there is none, and both keys together.
    fn check_rotational_scale(&self, key: &KeyPath, law: &Law) -> Result<(), KeyFault> {
        let keys = ["rotational_factor", "cosserat_length"];
        let Some(profile) = law.rotational_profile() else {
            let setting = format!("law = \"{}\"", law.name());
            return refuse(key, self, &keys, &setting, "its points have no rotations");
        };
        if profile.rotational == RotationalStiffness::Zero {
            let reason = "there is no rotational stiffness to scale";
            return refuse(key, self, &keys, "rotational_stiffness = \"none\"", reason);
        }
        let reason = "both scale the rotational stiffness";
        match self.rotational_factor {
            Some(_) => refuse(key, self, &keys[1..], "rotational_factor", reason),
            None => Ok(()),
        }
    }

    /// Scale of the rotational stiffness.
    pub(super) fn rotational_scale(&self) -> RotationalScale {
        let factor = self.rotational_factor.unwrap_or(1.0);
        let length = self.cosserat_length.map(RotationalScale::CosseratLength);
        length.unwrap_or(RotationalScale::Factor(factor))
    }

    pub(super) fn horizon(&self, key: &KeyPath) -> Result<Horizon, KeyFault> {
        let factor = self.horizon_factor.map(Horizon::Factor);
        let length = self.horizon.map(Horizon::Length);
        one_of(key, [("horizon_factor", factor), ("horizon", length)])
    }
}

/// Description of a key, with the laws to which it applies.
fn laws_text(what: &str, takes: fn(&BondLaw) -> bool) -> String {
    let laws = LAWS.into_iter().filter(|it| takes(it));
    let words: Vec<String> = laws.map(|it| format!("`{}`", it.word)).collect();
    format!("{what}; of {}.", words.join(", "))
}

/// The corrections of the bonds.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Correction {
    /// The factor alpha of each bond; without it as in the paper of the law.
    pub alpha: Option<Alpha>,
    /// The correction of surfaces; without it as in the paper of the law.
    pub surface: Option<Word<Surface>>,
    /// Measure of the change in a sweep of the domain correction.
    pub rule: Option<Word<Option<StopRule>>>,
    /// Change of a sweep below which the domain correction has converged.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub tolerance: Option<f64>,
    /// Sweeps of the domain correction at most.
    #[schemars(range(min = 1), extend("default" = Iteration::default().max_sweeps))]
    pub max_sweeps: Option<usize>,
    /// Reference factors, from which the factors of the patch correction differ as little as they can.
    #[schemars(extend("default" = Settings::DEFAULT.reference))]
    pub reference: Option<Reference>,
    /// Smallest factor of the patch correction over the uncorrected one.
    #[schemars(transform = Settings::LOWEST.keywords(), extend("default" = Settings::DEFAULT.lowest))]
    pub smallest_factor: Option<f64>,
    /// Largest factor of the patch correction over the uncorrected one.
    #[schemars(transform = Settings::HIGHEST.keywords(), extend("default" = Settings::DEFAULT.highest))]
    pub largest_factor: Option<f64>,
    /// Weight of the equations of moments relative to the equations of forces in the patch correction.
    #[schemars(transform = Settings::MOMENT_WEIGHT.keywords(), extend("default" = Settings::DEFAULT.moment_weight))]
    pub moment_weight: Option<f64>,
    /// Regularisation of the patch correction, for equations that cannot be satisfied.
    #[schemars(transform = Settings::REGULARISATION.keywords(), extend("default" = Settings::DEFAULT.regularisation))]
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
            reference: *self.reference.get_or_insert(default.reference),
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
