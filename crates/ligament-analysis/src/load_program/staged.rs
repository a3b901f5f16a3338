//! One part of a programme, with loads A + w B for w from 0 at its start to 1 at its end.

use std::sync::Arc;

use super::programme::Pair;
use super::separate::Separate;
use super::{BoundaryGroup, Control, LoadCourse, LoadProgram, ProportionalLoading};
use crate::internal::InternalForces;
use crate::restraints::Restraints;
use ligament_model::thermal::ThermalStrain;

/// Loads of one part of a programme: A at its start, and their growth B.
///
/// At the load factor lambda, which runs from lambda_a to lambda_b in the part, all loads are A + w B with w = (lambda -
/// lambda_a)/(lambda_b - lambda_a), also beyond the ends of the part.
#[derive(Debug, Clone)]
pub struct StagedLoading {
    loads: Separate,
    course: LoadCourse,
    /// Prescribed value of each degree of freedom, shape (n_degrees_of_freedom), m or rad; zero where none is prescribed.
    prescribed: Vec<Pair>,
    /// External force or moment on each degree of freedom, shape (n_degrees_of_freedom), N or N m.
    force: Vec<Pair>,
    /// Forces of restraints with moved far ends on a fixed body, shape (n_degrees_of_freedom), N or N m; empty without such
    /// restraints.
    driving: Vec<Pair>,
}

impl StagedLoading {
    /// Combines loads (n_loads), each by itself at factor 1 with all supports and all groups of the history, with a course of their
    /// factors.
    pub fn new(loads: Arc<[ProportionalLoading]>, course: LoadCourse) -> Self {
        let n = loads[0].layout.n_degrees_of_freedom();
        let mut prescribed = vec![Pair::default(); n];
        let mut force = vec![Pair::default(); n];
        let mut driving = vec![Pair::default(); loads[0].driving.len()];
        for (load, &factor) in loads.iter().zip(&course.factors) {
            for (sum, value) in prescribed.iter_mut().zip(&load.prescribed) {
                sum.add(factor, value.unwrap_or(0.0));
            }
            for (sum, &value) in force.iter_mut().zip(&load.force) {
                sum.add(factor, value);
            }
            for (sum, &value) in driving.iter_mut().zip(&load.driving) {
                sum.add(factor, value);
            }
        }
        Self {
            loads: Separate(loads),
            course,
            prescribed,
            force,
            driving,
        }
    }

    /// Reaction at a degree of freedom to internal forces (n_degrees_of_freedom), N or N m.
    fn reaction(&self, time: f64, internal_forces: &[f64], dof: usize) -> f64 {
        match self.reacts_at(dof) {
            true => internal_forces[dof] - self.force_at(time, dof),
            false => 0.0,
        }
    }

    fn force_at(&self, load_factor: f64, dof: usize) -> f64 {
        self.force[dof].at(self.course.share(load_factor))
    }

    fn temperature(&self, load_factor: f64) -> Option<(usize, f64)> {
        let load = self.course.programme.temperature?;
        Some((load, self.course.factor(load, load_factor)))
    }
}

impl LoadProgram for StagedLoading {
    fn is_prescribed(&self, degree_of_freedom: usize) -> bool {
        self.loads.is_prescribed(degree_of_freedom)
    }

    fn restraints(&self) -> &Arc<Restraints> {
        self.loads.restraints()
    }

    fn prescribe(&self, time: f64, displacement: &mut [f64]) {
        let share = self.course.share(time);
        for load in &*self.loads.0 {
            for (dof, value) in load.prescribed.iter().enumerate() {
                if value.is_some() {
                    displacement[dof] = self.prescribed[dof].at(share);
                }
            }
        }
    }

    fn forces(&self, time: f64, degrees_of_freedom: &[u32]) -> Vec<f64> {
        let share = self.course.share(time);
        let force = |&dof: &u32| {
            let given = self.force[dof as usize].at(share);
            let driving = self.driving.get(dof as usize);
            driving.map_or(given, |driving| given + driving.at(share))
        };
        degrees_of_freedom.iter().map(force).collect()
    }

    fn thermal_strain(&self, time: f64) -> ThermalStrain<'_> {
        match self.temperature(time) {
            Some((load, factor)) => self.loads.0[load].thermal_strain.times(factor),
            None => ThermalStrain::NONE,
        }
    }

    fn temperature_change(&self, time: f64) -> Vec<f64> {
        let Some((load, factor)) = self.temperature(time) else {
            return Vec::new();
        };
        let changes = self.loads.0[load].temperature_change.iter();
        changes.map(|change| factor * change).collect()
    }

    fn temperature_factor(&self, time: f64) -> f64 {
        self.temperature(time).map_or(0.0, |(_, factor)| factor)
    }

    fn control_factor(&self, time: f64) -> f64 {
        self.course.factor(self.course.programme.control, time)
    }

    fn course(&self) -> Option<&LoadCourse> {
        Some(&self.course)
    }

    fn in_course(&self, course: LoadCourse) -> Option<Arc<dyn LoadProgram>> {
        Some(Arc::new(Self::new(self.loads.0.clone(), course)))
    }

    fn loaded_degrees_of_freedom(&self) -> Vec<u32> {
        self.loads.loaded_degrees_of_freedom()
    }

    fn reactions(&self, time: f64, internal_forces: &[f64]) -> Vec<f64> {
        (0..internal_forces.len())
            .map(|dof| self.reaction(time, internal_forces, dof))
            .collect()
    }

    fn groups(&self) -> &[BoundaryGroup] {
        self.loads.groups()
    }

    fn given_resultants(&self, time: f64) -> Vec<Vec<f64>> {
        self.loads.given_resultants(&self.course.factors(time))
    }

    fn control(&self) -> &Control {
        self.loads.control()
    }

    fn control_displacement(&self, time: f64, displacement: &[f64]) -> f64 {
        let factor = self.control_factor(time);
        (self.control()).displacement(self.loads.layout(), factor, displacement)
    }

    fn control_force(&self, time: f64, internal: &InternalForces) -> f64 {
        let factor = self.control_factor(time);
        let reaction = |dof: usize| self.reaction(time, &internal.values, dof);
        (self.control()).force(self.loads.layout(), factor, internal, reaction)
    }
}
