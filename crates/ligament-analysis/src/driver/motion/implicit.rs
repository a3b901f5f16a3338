//! Implicit motion by Newmark's scheme ([`newmark`](super::newmark)), with ordered breaking in each step as in load steps.
//!
//! A step is an equilibrium of the bonds under the loads at its end and between the springs of the inertia; the factor of the stiffness serves
//! all steps of one length. A step that does not converge, or in which bonds break round after round, is halved and taken again. The scheme `auto`
//! leaves inertia out as long as the body keeps its balance ([`quasi_static`]).
//!
//! Points with a prescribed motion have no mass here: the trapezoidal rule would let the acceleration of a prescribed motion ring.

use std::io::Read;
use std::sync::Arc;

use super::clock::{CALM, Clock, HALVINGS, Pace};
use super::newmark::{Newmark, StepLoads};
use super::rates::{MassAndDamping, Motion};
use super::record::RowInTime;
use super::trial_step::{self, Rejected, TrialStep};
use super::{quasi_static, rigid_step};
use crate::balanced::Balanced;
use crate::breakage::Breakage;
use crate::checkpoint::CheckpointError;
use crate::contact::{RigidBody, RigidMotion};
use crate::driver::checkpoint::{Restored, RestoredRun, WayKind};
use crate::driver::energies::Energies;
use crate::driver::record::ElasticAnswer;
use crate::driver::run::Run;
use crate::driver::way::{Outcome, Rows, Stop, Way};
use crate::equilibrium::Equilibrium;
use crate::error::SetupError;
use crate::history::{Observer, StepRecord, Termination};
use crate::load_program::LoadProgram;
use crate::motion::{MotionError, MotionProblem, MotionSettings};
use crate::problem::Problem;
use crate::restraints::Restraints;
use crate::softening::Softening;
use crate::state::State;
use crate::user_message::Message;

/// Motion in implicit steps.
pub(super) struct ImplicitSteps<'a> {
    /// Run with the equations of a step at the present pace.
    run: Run<'a>,
    settings: MotionSettings,
    body: MassAndDamping,
    clock: Clock,
    pace: Pace,
    /// Restraints of a step at the present pace.
    restraints: Arc<Restraints>,
    /// Deformations and energy of the bonds at the time of the state; its forces are those that supports and loads balance.
    balanced: Balanced,
    motion: Motion,
    /// Time at which the body last lost its balance, s, with the number of bonds broken before.
    moving_since: (f64, usize),
}

/// Position of a motion at a row of its history.
type AtRow = (Clock, Pace, (f64, usize), Motion);

/// Begins a motion at time zero.
pub(super) fn begin<'a>(
    problem: &MotionProblem,
    settings: &MotionSettings,
    observer: &'a mut dyn Observer,
) -> Result<ImplicitSteps<'a>, SetupError> {
    check(problem, settings)?;
    let clock = Clock::implicit(settings)?;
    if settings.share_of_statics().is_none() {
        observer.begins(clock.ahead(true));
    }
    let MotionProblem {
        problem: of_body,
        initial_velocity,
        ..
    } = problem;
    let mut state = State::fresh(&*of_body.system);
    of_body.loads.prescribe(0.0, &mut state.displacement);
    let n_bonds = state.intact.len();
    state.softening = Softening::of_sound_bonds(&of_body.criteria, n_bonds);
    let body = MassAndDamping::new(problem, settings);
    let pace = quasi_static::first_pace(problem, settings);
    let of_step = problem_of_step(&body, scheme(settings, &clock, pace));
    let mut equations = equations(&of_step, settings, &mut state)?;
    let balanced = equations.measured(&mut state);
    let (stop, elastic) = (settings.stop.into(), ElasticAnswer::UNKNOWN);
    let mut steps = ImplicitSteps {
        run: Run::new(of_body, (equations, state), elastic, stop, observer),
        settings: settings.clone(),
        motion: Motion::with_velocity(initial_velocity.to_vec(), &balanced),
        restraints: of_step.loads.restraints().clone(),
        moving_since: (0.0, 0),
        body,
        clock,
        pace,
        balanced,
    };
    steps.begin_to_move();
    Ok(steps)
}

/// Restores a motion from a checkpoint.
pub(super) fn restore(
    problem: &MotionProblem,
    settings: &MotionSettings,
    checkpoint: &mut dyn Read,
) -> Result<Restored, SetupError> {
    let clock = Clock::implicit(settings)?;
    let body = MassAndDamping::new(problem, settings);
    let scheme = |pace| scheme(settings, &clock, pace);
    let n_rigid = problem.problem.contact.rigid_bodies.len();
    let restored = RestoredRun::read(
        WayKind::Newmark,
        &problem.problem,
        checkpoint,
        |(_, (clock_then, pace, _, motion)): (_, &AtRow), numbered, from| {
            if *clock_then != clock {
                return Err(CheckpointError::OtherTimes.into());
            }
            let has_rates = motion.rigid.is_empty() || motion.rigid.len() == n_rigid;
            let fits = motion.fits(body.masses.len()) && has_rates;
            if !fits || pace.halvings > pace.most_halvings(&clock) {
                return Err(CheckpointError::OtherModel.into());
            }
            let of_step = problem_of_step(&body, scheme(*pace));
            let tolerance = settings.breakages.energy_tolerance;
            Equilibrium::restored(&of_step, tolerance, numbered, from)
        },
    )?;
    let of_step = problem_of_step(&body, scheme(restored.position.1));
    let settings = settings.clone();
    Ok(Restored::new(restored, move |restored, observer| {
        let (run, balanced, (clock, pace, moving_since, motion)) =
            Run::go_on(settings.stop.into(), restored, observer);
        let mut steps = ImplicitSteps {
            restraints: of_step.loads.restraints().clone(),
            run,
            settings,
            body,
            clock,
            pace,
            balanced,
            motion,
            moving_since,
        };
        steps.balance_forces();
        Box::new(steps)
    }))
}

/// Scheme of steps at a pace; None without inertia.
fn scheme(settings: &MotionSettings, clock: &Clock, pace: Pace) -> Option<Newmark> {
    pace.has_inertia.then(|| Newmark {
        step: clock.step() / f64::from(1_u32 << pace.halvings),
        dissipation: settings.dissipation,
        damping: settings.damping,
    })
}

/// Problem of a step of a scheme; that of the body without one.
fn problem_of_step(body: &MassAndDamping, scheme: Option<Newmark>) -> Problem {
    let problem = &body.problem.problem;
    let Some(scheme) = scheme else {
        return problem.clone();
    };
    let loads = StepLoads {
        base: problem.loads.clone(),
        restraints: Arc::new(scheme.restraints(&body.problem, &body.masses)),
        factor: 1.0 / scheme.of_stiffness(),
        added: vec![0.0; body.masses.len()],
        rigid: rigid_step::loads(&problem.contact, &scheme, None),
    };
    Problem {
        loads: Arc::new(loads),
        ..problem.clone()
    }
}

/// Equations of the problem of a step, for the bonds of a state.
fn equations(
    of_step: &Problem,
    settings: &MotionSettings,
    state: &mut State,
) -> Result<Equilibrium, SetupError> {
    let mut equations = Equilibrium::new(of_step, settings.breakages.energy_tolerance)?;
    let broken = (0..).zip(&state.intact).filter(|(_, intact)| !**intact);
    let broken: Vec<u32> = broken.map(|(bond, _)| bond).collect();
    for &bond in &broken {
        state.intact[bond as usize] = true;
    }
    state.held.fill(false);
    equations.break_bonds(state, &broken);
    if !state.softening.remaining.is_empty() {
        equations.soften();
    }
    Ok(equations)
}

impl Way for ImplicitSteps<'_> {
    /// Takes steps up to the next row of the history; stops where a step does not converge however small it is.
    fn advance(&mut self) -> Result<(), Stop> {
        self.record()?;
        let row = self.run.progress.history.len();
        self.run.enter(row, 0)?;
        let Clock {
            steps_per_row,
            rows,
            duration,
        } = self.clock;
        let (mut tick, ticks) = (0, steps_per_row << HALVINGS);
        while tick < ticks {
            if self.lengthen(tick)? {
                continue;
            }
            let length = self.pace.parts(&self.clock);
            let share = (tick + length) as f64 / ticks as f64;
            let time = duration * ((row - 1) as f64 + share) / rows as f64;
            match self.attempt(time) {
                Ok(trial) => {
                    self.accept(trial)?;
                    tick += length;
                }
                Err(Rejected::Failed(error)) => return Err(error.into()),
                Err(Rejected::Unbalanced(reason)) if !self.can_shorten() => {
                    return Err(Stop::End(Termination::NoEquilibrium { step: row, reason }));
                }
                Err(Rejected::Rounds | Rejected::Free | Rejected::Unbalanced(_)) => {
                    self.shorten()?;
                }
            }
        }
        Ok(())
    }

    fn now(&self) -> (&State, &[StepRecord]) {
        self.run.now()
    }

    fn outcome(self: Box<Self>, end: Termination) -> Result<Outcome, SetupError> {
        Ok(self.run.into_outcome(end, Rows::Times))
    }
}

impl ImplicitSteps<'_> {
    /// Sets accelerations and energies of time zero.
    fn begin_to_move(&mut self) {
        let (body, motion) = (&self.body, &mut self.motion);
        let (external, damping) = body.forces(&self.run.state, &motion.velocity);
        for (dof, &mass) in body.masses.iter().enumerate() {
            if mass > 0.0 {
                let force = external[dof] - motion.internal[dof] - damping[dof];
                motion.acceleration[dof] = force / mass;
            } else {
                motion.velocity[dof] = 0.0;
            }
        }
        (motion.external, motion.damping) = (external, damping);
        let contact = &self.run.problem.contact;
        motion.rigid = contact.rates_at_start(&self.balanced.touching);
        let rigid = contact.kinetic_energy(0.0, &motion.rigid);
        let kinetic = motion.kinetic_energy(&body.masses) + rigid;
        self.balance_forces();
        let run = &mut self.run;
        let at = (&run.state, &self.balanced);
        (run.energies).account(&run.problem, at, &Breakage::default());
        run.energies.motion.initial_energy = kinetic + self.balanced.stored_energy;
        run.energies.motion.kinetic_energy = kinetic;
    }

    fn balance_forces(&mut self) {
        let internal = &mut self.balanced.internal.values;
        self.body.balance_forces(&self.motion, internal);
    }

    fn scheme(&self) -> Option<Newmark> {
        scheme(&self.settings, &self.clock, self.pace)
    }

    /// Whether shorter steps than the present ones are possible, or steps with inertia.
    fn can_shorten(&self) -> bool {
        let most = self.pace.most_halvings(&self.clock);
        !self.pace.has_inertia || self.pace.halvings < most
    }

    /// Halves the steps, or lets the body move where the shortest ones without inertia are too long.
    fn shorten(&mut self) -> Result<(), SetupError> {
        if self.pace.halvings < self.pace.most_halvings(&self.clock) {
            let pace = self.pace.halved();
            if pace.has_inertia {
                return self.change_pace(pace);
            }
            self.pace = pace;
            self.run.equations.return_to(&self.run.state);
            return Ok(());
        }
        let time = self.run.state.load_factor;
        let share = self.settings.share_of_statics().unwrap_or_default();
        let text = format!(
            "the body loses its balance: a step without inertia would set free more than {share:.1e} of the work, or let a part slip off another \
             one, so that it moves from here on"
        );
        self.run
            .observer
            .message(Message::new("lost-balance", text).at_time(time))?;
        self.moving_since = (time, self.run.progress.broken);
        self.change_pace(Pace::MOTION)
    }

    /// Doubles steps that are calm, or leaves inertia out where the body came to rest; returns whether it did.
    fn lengthen(&mut self, tick: usize) -> Result<bool, SetupError> {
        let pace = self.pace;
        let is_aligned = tick.is_multiple_of(2 * pace.parts(&self.clock));
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
                self.come_to_rest(tick, share)
            }
            _ => Ok(false),
        }
    }

    /// Takes steps with the equations of another pace from here on.
    fn change_pace(&mut self, pace: Pace) -> Result<(), SetupError> {
        self.pace = pace;
        let of_step = problem_of_step(&self.body, self.scheme());
        let mut equations = equations(&of_step, &self.settings, &mut self.run.state)?;
        equations.add_costs(self.run.equations.costs());
        self.restraints = of_step.loads.restraints().clone();
        self.run.equations = equations;
        Ok(())
    }

    /// Leaves inertia out, if the body with its present bonds has an equilibrium at this time that is as near as `share` of the energy; returns
    /// whether it has.
    fn come_to_rest(&mut self, tick: usize, share: f64) -> Result<bool, SetupError> {
        let rounding = quasi_static::rounding(&self.run.equations, &self.balanced);
        let most = (share * self.energy_given()).max(rounding);
        let kinetic = self.run.energies.motion.kinetic_energy;
        if kinetic > most {
            return Ok(false);
        }
        let pace = self.pace;
        let time = self.run.state.load_factor;
        self.change_pace(quasi_static::pace_from(tick, &self.clock))?;
        let trial = match self.attempt(time) {
            Err(Rejected::Failed(error)) => return Err(error),
            trial => trial.ok(),
        };
        let is_near = |trial: &TrialStep| {
            let free = quasi_static::set_free(&self.run, &self.balanced, trial);
            trial.broken.is_empty() && kinetic + free <= most
        };
        let Some(trial) = trial.filter(is_near) else {
            self.change_pace(Pace { calm: 0, ..pace })?;
            return Ok(false);
        };
        let before = self.in_bonds();
        self.accept(trial)?;
        self.run.energies.motion.damping_energy += kinetic + self.in_bonds() - before;
        let (since, before) = self.moving_since;
        let broken = self.run.progress.broken - before;
        let text = format!(
            "the body is at rest again, after a motion of {:.3e} s in which {broken} bonds broke",
            time - since
        );
        self.run
            .observer
            .message(Message::new("at-rest", text).at_time(time))?;
        Ok(true)
    }

    /// Work less the energies of bonds and contacts, J.
    fn in_bonds(&self) -> f64 {
        let Energies {
            external_work,
            released,
            friction,
            ..
        } = self.run.energies;
        external_work - self.balanced.stored_energy - released - friction
    }

    /// Largest energy that the body was given so far, J.
    fn energy_given(&self) -> f64 {
        let initial = self.run.energies.motion.initial_energy;
        self.run.energies.largest_work().max(initial)
    }

    /// A step to a time, without effect on the motion; the reason why it is too long, if it is.
    fn attempt(&mut self, time: f64) -> Result<TrialStep, Rejected> {
        let breakages = &self.settings.breakages;
        let most = self.can_shorten().then_some(breakages.rounds);
        let loads = self.loads();
        self.run.equations.load_with(loads);
        let trial = trial_step::attempt(&mut self.run, time, &breakages.rule, most)?;
        let share = self.settings.share_of_statics();
        let Some(share) = share.filter(|_| !self.pace.has_inertia) else {
            return Ok(trial);
        };
        let Run {
            problem,
            equations,
            energies,
            state,
            ..
        } = &self.run;
        let free = quasi_static::set_free(&self.run, &self.balanced, &trial);
        let work = energies.work_to(problem, &trial.state, &trial.balanced);
        let given = energies.external_work + work;
        let rounding = quasi_static::rounding(equations, &trial.balanced);
        let slips = quasi_static::slips(problem, equations.size(), [state, &trial.state]);
        if !slips && free <= (share * self.energy_given().max(given)).max(rounding) {
            return Ok(trial);
        }
        Err(Rejected::Free)
    }

    /// Accepts a step, with its energies.
    fn accept(&mut self, trial: TrialStep) -> Result<(), SetupError> {
        self.run.observer.broke(&trial.records)?;
        let (before, system) = (&self.run.state, &*self.run.problem.system);
        let expansion = self
            .run
            .problem
            .loads
            .thermal_strain(trial.state.load_factor);
        let breakage = match trial.broken.is_empty() {
            true => Breakage::default(),
            false => Breakage::new(system, expansion, before, &trial.broken),
        };
        let after = self.after(&trial);
        let dissipates = self.settings.dissipation > 0.0;
        let motion = &mut self.run.energies.motion;
        if self.pace.has_inertia {
            let way = |dof: usize| trial.state.displacement[dof] - before.displacement[dof];
            let both = [&self.motion, &after];
            motion.damping_energy += self.body.damped(both, &way, dissipates);
        }
        motion.kinetic_energy = after.kinetic_energy(&self.body.masses);
        // The energies of rigid bodies with a mass.
        let contact = &self.run.problem.contact;
        let of_rigid = |it: &Motion| contact.kinetic_energy(0.0, &it.rigid);
        let [rigid_before, rigid] = [&self.motion, &after].map(of_rigid);
        motion.kinetic_energy += rigid;
        if dissipates {
            let both = [(before, &self.balanced), (&trial.state, &trial.balanced)];
            let work = rigid_step::work(contact, both[0], both[1]);
            motion.damping_energy += work - (rigid - rigid_before);
        }
        motion.time_steps += 1;
        self.pace.calm = if trial.broken.is_empty() {
            self.pace.calm + 1
        } else {
            0
        };
        self.run.progress.broken += trial.broken.len();
        self.run.state = trial.state;
        (self.balanced, self.motion) = (trial.balanced, after);
        self.balance_forces();
        let run = &mut self.run;
        let (energies, at) = (&mut run.energies, (&run.state, &self.balanced));
        energies.account(&run.problem, at, &breakage);
        match self.pace.has_inertia {
            true => energies.add_contact_in_motion(&run.problem, at, &breakage.bonds),
            false => energies.add_contact(&run.problem, &run.state, &breakage, &self.balanced),
        }
        Ok(())
    }

    /// Loads of a step from the present time.
    fn loads(&self) -> Arc<dyn LoadProgram> {
        let (body, problem, state) = (&self.body, &self.run.problem, &self.run.state);
        let base = problem.loads.clone();
        let Some(scheme) = &self.scheme() else {
            return base;
        };
        let Motion {
            velocity,
            acceleration,
            internal,
            external,
            damping,
            rigid,
        } = &self.motion;
        let (dt, beta, gamma) = (scheme.step, scheme.beta(), scheme.gamma());
        let n = velocity.len();
        let mut predicted = vec![0.0; n];
        // Velocity less its change with the displacement times the predicted displacement.
        let mut remaining = vec![0.0; n];
        for dof in 0..n {
            let (v, a) = (velocity[dof], acceleration[dof]);
            predicted[dof] = state.displacement[dof] + dt * v + (0.5 - beta) * dt * dt * a;
            remaining[dof] = v + (1.0 - gamma) * dt * a - scheme.velocity() * predicted[dof];
        }
        let mut added = body.damping_forces(state, &remaining);
        let factor = 1.0 / scheme.of_stiffness();
        let of_mass = scheme.acceleration() / (1.0 - scheme.dissipation);
        for (dof, sum) in added.iter_mut().enumerate() {
            let mass = body.masses[dof];
            let at_start = damping[dof] + internal[dof] - external[dof];
            let force = mass * of_mass * predicted[dof] - scheme.of_start() * at_start - *sum;
            *sum = if mass > 0.0 { factor * force } else { 0.0 };
        }
        let from = Some((state, &self.balanced, &**rigid));
        Arc::new(StepLoads {
            base,
            restraints: self.restraints.clone(),
            factor,
            added,
            rigid: rigid_step::loads(&problem.contact, scheme, from),
        })
    }

    /// Velocities, accelerations and forces after a step.
    fn after(&self, trial: &TrialStep) -> Motion {
        let (body, motion, state) = (&self.body, &self.motion, &self.run.state);
        let n = body.masses.len();
        let mut after = Motion::with_velocity(vec![0.0; n], &trial.balanced);
        let Some(scheme) = &self.scheme() else {
            after.external = body.forces(&trial.state, &after.velocity).0;
            return after;
        };
        let (dt, beta, gamma) = (scheme.step, scheme.beta(), scheme.gamma());
        for dof in (0..n).filter(|&dof| body.masses[dof] > 0.0) {
            let (u, v, a) = (
                state.displacement[dof],
                motion.velocity[dof],
                motion.acceleration[dof],
            );
            let predicted = u + dt * v + (0.5 - beta) * dt * dt * a;
            let now = scheme.acceleration() * (trial.state.displacement[dof] - predicted);
            after.acceleration[dof] = now;
            after.velocity[dof] = v + dt * ((1.0 - gamma) * a + gamma * now);
        }
        (after.external, after.damping) = body.forces(&trial.state, &after.velocity);
        let contact = &self.run.problem.contact;
        after.rigid = rigid_step::after(contact, scheme, (state, &motion.rigid), &trial.state);
        after
    }

    /// Records the present time as a row, and stops where the motion ends there.
    fn record(&mut self) -> Result<(), Stop> {
        let Self {
            run,
            balanced,
            motion,
            clock,
            ..
        } = self;
        let rounding = match run.problem.contact.is_empty() {
            true => 0.0,
            false => quasi_static::rounding(&run.equations, balanced),
        };
        let now = RowInTime {
            clock,
            balanced,
            rates: motion.rates(),
            missed: None,
            below_zero: 0.0,
            rounding,
        };
        let position = (&*clock, &self.pace, &self.moving_since, &*motion);
        run.record_in_time(&now, (WayKind::Newmark, &position))
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
