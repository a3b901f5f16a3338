//! `[[fracture.criterion]]`: failure criteria of bonds, and their laws after the limit.

use ligament_model::failure::softening::Law;
use ligament_model::failure::{After, Calibration, Choice, Kind, frictional};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::fault::KeyFault;
use super::key_path::KeyPath;
use super::word::Word;

/// A criterion of failure.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Criterion {
    /// What fails, and where its limit comes from.
    pub kind: Word<Kind>,
    /// Stretch, shortening or sliding at which a bond fails, in the place of the strength or the energy of the material.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub limit: Option<f64>,
    /// Stretch at which a bond without shear fails; of `mixed-mode`, with `critical_angle`.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub critical_stretch: Option<f64>,
    /// Shear at which a bond that does not open fails, rad; of `mixed-mode`, with `critical_stretch`.
    #[schemars(extend("exclusiveMinimum" = 0, "x-unit" = "rad"))]
    pub critical_angle: Option<f64>,
    /// How the limit of `frictional` comes from the strengths.
    #[schemars(extend("default" = Calibration::default()))]
    pub calibration: Option<Calibration>,
    /// Angle of friction, rad. Of `mohr-coulomb` that of the material, phi. Of `frictional` that of a bond, beta, in the place of the
    /// compressive strength: compression by s makes its limit of sliding larger by s tan(beta).
    #[schemars(range(min = 0), extend("x-unit" = "rad"))]
    pub friction_angle: Option<f64>,
    /// Cohesion of `mohr-coulomb`, Pa, in the place of the compressive strength; with `friction_angle`.
    #[schemars(extend("exclusiveMinimum" = 0, "x-unit" = "Pa"))]
    pub cohesion: Option<f64>,
    /// Distance of the outermost fibre from the axis of a bond, m; of `fibre`.
    #[schemars(range(min = 0), extend("x-unit" = "m"))]
    pub fibre_distance: Option<f64>,
    /// What a bond does after its limit.
    #[serde(default)]
    pub after: Word<Law>,
    /// Deformation at which the force of `linear` (above 1) or `two-branch` (above 3) is gone, over that at the limit; without it so that the `fracture_energy` comes out.
    #[schemars(extend("exclusiveMinimum" = 1))]
    pub end: Option<f64>,
    /// Scale of the fall of `exponential` over the deformation at the limit; without it so that the `fracture_energy` comes out.
    #[schemars(extend("exclusiveMinimum" = 0))]
    pub scale: Option<f64>,
}

impl From<Kind> for Criterion {
    fn from(kind: Kind) -> Self {
        Self {
            kind: Word(kind),
            limit: None,
            critical_stretch: None,
            critical_angle: None,
            calibration: None,
            friction_angle: None,
            cohesion: None,
            fibre_distance: None,
            after: Word::default(),
            end: None,
            scale: None,
        }
    }
}

impl Criterion {
    /// Fills in missing keys.
    pub(super) fn complete(&mut self) {
        if self.kind.0 == frictional::FRICTIONAL && self.limit.is_none() {
            self.calibration.get_or_insert_default();
        }
    }

    pub(super) fn setup(&self, key: &KeyPath) -> Result<Choice, KeyFault> {
        let keys = [("end", self.end), ("scale", self.scale)];
        let after = After::from_keys(self.after.0, &keys).map_err(|unfit| {
            let key = unfit.field().map_or(key.clone(), |it| key.child(it));
            KeyFault::new(key, unfit)
        })?;
        Ok(Choice {
            kind: self.kind.0,
            limit: self.limit,
            critical_stretch: self.critical_stretch,
            critical_angle: self.critical_angle,
            calibration: self.calibration,
            friction_angle: self.friction_angle,
            cohesion: self.cohesion,
            fibre_distance: self.fibre_distance,
            after,
        })
    }
}
