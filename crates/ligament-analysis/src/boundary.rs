//! Supports and loads on the points, all proportional to the load factor.

use thiserror::Error;

use crate::unknowns::{COMPONENTS, Component};

/// Prescribed motions and forces at load factor one, and what the history reports of them.
#[derive(Debug, Clone, PartialEq)]
pub struct Boundary {
    /// Prescribed value of each degree of freedom at load factor 1, shape (3 n_points), m or rad.
    pub prescribed: Vec<Option<f64>>,
    /// External force or moment on each degree of freedom at load factor 1, shape (3 n_points), N or N m.
    pub force: Vec<f64>,
    /// Groups whose resultant the history reports.
    pub groups: Vec<BoundaryGroup>,
    /// What `displacement` and `reaction` of the history mean.
    pub control: Control,
}

/// A supported or loaded set of points.
#[derive(Debug, Clone, PartialEq)]
pub struct BoundaryGroup {
    /// Name in the history.
    pub name: String,
    /// Points, ascending.
    pub points: Vec<u32>,
    /// Resultant of the given forces that act through this group at load factor 1, N and N m.
    pub force: [f64; COMPONENTS],
}

/// The load whose displacement and force are the axes of the force-displacement curve.
#[derive(Debug, Clone, PartialEq)]
pub struct Control {
    /// Whether the motion or the force is given.
    pub kind: ControlKind,
    /// Points of the load, ascending.
    pub points: Vec<u32>,
    /// Unit direction among (x, y, rotation).
    pub direction: [f64; COMPONENTS],
    /// Size of the displacement (m, rad) or of the total force (N) at load factor 1.
    pub magnitude: f64,
}

/// What a load prescribes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ControlKind {
    /// The motion of its points.
    Displacement,
    /// The force on its points.
    Force,
}

/// Why supports and loads do not go together.
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

impl Boundary {
    /// A body of `n_points` points that nothing holds or loads but the motion or force of `control`, which is still to be
    /// added by [`Boundary::prescribe`] or [`Boundary::add_force`].
    pub fn new(n_points: usize, control: Control) -> Self {
        Self {
            prescribed: vec![None; COMPONENTS * n_points],
            force: vec![0.0; COMPONENTS * n_points],
            groups: Vec::new(),
            control,
        }
    }

    /// Prescribes a component of some points: `value` at load factor 1. The same value twice is no conflict.
    pub fn prescribe(
        &mut self,
        points: &[u32],
        component: Component,
        value: f64,
    ) -> Result<(), BoundaryError> {
        for &point in points {
            let slot = &mut self.prescribed[COMPONENTS * point as usize + component.index()];
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

    /// Adds a force on a component of one point, N at load factor 1.
    pub fn add_force(&mut self, point: u32, component: Component, force: f64) {
        self.force[COMPONENTS * point as usize + component.index()] += force;
    }

    /// Adds a group to the history, with the resultant of its own given forces at load factor 1.
    ///
    /// The same points under the same name are one group however many supports and loads act on them; other points
    /// under the same name get a number.
    pub fn report_group(&mut self, name: &str, points: Vec<u32>, force: [f64; COMPONENTS]) {
        let mut same_name = self.groups.iter_mut().filter(|group| group.name == name);
        if let Some(group) = same_name.find(|group| group.points == points) {
            group.force = [0, 1, 2].map(|component| group.force[component] + force[component]);
            return;
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
        });
    }

    /// Reaction of supports and prescribed motions at every degree of freedom: internal less given force where something
    /// prescribes the motion, zero elsewhere; shape (3 n_points), N and N m.
    pub fn reactions(&self, load_factor: f64, internal_forces: &[f64]) -> Vec<f64> {
        let reaction = |dof: usize| internal_forces[dof] - load_factor * self.force[dof];
        let prescribed = self.prescribed.iter().enumerate();
        prescribed
            .map(|(dof, value)| if value.is_some() { reaction(dof) } else { 0.0 })
            .collect()
    }

    /// Force that the control load exerts along its direction, from the internal forces (3 n_points), N: the same as
    /// [`Control::force`] of all reactions.
    pub fn control_force(&self, load_factor: f64, internal_forces: &[f64]) -> f64 {
        let control = &self.control;
        if control.kind == ControlKind::Force {
            return control.magnitude * load_factor;
        }
        let of_point = |&point: &u32| {
            let along = |(component, cosine): (usize, f64)| {
                let dof = COMPONENTS * point as usize + component;
                self.prescribed[dof].map_or(0.0, |_| {
                    (internal_forces[dof] - load_factor * self.force[dof]) * cosine
                })
            };
            let direction = control.direction.into_iter().enumerate();
            direction.map(along).sum::<f64>()
        };
        control.points.iter().map(of_point).sum()
    }

    /// Degrees of freedom (of 3 n_points) that something moves or loads, ascending: no other one does work.
    pub fn loaded_degrees_of_freedom(&self) -> Vec<usize> {
        (0..self.prescribed.len())
            .filter(|&dof| {
                self.force[dof] != 0.0 || self.prescribed[dof].is_some_and(|value| value != 0.0)
            })
            .collect()
    }
}

impl Control {
    /// Displacement along the direction at some load factor: the prescribed one, or the mean over the points, m.
    pub fn displacement(&self, load_factor: f64, displacement: &[f64]) -> f64 {
        match self.kind {
            ControlKind::Displacement => self.magnitude * load_factor,
            ControlKind::Force => self.along(displacement) / self.points.len() as f64,
        }
    }

    /// Force that the load exerts along the direction: the sum of the reactions (3 n_points) at its points, or the given
    /// one, N.
    pub fn force(&self, load_factor: f64, reactions: &[f64]) -> f64 {
        match self.kind {
            ControlKind::Displacement => self.along(reactions),
            ControlKind::Force => self.magnitude * load_factor,
        }
    }

    fn along(&self, values: &[f64]) -> f64 {
        self.points
            .iter()
            .map(|&point| {
                let values = &values[COMPONENTS * point as usize..][..COMPONENTS];
                values
                    .iter()
                    .zip(self.direction)
                    .map(|(value, cosine)| value * cosine)
                    .sum::<f64>()
            })
            .sum()
    }
}
