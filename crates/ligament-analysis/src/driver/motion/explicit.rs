//! Explicit motion by velocity Verlet (central differences), in which all bonds that come to their limits in a time step break in it.
//!
//! A step from t to t' = t + dt: u' = u + dt v+ with the velocities v+ in its middle; deformations and breakages at u'; forces f(u') of the bonds
//! that are left; velocities in the middle of the next step ([`Inertia::advance`]).
//!
//! With the kinetic energy 1/2 v-^T M v+ and the trapezoidal rule for work, damping and released energy the energies balance to rounding for forces
//! that are linear in the displacements: 1/2 (M a + M a')^T (u' - u) is the change of the kinetic energy.

use std::time::Instant;

use rayon::prelude::*;

use super::body::{Body, TimeStep};
use super::checkpoint::ExplicitMotion;
use super::clock::Clock;
use super::inertia::{Inertia, Velocities};
use super::record::{self, EXPLICIT, Progress};
use crate::bond_numbers::BondNumbers;
use crate::breakage::Breakage;
use crate::checkpoint::CheckpointError;
use crate::driver::energies::Energies;
use crate::driver::way::{Outcome, Stop, Way};
use crate::error::SetupError;
use crate::history::{Observer, StepRecord, Termination};
use crate::motion::{MotionError, MotionProblem, MotionSettings, critical_step};
use crate::serial::Sink;
use crate::solver::{ExplicitChoice, SolverChoice};
use crate::state::State;
use crate::vectors::{CHUNK, sum_of_chunks};

/// Motion in explicit steps.
pub(super) struct ExplicitSteps<'a> {
    settings: &'a MotionSettings,
    choice: ExplicitChoice,
    inertia: Inertia,
    body: Body,
    velocities: Velocities,
    energies: Energies,
    progress: Progress,
    /// Degrees of freedom that are prescribed or loaded, ascending.
    loaded: Vec<u32>,
    /// External forces, shape (n_degrees_of_freedom), N and N m.
    external: Vec<f64>,
    /// Forces of restraints on the body, shape (n_degrees_of_freedom), N and N m; empty without restraints.
    restraining: Vec<f64>,
    /// Prescribed displacements at the end of the next step, shape (n_degrees_of_freedom); zero at others.
    ahead: Vec<f64>,
    /// Product of the stiffness with the velocities, shape (n_degrees_of_freedom); empty without damping by stiffness.
    damped: Vec<f64>,
    observer: &'a mut dyn Observer,
    started: Instant,
}

/// Begins a motion at time zero.
pub(super) fn begin<'a>(
    problem: &MotionProblem,
    settings: &'a MotionSettings,
    observer: &'a mut dyn Observer,
) -> Result<ExplicitSteps<'a>, SetupError> {
    let (clock, choice) = chosen(problem, settings)?;
    observer.begins(clock.ahead(false));
    let numbers = BondNumbers::new(&*problem.problem.system)?;
    let body = Body::new(&problem.problem, numbers, None);
    let n = body.state.displacement.len();
    let velocities = Velocities {
        half: vec![0.0; n],
        acceleration: vec![0.0; n],
        rigid: Vec::new(),
    };
    let energies = Energies::unloaded(&problem.problem);
    let progress = Progress::at_start(clock);
    let motion = ExplicitMotion {
        problem: problem.clone(),
        body,
        velocities,
        energies,
        progress,
    };
    let mut motion = ExplicitSteps::new(settings, choice, motion, observer);
    motion.begin(&problem.initial_velocity);
    Ok(motion)
}

/// Continues a motion from a checkpoint.
pub(super) fn resume(
    settings: &MotionSettings,
    motion: ExplicitMotion,
    observer: &mut dyn Observer,
) -> Result<Outcome, SetupError> {
    let (clock, choice) = chosen(&motion.problem, settings)?;
    if clock != motion.progress.clock {
        return Err(CheckpointError::OtherTimes.into());
    }
    let mut motion = ExplicitSteps::new(settings, choice, motion, observer);
    motion.apply_loads();
    Box::new(motion).follow()
}

/// Times of a motion, with the critical step.
pub(super) fn chosen(
    problem: &MotionProblem,
    settings: &MotionSettings,
) -> Result<(Clock, ExplicitChoice), SetupError> {
    let system = &problem.problem.system;
    if !system.subdomain.is_whole() {
        return Err(MotionError::SeveralProcesses.into());
    }
    if settings.damping.stiffness > 0.0 && !system.element.is_linear() {
        return Err(MotionError::StiffnessDamping.into());
    }
    let critical = critical_step(problem, settings)?;
    let clock = Clock::explicit(settings, critical.step)?;
    let step = clock.step();
    settings.damping.check(step)?;
    Ok((clock, ExplicitChoice { step, critical }))
}

impl<'a> ExplicitSteps<'a> {
    fn new(
        settings: &'a MotionSettings,
        choice: ExplicitChoice,
        motion: ExplicitMotion,
        observer: &'a mut dyn Observer,
    ) -> Self {
        let ExplicitMotion {
            problem,
            body,
            velocities,
            energies,
            progress,
        } = motion;
        let (alpha, step) = (settings.damping.mass, choice.step);
        let loads = &problem.problem.loads;
        let n = body.state.displacement.len();
        let is_damped = settings.damping.stiffness > 0.0;
        Self {
            inertia: Inertia::new(&problem, settings.rotary_inertia, alpha, step),
            loaded: loads.loaded_degrees_of_freedom(),
            external: vec![0.0; n],
            restraining: vec![0.0; if loads.restraints().is_empty() { 0 } else { n }],
            ahead: vec![0.0; n],
            damped: vec![0.0; if is_damped { n } else { 0 }],
            settings,
            choice,
            body,
            velocities,
            energies,
            progress,
            observer,
            started: Instant::now(),
        }
    }

    /// Sets the velocities and the energies of time zero.
    fn begin(&mut self, velocity: &[f64]) {
        let loads = self.body.problem.loads.clone();
        loads.prescribe(0.0, &mut self.body.state.displacement);
        self.body.measure();
        self.velocities.rigid = self.body.begin_contact();
        self.apply_loads();
        let internal = &self.body.balanced.internal.values;
        let forces = self.external.iter().zip(internal);
        let unbalanced: Vec<f64> = forces.map(|(given, inner)| given - inner).collect();
        self.velocities.half = self.inertia.before_start(velocity, &unbalanced);
        for &dof in self.inertia.prescribed() {
            let dof = dof as usize;
            let way = self.ahead[dof] - self.body.state.displacement[dof];
            self.velocities.half[dof] = way / self.inertia.step();
        }
        self.advance();
        let Body {
            problem,
            state,
            balanced,
            ..
        } = &self.body;
        let nothing = Breakage::default();
        (self.energies).account(problem, (state, balanced), &nothing);
        // The first step goes on from the contact at the start, which has no energy.
        self.energies.follow_surfaces(problem, state);
        self.progress.motion.initial_energy =
            self.kinetic_energy() + self.body.balanced.stored_energy;
        self.damp();
    }
}

impl Way for ExplicitSteps<'_> {
    fn advance(&mut self) -> Result<(), Stop> {
        self.record()?;
        let (row, time) = (self.progress.history.len(), self.body.state.load_factor);
        self.observer.round(row, 0, time, self.body.broken)?;
        for _ in 0..self.progress.clock.steps_per_row {
            self.step(row)?;
        }
        Ok(())
    }

    fn state(&self) -> &State {
        &self.body.state
    }

    fn history(&self) -> &[StepRecord] {
        &self.progress.history
    }

    fn outcome(self: Box<Self>, end: Termination) -> Result<Outcome, SetupError> {
        let velocity = self.velocities.at_time(self.inertia.step());
        let rates = self.velocities.rates(&velocity);
        let of_critical = self.choice.of_critical();
        let now = self.body.now(&self.energies, rates, of_critical);
        let solver = SolverChoice::Explicit(self.choice);
        Ok(record::outcome(&now, self.progress, solver, end))
    }
}

impl ExplicitSteps<'_> {
    /// Records the present time as a row, and stops where the motion ends there.
    fn record(&mut self) -> Result<(), Stop> {
        self.progress.motion.kinetic_energy = self.kinetic_energy();
        let Self {
            body,
            velocities,
            energies,
            progress,
            observer,
            ..
        } = self;
        let velocity = velocities.at_time(self.inertia.step());
        let of_critical = self.choice.of_critical();
        let now = body.now(energies, velocities.rates(&velocity), of_critical);
        let stop = (&self.settings.stop, self.started);
        let checkpoint = |progress: &Progress, out: &mut dyn Sink| {
            let state = |out: &mut dyn Sink| {
                ExplicitMotion::write(body, velocities, out);
            };
            progress.write_all(energies, EXPLICIT, &state, out);
        };
        now.record(progress, stop, *observer, &checkpoint)
    }

    /// One time step on the way to a row of the history.
    fn step(&mut self, row: usize) -> Result<(), SetupError> {
        self.progress.motion.time_steps += 1;
        let time_step = self.progress.motion.time_steps;
        self.body.state.load_factor = self.progress.clock.time(time_step);
        self.displace();
        let step = TimeStep {
            number: time_step,
            row,
            length: self.inertia.step(),
            velocity: &self.velocities.half,
        };
        let is_row = time_step == row * self.progress.clock.steps_per_row;
        let breakage = self.body.move_to(&step, is_row, self.observer)?;
        let length = self.inertia.step();
        self.body.touch(length, &mut self.velocities.rigid);
        self.apply_loads();
        self.advance();
        let Body {
            problem,
            state,
            balanced,
            ..
        } = &self.body;
        let (at, motion) = ((state, balanced), &mut self.progress.motion);
        self.energies.account(problem, at, &breakage);
        (self.energies).add_contact_in_motion(problem, at, &breakage.bonds, motion);
        self.damp();
        Ok(())
    }

    /// Moves the points by their velocities in the middle of the step, or as prescribed.
    fn displace(&mut self) {
        let step = self.inertia.step();
        let displacement = &mut self.body.state.displacement;
        (
            displacement.par_chunks_mut(CHUNK),
            self.velocities.half.par_chunks(CHUNK),
        )
            .into_par_iter()
            .for_each(|(displacement, half)| {
                for (displacement, velocity) in displacement.iter_mut().zip(half) {
                    *displacement += step * velocity;
                }
            });
        for &dof in self.inertia.prescribed() {
            displacement[dof as usize] = self.ahead[dof as usize];
        }
    }

    /// Kinetic energy of the body and of free rigid bodies, J.
    fn kinetic_energy(&self) -> f64 {
        let contact = &self.body.problem.contact;
        let rigid = contact.kinetic_energy(self.inertia.step(), &self.velocities.rigid);
        self.inertia.kinetic_energy(&self.velocities) + rigid
    }

    /// Sets the external forces of the time, and the prescribed displacements of the end of the next step.
    fn apply_loads(&mut self) {
        let loads = &self.body.problem.loads;
        let time = self.body.state.load_factor;
        let forces = loads.forces(time, &self.loaded);
        for (&dof, force) in self.loaded.iter().zip(forces) {
            self.external[dof as usize] = force;
        }
        if !self.restraining.is_empty() {
            let restraints = loads.restraints();
            let restrained = restraints.degrees_of_freedom();
            for &dof in restrained {
                self.restraining[dof as usize] = 0.0;
            }
            restraints.add_forces(&self.body.state.displacement, &mut self.restraining);
            for &dof in restrained {
                self.external[dof as usize] -= self.restraining[dof as usize];
            }
        }
        let next = self.progress.motion.time_steps + 1;
        loads.prescribe(self.progress.clock.time(next), &mut self.ahead);
    }

    /// Finds the velocities in the middle of the next step.
    fn advance(&mut self) {
        let beta = self.settings.damping.stiffness;
        let internal = &mut self.body.balanced.internal.values;
        if !self.damped.is_empty() {
            let (system, bonds) = (&self.body.problem.system, self.body.state.bonds());
            system.multiply(bonds, &self.velocities.half, &mut self.damped);
            for (force, damped) in internal.iter_mut().zip(&self.damped) {
                *force += beta * damped;
            }
        }
        let displacement = &self.body.state.displacement;
        self.inertia.advance(
            &mut self.velocities,
            &self.external,
            internal,
            displacement,
            &self.ahead,
        );
    }

    /// Adds the energy that damping took in the last step, by the trapezoidal rule.
    fn damp(&mut self) {
        if !self.inertia.is_damped() && self.damped.is_empty() {
            return;
        }
        let n = self.external.len();
        let mut forces = vec![0.0; n];
        self.inertia.damping_forces(&self.velocities, &mut forces);
        let beta = self.settings.damping.stiffness;
        for (force, damped) in forces.iter_mut().zip(&self.damped) {
            *force += beta * damped;
        }
        let earlier = &self.progress.damping_forces;
        if !earlier.is_empty() {
            let Velocities {
                half, acceleration, ..
            } = &self.velocities;
            let step = self.inertia.step();
            self.progress.motion.damping_energy += sum_of_chunks(n, |range| {
                let of = |dof: usize| {
                    let way = step * (half[dof] - step * acceleration[dof]);
                    0.5 * (forces[dof] + earlier[dof]) * way
                };
                range.map(of).sum()
            });
        }
        self.progress.damping_forces = forces;
    }
}
