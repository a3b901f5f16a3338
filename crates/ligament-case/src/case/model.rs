//! `[model]`: the bond model.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::fault::{Fault, KeyFault};
use super::key_path::KeyPath;
use super::values::{exactly_one, one_of, refuse};
use ligament::setup::{Calibration, Form, Horizon, Law, Options, Strains};
use ligament_model::law::rotational::{RotationalScale, RotationalStiffness};
use ligament_model::law::{BondLaw, LAWS};

/// The bond model.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(extend("oneOf" = exactly_one(&["horizon_factor", "horizon"])))]
pub struct ModelSection {
    /// The bond law.
    pub law: Law,
    /// Horizon of each point over the distance to its nearest neighbour, lambda; 3 is usual.
    #[schemars(range(min = 1))]
    pub horizon_factor: Option<f64>,
    /// One horizon for all points, m, in the place of `horizon_factor`.
    #[schemars(extend("exclusiveMinimum" = 0))]
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
    #[schemars(range(min = 0), extend("default" = 0.0))]
    pub closing_friction: f64,
    /// Whether a run goes on where the intact model is unstable, with more negative eigenvalues than its rotations explain; its results are
    /// then not to be trusted.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    #[schemars(extend("default" = false))]
    pub allow_unstable: bool,
    /// Where the constants of the law come from.
    #[schemars(extend("description" = of_laws("Where the constants of the law come from", |it| it.options.calibration.is_some())))]
    pub calibration: Option<Calibration>,
    /// Stiffness against relative rotation.
    #[schemars(extend("description" = of_laws("Stiffness against relative rotation", |it| it.options.rotational_stiffness.is_some())))]
    pub rotational_stiffness: Option<RotationalStiffness>,
    /// Stiffness against relative rotation over that of the law; 1 without the key.
    #[schemars(range(min = 0), extend("description" = of_laws("Stiffness against relative rotation over that of the law; 1 without the \
        key", |it| it.shear_form.is_some())))]
    pub rotational_factor: Option<f64>,
    /// Stiffness against relative rotation of a Cosserat continuum with this characteristic length in bending, m; in the place of
    /// `rotational_factor`.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub cosserat_length: Option<f64>,
    /// How the bonds of `mbb-pd` resist their strains.
    pub form: Option<Form>,
    /// What the strains of `mbb-pd` are taken over.
    pub strains: Option<Strains>,
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
        });
        let reasons = [
            ("calibration", "its constants are those of the paper"),
            ("rotational_stiffness", "the law determines it"),
            ("form", "only \"mbb-pd\" has several"),
            ("strains", "only \"mbb-pd\" has true strains"),
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

    /// Size of the rotational stiffness.
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

/// Description of a key with the laws to which it applies.
fn of_laws(what: &str, takes: fn(&BondLaw) -> bool) -> String {
    let laws = LAWS.into_iter().filter(|it| takes(it));
    let words: Vec<String> = laws.map(|it| format!("`{}`", it.word)).collect();
    format!("{what}; of {}.", words.join(", "))
}
