//! Supports and loads on the points, all proportional to the load factor.

pub use ligament_model::thermal::{ThermalStrain, ThermalStrains};
use thiserror::Error;

use crate::internal::InternalForces;
use crate::unknowns::{COMPONENTS, Component};

/// Prescribed motions and forces at load factor one, and what the history reports of them.
#[derive(Debug, Clone, PartialEq)]
pub struct Boundary {
    /// Prescribed value of each degree of freedom at load factor 1, shape (3 n_points), m or rad.
    pub prescribed: Vec<Option<f64>>,
    /// External force or moment on each degree of freedom at load factor 1, shape (3 n_points), N or N m.
    pub force: Vec<f64>,
    /// Change of the temperature of each point at load factor 1, shape (n_points), K; empty where there is none.
    pub temperature_change: Vec<f64>,
    /// Strains that the temperature would give the points without stress, at load factor 1.
    pub thermal_strain: ThermalStrains,
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
///
/// They are work-conjugate: force times the increment of displacement is the work of this load, whatever its distribution.
/// With the load's `shape` w_i (n_points, components x, y and rotation) and `magnitude` m at load factor lambda
///
/// - prescribed motions are u_i = lambda m w_i: the displacement is lambda m, the force the sum of w_i . R_i over the
///   reactions R_i;
/// - given forces are F_i = lambda m w_i: the force is lambda m, the displacement the sum of w_i . u_i;
/// - a temperature changes by lambda m at most: the displacement is that, K, the force what does the work with it,
///   -sum over the bonds of force . thermal deformation for m = 1 K, J/K.
///
/// So a load that is the same everywhere has the sum of its forces and the mean of its displacements along it, a bending
/// load the moments of both about its zero. A pressure has no resultant where it acts all round: its magnitude is the
/// pressure and its shape the areas with their normals into the body, so that the force is the pressure and the displacement
/// the volume by which its surface gave way.
#[derive(Debug, Clone, PartialEq)]
pub struct Control {
    /// Whether the motion or the force is given.
    pub kind: ControlKind,
    /// Points of the load.
    pub points: Vec<u32>,
    /// What each of them takes of a load of size one, in (x, y, rotation).
    pub shape: Vec<[f64; COMPONENTS]>,
    /// Size at load factor 1 of the displacement (m, rad), of the force or couple in total (N, N m) or of the pressure (Pa),
    /// before a profile.
    pub magnitude: f64,
}

/// What a load prescribes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ControlKind {
    /// The motion of its points.
    Displacement,
    /// The force on its points.
    Force,
    /// The temperature.
    Temperature,
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
            temperature_change: Vec::new(),
            thermal_strain: ThermalStrains::default(),
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

    /// Adds a force or couple on a component of one point, N or N m at load factor 1.
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

    /// Force that the control load exerts along its direction, N, N m or J/K: what does its work.
    pub fn control_force(&self, load_factor: f64, internal: &InternalForces) -> f64 {
        let control = &self.control;
        match control.kind {
            ControlKind::Force => control.magnitude * load_factor,
            ControlKind::Temperature => internal.thermal / control.magnitude,
            ControlKind::Displacement => control.along(|dof| {
                self.prescribed[dof].map_or(0.0, |_| {
                    internal.values[dof] - load_factor * self.force[dof]
                })
            }),
        }
    }

    /// What the temperature does to the bonds at a load factor.
    pub fn thermal_strain_at(&self, load_factor: f64) -> ThermalStrain<'_> {
        self.thermal_strain.at(load_factor)
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
    /// Displacement along the load at some load factor, m, rad or K, or m^3 with a pressure: the prescribed one, or the mean that
    /// does the work of the given forces.
    pub fn displacement(&self, load_factor: f64, displacement: &[f64]) -> f64 {
        match self.kind {
            ControlKind::Displacement | ControlKind::Temperature => self.magnitude * load_factor,
            ControlKind::Force => self.along(|dof| displacement[dof]),
        }
    }

    /// Sum over the points of shape . value.
    fn along(&self, value: impl Fn(usize) -> f64) -> f64 {
        let of_point = |(&point, shape): (&u32, &[f64; COMPONENTS])| {
            let first = COMPONENTS * point as usize;
            let components = shape.iter().enumerate();
            components
                .map(|(component, share)| value(first + component) * share)
                .sum::<f64>()
        };
        self.points.iter().zip(&self.shape).map(of_point).sum()
    }
}
