//! Checks of the control of stages.

use super::check::{Checked, contradiction, require};
use super::{Analysis, Control, Course, Quantity, Setup, Stage};
use crate::error::{Fault, Field};

impl Setup {
    pub(super) fn check_control(&self, field: Field, stage: &Stage, control: &Control) -> Checked {
        let part = field.part("control");
        match &control.quantity {
            Quantity::Probes(probes) => self.check_probes_that_control(part, probes)?,
            Quantity::DissipatedEnergy => self.check_dissipated(part)?,
        }
        let is_energy = control.quantity == Quantity::DissipatedEnergy;
        let is_value = control.to.is_finite() && (!is_energy || control.to > 0.0);
        let expected = match is_energy {
            true => "an energy above 0 at the end",
            false => "a finite value at the end",
        };
        require(is_value, part, expected, control.to)?;
        let goes_straight = |(_, course): &(String, Course)| course.points.len() == 1;
        let ends = |(_, course): &(String, Course)| course.points[0][0] == 1.0;
        if !stage.loads.iter().all(|it| goes_straight(it) && ends(it)) {
            let reason = "with `control` the loads have only a proportion: give each load one factor; its difference to the present factor \
                is its part";
            return contradiction(field.part("loads"), reason);
        }
        Ok(())
    }

    /// Refuses control by probes in other analyses than load steps, by unknown probes or ones that read no motion, and with weights of 0.
    fn check_probes_that_control(&self, part: Field, probes: &[(String, f64)]) -> Checked {
        if !matches!(self.analysis, Analysis::Stepped(_)) {
            let reason = "a probe controls load steps: the exact path passes peaks and snap-backs by itself, and an elastic solution has \
                none";
            return contradiction(part, reason);
        }
        for (name, weight) in probes {
            let Some(probe) = self.probes.iter().find(|it| it.name == *name) else {
                return Err(part.error(Fault::UnknownName {
                    what: "probe",
                    found: name.clone(),
                    candidates: self.probes.iter().map(|it| it.name.clone()).collect(),
                }));
            };
            if !probe.reading.is_motion() {
                let reason = format!(
                    "`{name}` reads no motion of points, and only motions can control the load: a displacement, or one between two points"
                );
                return contradiction(part, reason);
            }
            let expected = format!("a weight of `{name}` other than 0");
            require(weight.is_finite() && *weight != 0.0, part, expected, weight)?;
        }
        require(!probes.is_empty(), part, "one probe or more", probes)
    }

    /// Refuses control by dissipated energy in load steps without softening bonds, which dissipate it in jumps.
    fn check_dissipated(&self, part: Field) -> Checked {
        match &self.analysis {
            Analysis::Event(_) => Ok(()),
            Analysis::Stepped(_) if self.criteria.iter().any(|it| it.after.law.softens) => Ok(()),
            Analysis::Stepped(_) => {
                let reason = "brittle bonds take their energy all at once, so that load steps cannot follow it: let bonds soften \
                    (`after`), or take the exact path, which goes from breakage to breakage";
                contradiction(part, reason)
            }
            Analysis::Elastic { .. } | Analysis::Modal(_) | Analysis::Motion(_) => {
                let reason = "nothing is dissipated where bonds neither soften nor break";
                contradiction(part, reason)
            }
        }
    }
}
