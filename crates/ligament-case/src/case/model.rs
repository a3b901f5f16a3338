//! `[model]`: the bond model.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::fault::{Fault, KeyFault};
use super::key_path::KeyPath;
use super::values::{exactly_one, one_of};
use super::word::Word;
use ligament::setup::{Calibration, Form, Horizon, Law, Open, Strains};
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
        let Open {
            calibration,
            rotational_stiffness,
            form,
            strains,
        } = law.open();
        let of_paper = "its constants are those of the paper";
        let settled = settle(&mut self.calibration, calibration, "calibration", of_paper)
            .and_then(|()| {
                let (given, reason) = (&mut self.rotational_stiffness, "the law says what it is");
                settle(given, rotational_stiffness, "rotational_stiffness", reason)
            })
            .and_then(|()| {
                let reason = "only \"mbb-pd\" has several";
                settle(&mut self.form, form, "form", reason)
            })
            .and_then(|()| {
                let reason = "only \"mbb-pd\" has true strains";
                settle(&mut self.strains, strains, "strains", reason)
            });
        settled.map_err(|(name, reason)| {
            let fault = Fault::NotWith {
                key: name,
                setting: format!("law = \"{}\"", self.law.0.name()),
                reason,
            };
            KeyFault::new(key.child(name), fault)
        })?;
        self.law = Word(law);
        Ok(())
    }

    pub(super) fn horizon(&self, key: &KeyPath) -> Result<Horizon, KeyFault> {
        let factor = self.horizon_factor.map(Horizon::Factor);
        let length = self.horizon.map(Horizon::Length);
        one_of(key, [("horizon_factor", factor), ("horizon", length)])
    }
}

/// Gives a key and what a law leaves open the same value; the key and the reason where the law does not leave it open.
fn settle<T: Copy>(
    given: &mut Option<Word<T>>,
    open: Option<&mut T>,
    key: &'static str,
    reason: &'static str,
) -> Result<(), (&'static str, &'static str)> {
    match (given, open) {
        (Some(_), None) => return Err((key, reason)),
        (None, None) => {}
        (Some(given), Some(open)) => *open = given.0,
        (given, Some(open)) => *given = Some(Word(*open)),
    }
    Ok(())
}
