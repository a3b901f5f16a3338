//! Checks of a motion in time, and of what only a motion has.

use ligament_analysis::motion::{MOST_DISSIPATION, MotionSettings};

use super::check::{Checked, contradiction, missing, positive, require};
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
    positive(field.part("duration"), Some(settings.duration))?;
    let rows = settings.rows;
    require(rows > 0, field.part("rows"), "at least 1", rows)?;
    positive(field.part("step"), settings.step)?;
    let safety = settings.safety;
    let is_share = safety > 0.0 && safety < 1.0;
    let expected = "greater than 0 and less than 1: the share of the critical step, beyond which an explicit scheme is unstable";
    require(is_share, field.part("safety"), expected, safety)?;
    let dissipation = settings.dissipation;
    let is_fit = (0.0..=MOST_DISSIPATION).contains(&dissipation);
    require(is_fit, field.part("dissipation"), "0 to 1/3", dissipation)?;
    let share = settings.statics;
    let is_share = share > 0.0 && share < 1.0;
    let expected = "greater than 0 and less than 1";
    require(is_share, field.part("statics"), expected, share)?;
    let factor = settings.rotary_inertia;
    positive(field.part("rotary_inertia"), Some(factor))?;
    for (part, value) in [
        ("damping.mass", settings.damping.mass),
        ("damping.stiffness", settings.damping.stiffness),
    ] {
        let damps = value >= 0.0 && value.is_finite();
        let expected = "at least 0: a negative damping would feed energy to the body";
        require(damps, field.part(part), expected, value)?;
    }
    positive(field.part("stop.wall_time"), settings.stop.wall_time)
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
