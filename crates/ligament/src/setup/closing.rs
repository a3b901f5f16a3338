//! Checks of closing faces against law, correction and analysis.

use ligament_model::law::{BondLaw, listed, suited};
use ligament_model::{Advice, ElementKind};

use super::check::{Checked, contradiction};
use super::setting::Setting;
use super::{Analysis, CorrectionDomain, Setup};
use crate::error::Field;

impl Setup {
    pub(super) fn check_closing(&self) -> Checked {
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
        if matches!(self.analysis, Analysis::Modal(_)) {
            let reason = "natural modes assume that crack faces do not close: remove it";
            return contradiction(field, reason);
        }
        if self.analysis.is_motion() {
            let reason = "a motion does not find the faces that close: remove it";
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
