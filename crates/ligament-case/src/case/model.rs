//! `[model]`: the bond model.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::fault::{Fault, KeyFault};
use super::key_path::KeyPath;
use super::values::{exactly_one, one_of};
use super::word::Word;
use ligament::setup::{Calibration, Form, Horizon, Law, Strains};
use ligament_model::law::rotational::RotationalStiffness;

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
    /// Where the constants of the law come from; of `bbpd`, `bbpd-conical`, `pds`, `mppd`, `mppd-beam`.
    pub calibration: Option<Word<Calibration>>,
    /// Stiffness against relative rotation; of `mppd` and `orthotropic`.
    pub rotational_stiffness: Option<Word<RotationalStiffness>>,
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
        Ok(())
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
