//! Checks of the control of stages.

use super::check::{Checked, contradiction, require};
use super::{Control, Course, Quantity, Setup, Stage};
use crate::error::{Fault, Field};

impl Setup {
    pub(super) fn check_control(&self, field: Field, stage: &Stage, control: &Control) -> Checked {
        let part = field.part("control");
        if let Quantity::Probes(probes) = &control.quantity {
            self.check_probes_that_control(part, probes)?;
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
}
