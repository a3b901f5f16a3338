//! Checks of closing faces against law and correction.

use ligament_model::law::{BondLaw, listed, suited};
use ligament_model::{Advice, ElementKind};

use super::check::{Checked, contradiction, require};
use super::setting::Setting;
use super::{CorrectionDomain, Setup};
use crate::error::Field;

impl Setup {
    pub(super) fn check_closing(&self) -> Checked {
        let friction = Field::whole("closing_friction");
        let is_fit = self.closing_friction >= 0.0 && self.closing_friction.is_finite();
        require(is_fit, friction, "at least 0", self.closing_friction)?;
        if self.closing_friction > 0.0 && !self.closing {
            let reason =
                "faces that do not close carry no pressure, and so no friction: let them close";
            return contradiction(friction, reason);
        }
        if !self.closing {
            return Ok(());
        }
        let field = Field::whole("closing");
        let law = self.law.name();
        if self.law.element() != ElementKind::Beam {
            let reason = format!(
                "faces can slide on each other without turning moments only where points turn, and those of \"{law}\" do not: take {}",
                listed(&suited(|it| it.shear_form.is_some()), BondLaw::quoted)
            );
            return contradiction(field, reason);
        }
        let cut_first = self.correction.domain == CorrectionDomain::Cracked;
        if cut_first && !self.precracks.is_empty() {
            let text = "the bonds that pre-cracks cut have the stiffness of the whole body when their faces close: take {}";
            let whole = Setting::Domain(CorrectionDomain::Whole);
            return contradiction(field, Advice::new(text, [whole]));
        }
        Ok(())
    }
}
