//! `[model]`: the bond model.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::fault::{Fault, KeyFault};
use super::key_path::KeyPath;
use super::values::{exactly_one, one_of, refuse};
use super::word::Word;
use ligament::setup::{Calibration, Form, Horizon, Law, Strains};
use ligament_model::law::rotational::{RotationalScale, RotationalStiffness};

/// The bond model.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(extend("oneOf" = exactly_one(&["horizon_factor", "horizon"])))]
pub struct ModelSection {
    /// The bond law.
    pub law: Word<Law>,
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
    /// Where the constants of the law come from; of `bbpd`, `bbpd-conical`, `pds`, `mppd`, `mppd-beam`.
    pub calibration: Option<Word<Calibration>>,
    /// Stiffness against relative rotation; of `mppd` and `orthotropic`.
    pub rotational_stiffness: Option<Word<RotationalStiffness>>,
    /// Stiffness against relative rotation over that of the law; of `nhpd`, `mppd`, `mppd-beam`, `orthotropic`; 1 without the key.
    #[schemars(range(min = 0))]
    pub rotational_factor: Option<f64>,
    /// Stiffness against relative rotation of a Cosserat continuum with this characteristic length in bending, m; in the place of
    /// `rotational_factor`.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub cosserat_length: Option<f64>,
    /// How the bonds of `mbb-pd` resist their strains.
    pub form: Option<Word<Form>>,
    /// What the strains of `mbb-pd` are taken over.
    pub strains: Option<Word<Strains>>,
}

impl ModelSection {
    /// Puts what the case says into the law, and what the law says else into the case.
    pub(super) fn complete(&mut self, key: &KeyPath) -> Result<(), KeyFault> {
        let mut law = self.law.0;
        let open = law.open();
        let is_open = [
            settle(&mut self.calibration, open.calibration),
            settle(&mut self.rotational_stiffness, open.rotational_stiffness),
            settle(&mut self.form, open.form),
            settle(&mut self.strains, open.strains),
        ];
        let reasons = [
            ("calibration", "its constants are those of the paper"),
            ("rotational_stiffness", "the law says what it is"),
            ("form", "only \"mbb-pd\" has several"),
            ("strains", "only \"mbb-pd\" has true strains"),
        ];
        if let Some(settled) = is_open.iter().position(|is_open| !is_open) {
            let (name, reason) = reasons[settled];
            let fault = Fault::NotWith {
                key: name,
                setting: format!("law = \"{}\"", law.name()),
                reason,
            };
            return Err(KeyFault::new(key.child(name), fault));
        }
        self.law = Word(law);
        self.check_rotational_scale(key, &law)
    }

    /// Keys for the size of the rotational stiffness mean nothing where there is none, and each other's place.
    fn check_rotational_scale(&self, key: &KeyPath, law: &Law) -> Result<(), KeyFault> {
        let given = [
            ("rotational_factor", self.rotational_factor.is_some()),
            ("cosserat_length", self.cosserat_length.is_some()),
        ];
        let Some(profile) = law.rotational_profile() else {
            let setting = format!("law = \"{}\"", law.name());
            return refuse(key, given, &setting, "its points have no rotations");
        };
        if profile.rotational == RotationalStiffness::Zero {
            let reason = "there is no stiffness to give a size to";
            return refuse(key, given, "rotational_stiffness = \"none\"", reason);
        }
        let reason = "both give the rotational stiffness its size";
        let length = [given[1]];
        match self.rotational_factor {
            Some(_) => refuse(key, length, "rotational_factor", reason),
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

/// Gives a key and what a law leaves open the same value; false where the law does not leave it open.
fn settle<T: Copy>(given: &mut Option<Word<T>>, open: Option<&mut T>) -> bool {
    match (given, open) {
        (Some(_), None) => return false,
        (None, None) => {}
        (Some(given), Some(open)) => *open = given.0,
        (given, Some(open)) => *given = Some(Word(*open)),
    }
    true
}
