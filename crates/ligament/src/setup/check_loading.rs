//! Checks of what loads a body: motions in time, stages, contacts and rigid bodies.

use ligament_analysis::load_program::Amplitude;
use ligament_analysis::motion::MotionSettings;

use super::check::{
    Checked, contradiction, in_range, missing, positive, require, require_unique, within,
};
use super::check_dimension::NO_Z;
use super::stage::TEMPERATURE;
use super::{
    Action, Analysis, ContactLaw, Control, Course, Load, Place, Quantity, Rigid, RigidForm, Setup,
    Stage, SurfaceContact,
};
use crate::error::{Fault, Field};

impl Setup {
    pub(super) fn check_motion(&self) -> Checked {
        let Analysis::Motion(settings) = &self.analysis else {
            return Ok(());
        };
        check_settings(settings)?;
        for (index, region) in self.materials.iter().enumerate() {
            if region.material.density.is_none() {
                let field = Field::element("materials", index);
                return missing(
                    field,
                    "density",
                    "(in kg/m^3) because a motion needs masses",
                );
            }
        }
        let is_idle = self.loads.is_empty() && self.initial_velocities.is_empty();
        if is_idle && self.rigid_bodies.is_empty() {
            let reason =
                "there is no load, no initial velocity and no rigid body, so nothing would move";
            return contradiction(Field::whole("loads"), reason);
        }
        for (index, load) in self.loads.iter().enumerate() {
            check_load(Field::element("loads", index), load)?;
        }
        for (index, initial) in self.initial_velocities.iter().enumerate() {
            let field = Field::element("initial_velocities", index).part("velocity");
            let is_number = initial.velocity.iter().all(|it| it.is_finite());
            require(is_number, field, "finite numbers", initial.velocity)?;
            let is_off =
                matches!(&initial.place, Place::At(position) if self.leaves_plane(position));
            if is_off || self.leaves_plane(&initial.velocity) {
                return contradiction(field, NO_Z);
            }
        }
        Ok(())
    }
}

fn check_settings(settings: &MotionSettings) -> Checked {
    let field = Field::whole("motion");
    in_range(settings, |key| field.part(key))?;
    in_range(&settings.damping, |key| field.part("damping").key(key))?;
    in_range(&settings.stop, |key| field.part("stop").key(key))
}

/// Refuses displacements that jump at time zero or later.
fn check_load(field: Field, load: &Load) -> Checked {
    if !matches!(load.action, Action::Displacement(_)) {
        return Ok(());
    }
    match &load.amplitude {
        None => {
            let reason = "the points would jump at time zero: give the load an `amplitude` that begins at 0, or a `velocity` in the place \
                          of the displacement";
            contradiction(field.part("action"), reason)
        }
        Some(amplitude) if amplitude.jumps() => {
            let reason = "the points would jump: a displacement takes an amplitude that begins at 0 and has no steps, such as \
                          \"smooth-ramp\", or give a `velocity` in its place";
            contradiction(field.part("amplitude"), reason)
        }
        Some(_) => Ok(()),
    }
}

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
            within(Stage::STEPS, field, steps)?;
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

impl Setup {
    /// Whether surfaces may come into contact.
    pub fn has_contact(&self) -> bool {
        !self.contacts.is_empty() || !self.rigid_bodies.is_empty()
    }

    pub(super) fn check_contacts(&self) -> Checked {
        for (index, contact) in self.contacts.iter().enumerate() {
            let field = Field::element("contacts", index);
            in_range(contact, |key| field.part(key))?;
            if let Some([one, other]) = &contact.between
                && one == other
            {
                let reason = "contact is between two different groups: give two, or all parts";
                return contradiction(field.part("between"), reason);
            }
            if self.contacts[..index]
                .iter()
                .any(|it| it.between == contact.between)
            {
                let reason = "an earlier contact is between the same: give one of them";
                return contradiction(field.part("between"), reason);
            }
        }
        require_unique(
            "rigid_bodies",
            self.rigid_bodies.iter().map(|it| it.name.as_str()),
        )?;
        for (index, body) in self.rigid_bodies.iter().enumerate() {
            let field = Field::element("rigid_bodies", index);
            let ContactLaw {
                friction,
                stiffness,
            } = body.law;
            within(ContactLaw::FRICTION, field.part("friction"), friction)?;
            within(ContactLaw::STIFFNESS, field.part("stiffness"), stiffness)?;
            within(Rigid::MASS, field.part("mass"), body.mass)?;
            within(Rigid::INERTIA, field.part("inertia"), body.inertia)?;
            self.check_free(field, body)?;
            self.check_rigid_name(field, &body.name)?;
            self.check_form(field, &body.form)?;
            for (part, given) in [
                ("velocity", body.velocity),
                ("displacement", body.displacement),
            ] {
                let is_number = given.iter().all(|it| it.is_finite());
                require(is_number, field.part(part), "of finite components", given)?;
            }
            if body.mass.is_some() && body.amplitude != Amplitude::constant() {
                let reason = "a body with a mass moves by itself from its first velocity: give an amplitude or a mass";
                return contradiction(field.part("amplitude"), reason);
            }
        }
        Ok(())
    }

    /// Refuses a name whose columns in the history are those of a group or of another contact.
    fn check_rigid_name(&self, field: Field, name: &str) -> Checked {
        let is_group = self.body.group_names().iter().any(|it| it == name);
        let mut others = self.contacts.iter().map(SurfaceContact::name);
        if is_group || others.any(|it| it == name) {
            let reason = format!(
                "`{name}` is a group or a contact, whose columns in the history are called so"
            );
            return contradiction(field.part("name"), reason);
        }
        Ok(())
    }

    /// Refuses what only a body with a mass can have, and rotations of shapes that do not turn.
    fn check_free(&self, field: Field, body: &Rigid) -> Checked {
        let is_number = body.acceleration.iter().all(|it| it.is_finite());
        let part = field.part("acceleration");
        require(is_number, part, "of finite components", body.acceleration)?;
        if body.mass.is_none() && body.acceleration != [0.0; 3] {
            return contradiction(part, "its motion is prescribed: give it a mass");
        }
        let turns = match body.form {
            RigidForm::Ball { .. } => true,
            RigidForm::Box { .. } => self.body.dimensions() == 2,
            RigidForm::Wall { .. } => false,
        };
        let reason = match (body.inertia, body.mass) {
            (None, _) => return Ok(()),
            (Some(_), None) => "its motion is prescribed: give it a mass",
            (Some(_), Some(_)) if turns => return Ok(()),
            (Some(_), Some(_)) => "walls do not turn, nor boxes in space: remove it",
        };
        contradiction(field.part("inertia"), reason)
    }

    fn check_form(&self, field: Field, form: &RigidForm) -> Checked {
        let dimensions = self.body.dimensions();
        match form {
            RigidForm::Ball { radius, .. } => {
                within(RigidForm::RADIUS, field.part("radius"), *radius)
            }
            RigidForm::Wall { normal, .. } => {
                let is_direction = *normal != [0.0; 3] && normal.iter().all(|it| it.is_finite());
                let expected = format!("a direction other than {:?}", vec![0; dimensions]);
                require(is_direction, field.part("normal"), expected, normal)
            }
            RigidForm::Box { size, .. } => {
                let mut sides = size[..dimensions].iter();
                sides.try_for_each(|&side| positive(field.part("size"), Some(side)))
            }
        }
    }
}
