//! Checks of contacts and rigid bodies.

use ligament_analysis::load_program::Amplitude;
use ligament_analysis::motion::{ImplicitSettings, Scheme};
use ligament_model::ElementKind;

use super::check::{Checked, contradiction, positive, require, require_unique};
use super::{Analysis, Between, ContactLaw, Rigid, RigidForm, Setup};
use crate::error::Field;

impl Setup {
    /// Whether surfaces may come into contact.
    pub fn has_contact(&self) -> bool {
        !self.contacts.is_empty() || !self.rigid_bodies.is_empty()
    }

    pub(super) fn check_contacts(&self) -> Checked {
        for (index, contact) in self.contacts.iter().enumerate() {
            let field = Field::element("contacts", index);
            self.check_contact_law(field, contact.law)?;
            self.check_cracks(field, contact.cracks)?;
            if let Between::Groups([one, other]) = &contact.between
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
            self.check_contact_law(field, body.law)?;
            self.check_cracks(field, body.cracks)?;
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
            self.check_rigid_motion(field, body)?;
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
        let mut others = self.contacts.iter().map(|it| it.between.name());
        if is_group || others.any(|it| it == name) {
            let reason = format!(
                "`{name}` is a group or a contact, whose columns in the history are called so"
            );
            return contradiction(field.part("name"), reason);
        }
        Ok(())
    }

    fn check_contact_law(&self, field: Field, law: ContactLaw) -> Checked {
        let ContactLaw {
            friction,
            stiffness,
        } = law;
        let is_coefficient = friction >= 0.0 && friction.is_finite();
        require(
            is_coefficient,
            field.part("friction"),
            "0 or more",
            friction,
        )?;
        positive(field.part("stiffness"), Some(stiffness))?;
        match &self.analysis {
            Analysis::Motion(settings) if settings.is_explicit() => Ok(()),
            Analysis::Motion(_) | Analysis::Stepped(_) | Analysis::Elastic { .. } => {
                self.check_contact_in_equilibria(field)
            }
            Analysis::Event(_) => self.check_contact_on_exact_path(field, friction),
            Analysis::Modal(_) => {
                let reason = "natural modes assume that no surfaces touch: remove it";
                contradiction(field, reason)
            }
        }
    }

    /// Refuses contact that bends the lines of the exact path.
    fn check_contact_on_exact_path(&self, field: Field, friction: f64) -> Checked {
        if friction > 0.0 {
            let reason = "what slides depends on the way and not on the load alone, and the exact path goes from breakage to breakage in straight \
                lines: remove the friction, or take load steps";
            return contradiction(field.part("friction"), reason);
        }
        if !self.stages.is_empty() {
            let reason = "the exact path through stages does not follow surfaces that meet on the way: let all loads grow together, or take \
                load steps";
            return contradiction(field, reason);
        }
        self.check_contact_in_equilibria(field)
    }

    /// Refuses contact in the equilibria of what they cannot solve with it.
    fn check_contact_in_equilibria(&self, field: Field) -> Checked {
        if matches!(
            self.law.element(),
            ElementKind::TrueStrain | ElementKind::Pairwise
        ) {
            let law = self.law.name();
            let reason = format!(
                "the stiffness of the law \"{law}\" is not symmetric, and equilibria with contact need one that is: take another law, or \
                 explicit steps of a motion"
            );
            return contradiction(field, reason);
        }
        if self.stages.iter().any(|it| it.control.is_some()) {
            let reason = "a stage with `control` finds its load along straight lines, and contact bends them: let loads lead";
            return contradiction(field, reason);
        }
        Ok(())
    }

    /// Refuses contact of faces of cracks that carry pressure already.
    fn check_cracks(&self, field: Field, cracks: bool) -> Checked {
        if cracks && self.closing {
            let reason =
                "the faces of cracks carry pressure already, by `closing`: give one of both";
            return contradiction(field.part("cracks"), reason);
        }
        let is_explicit = matches!(&self.analysis, Analysis::Motion(it) if it.is_explicit());
        if cracks && !is_explicit {
            let reason = "the faces of cracks meet as surfaces in explicit steps alone; elsewhere let them close by `closing`";
            return contradiction(field.part("cracks"), reason);
        }
        Ok(())
    }

    /// Refuses what does not move a rigid body in the analysis.
    fn check_rigid_motion(&self, field: Field, body: &Rigid) -> Checked {
        if let Analysis::Motion(settings) = &self.analysis {
            if body.displacement != [0.0; 3] {
                let reason = "a displacement grows with the load factor, which a motion does not have: give a `velocity` and an `amplitude`";
                return contradiction(field.part("displacement"), reason);
            }
            return match settings.scheme {
                Scheme::Implicit(implicit) if body.mass.is_some() => {
                    self.check_free_in_implicit_steps(field, body, implicit)
                }
                Scheme::Implicit(_) | Scheme::Explicit(_) => Ok(()),
            };
        }
        let of_time = [
            ("velocity", body.velocity != [0.0; 3]),
            ("mass", body.mass.is_some()),
            ("amplitude", body.amplitude != Amplitude::constant()),
        ];
        if let Some((part, _)) = of_time.iter().find(|it| it.1) {
            let reason = "there is no time in this analysis, only in a motion: give a `displacement`, which grows with the load factor";
            return contradiction(field.part(part), reason);
        }
        if body.displacement != [0.0; 3] && !self.stages.is_empty() {
            let reason = "with stages each load has a factor of its own, and a rigid body has none: let it rest and move the body by a load";
            return contradiction(field.part("displacement"), reason);
        }
        Ok(())
    }

    /// Refuses what implicit steps do not do with a body with a mass.
    fn check_free_in_implicit_steps(
        &self,
        field: Field,
        body: &Rigid,
        implicit: ImplicitSettings,
    ) -> Checked {
        if body.inertia.is_some() {
            let reason =
                "a rigid body turns in explicit steps alone: remove it, or take explicit steps";
            return contradiction(field.part("inertia"), reason);
        }
        if self.criteria.iter().any(|it| it.after.law.softens) {
            let reason = "implicit steps move rigid bodies beside bonds that do not soften: take explicit steps, or brittle bonds";
            return contradiction(field.part("mass"), reason);
        }
        if implicit.statics.is_some() {
            let reason = "a body with a mass that nothing holds has no equilibrium from which a motion could begin: take `scheme = \"implicit\"`, \
                or move it by a velocity";
            return contradiction(field.part("mass"), reason);
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
