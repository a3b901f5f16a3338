//! Checks of a far field against body, correction and what needs bonds everywhere.

use ligament_model::Advice;
use ligament_model::correction::patch;

use super::check::{Checked, contradiction};
use super::setting::Setting;
use super::{MaterialRegion, Setup, Surface};
use crate::body::Origin;
use crate::error::Field;

impl Setup {
    pub(super) fn check_far_field(&self) -> Checked {
        let Some(far_field) = &self.far_field else {
            return Ok(());
        };
        let field = Field::whole("far_field");
        if !matches!(self.body.origin(), Origin::Mesh(_) | Origin::SolidMesh(_)) {
            let reason = "the elements of the far field are the cells of a mesh: take a mesh";
            return contradiction(field, reason);
        }
        if !matches!(self.correction.surface, Surface::Patch(_)) {
            let text = "bonds and elements bear the same forces only where the bonds pass uniform strains exactly: take {}";
            let patch = Setting::Surface(Surface::Patch(patch::Settings::default()));
            return contradiction(
                Field::whole("correction").part("surface"),
                Advice::new(text, [patch]),
            );
        }
        match far_field.strength_share {
            Some(share) => self.check_growth(share),
            None if far_field.near.is_empty() => {
                let reason = "nothing says where bonds are: give places, or with `strength_share` a share of the strength from which on elements become bonds";
                contradiction(field.part("near"), reason)
            }
            None => Ok(()),
        }
    }

    /// Checks a near field that grows.
    fn check_growth(&self, share: f64) -> Checked {
        let field = Field::whole("far_field").part("strength_share");
        if !(share > 0.0 && share <= 1.0) {
            let reason = format!("a share of the strength is above 0 and at most 1, found {share}");
            return contradiction(field, reason);
        }
        let without = |it: &MaterialRegion| it.material.tensile_strength.is_none();
        match self.materials.iter().position(without) {
            Some(index) => {
                let field = Field::element("materials", index).part("tensile_strength");
                let reason = "the near field grows where elements reach a share of it: give it, or remove `far_field.strength_share`";
                contradiction(field, reason)
            }
            None => Ok(()),
        }
    }
}
