//! Units of the force-displacement curve.

use ligament_analysis::Timed;

use crate::setup::{Action, CurveAxis, Setup};

/// Units of the axes of the force-displacement curve.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Units {
    /// Unit of the displacement.
    pub displacement: &'static str,
    /// Unit of the force.
    pub force: &'static str,
    /// Unit of the stiffness, force over displacement.
    pub stiffness: &'static str,
}

impl Units {
    /// Units of a force and its displacement.
    pub const FORCE: Self = Self::new("m", "N", "N/m");
    /// Units of a couple and its rotation.
    pub const COUPLE: Self = Self::new("rad", "N m", "N m/rad");
    /// Units of a pressure and its swept volume.
    pub const PRESSURE: Self = Self::new("m^3", "Pa", "Pa/m^3");
    /// Units of a change of temperature and its conjugate.
    pub const TEMPERATURE: Self = Self::new("K", "J/K", "J/K^2");

    const fn new(displacement: &'static str, force: &'static str, stiffness: &'static str) -> Self {
        Self {
            displacement,
            force,
            stiffness,
        }
    }
}

impl Setup {
    /// Units of displacement and force in the history: the units of the load of the curve, of the temperature, or of a force
    /// where a rigid body or an initial velocity moves the body.
    pub fn units(&self) -> Units {
        match self.curve_axis() {
            CurveAxis::Load(load) => self.loads[load].action.units(),
            CurveAxis::Temperature => Units::TEMPERATURE,
            CurveAxis::RigidBody(_) | CurveAxis::FreeBody(_) | CurveAxis::Nothing => Units::FORCE,
        }
    }
}

impl Setup {
    /// Unit of the size of the load of the curve: of its displacement or force, or of the rate of its displacement.
    pub fn control_unit(&self) -> &'static str {
        let units = self.units();
        let action = self.curve_load().map(|load| &self.loads[load].action);
        let is_turned = units == Units::COUPLE;
        match action.map(|it| (it.motion().is_some(), it.timed())) {
            None if self.is_driven_in_time() => "m/s",
            None => units.displacement,
            Some((false, _)) => units.force,
            Some((true, Timed::Value)) => units.displacement,
            Some((true, Timed::Velocity)) if is_turned => "rad/s",
            Some((true, Timed::Velocity)) => "m/s",
            Some((true, Timed::Acceleration)) if is_turned => "rad/s^2",
            Some((true, Timed::Acceleration)) => "m/s^2",
        }
    }
}

impl Setup {
    /// Whether the curve is of a rigid body with a velocity.
    fn is_driven_in_time(&self) -> bool {
        let axis = self.curve_axis();
        self.analysis.is_motion()
            && matches!(axis, CurveAxis::RigidBody(_) | CurveAxis::FreeBody(_))
    }
}

impl Action {
    /// Units of the displacement and the force of the action in the history: their product is work.
    pub fn units(&self) -> Units {
        match self {
            Self::Displacement(it) | Self::Velocity(it) | Self::BaseAcceleration(it)
                if it.components().all(|(it, _)| it.is_rotation()) =>
            {
                Units::COUPLE
            }
            Self::Displacement(_)
            | Self::Velocity(_)
            | Self::BaseAcceleration(_)
            | Self::Force(_)
            | Self::ForcePerLength(_)
            | Self::ForcePerArea(_)
            | Self::BodyForce(_)
            | Self::Acceleration(_) => Units::FORCE,
            Self::Moment(_) | Self::BodyCouple(_) => Units::COUPLE,
            Self::Pressure(_) => Units::PRESSURE,
        }
    }
}
