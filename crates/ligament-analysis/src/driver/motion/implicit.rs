//! Implicit motion by Newmark's scheme ([`newmark`](super::newmark)), with ordered breaking in each step as in load steps.
//!
//! A step is an equilibrium of the bonds under the loads at its end and between the springs of the inertia; the factor of the stiffness serves
//! all steps of one length. A step that does not converge, or in which bonds break round after round, is halved and taken again.
//!
//! Points with a prescribed motion have no mass here: the trapezoidal rule would let the acceleration of a prescribed motion ring.

use std::sync::Arc;
use std::time::Instant;

use super::clock::Clock;
use super::here::{Here, MassAndDamping, Motion, free_masses};
use super::implicit_kept::ImplicitKept;
use super::progress::{IMPLICIT, Progress, Resumed};
use super::record;
use super::stepping::{HALVINGS, Pace, Stepping, scheme};
use super::taken::{Taken, next};
use crate::balanced::Attempt;
use crate::breakage::Breakage;
use crate::checkpoint::CheckpointError;
use crate::driver::dissipation;
use crate::driver::outcome::Outcome;
use crate::driver::recorder::Energies;
use crate::driver::start::NoObserver;
use crate::error::SetupError;
use crate::history::{BreakRecord, Observer, Termination};
use crate::motion::{ImplicitSettings, MotionError, MotionProblem, MotionSettings};
use crate::problem::Problem;
use crate::softening::Softening;
use crate::state::State;
use crate::unbalanced::Unbalanced;
use crate::vectors::sum_of_chunks;

/// Steps without a breakage after which a halved step is doubled again.
const CALM: usize = 8;

/// Motion in implicit steps.
struct Implicit<'a> {
    settings: &'a MotionSettings,
    implicit: ImplicitSettings,
    /// The problem, with the criteria of bonds that began to soften.
    problem: MotionProblem,
    /// Mass of each degree of freedom, zero where its motion is prescribed, shape (n_degrees_of_freedom).
    masses: Vec<f64>,
    stepping: Stepping,
    here: Here,
    energies: Energies,
    progress: Progress,
    pace: Pace,
    observer: &'a mut dyn Observer,
    started: Instant,
}

/// Reason why a step is halved and taken again.
enum TooLong {
    /// Bonds broke round after round.
    Rounds,
    /// There was no equilibrium.
    Unbalanced(Unbalanced),
}

/// Follows a motion from time zero to its end.
pub(super) fn run(
    problem: &MotionProblem,
    settings: &MotionSettings,
    implicit: ImplicitSettings,
    observer: &mut dyn Observer,
) -> Result<Outcome, SetupError> {
    check(problem, settings)?;
    let clock = Clock::new(settings, implicit.step);
    let mut state = State::fresh(&*problem.problem.system);
    problem
        .problem
        .loads
        .prescribe(0.0, &mut state.displacement);
    let n_bonds = state.intact.len();
    state.softening = Softening::of_sound_bonds(&problem.problem.criteria, n_bonds);
    let masses = free_masses(problem, settings.rotary_inertia);
    let pace = Pace::default();
    let scheme = scheme(settings, implicit, &clock, pace);
    let mut stepping = Stepping::new(problem, scheme, &masses, (&mut state, implicit))?;
    let balanced = stepping.equilibrium.measured(&mut state);
    let mut motion = Implicit {
        here: Here {
            motion: Motion::at_rest(&problem.initial_velocity, &balanced),
            state,
            balanced,
            broken: 0,
        },
        energies: Energies::unloaded(&problem.problem),
        progress: Progress::at_start(clock),
        problem: problem.clone(),
        started: Instant::now(),
        settings,
        implicit,
        masses,
        stepping,
        pace,
        observer,
    };
    motion.begin();
    motion.follow()
}

/// Continues a motion from a checkpoint.
pub(super) fn resume(
    settings: &MotionSettings,
    implicit: ImplicitSettings,
    resumed: Resumed<ImplicitKept>,
    observer: &mut dyn Observer,
) -> Result<Outcome, SetupError> {
    let Resumed {
        problem,
        energies,
        progress,
        kept,
    } = resumed;
    if progress.clock != Clock::new(settings, implicit.step) {
        return Err(CheckpointError::OtherTimes.into());
    }
    let ImplicitKept {
        here,
        stepping,
        pace,
    } = kept;
    let motion = Implicit {
        masses: free_masses(&problem, settings.rotary_inertia),
        started: Instant::now(),
        settings,
        implicit,
        problem,
        stepping,
        here,
        energies,
        progress,
        pace,
        observer,
    };
    motion.follow()
}

/// Refuses what implicit steps cannot follow.
fn check(problem: &MotionProblem, settings: &MotionSettings) -> Result<(), MotionError> {
    let Problem {
        system,
        criteria,
        loads,
        ..
    } = &problem.problem;
    if !system.subdomain().is_whole() {
        return Err(MotionError::SeveralProcesses);
    }
    if !problem.problem.contact.is_empty() || problem.face_friction > 0.0 {
        return Err(MotionError::ImplicitContact);
    }
    let is_heated = !loads.temperature_change(0.0).is_empty();
    let is_plain = system.is_linear() && !system.faces_close() && !criteria.soften() && !is_heated;
    if settings.damping.stiffness > 0.0 && !is_plain {
        return Err(MotionError::StiffnessDamping);
    }
    Ok(())
}

impl Implicit<'_> {
    /// Sets accelerations and energies of time zero.
    fn begin(&mut self) {
        let Here { state, motion, .. } = &self.here;
        let (external, damping) = self.inertia().forces(state, &motion.velocity);
        let masses = &self.masses;
        let motion = &mut self.here.motion;
        for (dof, &mass) in masses.iter().enumerate() {
            if mass > 0.0 {
                let force = external[dof] - motion.internal[dof] - damping[dof];
                motion.acceleration[dof] = force / mass;
            } else {
                motion.velocity[dof] = 0.0;
            }
        }
        (motion.external, motion.damping) = (external, damping);
        let problem = &self.problem.problem;
        self.here.balance_forces(problem, &self.masses);
        let Here {
            state,
            balanced,
            motion,
            ..
        } = &self.here;
        let problem = &self.problem.problem;
        self.energies.add_work(problem, state, balanced);
        let nothing = Breakage::default();
        self.energies
            .add_released(problem, state, &nothing, balanced);
        let kinetic = motion.kinetic_energy(masses);
        self.progress.motion.initial_energy = kinetic + balanced.stored_energy;
        self.progress.motion.kinetic_energy = kinetic;
    }

    /// Follows the motion row by row.
    fn follow(mut self) -> Result<Outcome, SetupError> {
        if self.progress.history.is_empty() {
            self.record()?;
        }
        let Clock { rows, duration, .. } = self.progress.clock;
        let mut end = None;
        for row in self.progress.history.len()..=rows {
            let time = self.here.state.load_factor;
            self.observer.round(row, 0, time, self.here.broken)?;
            end = self.move_to_row(row)?;
            if end.is_none() {
                end = self.record()?;
            }
            if end.is_some() {
                break;
            }
        }
        let termination = end.unwrap_or(Termination::TimeReached { time: duration });
        let solver = *self.stepping.equilibrium.choice();
        let costs = self.stepping.costs();
        let records = (&self.energies, &costs);
        let now = self
            .stepping
            .now(&self.problem.problem, &self.here, records);
        Ok(record::outcome(&now, self.progress, solver, termination))
    }

    /// Takes steps up to a row of the history; returns the reason why there is none, if a step does not converge however small it is.
    fn move_to_row(&mut self, row: usize) -> Result<Option<Termination>, SetupError> {
        let Clock { steps_per_row, .. } = self.progress.clock;
        let whole = 1_usize << HALVINGS;
        let (mut tick, ticks) = (0, steps_per_row * whole);
        while tick < ticks {
            let length = whole >> self.pace.halvings;
            let is_aligned = (tick + ticks).is_multiple_of(2 * length);
            if self.pace.halvings > 0 && self.pace.calm >= CALM && is_aligned {
                self.change_pace(self.pace.halvings - 1)?;
                continue;
            }
            let share = (tick + length) as f64 / ticks as f64;
            let rows = self.progress.clock.rows as f64;
            let time = self.progress.clock.duration * ((row - 1) as f64 + share) / rows;
            match self.attempt(row, time)? {
                Ok(taken) => {
                    self.accept(taken)?;
                    tick += length;
                }
                Err(TooLong::Unbalanced(reason)) if self.pace.halvings == HALVINGS => {
                    let step = self.progress.history.len();
                    return Ok(Some(Termination::NoEquilibrium { step, reason }));
                }
                Err(TooLong::Rounds | TooLong::Unbalanced(_)) => {
                    self.change_pace(self.pace.halvings + 1)?;
                }
            }
        }
        Ok(None)
    }

    /// Takes steps of another length from here on.
    fn change_pace(&mut self, halvings: usize) -> Result<(), SetupError> {
        self.pace = Pace { halvings, calm: 0 };
        let scheme = scheme(
            self.settings,
            self.implicit,
            &self.progress.clock,
            self.pace,
        );
        let of_state = (&mut self.here.state, self.implicit);
        let stepping = Stepping::new(&self.problem, scheme, &self.masses, of_state)?;
        let costs = self.stepping.costs();
        self.stepping = Stepping { costs, ..stepping };
        Ok(())
    }

    fn inertia(&self) -> MassAndDamping<'_> {
        MassAndDamping {
            problem: &self.problem,
            masses: &self.masses,
            damping: self.stepping.scheme.damping,
        }
    }

    /// A step to a time, without effect on the motion; the reason why it is too long, if it is.
    fn attempt(&mut self, row: usize, time: f64) -> Result<Result<Taken, TooLong>, SetupError> {
        let criteria = self.problem.problem.criteria.clone();
        let loads = Arc::new(self.stepping.loads(&self.here, self.inertia()));
        let equilibrium = &mut self.stepping.equilibrium;
        equilibrium.load_with(loads);
        let mut taken = Taken {
            state: State {
                load_factor: time,
                ..self.here.state.clone()
            },
            balanced: self.here.balanced.clone(),
            broken: Vec::new(),
            records: Vec::new(),
        };
        let mut breakage = Breakage::default();
        let mut rounds = 0;
        loop {
            let attempt = equilibrium.balance(&mut taken.state, &breakage, &mut NoObserver)?;
            taken.balanced = match attempt {
                Attempt::Balanced(balanced) => balanced,
                Attempt::Unbalanced(reason) => {
                    self.problem.problem.criteria = criteria;
                    return Ok(Err(TooLong::Unbalanced(reason)));
                }
            };
            breakage = Breakage::default();
            let problem = &mut self.problem.problem;
            if let Some(begun) = problem.beginning(&taken.state, &taken.balanced) {
                problem.criteria = Arc::new(problem.criteria.begun_at(&begun));
                equilibrium.judge_by(problem.criteria.clone());
                taken.state.softening.begun = begun;
                continue;
            }
            let next = next(problem, &self.implicit.rule, equilibrium, &taken);
            if next.is_empty() {
                return Ok(Ok(taken));
            }
            rounds += 1;
            if rounds > self.implicit.rounds && self.pace.halvings < HALVINGS {
                problem.criteria = criteria;
                return Ok(Err(TooLong::Rounds));
            }
            let moment = BreakRecord {
                order: self.here.broken + taken.broken.len(),
                step: row,
                round: rounds,
                ..BreakRecord::default()
            };
            breakage = taken.break_bonds(problem, &next, moment, equilibrium);
        }
    }

    /// Accepts a step, with its energies.
    fn accept(&mut self, mut taken: Taken) -> Result<(), SetupError> {
        let problem = &self.problem.problem;
        self.observer.broke(&taken.records)?;
        dissipation::soften(problem, &mut taken.state);
        let expansion = problem.loads.thermal_strain(taken.state.load_factor);
        let (system, before) = (&*problem.system, &self.here.state);
        let breakage = match taken.broken.is_empty() {
            true => Breakage::default(),
            false => Breakage::new(system, expansion, before, &taken.broken),
        };
        let motion = self.stepping.after(&self.here, &taken, self.inertia());
        let way = |dof: usize| taken.state.displacement[dof] - before.displacement[dof];
        let earlier = &self.here.motion;
        self.progress.motion.damping_energy += self.damped(earlier, &motion, &way);
        self.progress.motion.kinetic_energy = motion.kinetic_energy(&self.masses);
        self.progress.motion.time_steps += 1;
        self.pace.calm = if taken.broken.is_empty() {
            self.pace.calm + 1
        } else {
            0
        };
        self.here = Here {
            broken: self.here.broken + taken.broken.len(),
            state: taken.state,
            balanced: taken.balanced,
            motion,
        };
        let problem = &self.problem.problem;
        self.here.balance_forces(problem, &self.masses);
        let (
            problem,
            Here {
                state, balanced, ..
            },
        ) = (&self.problem.problem, &self.here);
        self.energies.add_work(problem, state, balanced);
        self.energies
            .add_released(problem, state, &breakage, balanced);
        self.progress.motion.friction_energy +=
            self.energies.follow_contact(problem, state, balanced);
        Ok(())
    }

    /// Energy that damping took in a step, and with dissipation that of the scheme, J: the work of the forces that are out of balance at its
    /// ends, and what its parameters take from the kinetic energy.
    fn damped(&self, before: &Motion, after: &Motion, way: &(dyn Fn(usize) -> f64 + Sync)) -> f64 {
        let dissipates = self.implicit.dissipation > 0.0;
        let masses = &self.masses;
        let left = |motion: &Motion, dof: usize| {
            let inertia = masses[dof] * motion.acceleration[dof];
            let balance = motion.external[dof] - motion.internal[dof];
            if masses[dof] > 0.0 {
                balance - motion.damping[dof] - inertia
            } else {
                0.0
            }
        };
        let sum = sum_of_chunks(masses.len(), |range| {
            let of = |dof: usize| {
                let mut force = before.damping[dof] + after.damping[dof];
                if dissipates {
                    let inertia = before.acceleration[dof] + after.acceleration[dof];
                    force += left(before, dof) + left(after, dof) + masses[dof] * inertia;
                }
                0.5 * force * way(dof)
            };
            range.map(of).sum()
        });
        match dissipates {
            true => sum + before.kinetic_energy(masses) - after.kinetic_energy(masses),
            false => sum,
        }
    }

    /// Records the present time as a row, and returns the reason why the motion ends there, if it does.
    fn record(&mut self) -> Result<Option<Termination>, SetupError> {
        let costs = self.stepping.costs();
        let Self {
            here,
            problem,
            stepping,
            energies,
            progress,
            observer,
            ..
        } = self;
        let now = stepping.now(&problem.problem, here, (energies, &costs));
        let stop = (&self.settings.stop, self.started);
        let end = now.record(progress, stop, *observer)?;
        let pace = self.pace;
        let checkpoint = || {
            progress.bytes(energies, IMPLICIT, &|out| {
                ImplicitKept::write(&problem.problem, here, (stepping, pace), out);
            })
        };
        Ok(record::offer(*observer, end, &checkpoint)?)
    }
}
