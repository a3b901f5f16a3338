//! Implicit steps of one length: their equations, their loads, and the motion after them.

use std::sync::Arc;

use serde::{Deserialize, Serialize};

use super::clock::Clock;
use super::motion_state::{MassAndDamping, Motion, MotionState};
use super::newmark::{Newmark, StepLoads};
use super::record::MotionView;
use super::rigid_step;
use super::trial_step::TrialStep;
use crate::costs::Costs;
use crate::driver::energies::Energies;
use crate::driver::record::RunView;
use crate::equilibrium::Equilibrium;
use crate::error::SetupError;
use crate::load_program::LoadProgram;
use crate::motion::{MotionProblem, MotionSettings};
use crate::problem::Problem;
use crate::restraints::Restraints;
use crate::state::State;

/// Largest number of times that a step is halved.
pub(super) const HALVINGS: usize = 10;

/// Steps of a motion without a breakage after which halved steps are doubled again.
pub(super) const CALM: usize = 8;

/// Equations of steps of one length.
pub(super) struct Stepping {
    /// Scheme of the motion; None for equilibria without inertia.
    pub(super) scheme: Option<Newmark>,
    pub(super) restraints: Arc<Restraints>,
    pub(super) equilibrium: Equilibrium,
    /// Costs of the equations of other lengths before.
    pub(super) costs: Costs,
}

/// Kind and length of the steps.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub(super) struct Pace {
    /// Whether the steps have inertia; steps without it are equilibria.
    pub(super) has_inertia: bool,
    /// Number of halvings: of the steps of the clock, without inertia of the time between two rows.
    pub(super) halvings: usize,
    /// Number of steps since the last halving or breakage.
    pub(super) calm: usize,
}

impl Pace {
    /// Steps without inertia from row to row.
    pub(super) const STATICS: Self = Self {
        has_inertia: false,
        halvings: 0,
        calm: 0,
    };

    /// Steps of the clock, with inertia.
    pub(super) const MOTION: Self = Self {
        has_inertia: true,
        ..Self::STATICS
    };

    /// Steps of half the length.
    pub(super) fn halved(self) -> Self {
        Self {
            halvings: self.halvings + 1,
            calm: 0,
            ..self
        }
    }

    /// Steps of twice the length.
    pub(super) fn doubled(self) -> Self {
        Self {
            halvings: self.halvings - 1,
            calm: 0,
            ..self
        }
    }

    /// Largest number of halvings.
    pub(super) fn most_halvings(&self, clock: &Clock) -> usize {
        match self.has_inertia {
            true => HALVINGS,
            false => clock.steps_per_row.trailing_zeros() as usize,
        }
    }

    /// Number of parts, 2^[`HALVINGS`] of which a step of the clock has, in a step.
    pub(super) fn parts(&self, clock: &Clock) -> usize {
        let whole = 1_usize << HALVINGS;
        match self.has_inertia {
            true => whole >> self.halvings,
            false => (clock.steps_per_row * whole) >> self.halvings,
        }
    }

    /// Number of calm steps after which the steps are doubled.
    pub(super) fn calm_enough(&self) -> usize {
        if self.has_inertia { CALM } else { 1 }
    }
}

/// Scheme of steps at a pace; None without inertia.
pub(super) fn scheme(settings: &MotionSettings, clock: &Clock, pace: Pace) -> Option<Newmark> {
    pace.has_inertia.then(|| Newmark {
        step: clock.step() / f64::from(1_u32 << pace.halvings),
        dissipation: settings.dissipation,
        damping: settings.damping,
    })
}

/// Problem of a step of a scheme, with its restraints.
pub(super) fn of_step(
    problem: &MotionProblem,
    scheme: Option<Newmark>,
    masses: &[f64],
) -> (Problem, Arc<Restraints>) {
    let base = &problem.problem.loads;
    let Some(scheme) = scheme else {
        return (problem.problem.clone(), base.restraints().clone());
    };
    let restraints = Arc::new(scheme.restraints(problem, masses));
    let loads = StepLoads {
        base: base.clone(),
        restraints: restraints.clone(),
        factor: 1.0 / scheme.of_stiffness(),
        added: vec![0.0; masses.len()],
        rigid: rigid_step::loads(&problem.problem.contact, &scheme, None),
    };
    let of_step = Problem {
        loads: Arc::new(loads),
        ..problem.problem.clone()
    };
    (of_step, restraints)
}

impl Stepping {
    /// Equations of steps of a scheme, for the bonds of a state.
    pub(super) fn new(
        problem: &MotionProblem,
        scheme: Option<Newmark>,
        masses: &[f64],
        (state, settings): (&mut State, &MotionSettings),
    ) -> Result<Self, SetupError> {
        let (of_step, restraints) = of_step(problem, scheme, masses);
        let mut equilibrium = Equilibrium::new(&of_step, settings.breakages.energy_tolerance)?;
        let broken = (0..).zip(&state.intact).filter(|(_, intact)| !**intact);
        let broken: Vec<u32> = broken.map(|(bond, _)| bond).collect();
        for &bond in &broken {
            state.intact[bond as usize] = true;
        }
        state.held.fill(false);
        equilibrium.break_bonds(state, &broken);
        if !state.softening.remaining.is_empty() {
            equilibrium.soften();
        }
        Ok(Self {
            scheme,
            restraints,
            equilibrium,
            costs: Costs::default(),
        })
    }

    /// Costs of all steps so far.
    pub(super) fn costs(&self) -> Costs {
        self.costs.plus(self.equilibrium.costs())
    }

    /// Loads of a step from here.
    pub(super) fn loads(
        &self,
        here: &MotionState,
        inertia: MassAndDamping<'_>,
    ) -> Arc<dyn LoadProgram> {
        let base = inertia.problem.problem.loads.clone();
        let Some(scheme) = &self.scheme else {
            return base;
        };
        let MotionState { state, motion, .. } = here;
        let Motion {
            velocity,
            acceleration,
            internal,
            external,
            damping,
            rigid,
        } = motion;
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
        let mut added = inertia.damping_forces(state, &remaining);
        let factor = 1.0 / scheme.of_stiffness();
        let of_mass = scheme.acceleration() / (1.0 - scheme.dissipation);
        for (dof, sum) in added.iter_mut().enumerate() {
            let mass = inertia.masses[dof];
            let at_start = damping[dof] + internal[dof] - external[dof];
            let force = mass * of_mass * predicted[dof] - scheme.of_start() * at_start - *sum;
            *sum = if mass > 0.0 { factor * force } else { 0.0 };
        }
        let from = Some((state, &here.balanced, &**rigid));
        Arc::new(StepLoads {
            base,
            restraints: self.restraints.clone(),
            factor,
            added,
            rigid: rigid_step::loads(&inertia.problem.problem.contact, scheme, from),
        })
    }

    /// Velocities, accelerations and forces after a step.
    pub(super) fn after(
        &self,
        here: &MotionState,
        taken: &TrialStep,
        inertia: MassAndDamping<'_>,
    ) -> Motion {
        let MotionState { state, motion, .. } = here;
        let n = inertia.masses.len();
        let mut after = Motion::with_velocity(vec![0.0; n], &taken.balanced);
        let Some(scheme) = &self.scheme else {
            after.external = inertia.forces(&taken.state, &after.velocity).0;
            return after;
        };
        let (dt, beta, gamma) = (scheme.step, scheme.beta(), scheme.gamma());
        for dof in (0..n).filter(|&dof| inertia.masses[dof] > 0.0) {
            let (u, v, a) = (
                state.displacement[dof],
                motion.velocity[dof],
                motion.acceleration[dof],
            );
            let predicted = u + dt * v + (0.5 - beta) * dt * dt * a;
            let now = scheme.acceleration() * (taken.state.displacement[dof] - predicted);
            after.acceleration[dof] = now;
            after.velocity[dof] = v + dt * ((1.0 - gamma) * a + gamma * now);
        }
        (after.external, after.damping) = inertia.forces(&taken.state, &after.velocity);
        let contact = &inertia.problem.problem.contact;
        after.rigid = rigid_step::after(contact, scheme, (state, &motion.rigid), &taken.state);
        after
    }

    /// The body at its time for a row of the history.
    pub(super) fn now<'a>(
        &'a self,
        problem: &'a Problem,
        here: &'a MotionState,
        (energies, costs): (&'a Energies, &'a Costs),
    ) -> MotionView<'a> {
        MotionView {
            missed: None,
            broken: here.broken,
            below_zero: 0.0,
            rounding: 0.0,
            body: RunView {
                numbers: self.equilibrium.numbers(),
                fragments: self.equilibrium.fragments(),
                state: &here.state,
                balanced: &here.balanced,
                rates: Some(here.motion.rates()),
                energies,
                problem,
                costs,
            },
        }
    }
}
