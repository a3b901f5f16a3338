//! Checks of a far field against body, correction and what needs bonds everywhere.

use ligament_model::Advice;
use ligament_model::correction::patch;

use super::check::{Checked, contradiction};
use super::setting::Setting;
use super::{Setup, Surface};
use crate::body::Origin;
use crate::error::Field;

impl Setup {
    pub(super) fn check_far_field(&self) -> Checked {
        if self.far_field.is_none() {
            return Ok(());
        }
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
        let others = [
            (self.closing, "faces that close"),
            (self.has_contact(), "contact between surfaces"),
            (!self.temperatures.is_empty(), "changes of temperature"),
        ];
        if let Some((_, what)) = others.into_iter().find(|(is_there, _)| *is_there) {
            let reason =
                format!("{what} are for bodies whose cells all have bonds: remove one of both");
            return contradiction(field, reason);
        }
        Ok(())
    }
}
