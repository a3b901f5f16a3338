//! Implicit motion by Newmark's scheme ([`newmark`](super::newmark)), with ordered breaking in each step as in load steps.
//!
//! A step is an equilibrium of the bonds under the loads at its end and between the springs of the inertia; the factor of the stiffness serves
//! all steps of one length. A step that does not converge, or in which bonds break round after round, is halved and taken again.
//!
//! Points with a prescribed motion have no mass here: the trapezoidal rule would let the acceleration of a prescribed motion ring.

use std::time::Instant;

use super::checkpoint::ImplicitMotion;
use super::clock::Clock;
use super::motion_state::{MassAndDamping, Motion, MotionState, free_masses};
use super::record::{self, MotionView};
use super::record::{IMPLICIT, Progress};
use super::stepping::{CALM, HALVINGS, Pace, Stepping, scheme};
use super::trial_step::{self, Rejected, StepSettings, TrialStep};
use super::{quasi_static, rigid_step};
use crate::breakage::Breakage;
use crate::checkpoint::CheckpointError;
use crate::contact::{RigidBody, RigidMotion};
use crate::driver::energies::Energies;
use crate::driver::way::{Outcome, Stop, Way};
use crate::error::SetupError;
use crate::history::{Observer, StepRecord, Termination};
use crate::motion::{MotionError, MotionProblem, MotionSettings};
use crate::problem::Problem;
use crate::serial::Sink;
use crate::softening::Softening;
use crate::state::State;
use crate::user_message::Message;

/// Motion in implicit steps.
pub(super) struct ImplicitSteps<'a> {
    settings: &'a MotionSettings,
    problem: MotionProblem,
    /// Mass of each degree of freedom, zero where its motion is prescribed, shape (n_degrees_of_freedom).
    masses: Vec<f64>,
    stepping: Stepping,
    here: MotionState,
    energies: Energies,
    progress: Progress,
    pace: Pace,
    observer: &'a mut dyn Observer,
    started: Instant,
}

/// Begins a motion at time zero.
pub(super) fn begin<'a>(
    problem: &MotionProblem,
    settings: &'a MotionSettings,
    observer: &'a mut dyn Observer,
) -> Result<ImplicitSteps<'a>, SetupError> {
    check(problem, settings)?;
    let clock = Clock::implicit(settings)?;
    if settings.share_of_statics().is_none() {
        observer.begins(clock.ahead(true));
    }
    let mut state = State::fresh(&*problem.problem.system);
    problem
        .problem
        .loads
        .prescribe(0.0, &mut state.displacement);
    let n_bonds = state.intact.len();
    state.softening = Softening::of_sound_bonds(&problem.problem.criteria, n_bonds);
    let masses = free_masses(problem, settings.rotary_inertia);
    let pace = quasi_static::first_pace(problem, settings);
    let scheme = scheme(settings, &clock, pace);
    let mut stepping = Stepping::new(problem, scheme, &masses, (&mut state, settings))?;
    let balanced = stepping.equilibrium.measured(&mut state);
    let mut motion = ImplicitSteps {
        here: MotionState {
            motion: Motion::with_velocity(problem.initial_velocity.to_vec(), &balanced),
            state,
            balanced,
            broken: 0,
        },
        energies: Energies::unloaded(&problem.problem),
        progress: Progress::at_start(clock),
        problem: problem.clone(),
        started: Instant::now(),
        settings,
        masses,
        stepping,
        pace,
        observer,
    };
    motion.begin();
    Ok(motion)
}

/// Continues a motion from a checkpoint.
pub(super) fn resume(
    settings: &MotionSettings,
    motion: ImplicitMotion,
    observer: &mut dyn Observer,
) -> Result<Outcome, SetupError> {
    if motion.progress.clock != Clock::implicit(settings)? {
        return Err(CheckpointError::OtherTimes.into());
    }
    let ImplicitMotion {
        problem,
        here,
        stepping,
        pace,
        energies,
        progress,
    } = motion;
    let motion = ImplicitSteps {
        masses: free_masses(&problem, settings.rotary_inertia),
        started: Instant::now(),
        settings,
        problem,
        stepping,
        here,
        energies,
        progress,
        pace,
        observer,
    };
    Box::new(motion).follow()
}

impl ImplicitSteps<'_> {
    /// Sets accelerations and energies of time zero.
    fn begin(&mut self) {
        let MotionState { state, motion, .. } = &self.here;
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
        motion.rigid = problem.contact.rates_at_start(&self.here.balanced.touching);
        self.here.balance_forces(problem, &self.masses);
        let MotionState {
            state,
            balanced,
            motion,
            ..
        } = &self.here;
        let problem = &self.problem.problem;
        let nothing = Breakage::default();
        (self.energies).account(problem, (state, balanced), &nothing);
        let rigid = problem.contact.kinetic_energy(0.0, &motion.rigid);
        let kinetic = motion.kinetic_energy(masses) + rigid;
        self.progress.motion.initial_energy = kinetic + balanced.stored_energy;
        self.progress.motion.kinetic_energy = kinetic;
    }
}

impl Way for ImplicitSteps<'_> {
    fn advance(&mut self) -> Result<(), Stop> {
        self.record()?;
        let (row, time) = (self.progress.history.len(), self.here.state.load_factor);
        self.observer.round(row, 0, time, self.here.broken)?;
        self.move_to_row(row)
    }

    fn state(&self) -> &State {
        &self.here.state
    }

    fn history(&self) -> &[StepRecord] {
        &self.progress.history
    }

    fn outcome(self: Box<Self>, end: Termination) -> Result<Outcome, SetupError> {
        let solver = *self.stepping.equilibrium.choice();
        let costs = self.stepping.costs();
        let (problem, records) = (&self.problem.problem, (&self.energies, &costs));
        let now = self.stepping.now(problem, &self.here, records);
        Ok(record::outcome(&now, self.progress, solver, end))
    }
}

impl ImplicitSteps<'_> {
    /// Takes steps up to a row of the history; stops where a step does not converge however small it is.
    fn move_to_row(&mut self, row: usize) -> Result<(), Stop> {
        let Clock {
            steps_per_row,
            rows,
            duration,
        } = self.progress.clock;
        let (mut tick, ticks) = (0, steps_per_row << HALVINGS);
        while tick < ticks {
            if self.lengthen(row, tick)? {
                continue;
            }
            let length = self.pace.parts(&self.progress.clock);
            let share = (tick + length) as f64 / ticks as f64;
            let time = duration * ((row - 1) as f64 + share) / rows as f64;
            match self.attempt(row, time) {
                Ok(taken) => {
                    self.accept(taken)?;
                    tick += length;
                }
                Err(Rejected::Failed(error)) => return Err(error.into()),
                Err(Rejected::Unbalanced(reason)) if !self.can_shorten() => {
                    let step = self.progress.history.len();
                    return Err(Stop::End(Termination::NoEquilibrium { step, reason }));
                }
                Err(Rejected::Rounds | Rejected::Free | Rejected::Unbalanced(_)) => {
                    self.shorten()?;
                }
            }
        }
        Ok(())
    }

    /// Whether shorter steps than the present ones are possible, or steps with inertia.
    fn can_shorten(&self) -> bool {
        let most = self.pace.most_halvings(&self.progress.clock);
        !self.pace.has_inertia || self.pace.halvings < most
    }

    /// Halves the steps, or lets the body move where the shortest ones without inertia are too long.
    fn shorten(&mut self) -> Result<(), SetupError> {
        if self.pace.halvings < self.pace.most_halvings(&self.progress.clock) {
            let pace = self.pace.halved();
            if pace.has_inertia {
                return self.change_pace(pace);
            }
            self.pace = pace;
            let equilibrium = &mut self.stepping.equilibrium;
            equilibrium.return_to(&self.here.state);
            return Ok(());
        }
        let time = self.here.state.load_factor;
        let share = self.settings.share_of_statics().unwrap_or_default();
        let text = format!(
            "the body loses its balance: a step without inertia would set free more than {share:.1e} of the work, or let a part slip off another \
             one, so that it moves from here on"
        );
        self.observer
            .message(Message::new("lost-balance", text).at_time(time))?;
        self.progress.moving_since = (time, self.here.broken);
        self.change_pace(Pace::MOTION)
    }

    /// Doubles steps that are calm, or leaves inertia out where the body came to rest; returns whether it did.
    fn lengthen(&mut self, row: usize, tick: usize) -> Result<bool, SetupError> {
        let pace = self.pace;
        let is_aligned = tick.is_multiple_of(2 * pace.parts(&self.progress.clock));
        if pace.halvings > 0 && pace.calm >= pace.calm_enough() && is_aligned {
            let pace = pace.doubled();
            match pace.has_inertia {
                true => self.change_pace(pace)?,
                false => self.pace = pace,
            }
            return Ok(true);
        }
        let is_calm = pace.calm > 0 && pace.calm.is_multiple_of(CALM);
        match self.settings.share_of_statics() {
            Some(share) if pace.has_inertia && pace.halvings == 0 && is_calm => {
                self.come_to_rest(row, tick, share)
            }
            _ => Ok(false),
        }
    }

    /// Takes steps with the equations of another pace from here on.
    fn change_pace(&mut self, pace: Pace) -> Result<(), SetupError> {
        self.pace = pace;
        let clock = &self.progress.clock;
        let scheme = scheme(self.settings, clock, pace);
        let of_state = (&mut self.here.state, self.settings);
        let stepping = Stepping::new(&self.problem, scheme, &self.masses, of_state)?;
        let costs = self.stepping.costs();
        self.stepping = Stepping { costs, ..stepping };
        Ok(())
    }

    /// Leaves inertia out, if the body with its present bonds has an equilibrium at this time that is as near as `share` of the energy; returns
    /// whether it has.
    fn come_to_rest(&mut self, row: usize, tick: usize, share: f64) -> Result<bool, SetupError> {
        let rounding = quasi_static::rounding(&self.stepping.equilibrium, &self.here.balanced);
        let most = (share * self.energy_given()).max(rounding);
        let kinetic = self.progress.motion.kinetic_energy;
        if kinetic > most {
            return Ok(false);
        }
        let pace = self.pace;
        let time = self.here.state.load_factor;
        self.change_pace(quasi_static::pace_from(tick, &self.progress.clock))?;
        let taken = match self.attempt(row, time) {
            Err(Rejected::Failed(error)) => return Err(error),
            taken => taken.ok(),
        };
        let problem = &self.problem.problem;
        let is_near = |taken: &TrialStep| {
            let free = quasi_static::set_free(problem, &self.energies, &self.here, taken);
            taken.broken.is_empty() && kinetic + free <= most
        };
        let Some(taken) = taken.filter(is_near) else {
            self.change_pace(Pace { calm: 0, ..pace })?;
            return Ok(false);
        };
        let before = self.in_bonds();
        self.accept(taken)?;
        self.progress.motion.damping_energy += kinetic + self.in_bonds() - before;
        let (since, before) = self.progress.moving_since;
        let broken = self.here.broken - before;
        let text = format!(
            "the body is at rest again, after a motion of {:.3e} s in which {broken} bonds broke",
            time - since
        );
        self.observer
            .message(Message::new("at-rest", text).at_time(time))?;
        Ok(true)
    }

    /// Work less the energies of bonds and contacts, J.
    fn in_bonds(&self) -> f64 {
        let Energies {
            external_work,
            released,
            ..
        } = self.energies;
        let friction = self.progress.motion.friction_energy;
        external_work - self.here.balanced.stored_energy - released - friction
    }

    /// Largest energy that the body was given so far, J.
    fn energy_given(&self) -> f64 {
        let initial = self.progress.motion.initial_energy;
        self.energies.largest_work().max(initial)
    }

    fn inertia(&self) -> MassAndDamping<'_> {
        MassAndDamping {
            problem: &self.problem,
            masses: &self.masses,
            damping: self.settings.damping,
        }
    }

    /// A step to a time, without effect on the motion; the reason why it is too long, if it is.
    fn attempt(&mut self, row: usize, time: f64) -> Result<TrialStep, Rejected> {
        let loads = self.stepping.loads(&self.here, self.inertia());
        let trial = StepSettings {
            row,
            broken: self.here.broken,
            rule: self.settings.breakages.rule,
            rounds: self.can_shorten().then_some(self.settings.breakages.rounds),
        };
        let equilibrium = &mut self.stepping.equilibrium;
        equilibrium.load_with(loads);
        let start = State {
            load_factor: time,
            ..self.here.state.clone()
        };
        let start = (start, self.here.balanced.clone());
        let problem = &self.problem.problem;
        let taken = trial_step::attempt(problem, equilibrium, start, &trial)?;
        let Some(share) = self
            .settings
            .share_of_statics()
            .filter(|_| !self.pace.has_inertia)
        else {
            return Ok(taken);
        };
        let problem = &self.problem.problem;
        let free = quasi_static::set_free(problem, &self.energies, &self.here, &taken);
        let work = (self.energies).work_to(problem, &taken.state, &taken.balanced);
        let given = self.energies.external_work + work;
        let equilibrium = &self.stepping.equilibrium;
        let rounding = quasi_static::rounding(equilibrium, &taken.balanced);
        let both = [&self.here.state, &taken.state];
        let slips = quasi_static::slips(problem, equilibrium.size(), both);
        if !slips && free <= (share * self.energy_given().max(given)).max(rounding) {
            return Ok(taken);
        }
        Err(Rejected::Free)
    }

    /// Accepts a step, with its energies.
    fn accept(&mut self, taken: TrialStep) -> Result<(), SetupError> {
        let problem = &self.problem.problem;
        self.observer.broke(&taken.records)?;
        let expansion = problem.loads.thermal_strain(taken.state.load_factor);
        let (system, before) = (&*problem.system, &self.here.state);
        let breakage = match taken.broken.is_empty() {
            true => Breakage::default(),
            false => Breakage::new(system, expansion, before, &taken.broken),
        };
        let motion = self.stepping.after(&self.here, &taken, self.inertia());
        if self.pace.has_inertia {
            let way = |dof: usize| taken.state.displacement[dof] - before.displacement[dof];
            let both = [&self.here.motion, &motion];
            let dissipates = self.settings.dissipation > 0.0;
            let damped = self.inertia().damped(both, &way, dissipates);
            self.progress.motion.damping_energy += damped;
        }
        self.progress.motion.kinetic_energy = motion.kinetic_energy(&self.masses);
        self.move_rigid_bodies(&taken, &motion);
        self.progress.motion.time_steps += 1;
        self.pace.calm = if taken.broken.is_empty() {
            self.pace.calm + 1
        } else {
            0
        };
        self.here = MotionState {
            broken: self.here.broken + taken.broken.len(),
            state: taken.state,
            balanced: taken.balanced,
            motion,
        };
        let problem = &self.problem.problem;
        self.here.balance_forces(problem, &self.masses);
        let (
            problem,
            MotionState {
                state, balanced, ..
            },
        ) = (&self.problem.problem, &self.here);
        (self.energies).account(problem, (state, balanced), &breakage);
        if self.pace.has_inertia {
            let (at, motion) = ((state, balanced), &mut self.progress.motion);
            (self.energies).add_contact_in_motion(problem, at, &breakage.bonds, motion);
        } else {
            let taken = (self.energies).add_contact(problem, state, &breakage, balanced);
            let motion = &mut self.progress.motion;
            motion.friction_energy += taken.friction_energy;
            motion.contact_energy = taken.contact_energy;
        }
        Ok(())
    }

    /// Adds the energies of the rigid bodies with a mass in a step.
    fn move_rigid_bodies(&mut self, taken: &TrialStep, after: &Motion) {
        let contact = &self.problem.problem.contact;
        let kinetic = |it: &Motion| contact.kinetic_energy(0.0, &it.rigid);
        let [before, now] = [&self.here.motion, after].map(kinetic);
        let motion = &mut self.progress.motion;
        motion.kinetic_energy += now;
        if self.settings.dissipation > 0.0 {
            let here = (&self.here.state, &self.here.balanced);
            let work = rigid_step::work(contact, here, (&taken.state, &taken.balanced));
            motion.damping_energy += work - (now - before);
        }
    }

    /// Records the present time as a row, and stops where the motion ends there.
    fn record(&mut self) -> Result<(), Stop> {
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
        let rounding = match problem.problem.contact.is_empty() {
            true => 0.0,
            false => quasi_static::rounding(&stepping.equilibrium, &here.balanced),
        };
        let now = MotionView {
            rounding,
            ..stepping.now(&problem.problem, here, (energies, &costs))
        };
        let stop = (&self.settings.stop, self.started);
        let pace = self.pace;
        let checkpoint = |progress: &Progress, out: &mut dyn Sink| {
            let state = |out: &mut dyn Sink| {
                ImplicitMotion::write(&problem.problem, here, (stepping, pace), out);
            };
            progress.write_all(energies, IMPLICIT, &state, out);
        };
        now.record(progress, stop, *observer, &checkpoint)
    }
}

/// Refuses what implicit steps cannot follow.
pub(super) fn check(problem: &MotionProblem, settings: &MotionSettings) -> Result<(), MotionError> {
    let Problem {
        system,
        criteria,
        loads,
        ..
    } = &problem.problem;
    if !system.subdomain.is_whole() {
        return Err(MotionError::SeveralProcesses);
    }
    let is_free = |it: &RigidBody| matches!(it.motion, RigidMotion::Free { .. });
    let turns = |it: &RigidBody| match it.motion {
        RigidMotion::Free { inertia, .. } => inertia.is_finite(),
        RigidMotion::Prescribed { .. } => false,
    };
    let bodies = &problem.problem.contact.rigid_bodies;
    let is_refused =
        bodies.iter().any(turns) || criteria.soften() || settings.share_of_statics().is_some();
    if bodies.iter().any(is_free) && is_refused {
        return Err(MotionError::FreeRigidBody);
    }
    let is_heated = !loads.temperature_change(0.0).is_empty();
    let is_plain = system.element.is_linear()
        && !problem.problem.may_press()
        && !criteria.soften()
        && !is_heated;
    if settings.damping.stiffness > 0.0 && !is_plain {
        return Err(MotionError::StiffnessDamping);
    }
    let step = Clock::implicit(settings)?.step();
    settings.damping.check(step)
}
