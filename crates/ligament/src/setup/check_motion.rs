//! Checks of a motion in time, and of what only a motion has.

use ligament_analysis::motion::MotionSettings;

use super::check::{Checked, contradiction, in_range, missing, require};
use super::check_dimension::NO_Z;
use super::{Action, Analysis, Load, Place, Setup};
use crate::error::Field;

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
