//! Checks of contacts and rigid bodies.

use ligament_analysis::load_program::Amplitude;

use super::check::{Checked, contradiction, in_range, positive, require, require_unique};
use super::{Rigid, RigidForm, Setup, SurfaceContact};
use crate::error::Field;

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
            in_range(&SurfaceContact::from(body.law), |key| field.part(key))?;
            positive(field.part("mass"), body.mass)?;
            positive(field.part("inertia"), body.inertia)?;
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
            RigidForm::Ball { radius, .. } => positive(field.part("radius"), Some(*radius)),
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
