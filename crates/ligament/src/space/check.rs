//! What a setup says of a body in space alone.

use ligament_analysis::Component;
use ligament_analysis::probe::PointField;
use ligament_model::Elasticity;
use ligament_model::law::rotational::RotationalScale;

use crate::error::{Field, SetupError};
use crate::setup::check::contradiction;
use crate::setup::{Action, Checks, Dim, Law, Reading, Setup};

type Checked = Result<(), SetupError>;

impl Checks<3> for Dim {
    fn check(setup: &Setup<3>) -> Checked {
        setup.check_in_space()
    }
}

impl Setup<3> {
    fn check_in_space(&self) -> Checked {
        self.check_law()?;
        self.check_motions()?;
        for (index, region) in self.materials.iter().enumerate() {
            if !matches!(region.material.elasticity, Elasticity::Isotropic(_)) {
                let reason = "solids are of isotropic materials: `young` and `poisson`";
                let field = Field::element("materials", index).part("elasticity");
                return contradiction(field, reason);
            }
        }
        if self.closing {
            let reason =
                "faces that close are known in the plane alone so far: leave `closing` out";
            return contradiction(Field::whole("closing"), reason);
        }
        Ok(())
    }

    fn check_law(&self) -> Checked {
        let law = Field::whole("law");
        match self.law {
            Law::Nhpd
            | Law::Bbpd { .. }
            | Law::Pds { .. }
            | Law::Mppd { .. }
            | Law::MppdBeam { .. } => {}
            Law::BbpdConical { .. } | Law::Orthotropic { .. } | Law::MbbPd { .. } => {
                let reason = format!(
                    "\"{}\" is a law of the plane: solids take \"nhpd\", \"mppd\", \"mppd-beam\", \"pds\" or \"bbpd\"",
                    self.law.name()
                );
                return contradiction(law, reason);
            }
        }
        match self.rotational_scale {
            RotationalScale::Factor(_) => Ok(()),
            RotationalScale::CosseratLength(_) => {
                let reason = "a Cosserat length is one of the plane: take a factor";
                contradiction(Field::whole("rotational_scale").part("length"), reason)
            }
        }
    }

    /// Points of a solid turn about three axes.
    fn check_motions(&self) -> Checked {
        let reason =
            "a solid turns about three axes: give `rotation_x`, `rotation_y` or `rotation_z`";
        for (index, support) in self.supports.iter().enumerate() {
            let springs = support.stiffness.components.rotation.is_some();
            if springs || support.held.contains(&Component::Rotation) {
                return contradiction(Field::element("supports", index), reason);
            }
        }
        for (index, load) in self.loads.iter().enumerate() {
            if let Action::Displacement(it) = load.action
                && it.rotation.is_some()
            {
                return contradiction(Field::element("loads", index).part("action"), reason);
            }
        }
        for (index, probe) in self.probes.iter().enumerate() {
            let (component, part) = match probe.reading {
                Reading::Between { component, .. } => (component, "component"),
                Reading::At {
                    field: PointField::Motion(component),
                    ..
                } => (component, "field"),
                _ => continue,
            };
            if component == Component::Rotation {
                return contradiction(Field::element("probes", index).part(part), reason);
            }
        }
        Ok(())
    }
}
