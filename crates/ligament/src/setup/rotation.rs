//! Checks of the rotational stiffness against law and materials.

use ligament_model::Advice;
use ligament_model::law::orthotropic;
use ligament_model::law::rotational::{RotationalScale, RotationalStiffness};
use ligament_model::law::{BondLaw, listed, suited};

use super::Setup;
use super::check::{Checked, contradiction, positive, require};
use super::setting::Setting;
use crate::error::Field;

impl Setup {
    pub(super) fn check_rotational_scale(&self) -> Checked {
        let (field, scale) = (Field::whole("rotational_scale"), self.rotational_scale);
        let law = self.law.name();
        match (self.law.rotational_profile(), scale) {
            (_, RotationalScale::Factor(1.0)) => return Ok(()),
            (None, _) => {
                let reason = format!(
                    "the points of \"{law}\" have no rotations, so that nothing resists them: take {}",
                    listed(&suited(|it| it.shear_form.is_some()), BondLaw::quoted)
                );
                return contradiction(field, reason);
            }
            (Some(profile), _) if profile.rotational == RotationalStiffness::Zero => {
                let text = "there is no rotational stiffness to scale: take {}";
                let decaying = Setting::RotationalStiffness(RotationalStiffness::Decaying);
                return contradiction(field, Advice::new(text, [decaying]));
            }
            _ => {}
        }
        match scale {
            RotationalScale::Factor(factor) => {
                let expected = "at least 0";
                let holds = factor >= 0.0 && factor.is_finite();
                require(holds, field.part("factor"), expected, factor)
            }
            RotationalScale::CosseratLength(length) => {
                positive(field.part("length"), Some(length))?;
                self.check_coupling(field.part("length"))
            }
        }
    }

    /// Refuses a negative shear stiffness with a positive rotational stiffness: waves of rotation of some wave length would have no energy.
    fn check_coupling(&self, field: Field) -> Checked {
        let elasticities = self.materials.iter().map(|it| &it.material.elasticity);
        let least = elasticities.map(|it| orthotropic::smallest_shear(it, self.plane()));
        let least = least.fold(f64::INFINITY, f64::min);
        if least < 0.0 {
            let reason = format!(
                "the shear stiffness of some bonds is negative (k_t H^3 t = {least:.4e} Pa), and a length makes their rotational \
                 stiffness positive, so that waves of rotation would cost nothing: take a factor, whose sign is that of the shear \
                 stiffness, or a smaller Poisson's ratio"
            );
            return contradiction(field, reason);
        }
        Ok(())
    }
}
