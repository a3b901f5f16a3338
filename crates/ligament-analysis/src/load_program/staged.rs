//! One part of a programme: everything is A + w B, with w from 0 at its start to 1 at its end.

use std::sync::Arc;

use super::{BoundaryGroup, Control, ControlKind, LoadProgram, Programme};
use crate::internal::InternalForces;
use ligament_model::thermal::ThermalStrain;

/// What acts in one part of a programme: A, what acts at its start, and B, what grows in it.
///
/// At the load factor lambda, which runs from lambda_a to lambda_b in the part, all is A + w B with
/// w = (lambda - lambda_a)/(lambda_b - lambda_a); beyond the ends of the part as well.
#[derive(Debug, Clone)]
pub struct StagedLoading {
    programme: Arc<Programme>,
    part: usize,
    span: [f64; 2],
    /// Factor of each load at the start of the part, and what it grows by in the part.
    factors: Vec<Pair>,
    /// Prescribed value of each degree of freedom, shape (n_degrees_of_freedom), m or rad; zero where none is prescribed.
    prescribed: Vec<Pair>,
    /// External force or moment on each degree of freedom, shape (n_degrees_of_freedom), N or N m.
    force: Vec<Pair>,
}

/// What a quantity is at the start of a part, and what it grows by in it.
#[derive(Debug, Clone, Copy, Default)]
struct Pair {
    start: f64,
    growth: f64,
}

impl Pair {
    fn at(self, share: f64) -> f64 {
        self.start + share * self.growth
    }

    fn add(&mut self, factor: Self, value: f64) {
        self.start += factor.start * value;
        self.growth += factor.growth * value;
    }
}

impl StagedLoading {
    /// The part of a programme that begins with these factors of the loads (n_loads).
    pub fn new(programme: Arc<Programme>, part: usize, start: &[f64]) -> Self {
        let given = &programme.parts[part];
        let pair = |(&start, end): (&f64, &Option<f64>)| Pair {
            start,
            growth: end.unwrap_or(start) - start,
        };
        let factors = start.iter().zip(&given.ends).map(pair).collect();
        let span = given.span;
        Self::with(programme, part, span, factors)
    }

    /// The load of the force-displacement curve alone, which grows to its factor 1 at the load factor 1 while the others are absent:
    /// what they prescribe is held at zero.
    pub fn control_alone(&self) -> Self {
        let programme = self.programme.clone();
        let control = programme.control;
        let pair = |load: usize| Pair {
            start: 0.0,
            growth: f64::from(u8::from(load == control)),
        };
        let factors = (0..programme.loads.len()).map(pair).collect();
        Self::with(programme, self.part, [0.0, 1.0], factors)
    }

    /// What grows in this part alone, for a growth of the load factor by one: a loading in proportion to the load factor.
    pub fn rate(&self) -> Self {
        let length = self.span[1] - self.span[0];
        let alone = |it: &Pair| Pair {
            start: 0.0,
            growth: it.growth / length,
        };
        let factors = self.factors.iter().map(alone).collect();
        Self::with(self.programme.clone(), self.part, [0.0, 1.0], factors)
    }

    /// The programme that it is a part of.
    pub fn programme(&self) -> &Arc<Programme> {
        &self.programme
    }

    /// Index of the part in its programme.
    pub fn part(&self) -> usize {
        self.part
    }

    /// Factors of all loads at a load factor, shape (n_loads).
    pub fn factors(&self, load_factor: f64) -> Vec<f64> {
        let share = self.share(load_factor);
        self.factors.iter().map(|it| it.at(share)).collect()
    }

    /// Factors of all loads at the start of the part, shape (n_loads).
    pub fn start(&self) -> Vec<f64> {
        self.factors.iter().map(|it| it.start).collect()
    }

    fn with(programme: Arc<Programme>, part: usize, span: [f64; 2], factors: Vec<Pair>) -> Self {
        let n = programme.loads[0].layout.n_degrees_of_freedom();
        let mut prescribed = vec![Pair::default(); n];
        let mut force = vec![Pair::default(); n];
        for (load, &factor) in programme.loads.iter().zip(&factors) {
            for (sum, value) in prescribed.iter_mut().zip(&load.prescribed) {
                sum.add(factor, value.unwrap_or(0.0));
            }
            for (sum, &value) in force.iter_mut().zip(&load.force) {
                sum.add(factor, value);
            }
        }
        Self {
            programme,
            part,
            span,
            factors,
            prescribed,
            force,
        }
    }

    fn share(&self, load_factor: f64) -> f64 {
        (load_factor - self.span[0]) / (self.span[1] - self.span[0])
    }

    fn force_at(&self, load_factor: f64, dof: usize) -> f64 {
        self.force[dof].at(self.share(load_factor))
    }

    fn temperature(&self, load_factor: f64) -> Option<(usize, f64)> {
        let load = self.programme.temperature?;
        Some((load, self.factors[load].at(self.share(load_factor))))
    }
}

impl LoadProgram for StagedLoading {
    fn is_prescribed(&self, degree_of_freedom: usize) -> bool {
        let mut loads = self.programme.loads.iter();
        loads.any(|it| it.prescribed[degree_of_freedom].is_some())
    }

    fn prescribe(&self, time: f64, displacement: &mut [f64]) {
        let share = self.share(time);
        for load in &self.programme.loads {
            for (dof, value) in load.prescribed.iter().enumerate() {
                if value.is_some() {
                    displacement[dof] = self.prescribed[dof].at(share);
                }
            }
        }
    }

    fn forces(&self, time: f64, degrees_of_freedom: &[u32]) -> Vec<f64> {
        let share = self.share(time);
        let force = |&dof: &u32| self.force[dof as usize].at(share);
        degrees_of_freedom.iter().map(force).collect()
    }

    fn thermal_strain(&self, time: f64) -> ThermalStrain<'_> {
        match self.temperature(time) {
            Some((load, factor)) => {
                ThermalStrain::proportional(&self.programme.loads[load].thermal_strain, factor)
            }
            None => ThermalStrain::NONE,
        }
    }

    fn temperature_change(&self, time: f64) -> Vec<f64> {
        let Some((load, factor)) = self.temperature(time) else {
            return Vec::new();
        };
        let changes = self.programme.loads[load].temperature_change.iter();
        changes.map(|change| factor * change).collect()
    }

    fn temperature_factor(&self, time: f64) -> f64 {
        self.temperature(time).map_or(0.0, |(_, factor)| factor)
    }

    fn control_factor(&self, time: f64) -> f64 {
        self.factors[self.programme.control].at(self.share(time))
    }

    fn staged(&self) -> Option<&StagedLoading> {
        Some(self)
    }

    fn loaded_degrees_of_freedom(&self) -> Vec<u32> {
        let of_loads = self.programme.loads.iter();
        let mut loaded: Vec<u32> = of_loads
            .flat_map(LoadProgram::loaded_degrees_of_freedom)
            .collect();
        loaded.sort_unstable();
        loaded.dedup();
        loaded
    }

    fn reactions(&self, time: f64, internal_forces: &[f64]) -> Vec<f64> {
        let reaction = |(dof, internal): (usize, &f64)| match self.is_prescribed(dof) {
            true => internal - self.force_at(time, dof),
            false => 0.0,
        };
        internal_forces.iter().enumerate().map(reaction).collect()
    }

    fn groups(&self) -> &[BoundaryGroup] {
        &self.programme.loads[0].groups
    }

    fn given_resultants(&self, time: f64) -> Vec<Vec<f64>> {
        let mut sums: Vec<Vec<f64>> = (self.groups().iter())
            .map(|group| vec![0.0; group.force.len()])
            .collect();
        for (load, factor) in self.programme.loads.iter().zip(self.factors(time)) {
            for (sum, group) in sums.iter_mut().zip(&load.groups) {
                for (sum, force) in sum.iter_mut().zip(&group.force) {
                    *sum += factor * force;
                }
            }
        }
        sums
    }

    fn control(&self) -> &Control {
        &self.programme.loads[0].control
    }

    fn control_displacement(&self, time: f64, displacement: &[f64]) -> f64 {
        let control = self.control();
        match control.kind {
            ControlKind::Displacement | ControlKind::Temperature => {
                control.magnitude * self.control_factor(time)
            }
            ControlKind::Force => {
                let layout = self.programme.loads[0].layout;
                control.along(layout, |dof| displacement[dof])
            }
        }
    }

    fn control_force(&self, time: f64, internal: &InternalForces) -> f64 {
        let control = self.control();
        match control.kind {
            ControlKind::Force => control.magnitude * self.control_factor(time),
            ControlKind::Temperature => internal.thermal / control.magnitude,
            ControlKind::Displacement => {
                let layout = self.programme.loads[0].layout;
                control.along(layout, |dof| match self.is_prescribed(dof) {
                    true => internal.values[dof] - self.force_at(time, dof),
                    false => 0.0,
                })
            }
        }
    }
}
