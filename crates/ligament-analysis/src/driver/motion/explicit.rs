//! Explicit motion by velocity Verlet (central differences), in which all bonds that come to their limits in a time step break in it.
//!
//! A step from t to t' = t + dt: u' = u + dt v+ with the velocities v+ in its middle; deformations and breakages at u'; forces f(u') of the bonds
//! that are left; velocities in the middle of the next step ([`Inertia::advance`]).
//!
//! With the kinetic energy 1/2 v-^T M v+ and the trapezoidal rule for work, damping and released energy the energies balance to rounding for forces
//! that are linear in the displacements: 1/2 (M a + M a')^T (u' - u) is the change of the kinetic energy.

use std::io::Read;
use std::mem;
use std::sync::Arc;
use std::time::Instant;

use ligament_model::element::BondDeformation;
use ligament_model::failure::{CriteriaInState, Criterion};
use ligament_model::parallel;
use ligament_model::product::NearLimits;
use ligament_model::surface::Vector;
use ligament_model::thermal::ThermalStrain;

use super::clock::Clock;
use super::inertia::{Inertia, Velocities};
use super::record::RowInTime;
use crate::balanced::Balanced;
use crate::bond_numbers::BondNumbers;
use crate::breakage::Breakage;
use crate::breaking::{BreakingOrder, BreakingRule, next_of_near};
use crate::checkpoint::CheckpointError;
use crate::connectivity::Fragments;
use crate::connectivity::decremental::Connectivity;
use crate::contact::faces::{self, FacePairs};
use crate::contact::{ContactSearch, LastTouching, RigidRates};
use crate::costs::Costs;
use crate::driver::breaks;
use crate::driver::checkpoint::{NumberedState, Restored, RestoredRun, WayKind};
use crate::driver::equations::{Equations, next_to_break};
use crate::driver::record::ElasticAnswer;
use crate::driver::run::Run;
use crate::driver::way::{Outcome, Rows, Stop, Way};
use crate::error::SetupError;
use crate::history::{Observer, ObserverError, StepRecord, Termination};
use crate::motion::{MotionError, MotionProblem, MotionSettings, critical_step};
use crate::problem::Problem;
use crate::serial::{Serial, Sink};
use crate::softening::Softening;
use crate::solver::{ExplicitChoice, SolverChoice};
use crate::state::State;
use crate::unbalanced::Unbalanced;
use crate::vectors::{CHUNK, sum_of_chunks};

/// All bonds at their limits break in a step, with those that differ from the first of them by rounding.
const RULE: BreakingRule = BreakingRule {
    order: BreakingOrder::Ratio,
    bonds_per_iteration: usize::MAX,
    tie_tolerance: 1e-8,
};

/// Largest share of the critical step for the bound of the kinetic energy, which is infinite at the critical step.
///
/// Bound of the kinetic energy: an oscillator of central differences with the phase theta a step, sin(theta/2) = omega dt/2, has the energy
/// e = k A^2/2 cos^2(theta/2). Its kinetic energy 1/2 v- m v+ = k A^2/4 (cos theta - cos 2 n theta) is at least -e tan^2(theta/2), which is
/// -e s^2/(1 - s^2) with s = dt/dt_critical.
const NEARLY_CRITICAL: f64 = 0.999;

/// Motion in explicit steps.
pub(super) struct ExplicitSteps<'a> {
    run: Run<'a, MovingBonds>,
    clock: Clock,
    /// Deformations, forces and energy of the bonds at the time of the state.
    balanced: Balanced,
    velocities: Velocities,
    /// Forces of damping at the time (n_degrees_of_freedom), N and N m; empty where nothing damps.
    damping_forces: Vec<f64>,
    inertia: Inertia,
    /// Damping over stiffness, s.
    beta: f64,
    /// Whether the bonds are linear up to limits of their own, so that one sweep needs no deformations.
    in_one_sweep: bool,
    /// Surfaces that moved through each other unseen in a step so far.
    missed: Option<Unbalanced>,
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
}

/// Position of a motion at a row of its history: times, velocities and forces of damping, and the internal forces on points and rigid bodies, which
/// have inertia and damping in them and do not follow from the state.
type AtRow = (Clock, Velocities, Vec<f64>, Vec<f64>, Vec<Vector>);

/// Begins a motion at time zero.
pub(super) fn begin<'a>(
    problem: &MotionProblem,
    settings: &MotionSettings,
    observer: &'a mut dyn Observer,
) -> Result<ExplicitSteps<'a>, SetupError> {
    let (clock, choice) = chosen(problem, settings)?;
    observer.begins(clock.ahead(false));
    let of_body = &problem.problem;
    let system = &*of_body.system;
    let state = State {
        softening: Softening::of_sound_bonds(&of_body.criteria, system.ends.len()),
        ..State::fresh(system)
    };
    let numbered = (BondNumbers::new(system)?, state);
    let (bonds, state) = MovingBonds::new(of_body, numbered, choice);
    let n = state.displacement.len();
    let velocities = Velocities {
        half: vec![0.0; n],
        acceleration: vec![0.0; n],
        rigid: Vec::new(),
    };
    let (stop, elastic) = (settings.stop.into(), ElasticAnswer::UNKNOWN);
    let run = Run::new(of_body, (bonds, state), elastic, stop, observer);
    let initial = InitialMotion {
        clock,
        velocities,
        damping_forces: Vec::new(),
    };
    let balanced = Balanced::unloaded(system);
    let mut steps = ExplicitSteps::new((problem, settings), run, balanced, initial);
    steps.begin_to_move(&problem.initial_velocity);
    Ok(steps)
}

/// Restores a motion from a checkpoint.
pub(super) fn restore(
    problem: &MotionProblem,
    settings: &MotionSettings,
    checkpoint: &mut dyn Read,
) -> Result<Restored, SetupError> {
    let (clock, choice) = chosen(problem, settings)?;
    let n_rigid = problem.problem.contact.rigid_bodies.len();
    let mut restored = RestoredRun::read(
        WayKind::CentralDifferences,
        &problem.problem,
        checkpoint,
        |(problem, position): (_, &AtRow), numbered, from| {
            let (clock_then, velocities, _, internal, _) = position;
            if *clock_then != clock {
                return Err(CheckpointError::OtherTimes.into());
            }
            let n = problem.system.layout.n_degrees_of_freedom();
            let of_motion = [&velocities.half, &velocities.acceleration, internal];
            let fits = of_motion.iter().all(|it| it.len() == n);
            if !fits || velocities.rigid.len() != n_rigid {
                return Err(CheckpointError::OtherModel.into());
            }
            MovingBonds::restored(problem, numbered, choice, from)
        },
    )?;
    let (.., values, on_rigid_bodies) = &mut restored.position;
    let internal = &mut restored.balanced.internal;
    internal.values = mem::take(values);
    internal.on_rigid_bodies = mem::take(on_rigid_bodies);
    let (problem, settings) = (problem.clone(), settings.clone());
    Ok(Restored::new(restored, move |restored, observer| {
        let (run, balanced, position) = Run::go_on(settings.stop.into(), restored, observer);
        let (clock, velocities, damping_forces, ..) = position;
        let initial = InitialMotion {
            clock,
            velocities,
            damping_forces,
        };
        let mut steps = ExplicitSteps::new((&problem, &settings), run, balanced, initial);
        steps.apply_loads();
        Box::new(steps)
    }))
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

/// Bonds that explicit steps move, without equations.
pub(super) struct MovingBonds {
    numbers: BondNumbers,
    connectivity: Connectivity,
    contact: ContactSearch,
    costs: Costs,
    choice: ExplicitChoice,
}

impl Equations for MovingBonds {
    fn numbers(&self) -> &BondNumbers {
        &self.numbers
    }

    fn fragments(&self) -> &Fragments {
        self.connectivity.fragments()
    }

    fn costs(&self) -> &Costs {
        &self.costs
    }

    fn choice(&self) -> SolverChoice {
        SolverChoice::Explicit(self.choice)
    }

    fn write(&self, out: &mut dyn Sink) {
        self.costs.write(out);
    }
}

impl MovingBonds {
    /// The bonds of a state with their global numbers.
    fn new(
        problem: &Problem,
        (numbers, state): NumberedState,
        choice: ExplicitChoice,
    ) -> (Self, State) {
        let system = &*problem.system;
        let mut contact = ContactSearch::new(problem);
        contact.faces = FacePairs::new(system, &state.intact);
        let numbered = (0..).zip(&state.intact).filter(|it| !it.1);
        contact.surfaces.join(numbered.map(|it| it.0));
        let bonds = Self {
            connectivity: match state.broken_bonds() {
                0 => Connectivity::new(system),
                _ => Connectivity::held(system, &state.intact),
            },
            numbers,
            contact,
            costs: Costs::default(),
            choice,
        };
        (bonds, state)
    }

    /// The bonds of a checkpoint, with their state and its deformations, forces and energy.
    fn restored(
        problem: &Problem,
        numbered: NumberedState,
        choice: ExplicitChoice,
        from: &mut dyn Read,
    ) -> Result<(Self, State, Balanced), SetupError> {
        let system = &*problem.system;
        let (state, contact) = (&numbered.1, &problem.contact);
        let fits = state.fits(system, system.ends.len(), &problem.criteria);
        if !fits || !state.surfaces.fits(contact) {
            return Err(CheckpointError::OtherModel.into());
        }
        let (mut bonds, state) = Self::new(problem, numbered, choice);
        bonds.costs = Serial::read(from).map_err(CheckpointError::Damaged)?;
        let mut balanced = Balanced::unloaded(system);
        bonds.measure(problem, &state, &mut balanced);
        Ok((bonds, state, balanced))
    }

    /// Deformations, forces and energy at the displacements and the time of a state.
    fn measure(&self, problem: &Problem, state: &State, balanced: &mut Balanced) {
        deform(problem, state, balanced);
        self.sum_forces(problem, state, balanced);
        balanced.touching = state.surfaces.shared();
        load_by_surfaces(problem, balanced);
    }

    /// Forces and energy of the bonds and of closed pairs across cracks.
    fn sum_forces(&self, problem: &Problem, state: &State, balanced: &mut Balanced) {
        let expansion = problem.loads.thermal_strain(state.load_factor);
        let deformations = mem::take(&mut balanced.deformations);
        let mut swept = (problem.system).forces(state.bonds(), deformations, expansion);
        balanced.closed = self.contact.closed(state, expansion).1;
        let layout = problem.system.layout;
        faces::add_to(&mut swept, &balanced.closed, layout, expansion);
        balanced.deformations = swept.deformations;
        balanced.internal = swept.internal;
        balanced.stored_energy = swept.stored_energy;
    }
}

/// Deformations of the bonds in a state.
fn deform(problem: &Problem, state: &State, balanced: &mut Balanced) {
    let expansion = problem.loads.thermal_strain(state.load_factor);
    let (intact, displacement) = (&state.intact, &state.displacement);
    // Its memory returns to the pool before the new deformations need some.
    balanced.deformations = Default::default();
    balanced.deformations = (problem.system).deformations(intact, displacement, expansion);
    balanced.forget_stresses();
}

/// Adds the forces of contact between surfaces to the internal forces.
fn load_by_surfaces(problem: &Problem, balanced: &mut Balanced) {
    let (touching, internal) = (&balanced.touching, &mut balanced.internal);
    touching.add_forces(&problem.contact, -1.0, &mut internal.values);
    internal.on_rigid_bodies = touching.forces_on_rigid_bodies(&problem.contact);
}

/// Whether the bonds of a problem are linear up to limits of their own.
fn in_one_sweep(problem: &Problem) -> bool {
    let Problem {
        system,
        criteria,
        loads,
        ..
    } = problem;
    let is_plain = |it: &Criterion| it.after.is_brittle() && it.surroundings.is_none();
    let are_plain = criteria.list.iter().all(is_plain);
    let is_cold = loads.temperature_change(0.0).is_empty();
    let is_linear = system.element.is_linear() && !system.faces_close;
    are_plain && is_cold && is_linear
}

/// Clock, velocities and damping forces at the start of a motion, or where it continues.
struct InitialMotion {
    clock: Clock,
    velocities: Velocities,
    damping_forces: Vec<f64>,
}

impl<'a> ExplicitSteps<'a> {
    fn new(
        (problem, settings): (&MotionProblem, &MotionSettings),
        run: Run<'a, MovingBonds>,
        balanced: Balanced,
        initial: InitialMotion,
    ) -> Self {
        let step = run.equations.choice.step;
        let loads = &problem.problem.loads;
        let n = run.state.displacement.len();
        let beta = settings.damping.stiffness;
        Self {
            inertia: Inertia::new(
                problem,
                settings.rotary_inertia,
                settings.damping.mass,
                step,
            ),
            in_one_sweep: in_one_sweep(&problem.problem),
            loaded: loads.loaded_degrees_of_freedom(),
            external: vec![0.0; n],
            restraining: vec![0.0; if loads.restraints().is_empty() { 0 } else { n }],
            ahead: vec![0.0; n],
            damped: vec![0.0; if beta > 0.0 { n } else { 0 }],
            missed: None,
            run,
            clock: initial.clock,
            balanced,
            velocities: initial.velocities,
            damping_forces: initial.damping_forces,
            beta,
        }
    }

    /// Sets the velocities and the energies of time zero.
    fn begin_to_move(&mut self, velocity: &[f64]) {
        let Run {
            problem,
            equations,
            state,
            ..
        } = &mut self.run;
        problem.loads.prescribe(0.0, &mut state.displacement);
        equations.measure(problem, state, &mut self.balanced);
        // Contact begins without force where surfaces overlap.
        if !problem.contact.is_empty() {
            state.surfaces = LastTouching::new(Arc::default(), &state.displacement);
        }
        self.touch(0.0);
        let contact = &self.run.problem.contact;
        self.velocities.rigid = contact.rates_at_start(&self.balanced.touching);
        self.apply_loads();
        let internal = &self.balanced.internal.values;
        let forces = self.external.iter().zip(internal);
        let unbalanced: Vec<f64> = forces.map(|(given, inner)| given - inner).collect();
        self.velocities.half = self.inertia.before_start(velocity, &unbalanced);
        for &dof in self.inertia.prescribed() {
            let dof = dof as usize;
            let way = self.ahead[dof] - self.run.state.displacement[dof];
            self.velocities.half[dof] = way / self.inertia.step();
        }
        self.accelerate();
        let initial_energy = self.kinetic_energy() + self.balanced.stored_energy;
        let run = &mut self.run;
        let at = (&run.state, &self.balanced);
        (run.energies).account(&run.problem, at, &Breakage::default());
        // The first step continues from the contact at the start, which has no energy.
        run.energies.follow_surfaces(&run.problem, &run.state);
        run.energies.motion.initial_energy = initial_energy;
        self.damp();
    }
}

impl Way for ExplicitSteps<'_> {
    fn advance(&mut self) -> Result<(), Stop> {
        self.record()?;
        let row = self.run.progress.history.len();
        self.run.enter(row, 0)?;
        for _ in 0..self.clock.steps_per_row {
            self.step(row)?;
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

impl ExplicitSteps<'_> {
    /// Records the present time as a row, and stops where the motion ends there.
    fn record(&mut self) -> Result<(), Stop> {
        self.run.energies.motion.kinetic_energy = self.kinetic_energy();
        let Self {
            run,
            clock,
            balanced,
            velocities,
            damping_forces,
            ..
        } = self;
        let of_critical = run.equations.choice.of_critical();
        let square = of_critical.min(NEARLY_CRITICAL).powi(2);
        let velocity = velocities.at_time(self.inertia.step());
        let now = RowInTime {
            clock,
            balanced,
            rates: velocities.rates(&velocity),
            missed: self.missed.as_ref(),
            below_zero: square / (1.0 - square),
            rounding: 0.0,
        };
        let internal = &balanced.internal;
        let position = (
            &*clock,
            &*velocities,
            &*damping_forces,
            &internal.values,
            &internal.on_rigid_bodies,
        );
        run.record_in_time(&now, (WayKind::CentralDifferences, &position))
    }

    /// One time step on the way to a row of the history.
    fn step(&mut self, row: usize) -> Result<(), SetupError> {
        let motion = &mut self.run.energies.motion;
        motion.time_steps += 1;
        let number = motion.time_steps;
        self.run.state.load_factor = self.clock.time(number);
        self.displace();
        let start = Instant::now();
        // Deformations and the energy of the bonds are asked for at rows alone.
        let is_row = number == row * self.clock.steps_per_row;
        let breakage = match self.in_one_sweep && !is_row {
            true => self.move_in_one_sweep([row, number])?,
            false => self.move_with_deformations([row, number])?,
        };
        self.run.equations.costs.bonds += start.elapsed();
        self.touch(self.inertia.step());
        self.apply_loads();
        self.accelerate();
        let run = &mut self.run;
        let (energies, at) = (&mut run.energies, (&run.state, &self.balanced));
        energies.account(&run.problem, at, &breakage);
        energies.add_contact_in_motion(&run.problem, at, &breakage.bonds);
        self.damp();
        Ok(())
    }

    /// Moves the points by their velocities in the middle of the step, or as prescribed.
    fn displace(&mut self) {
        let step = self.inertia.step();
        let displacement = &mut self.run.state.displacement;
        let chunks = displacement.chunks_mut(CHUNK);
        let chunks = chunks.zip(self.velocities.half.chunks(CHUNK));
        parallel::for_each(chunks, |(displacement, half)| {
            for (displacement, velocity) in displacement.iter_mut().zip(half) {
                *displacement += step * velocity;
            }
        });
        for &dof in self.inertia.prescribed() {
            displacement[dof as usize] = self.ahead[dof as usize];
        }
    }

    /// Computes the forces at the displacements and the time of the state with deformations and energy, and breaks the bonds that have come to their
    /// limits.
    fn move_with_deformations(&mut self, at: [usize; 2]) -> Result<Breakage, SetupError> {
        deform(&self.run.problem, &self.run.state, &mut self.balanced);
        self.soften();
        let Run {
            problem,
            equations,
            state,
            ..
        } = &self.run;
        let bonds = next_to_break(problem, equations, &RULE, (state, &self.balanced));
        let mut breakage = Breakage::default();
        if !bonds.is_empty() {
            let problem = problem.clone();
            let criteria = problem.criteria_in(state, &self.balanced);
            let of_bond = |&bond: &u32| self.balanced.deformations[bond as usize];
            let deformations: Vec<BondDeformation> = bonds.iter().map(of_bond).collect();
            breakage = self.break_bonds((&bonds, &deformations), &criteria, at)?;
            if breakage.n_elements() != bonds.len() {
                deform(&problem, &self.run.state, &mut self.balanced);
            }
        }
        let Run {
            problem,
            equations,
            state,
            ..
        } = &self.run;
        equations.sum_forces(problem, state, &mut self.balanced);
        Ok(breakage)
    }

    /// Moves bonds that are linear until they break by limits of their own, without storing their deformations; these and the energy stay those of
    /// an earlier time.
    fn move_in_one_sweep(&mut self, at: [usize; 2]) -> Result<Breakage, SetupError> {
        let problem = self.run.problem.clone();
        let (system, criteria) = (&*problem.system, &*problem.criteria);
        let State {
            intact,
            displacement,
            ..
        } = &self.run.state;
        let limits = NearLimits {
            criteria,
            factor: RULE.near(),
        };
        let forces = &mut self.balanced.internal.values;
        let bonds = self.run.state.bonds();
        let near = system.forces_near_limits(bonds, displacement, limits, forces);
        if near.is_empty() {
            return Ok(Breakage::default());
        }
        let measured = system.measured(intact, displacement, &near);
        let near: Vec<(u32, BondDeformation)> = near.into_iter().zip(measured).collect();
        let in_file = |bond| system.ends_in_file(bond);
        let criteria = criteria.without_state();
        let bonds = next_of_near(&RULE, &near, &criteria, in_file);
        if bonds.is_empty() {
            return Ok(Breakage::default());
        }
        let deformations = system.measured(intact, displacement, &bonds);
        let breakage = self.break_bonds((&bonds, &deformations), &criteria, at)?;
        let lost = breakage.unbalanced_force(&self.run.state.displacement, ThermalStrain::NONE);
        for (dof, force) in lost {
            self.balanced.internal.values[dof] -= force;
        }
        Ok(breakage)
    }

    /// Lets bonds begin to soften by the stress around them, and follow their laws.
    fn soften(&mut self) {
        let Run { problem, state, .. } = &mut self.run;
        if state.softening.remaining.is_empty() {
            return;
        }
        problem.begin_softening(state, &self.balanced);
        let State {
            softening, intact, ..
        } = state;
        let deformations = self.balanced.deformations.measured();
        softening.follow(&problem.criteria, intact, deformations, false);
        softening.settle();
        breaks::soften(problem, state);
    }

    /// Breaks bonds with their deformations, in their order.
    fn break_bonds(
        &mut self,
        (bonds, deformations): (&[u32], &[BondDeformation]),
        criteria: &CriteriaInState<'_>,
        at: [usize; 2],
    ) -> Result<Breakage, ObserverError> {
        let deformation = |place: usize, _| deformations[place];
        let internal = &self.balanced.internal;
        (self.run).break_in_state(bonds, (criteria, &deformation), internal, at)?;
        let Run {
            problem,
            equations,
            state,
            ..
        } = &mut self.run;
        // With the displacements before the step, because the energy that leaves in it is 1/2 u^T K_b u' with those before and after.
        let step = self.inertia.step();
        let both = state.displacement.iter().zip(&self.velocities.half);
        let before = both.map(|(now, velocity)| now - step * velocity).collect();
        let now = mem::replace(&mut state.displacement, before);
        let system = &*problem.system;
        let expansion = problem.loads.thermal_strain(state.load_factor);
        let breakage = Breakage::new(system, expansion, state, bonds);
        state.displacement = now;
        (equations.connectivity).bonds_broke(system, &mut state.intact, bonds);
        equations.contact.follow(&state.intact, bonds);
        Ok(breakage)
    }

    /// Moves friction and contact by a step (s) to the present motions, with the forces of contact on the points and on the rigid bodies.
    fn touch(&mut self, step: f64) {
        let Run {
            problem,
            equations,
            state,
            ..
        } = &mut self.run;
        let (surfaces, contact) = (&problem.contact, &mut equations.contact);
        if !surfaces.is_empty() {
            let rates: &mut [RigidRates] = &mut self.velocities.rigid;
            surfaces.advance(step, rates, &mut state.rigid);
            let touching = contact.touching_in_time(state);
            self.missed = (self.missed.take()).or_else(|| contact.missed(state, &touching));
            surfaces.accelerate(step, &touching, rates);
            self.balanced.touching = touching.into();
        }
        contact.settle(state, &self.balanced);
        load_by_surfaces(problem, &mut self.balanced);
    }

    /// Kinetic energy of the body and of free rigid bodies, J.
    fn kinetic_energy(&self) -> f64 {
        let contact = &self.run.problem.contact;
        let rigid = contact.kinetic_energy(self.inertia.step(), &self.velocities.rigid);
        self.inertia.kinetic_energy(&self.velocities) + rigid
    }

    /// Sets the external forces of the time, and the prescribed displacements of the end of the next step.
    fn apply_loads(&mut self) {
        let loads = &self.run.problem.loads;
        let time = self.run.state.load_factor;
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
            restraints.add_forces(&self.run.state.displacement, &mut self.restraining);
            for &dof in restrained {
                self.external[dof as usize] -= self.restraining[dof as usize];
            }
        }
        let next = self.run.energies.motion.time_steps + 1;
        loads.prescribe(self.clock.time(next), &mut self.ahead);
    }

    /// Finds the velocities in the middle of the next step.
    fn accelerate(&mut self) {
        let internal = &mut self.balanced.internal.values;
        if !self.damped.is_empty() {
            let (system, bonds) = (&self.run.problem.system, self.run.state.bonds());
            system.multiply(bonds, &self.velocities.half, &mut self.damped);
            for (force, damped) in internal.iter_mut().zip(&self.damped) {
                *force += self.beta * damped;
            }
        }
        let displacement = &self.run.state.displacement;
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
        for (force, damped) in forces.iter_mut().zip(&self.damped) {
            *force += self.beta * damped;
        }
        let earlier = &self.damping_forces;
        if !earlier.is_empty() {
            let Velocities {
                half, acceleration, ..
            } = &self.velocities;
            let step = self.inertia.step();
            self.run.energies.motion.damping_energy += sum_of_chunks(n, |range| {
                let of = |dof: usize| {
                    let way = step * (half[dof] - step * acceleration[dof]);
                    0.5 * (forces[dof] + earlier[dof]) * way
                };
                range.map(of).sum()
            });
        }
        self.damping_forces = forces;
    }
}
