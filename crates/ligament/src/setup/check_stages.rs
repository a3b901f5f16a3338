//! Checks of the stages and of what controls them.

use super::check::{Checked, contradiction, require, require_unique};
use super::stage::TEMPERATURE;
use super::{Analysis, Control, Course, Quantity, Setup, Stage};
use crate::error::{Fault, Field};

impl Setup {
    pub(super) fn check_stages(&self) -> Checked {
        let name = self.curve.as_deref();
        if let Some(name) = name.filter(|name| !self.curve_names().iter().any(|it| it == name)) {
            let fault = Self::unknown_load(name, self.curve_names());
            return Err(Field::whole("curve").error(fault));
        }
        let names = self.stages.iter().map(|it| it.name.as_str());
        require_unique("stages", names)?;
        if self.stages.is_empty() {
            return Ok(());
        }
        let is_temperature = |name: &str| name == TEMPERATURE;
        let called_so = self.loads.iter().position(|it| is_temperature(&it.name));
        if let Some(load) = called_so.filter(|_| !self.temperatures.is_empty()) {
            let reason = "stages call the temperature so: give this load another name";
            return contradiction(Field::element("loads", load).part("name"), reason);
        }
        self.check_steps_of_stages()?;
        for (index, stage) in self.stages.iter().enumerate() {
            let field = Field::element("stages", index);
            self.check_stage(field.part("loads"), stage)?;
            if let Some(control) = &stage.control {
                self.check_control(field, stage, control)?;
            }
        }
        Ok(())
    }

    /// Names of the load factors: the loads, and the temperature where it changes.
    pub fn factor_names(&self) -> Vec<String> {
        let loads = self.loads.iter().map(|it| it.name.clone());
        let heated = (!self.temperatures.is_empty()).then(|| TEMPERATURE.to_owned());
        loads.chain(heated).collect()
    }

    fn unknown_load(name: &str, candidates: Vec<String>) -> Fault {
        Fault::UnknownName {
            what: "load",
            found: name.to_owned(),
            candidates,
        }
    }

    fn check_stage(&self, field: Field, stage: &Stage) -> Checked {
        if stage.loads.is_empty() {
            let reason =
                "nothing changes in this stage: name a load with the factor that it goes to";
            return contradiction(field, reason);
        }
        let names = self.factor_names();
        for (name, Course { points }) in &stage.loads {
            if !names.contains(name) {
                return Err(field.error(Self::unknown_load(name, self.factor_names())));
            }
            let expected = format!("one factor or more for `{name}`");
            require(!points.is_empty(), field, expected, points)?;
            let mut before = 0.0;
            for &[share, factor] in points {
                let expected = format!(
                    "shares of the stage that grow from one factor of `{name}` to the next, more than {before:?} and at most 1"
                );
                require(share > before && share <= 1.0, field, expected, share)?;
                let expected = format!("a finite factor of `{name}`");
                require(factor.is_finite(), field, expected, factor)?;
                before = share;
            }
        }
        Ok(())
    }

    /// Requires a number of load steps of each stage.
    fn check_steps_of_stages(&self) -> Checked {
        if !matches!(self.analysis, Analysis::Stepped(_)) {
            return Ok(());
        }
        for (index, stage) in self.stages.iter().enumerate() {
            let field = Field::element("stages", index).part("steps");
            let Some(steps) = stage.steps else {
                let reason = "load steps are taken, and this stage has none: give it a number";
                return contradiction(field, reason);
            };
            require(steps > 0, field, "at least 1", steps)?;
        }
        Ok(())
    }

    fn check_control(&self, field: Field, stage: &Stage, control: &Control) -> Checked {
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
