//! Checks of closing faces against law, correction and analysis.

use ligament_model::law::{BondLaw, listed, suited};
use ligament_model::{Advice, ElementKind};

use super::check::{Checked, contradiction, require};
use super::setting::Setting;
use super::{Analysis, CorrectionDomain, Setup};
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
        if self.closing_friction > 0.0 && matches!(self.analysis, Analysis::Event(_)) {
            let reason = "friction on closed faces depends on the way to a state and is not in proportion to the load between two breakages, so \
                that the exact path does not follow it: take load steps";
            return contradiction(friction, reason);
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
        if matches!(self.analysis, Analysis::Modal(_)) {
            let reason = "natural modes assume that crack faces do not close: remove it";
            return contradiction(field, reason);
        }
        if matches!(self.analysis, Analysis::Event(_)) && !self.stages.is_empty() {
            let reason = "with a part of the load that stays, faces open and close between two breakages, and the exact path does not \
                follow that: take load steps, or let all loads grow with one factor";
            return contradiction(field, reason);
        }
        Ok(())
    }
}
