//! Load programs: supports and loads on a body at each pseudo-time.

mod amplitude;
mod in_time;
mod programme;
mod proportional;
mod separate;
mod staged;

use std::fmt::Debug;
use std::sync::Arc;

use crate::internal::InternalForces;
use crate::restraints::Restraints;
use crate::unknowns::{Component, Layout};
use ligament_model::surface::Vector;
use ligament_model::thermal::ThermalStrain;

pub use amplitude::{Amplitude, Shape};
pub use in_time::{LoadInTime, LoadsInTime, Timed};
pub use programme::{LoadCourse, MotionControl, Part, PartControl, Programme};
pub use proportional::{BoundaryError, ProportionalLoading};
pub use staged::StagedLoading;

/// Load program: supports, prescribed motions, forces and temperatures as functions of a pseudo-time t.
///
/// Drivers choose t, the load factor of a state. Which degrees of freedom have a prescribed motion does not depend on t, so that
/// the unknowns are the same in all states. Degrees of freedom are numbered as in the displacements of a [`State`](crate::State).
pub trait LoadProgram: Debug + Send + Sync {
    /// Whether the pseudo-time is the time of a motion, s.
    fn is_in_time(&self) -> bool {
        false
    }

    /// Springs and forces on the rigid bodies with a mass in a step of a motion, in the order of the bodies.
    fn on_rigid_bodies(&self) -> &[RigidLoad] {
        &[]
    }

    /// Whether the motion of a degree of freedom is prescribed.
    fn is_prescribed(&self, degree_of_freedom: usize) -> bool;

    /// Restraints that resist motions that are not prescribed, in addition to the bonds.
    fn restraints(&self) -> &Arc<Restraints>;

    /// Whether a reaction acts at a degree of freedom: of a prescribed motion or a restraint.
    fn reacts_at(&self, degree_of_freedom: usize) -> bool {
        self.is_prescribed(degree_of_freedom) || self.restraints().acts_on(degree_of_freedom)
    }

    /// Sets the prescribed values of displacements (n_degrees_of_freedom, m and rad) at a time.
    fn prescribe(&self, time: f64, displacement: &mut [f64]);

    /// Given forces at some degrees of freedom, in their order, N and N m, including the forces of restraints with moved far ends
    /// on a fixed body.
    fn forces(&self, time: f64, degrees_of_freedom: &[u32]) -> Vec<f64>;

    /// Given forces and restraint forces at displacements (n_degrees_of_freedom), minus internal forces, at some degrees of
    /// freedom, in their order, N and N m.
    fn external_less(
        &self,
        time: f64,
        displacement: &[f64],
        internal: &InternalForces,
        degrees_of_freedom: &[u32],
    ) -> Vec<f64> {
        let mut force = self.forces(time, degrees_of_freedom);
        for (value, &dof) in force.iter_mut().zip(degrees_of_freedom) {
            *value -= internal.values[dof as usize];
        }
        if self.restraints().is_empty() {
            return force;
        }
        let mut restraining = vec![0.0; displacement.len()];
        self.restraints().add_forces(displacement, &mut restraining);
        for (value, &dof) in force.iter_mut().zip(degrees_of_freedom) {
            *value -= restraining[dof as usize];
        }
        force
    }

    /// Stress-free strains due to the temperature.
    fn thermal_strain(&self, time: f64) -> ThermalStrain<'_>;

    /// Changes of the temperature, shape (n_points), K; empty where no temperature changes at any time.
    fn temperature_change(&self, time: f64) -> Vec<f64>;

    /// Temperature factor: the ratio of the changes of the temperature to the changes at factor 1.
    fn temperature_factor(&self, time: f64) -> f64;

    /// Factor of the control load.
    fn control_factor(&self, time: f64) -> f64;

    /// Load factors in the present part of a programme of stages; None where all loads grow with one load factor.
    fn course(&self) -> Option<&LoadCourse> {
        None
    }

    /// Copy of the loads with another course of their factors; None where all grow with one load factor.
    fn in_course(&self, _course: LoadCourse) -> Option<Arc<dyn LoadProgram>> {
        None
    }

    /// Degrees of freedom that are moved or loaded at some time, ascending; no others do work.
    fn loaded_degrees_of_freedom(&self) -> Vec<u32>;

    /// Reactions of supports, prescribed motions and restraints to internal forces (n_degrees_of_freedom), N and N m: internal
    /// minus given force where a reaction [acts](Self::reacts_at), zero elsewhere.
    fn reactions(&self, time: f64, internal_forces: &[f64]) -> Vec<f64>;

    /// Groups whose resultants the history reports.
    fn groups(&self) -> &[BoundaryGroup];

    /// Resultants of the given forces that act through the groups, shape (n_groups, n_components), N and N m.
    fn given_resultants(&self, time: f64) -> Vec<Vec<f64>>;

    /// Load whose displacement and force are the axes of the force-displacement curve.
    fn control(&self) -> &Control;

    /// Displacement of the control load along its direction for given displacements, m, rad or K, or m^3 with a pressure: the
    /// prescribed one, or the mean that is work-conjugate to the given forces.
    fn control_displacement(&self, time: f64, displacement: &[f64]) -> f64;

    /// Force of the control load along its direction, work-conjugate to its displacement, N, N m or J/K.
    fn control_force(&self, time: f64, internal: &InternalForces) -> f64;
}

/// A spring to the ground and a force on a rigid body.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RigidLoad {
    /// Index of the rigid body.
    pub body: usize,
    /// Stiffness of the spring against displacements, N/m.
    pub stiffness: f64,
    /// Force, N.
    pub force: Vector,
}

/// A supported or loaded set of points.
#[derive(Debug, Clone, PartialEq)]
pub struct BoundaryGroup {
    /// Name in the history.
    pub name: String,
    /// Points, ascending.
    pub points: Vec<u32>,
    /// Resultant of the given forces that act through this group at load factor 1, shape (n_components), N and
    /// N m.
    pub force: Vec<f64>,
    /// Components whose motion its supports and loads prescribe at its points.
    pub holds: Vec<Component>,
    /// Components that its springs, rollers and platens resist at its points.
    pub restrains: Vec<Component>,
}

/// Number of the group for which each reaction counts, shape (n_degrees_of_freedom), so that none counts twice where groups have points in
/// common: the first group that prescribes the motion, otherwise the first that resists it, otherwise the first that has the point.
pub(crate) fn groups_of_reactions(groups: &[BoundaryGroup], layout: Layout) -> Vec<Option<usize>> {
    let mut owners = vec![None; layout.n_degrees_of_freedom()];
    let counts = |rule: usize, group: &BoundaryGroup, component: &Component| match rule {
        0 => group.holds.contains(component),
        1 => group.restrains.contains(component),
        _ => true,
    };
    for rule in 0..3 {
        for (number, group) in groups.iter().enumerate() {
            for &point in &group.points {
                for (dof, component) in layout.range(point).zip(layout.components) {
                    if counts(rule, group, component) {
                        owners[dof].get_or_insert(number);
                    }
                }
            }
        }
    }
    owners
}

/// Load whose displacement and force are the axes of the force-displacement curve.
///
/// Displacement and force are work-conjugate: force times the increment of displacement is the work of this load for any
/// distribution. With the load's `shape` w_i (n_points, n_components) and `magnitude` m at load factor lambda
///
/// - prescribed motions are u_i = lambda m w_i: the displacement is lambda m, the force the sum of w_i . R_i over the
///   reactions R_i;
/// - given forces are F_i = lambda m w_i: the force is lambda m, the displacement the sum of w_i . u_i;
/// - a rigid body moves by lambda m along the direction w: the displacement is lambda m, the force w . F for the force F that drives it
///   against the points;
/// - a temperature changes by lambda m at most, which is the displacement, K; the work-conjugate force is
///   -sum over the bonds of force . thermal deformation for m = 1 K, J/K.
///
/// The forces on a free body balance: there the displacement of a given force is [the one of all
/// forces](ProportionalLoading::displaced_by_all), since the sum of w_i . u_i alone depends on the gauges.
///
/// A uniform load thus has the sum of its forces and the mean of its displacements along it, a bending load the moments of both
/// about its zero. A pressure all round has no resultant: its magnitude is the pressure and its shape the areas with their inward
/// normals, so that the force is the pressure and the displacement the volume by which its surface receded.
#[derive(Debug, Clone, PartialEq)]
pub struct Control {
    /// Kind of the prescribed quantity.
    pub kind: ControlKind,
    /// Points of the load.
    pub points: Vec<u32>,
    /// Shares of the points in a load of unit size, shape (n_points of the load, n_components); for a rigid body its direction.
    pub shape: Vec<f64>,
    /// Size at load factor 1 of the displacement (m, rad), of the force or couple in total (N, N m) or of the pressure (Pa), before
    /// a profile.
    pub magnitude: f64,
}

/// Quantity that a load prescribes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum ControlKind {
    /// Motion of the points.
    Displacement,
    /// Force on the points.
    Force,
    /// Temperature.
    Temperature,
    /// Motion of a rigid body, by its index.
    RigidBody(usize),
    /// Nothing: a rigid body with a mass, by its index, moves freely, and the rows have its displacement.
    FreeBody(usize),
}

impl Control {
    /// Displacement at a factor of the load, for displacements of the points (n_degrees_of_freedom).
    pub(crate) fn displacement(&self, layout: Layout, factor: f64, displacement: &[f64]) -> f64 {
        match self.kind {
            ControlKind::Force => self.along(layout, |dof| displacement[dof]),
            ControlKind::Displacement | ControlKind::Temperature | ControlKind::RigidBody(_) => {
                self.magnitude * factor
            }
            ControlKind::FreeBody(_) => 0.0,
        }
    }

    /// Force at a factor of the load, for reactions at degrees of freedom.
    pub(crate) fn force(
        &self,
        layout: Layout,
        factor: f64,
        internal: &InternalForces,
        reaction: impl Fn(usize) -> f64,
    ) -> f64 {
        match self.kind {
            ControlKind::Force => self.magnitude * factor,
            ControlKind::Temperature => internal.thermal / self.magnitude,
            ControlKind::Displacement => self.along(layout, reaction),
            ControlKind::RigidBody(body) | ControlKind::FreeBody(body) => {
                let forces = internal.on_rigid_bodies.get(body).into_iter().flatten();
                let along = forces.zip(&self.shape);
                along.fold(0.0, |sum, (force, cosine)| sum - force * cosine)
            }
        }
    }

    /// Sum over the points of shape . value, for values at degrees of freedom.
    pub(crate) fn along(&self, layout: Layout, value: impl Fn(usize) -> f64) -> f64 {
        let of_point = |(&point, shape): (&u32, &[f64])| {
            let dofs = layout.range(point).zip(shape);
            dofs.map(|(dof, share)| value(dof) * share).sum::<f64>()
        };
        let shapes = self.shape.chunks(layout.components.len());
        self.points.iter().zip(shapes).map(of_point).sum()
    }
}
