//! `[[fracture.criterion]]`: when a bond fails, and what it does after.

use ligament_model::failure::softening::Law;
use ligament_model::failure::{
    After, Calibration, Choice, Kind, Unfit, frictional, mixed_mode, strength,
};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize, Serializer};

use super::fault::KeyFault;
use super::key_path::KeyPath;
use super::model;
use super::word::Word;

/// The criterion of a case that names none: the strength of NHPD, or the one criterion that the law takes.
pub(super) fn default_of(law: model::Law) -> Choice {
    match law {
        model::Law::MbbPd => mixed_mode::MIXED_MODE.into(),
        _ => strength::STRENGTH.into(),
    }
}

/// What is wrong with a choice, or with a material for it, under the key of its table.
pub(super) fn fault(table: &KeyPath, unfit: Unfit) -> KeyFault {
    let key = unfit
        .key()
        .map_or_else(|| table.clone(), |key| table.child(key));
    KeyFault::new(key, unfit.to_string())
}

#[derive(Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub(super) struct RawCriterion {
    /// What fails, and where its limit comes from.
    kind: Word<Kind>,
    /// Stretch, shortening or sliding at which a bond fails, in the place of the strength or the energy of the material.
    #[schemars(extend("exclusiveMinimum" = 0))]
    #[serde(skip_serializing_if = "Option::is_none")]
    limit: Option<f64>,
    /// Stretch at which a bond without shear fails; of `mixed-mode`, with `critical_angle`.
    #[schemars(extend("exclusiveMinimum" = 0))]
    #[serde(skip_serializing_if = "Option::is_none")]
    critical_stretch: Option<f64>,
    /// Shear at which a bond that does not open fails, rad; of `mixed-mode`, with `critical_stretch`.
    #[schemars(extend("exclusiveMinimum" = 0))]
    #[serde(skip_serializing_if = "Option::is_none")]
    critical_angle: Option<f64>,
    /// How the limit of `frictional` comes from the strengths.
    #[schemars(extend("default" = "printed"))]
    #[serde(skip_serializing_if = "Option::is_none")]
    calibration: Option<Word<Calibration>>,
    /// What a bond does after its limit.
    #[serde(default)]
    after: Word<Law>,
    /// Deformation at which the force of `bilinear` is gone, over that at the limit; without it so that the `fracture_energy` comes out.
    #[schemars(extend("exclusiveMinimum" = 1))]
    #[serde(skip_serializing_if = "Option::is_none")]
    end: Option<f64>,
    /// Scale of the fall of `exponential` over the deformation at the limit; without it so that the `fracture_energy` comes out.
    #[schemars(extend("exclusiveMinimum" = 0))]
    #[serde(skip_serializing_if = "Option::is_none")]
    scale: Option<f64>,
}

impl RawCriterion {
    pub(super) fn check(self, key: &KeyPath, on_exact_path: bool) -> Result<Choice, KeyFault> {
        let at = |unfit| fault(key, unfit);
        let is_frictional = self.kind.0 == frictional::FRICTIONAL;
        let given = self.calibration.map(|it| it.0);
        let choice = Choice {
            kind: self.kind.0,
            limit: self.limit,
            critical_stretch: self.critical_stretch,
            critical_angle: self.critical_angle,
            calibration: given.or(is_frictional.then(Calibration::default)),
            after: After::from_keys(self.after.0, &[("end", self.end), ("scale", self.scale)])
                .map_err(at)?,
        };
        choice.check(on_exact_path).map_err(at)?;
        Ok(choice)
    }

    fn written(choice: &Choice) -> Self {
        let After { law, parameter } = choice.after;
        let of_key = |key| parameter.filter(|_| law.parameter.is_some_and(|it| it.key == key));
        Self {
            kind: Word(choice.kind),
            limit: choice.limit,
            critical_stretch: choice.critical_stretch,
            critical_angle: choice.critical_angle,
            calibration: choice.calibration.map(Word),
            after: Word(law),
            end: of_key("end"),
            scale: of_key("scale"),
        }
    }
}

/// Writes the criteria as they stand in a case file.
pub(super) fn serialize<S: Serializer>(
    choices: &[Choice],
    serializer: S,
) -> Result<S::Ok, S::Error> {
    serializer.collect_seq(choices.iter().map(RawCriterion::written))
}
