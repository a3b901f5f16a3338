//! The force-displacement curve.

use super::stage::TEMPERATURE;
use super::{Rigid, Setup};

/// What has the displacement and force of the force-displacement curve.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum CurveAxis {
    /// A load, by its index.
    Load(usize),
    /// The temperature.
    Temperature,
    /// A rigid body whose motion is prescribed, by its index.
    RigidBody(usize),
    /// Nothing is driven.
    Nothing,
}

impl Setup {
    /// What has the displacement and force of the force-displacement curve.
    pub(crate) fn curve_axis(&self) -> CurveAxis {
        let is_named = |name: &str| self.curve.as_ref().is_none_or(|it| it == name);
        let load = self.loads.iter().position(|it| is_named(&it.name));
        let is_heated = !self.analysis.is_motion() && !self.temperatures.is_empty();
        let heating = (is_heated && is_named(TEMPERATURE)).then_some(CurveAxis::Temperature);
        let mut driven = self.driven_bodies();
        let body = driven.find(|it| is_named(&self.rigid_bodies[*it].name));
        (load.map(CurveAxis::Load))
            .or(heating)
            .or(body.map(CurveAxis::RigidBody))
            .unwrap_or(CurveAxis::Nothing)
    }

    /// Index of the load of the force-displacement curve, if one has it.
    pub(crate) fn curve_load(&self) -> Option<usize> {
        match self.curve_axis() {
            CurveAxis::Load(load) => Some(load),
            CurveAxis::Temperature | CurveAxis::RigidBody(_) | CurveAxis::Nothing => None,
        }
    }

    /// Indices of the rigid bodies whose motion is prescribed.
    fn driven_bodies(&self) -> impl Iterator<Item = usize> {
        let moves = |it: &Rigid| it.mass.is_none() && it.motion().iter().any(|it| *it != 0.0);
        let numbered = self.rigid_bodies.iter().enumerate();
        let driven = numbered.filter(move |(_, it)| self.stages.is_empty() && moves(it));
        driven.map(|(index, _)| index)
    }

    /// Names that `curve` can have.
    pub(crate) fn curve_names(&self) -> Vec<String> {
        let bodies = self.driven_bodies();
        let bodies = bodies.map(|it| self.rigid_bodies[it].name.clone());
        self.factor_names().into_iter().chain(bodies).collect()
    }
}
