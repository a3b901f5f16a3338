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
    /// A rigid body with a mass that moves freely, by its index.
    FreeBody(usize),
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
        let mut moving = self.moving_bodies();
        let body = moving.find(|it| is_named(&self.rigid_bodies[*it].name));
        let of_body = |it: usize| match self.rigid_bodies[it].mass {
            None => CurveAxis::RigidBody(it),
            Some(_) => CurveAxis::FreeBody(it),
        };
        (load.map(CurveAxis::Load))
            .or(heating)
            .or(body.map(of_body))
            .unwrap_or(CurveAxis::Nothing)
    }

    /// Index of the load of the force-displacement curve, if one has it.
    pub(crate) fn curve_load(&self) -> Option<usize> {
        match self.curve_axis() {
            CurveAxis::Load(load) => Some(load),
            _ => None,
        }
    }

    /// Indices of the rigid bodies that move, those with a mass behind those whose motion is prescribed.
    fn moving_bodies(&self) -> impl Iterator<Item = usize> {
        let moves = |it: &Rigid| it.direction().iter().any(|it| *it != 0.0);
        let numbered = || self.rigid_bodies.iter().enumerate();
        let moving = numbered().filter(move |(_, it)| self.stages.is_empty() && moves(it));
        let (driven, free): (Vec<_>, Vec<_>) = moving.partition(|(_, it)| it.mass.is_none());
        driven.into_iter().chain(free).map(|(index, _)| index)
    }

    /// Names that `curve` can have.
    pub(crate) fn curve_names(&self) -> Vec<String> {
        let bodies = self.moving_bodies();
        let bodies = bodies.map(|it| self.rigid_bodies[it].name.clone());
        self.factor_names().into_iter().chain(bodies).collect()
    }
}
