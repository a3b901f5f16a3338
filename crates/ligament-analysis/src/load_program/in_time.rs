//! Loads as functions of time, each by an amplitude of its own.

use std::sync::Arc;

use super::separate::Separate;
use super::{Amplitude, BoundaryGroup, Control, LoadProgram, ProportionalLoading};
use crate::internal::InternalForces;
use crate::restraints::Restraints;
use ligament_model::thermal::ThermalStrain;

/// Quantity that an amplitude multiplies.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Timed {
    /// Force or displacement.
    Value,
    /// Velocity, whose integral is a displacement.
    Velocity,
    /// Acceleration, whose second integral is a displacement.
    Acceleration,
}

/// Course of a load in time.
#[derive(Debug, Clone, PartialEq)]
pub struct LoadInTime {
    /// Amplitude.
    pub amplitude: Amplitude,
    /// Quantity that the amplitude multiplies.
    pub timed: Timed,
}

impl LoadInTime {
    /// Factor of the force, or of the displacement that a velocity or an acceleration has made, at a time.
    pub fn factor(&self, time: f64) -> f64 {
        match self.timed {
            Timed::Value => self.amplitude.value(time),
            Timed::Velocity => self.amplitude.integral(time),
            Timed::Acceleration => self.amplitude.second_integral(time),
        }
    }
}

/// Loads in time: the pseudo-time is the time t, s, and each load has a factor f(t) of its own.
///
/// Forces and prescribed displacements are their values at factor 1 times f; for a prescribed velocity f is the integral of the
/// amplitude, for a prescribed acceleration its second integral, from rest at time zero.
#[derive(Debug, Clone)]
pub struct LoadsInTime {
    loads: Separate,
    courses: Arc<[LoadInTime]>,
    /// Course of the control load; None where nothing is driven.
    control: Option<LoadInTime>,
    /// Degrees of freedom that stay at zero, ascending.
    held: Vec<u32>,
    /// Degrees of freedom that each load moves, with their displacements at factor 1, shape (n_loads), m or rad.
    moved: Vec<Vec<(u32, f64)>>,
    /// Forces on the points at factor 1.
    force: LoadedRows,
    /// Forces of restraints with moved far ends on a fixed body at factor 1.
    driving: LoadedRows,
}

/// Forces at loaded degrees of freedom by load, N or N m.
#[derive(Debug, Clone)]
struct LoadedRows {
    /// Row of each degree of freedom, shape (n_degrees_of_freedom); [`UNLOADED`] where no load acts.
    row: Vec<u32>,
    /// Start of each row in `terms`, shape (n_rows + 1).
    start: Vec<usize>,
    /// Load and force at factor 1, in the order of the loads.
    terms: Vec<(u32, f64)>,
}

/// Row of a degree of freedom without load.
const UNLOADED: u32 = u32::MAX;

impl LoadedRows {
    /// Rows of loads with forces (n_degrees_of_freedom each, or none).
    fn new<'a>(n: usize, loads: impl Iterator<Item = &'a [f64]> + Clone) -> Self {
        let (mut row, mut start, mut terms) = (vec![UNLOADED; n], vec![0], Vec::new());
        for (dof, row) in row.iter_mut().enumerate() {
            let forces = loads.clone().map(|it| it.get(dof).copied());
            let forces = forces
                .zip(0..)
                .map(|(force, load)| (load, force.unwrap_or(0.0)));
            terms.extend(forces.filter(|(_, force)| *force != 0.0));
            if start.last() != Some(&terms.len()) {
                *row = start.len() as u32 - 1;
                start.push(terms.len());
            }
        }
        Self { row, start, terms }
    }

    /// Force at a degree of freedom under loads with factors (n_loads).
    fn at(&self, dof: usize, factors: &[f64]) -> f64 {
        match self.row[dof] {
            UNLOADED => 0.0,
            row => {
                let range = self.start[row as usize]..self.start[row as usize + 1];
                let terms = self.terms[range].iter();
                terms.map(|&(load, it)| factors[load as usize] * it).sum()
            }
        }
    }
}

impl LoadsInTime {
    /// Combines loads (one or more), each by itself at factor 1 with all supports and all groups of the history, with their courses in time
    /// (n_loads), and the course of the control load. Without loads, `loads` has the supports alone, and `courses` is empty.
    pub fn new(
        loads: Arc<[ProportionalLoading]>,
        courses: Arc<[LoadInTime]>,
        control: Option<LoadInTime>,
    ) -> Self {
        let n = loads[0].layout.n_degrees_of_freedom();
        let force = LoadedRows::new(n, loads.iter().map(|it| &*it.force));
        let driving = LoadedRows::new(n, loads.iter().map(|it| &*it.driving));
        let moved: Vec<Vec<(u32, f64)>> = loads.iter().map(moved).collect();
        let loads = Separate(loads);
        let is_moved = |dof: u32| {
            let mut lists = moved.iter();
            lists.any(|it| it.binary_search_by_key(&dof, |it| it.0).is_ok())
        };
        let dofs = 0..n as u32;
        let held = dofs.filter(|&dof| loads.is_prescribed(dof as usize) && !is_moved(dof));
        Self {
            held: held.collect(),
            loads,
            courses,
            control,
            moved,
            force,
            driving,
        }
    }

    /// Factors of all loads at a time, shape (n_loads).
    fn factors(&self, time: f64) -> Vec<f64> {
        self.courses.iter().map(|it| it.factor(time)).collect()
    }

    /// Reaction at a degree of freedom to an internal force, N or N m, for factors of the loads (n_loads).
    fn reaction(&self, factors: &[f64], internal: f64, dof: usize) -> f64 {
        match self.reacts_at(dof) {
            true => internal - self.force.at(dof, factors),
            false => 0.0,
        }
    }
}

/// Degrees of freedom that a load moves, ascending, with their displacements at factor 1.
fn moved(load: &ProportionalLoading) -> Vec<(u32, f64)> {
    let prescribed = load.prescribed.iter().zip(0..);
    let moved = prescribed.filter_map(|(value, dof)| Some((dof, (*value)?)));
    moved.filter(|(_, value)| *value != 0.0).collect()
}

impl LoadProgram for LoadsInTime {
    fn is_in_time(&self) -> bool {
        true
    }

    fn is_prescribed(&self, degree_of_freedom: usize) -> bool {
        self.loads.is_prescribed(degree_of_freedom)
    }

    fn restraints(&self) -> &Arc<Restraints> {
        self.loads.restraints()
    }

    fn prescribe(&self, time: f64, displacement: &mut [f64]) {
        for &dof in &self.held {
            displacement[dof as usize] = 0.0;
        }
        for (moved, course) in self.moved.iter().zip(&*self.courses) {
            if moved.is_empty() {
                continue;
            }
            let factor = course.factor(time);
            for &(dof, value) in moved {
                displacement[dof as usize] = factor * value;
            }
        }
    }

    fn forces(&self, time: f64, degrees_of_freedom: &[u32]) -> Vec<f64> {
        let factors = self.factors(time);
        let mut forces = vec![0.0; degrees_of_freedom.len()];
        for rows in [&self.force, &self.driving] {
            if !rows.terms.is_empty() {
                for (sum, &dof) in forces.iter_mut().zip(degrees_of_freedom) {
                    *sum += rows.at(dof as usize, &factors);
                }
            }
        }
        forces
    }

    fn thermal_strain(&self, _time: f64) -> ThermalStrain<'_> {
        ThermalStrain::NONE
    }

    fn temperature_change(&self, _time: f64) -> Vec<f64> {
        Vec::new()
    }

    fn temperature_factor(&self, _time: f64) -> f64 {
        0.0
    }

    fn control_factor(&self, time: f64) -> f64 {
        self.control.as_ref().map_or(0.0, |it| it.factor(time))
    }

    fn loaded_degrees_of_freedom(&self) -> Vec<u32> {
        self.loads.loaded_degrees_of_freedom()
    }

    fn reactions(&self, time: f64, internal_forces: &[f64]) -> Vec<f64> {
        let factors = self.factors(time);
        let internal = internal_forces.iter().enumerate();
        let reactions = internal.map(|(dof, &internal)| self.reaction(&factors, internal, dof));
        reactions.collect()
    }

    fn groups(&self) -> &[BoundaryGroup] {
        self.loads.groups()
    }

    fn given_resultants(&self, time: f64) -> Vec<Vec<f64>> {
        self.loads.given_resultants(&self.factors(time))
    }

    fn control(&self) -> &Control {
        self.loads.control()
    }

    fn control_displacement(&self, time: f64, displacement: &[f64]) -> f64 {
        let factor = self.control_factor(time);
        (self.control()).displacement(self.loads.layout(), factor, displacement)
    }

    fn control_force(&self, time: f64, internal: &InternalForces) -> f64 {
        let factors = self.factors(time);
        let reaction = |dof: usize| self.reaction(&factors, internal.values[dof], dof);
        let factor = self.control_factor(time);
        (self.control()).force(self.loads.layout(), factor, internal, reaction)
    }
}

#[cfg(test)]
mod tests;
