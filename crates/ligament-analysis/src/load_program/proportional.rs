//! Proportional loading with one load factor.

use std::sync::Arc;

use thiserror::Error;

use super::{BoundaryGroup, Control, LoadProgram};
use crate::internal::InternalForces;
use crate::restraints::Restraints;
use crate::unknowns::{Component, Layout};
use ligament_model::thermal::{StressFreeStrains, ThermalStrain};

/// Loads proportional to the load factor, which is the pseudo-time: prescribed motions and forces at load factor one, and the
/// groups and control load of the history.
#[derive(Debug, Clone, PartialEq)]
pub struct ProportionalLoading {
    /// Layout of the components of the points in the arrays below.
    pub layout: Layout,
    /// Prescribed value of each degree of freedom at load factor 1, shape (n_degrees_of_freedom), m or rad.
    pub prescribed: Vec<Option<f64>>,
    /// External force or moment on each degree of freedom at load factor 1, shape (n_degrees_of_freedom), N or N m.
    pub force: Vec<f64>,
    /// Change of the temperature of each point at load factor 1, shape (n_points), K; empty where there is none.
    pub temperature_change: Vec<f64>,
    /// Stress-free strain of each point due to the temperature at load factor 1; empty where no temperature changes.
    pub thermal_strain: StressFreeStrains,
    /// Restraints that resist motions that are not prescribed, in addition to the bonds.
    pub restraints: Arc<Restraints>,
    /// Forces of restraints with moved far ends on a fixed body at load factor 1, shape (n_degrees_of_freedom), N or N m; empty
    /// without such restraints.
    pub driving: Vec<f64>,
    /// Groups whose resultants the history reports.
    pub groups: Vec<BoundaryGroup>,
    /// Load that defines `displacement` and `reaction` of the history.
    pub control: Control,
    /// Degrees of freedom with their shares in the displacement of the control load, where this is [the one of all
    /// forces](ProportionalLoading::displaced_by_all); empty where it is the one of the control load alone.
    pub displaced: Vec<(u32, f64)>,
}

/// Inconsistency of supports and loads.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum BoundaryError {
    /// Two entries prescribe different values of one degree of freedom.
    #[error("component {component} of point {point} is prescribed as {first} and as {second}")]
    Conflict {
        /// Point index.
        point: u32,
        /// Component name.
        component: &'static str,
        /// Value prescribed first, at load factor 1.
        first: f64,
        /// Value prescribed second, at load factor 1.
        second: f64,
    },
}

impl ProportionalLoading {
    /// Loading without supports and loads, except the motion or force of `control`, which is to be added by
    /// [`ProportionalLoading::prescribe`] or [`ProportionalLoading::add_force`].
    pub fn new(layout: Layout, control: Control) -> Self {
        Self {
            layout,
            prescribed: vec![None; layout.n_degrees_of_freedom()],
            force: vec![0.0; layout.n_degrees_of_freedom()],
            temperature_change: Vec::new(),
            thermal_strain: StressFreeStrains::default(),
            restraints: Arc::default(),
            driving: Vec::new(),
            groups: Vec::new(),
            control,
            displaced: Vec::new(),
        }
    }

    /// Loading whose control load has the displacement on which all given forces F_i do the work of the control load's force F: sum F_i . u_i/F.
    ///
    /// Forces in balance do no work on rigid motions, so that it does not depend on the gauges of a free body. While the body is elastic, it
    /// is 2 W/F with the stored energy W.
    pub fn displaced_by_all(self) -> Self {
        let magnitude = self.control.magnitude;
        let forces = (0..).zip(&self.force).filter(|(_, force)| **force != 0.0);
        let displaced = forces
            .map(|(dof, force)| (dof, force / magnitude))
            .collect();
        Self { displaced, ..self }
    }

    /// Whether all given forces define the displacement of the control load.
    pub fn is_displaced_by_all(&self) -> bool {
        !self.displaced.is_empty()
    }

    /// Loading with the force of the control load alone, where that load is a force.
    pub(crate) fn of_control_alone(&self) -> Self {
        let mut alone = Self {
            force: vec![0.0; self.force.len()],
            ..self.clone()
        };
        let n_components = self.layout.components.len();
        let shapes = self.control.shape.chunks(n_components);
        for (&point, shape) in self.control.points.iter().zip(shapes) {
            for (dof, share) in self.layout.range(point).zip(shape) {
                alone.force[dof] += self.control.magnitude * share;
            }
        }
        alone
    }

    /// Loading restricted to the components of another layout; loads on other components are dropped.
    pub fn reduced(self, layout: Layout) -> Self {
        let kept = |values: Vec<f64>| self.layout.reduced(layout, values);
        let group = |it: BoundaryGroup| BoundaryGroup {
            force: kept(it.force),
            ..it
        };
        Self {
            layout,
            prescribed: self.layout.reduced(layout, self.prescribed),
            force: kept(self.force),
            groups: self.groups.into_iter().map(group).collect(),
            control: Control {
                shape: kept(self.control.shape),
                ..self.control
            },
            ..self
        }
    }

    /// Prescribes a component of some points as `value` at load factor 1, at points that have it. Equal values are no conflict.
    pub fn prescribe(
        &mut self,
        points: &[u32],
        component: Component,
        value: f64,
    ) -> Result<(), BoundaryError> {
        for &point in points {
            let Some(dof) = self.layout.degree_of_freedom(point, component) else {
                continue;
            };
            let slot = &mut self.prescribed[dof];
            match *slot {
                Some(first) if first != value => {
                    return Err(BoundaryError::Conflict {
                        point,
                        component: component.name(),
                        first,
                        second: value,
                    });
                }
                _ => *slot = Some(value),
            }
        }
        Ok(())
    }

    /// Adds a force or couple on a component of a point, if the point has it, N or N m at load factor 1.
    pub fn add_force(&mut self, point: u32, component: Component, force: f64) {
        if let Some(dof) = self.layout.degree_of_freedom(point, component) {
            self.force[dof] += force;
        }
    }

    /// Adds a group to the history, with the resultant (n_components) of its own given forces at load factor 1.
    ///
    /// Equal points under one name form one group for any number of supports and loads; other points under the same name get a
    /// numbered name.
    pub fn report_group(
        &mut self,
        name: &str,
        points: Vec<u32>,
        force: Vec<f64>,
    ) -> &mut BoundaryGroup {
        let is_same = |it: &BoundaryGroup| it.name == name && it.points == points;
        if let Some(place) = self.groups.iter().position(is_same) {
            let group = &mut self.groups[place];
            for (sum, force) in group.force.iter_mut().zip(force) {
                *sum += force;
            }
            return group;
        }
        let earlier = self
            .groups
            .iter()
            .filter(|group| group.name == name)
            .count();
        let name = match earlier {
            0 => name.to_owned(),
            _ => format!("{name}-{}", earlier + 1),
        };
        self.groups.push(BoundaryGroup {
            name,
            points,
            force,
            holds: Vec::new(),
            restrains: Vec::new(),
        });
        let last = self.groups.len() - 1;
        &mut self.groups[last]
    }
}

impl ProportionalLoading {
    /// Reaction at a degree of freedom to internal forces (n_degrees_of_freedom), N or N m.
    fn reaction(&self, time: f64, internal_forces: &[f64], dof: usize) -> f64 {
        match self.reacts_at(dof) {
            true => internal_forces[dof] - time * self.force[dof],
            false => 0.0,
        }
    }
}

impl LoadProgram for ProportionalLoading {
    fn is_prescribed(&self, degree_of_freedom: usize) -> bool {
        self.prescribed[degree_of_freedom].is_some()
    }

    fn restraints(&self) -> &Arc<Restraints> {
        &self.restraints
    }

    fn prescribe(&self, time: f64, displacement: &mut [f64]) {
        for (displacement, value) in displacement.iter_mut().zip(&self.prescribed) {
            if let Some(value) = value {
                *displacement = value * time;
            }
        }
    }

    fn forces(&self, time: f64, degrees_of_freedom: &[u32]) -> Vec<f64> {
        let driving = |dof: usize| self.driving.get(dof).copied();
        let force = |&dof: &u32| match (self.force[dof as usize], driving(dof as usize)) {
            (force, None) => force * time,
            (force, Some(driving)) => (force + driving) * time,
        };
        degrees_of_freedom.iter().map(force).collect()
    }

    fn thermal_strain(&self, time: f64) -> ThermalStrain<'_> {
        self.thermal_strain.times(time)
    }

    fn temperature_change(&self, time: f64) -> Vec<f64> {
        let changes = self.temperature_change.iter();
        changes.map(|change| time * change).collect()
    }

    fn temperature_factor(&self, time: f64) -> f64 {
        time
    }

    fn control_factor(&self, time: f64) -> f64 {
        time
    }

    fn loaded_degrees_of_freedom(&self) -> Vec<u32> {
        let is_moved = |dof: usize| self.prescribed[dof].is_some_and(|value| value != 0.0);
        let is_loaded = |&dof: &u32| {
            let place = dof as usize;
            self.force[place] != 0.0 || is_moved(place) || self.restraints.acts_on(place)
        };
        (0..self.force.len() as u32).filter(is_loaded).collect()
    }

    fn reactions(&self, time: f64, internal_forces: &[f64]) -> Vec<f64> {
        (0..internal_forces.len())
            .map(|dof| self.reaction(time, internal_forces, dof))
            .collect()
    }

    fn groups(&self) -> &[BoundaryGroup] {
        &self.groups
    }

    fn given_resultants(&self, time: f64) -> Vec<Vec<f64>> {
        let at_time =
            |group: &BoundaryGroup| group.force.iter().map(|force| time * force).collect();
        self.groups.iter().map(at_time).collect()
    }

    fn control(&self) -> &Control {
        &self.control
    }

    fn control_displacement(&self, time: f64, displacement: &[f64]) -> f64 {
        if self.displaced.is_empty() {
            return self.control.displacement(self.layout, time, displacement);
        }
        let displaced = self.displaced.iter();
        displaced
            .map(|&(dof, share)| share * displacement[dof as usize])
            .sum()
    }

    fn control_force(&self, time: f64, internal: &InternalForces) -> f64 {
        let reaction = |dof: usize| self.reaction(time, &internal.values, dof);
        self.control.force(self.layout, time, internal, reaction)
    }
}
