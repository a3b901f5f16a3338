//! An implicit motion at a time: velocities and forces of the points, and the masses and the damping behind them.

use serde::{Deserialize, Serialize};

use crate::balanced::Balanced;
use crate::contact::RigidRates;
use crate::history::Rates;
use crate::motion::{Damping, MotionProblem, MotionSettings};
use crate::state::State;
use crate::vectors::{sum_of_chunks, weighted_square};

/// Velocities and forces at a time, each of shape (n_degrees_of_freedom).
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(super) struct Motion {
    pub(super) velocity: Vec<f64>,
    pub(super) acceleration: Vec<f64>,
    /// Forces of the bonds, N and N m.
    pub(super) internal: Vec<f64>,
    /// Forces of loads and restraints, N and N m.
    pub(super) external: Vec<f64>,
    /// Forces of damping, N and N m.
    pub(super) damping: Vec<f64>,
    /// Rates of the rigid bodies; empty in equilibria without inertia.
    pub(super) rigid: Vec<RigidRates>,
}

/// Masses and damping of a body.
pub(super) struct MassAndDamping {
    pub(super) problem: MotionProblem,
    /// Mass of each degree of freedom, zero where its motion is prescribed, shape (n_degrees_of_freedom).
    pub(super) masses: Vec<f64>,
    damping: Damping,
}

impl Motion {
    /// Motion with given velocities (n_degrees_of_freedom), before accelerations and forces are known.
    pub(super) fn with_velocity(velocity: Vec<f64>, balanced: &Balanced) -> Self {
        let n = velocity.len();
        Self {
            velocity,
            acceleration: vec![0.0; n],
            internal: balanced.internal.values.clone(),
            external: vec![0.0; n],
            damping: vec![0.0; n],
            rigid: Vec::new(),
        }
    }

    /// Whether all arrays have the shapes for a body with a number of degrees of freedom.
    pub(super) fn fits(&self, n: usize) -> bool {
        let Self {
            velocity,
            acceleration,
            internal,
            external,
            damping,
            rigid: _,
        } = self;
        let arrays = [velocity, acceleration, internal, external, damping];
        arrays.iter().all(|it| it.len() == n)
    }

    pub(super) fn rates(&self) -> Rates<'_> {
        Rates {
            velocity: &self.velocity,
            acceleration: &self.acceleration,
            rigid: &self.rigid,
        }
    }

    /// Kinetic energy 1/2 v^T M v, J.
    pub(super) fn kinetic_energy(&self, masses: &[f64]) -> f64 {
        0.5 * weighted_square(masses, &self.velocity)
    }
}

impl MassAndDamping {
    /// Masses and damping of a problem.
    pub(super) fn new(problem: &MotionProblem, settings: &MotionSettings) -> Self {
        let mut masses = problem.masses(settings.rotary_inertia);
        for dof in problem.prescribed() {
            masses[dof as usize] = 0.0;
        }
        Self {
            problem: problem.clone(),
            masses,
            damping: settings.damping,
        }
    }

    /// Forces of loads and restraints, and of damping, at the time of a state with its velocities (n_degrees_of_freedom).
    pub(super) fn forces(&self, state: &State, velocity: &[f64]) -> (Vec<f64>, Vec<f64>) {
        let loads = &self.problem.problem.loads;
        let n = velocity.len();
        let all: Vec<u32> = (0..n as u32).collect();
        let mut external = loads.forces(state.load_factor, &all);
        if !loads.restraints().is_empty() {
            let mut restraining = vec![0.0; n];
            (loads.restraints()).add_forces(&state.displacement, &mut restraining);
            for (sum, force) in external.iter_mut().zip(&restraining) {
                *sum -= force;
            }
        }
        (external, self.damping_forces(state, velocity))
    }

    /// Forces C v of damping for velocities (n_degrees_of_freedom), N and N m.
    pub(super) fn damping_forces(&self, state: &State, velocity: &[f64]) -> Vec<f64> {
        let Damping {
            mass: alpha,
            stiffness: beta,
        } = self.damping;
        let MotionProblem {
            problem, dashpots, ..
        } = &self.problem;
        let mut forces = vec![0.0; velocity.len()];
        if beta > 0.0 {
            problem
                .system
                .multiply(state.bonds(), velocity, &mut forces);
            forces.iter_mut().for_each(|force| *force *= beta);
        }
        for ((force, mass), velocity) in forces.iter_mut().zip(&self.masses).zip(velocity) {
            *force += alpha * mass * velocity;
        }
        let layout = problem.system.layout;
        for it in dashpots.iter() {
            let displacements = layout.range(it.point);
            let dofs: Vec<usize> = displacements
                .filter(|&dof| !layout.component(dof).is_rotation())
                .collect();
            for (row, &dof) in it.damping.row_iter().zip(&dofs) {
                let parts = row.iter().zip(&dofs);
                forces[dof] += parts.map(|(c, &dof)| c * velocity[dof]).sum::<f64>();
            }
        }
        forces
    }

    /// Energy that damping took between two times, and with dissipation that of the scheme, J, for the way of each degree of freedom: the work
    /// of the forces that are out of balance at both times, and what the parameters of the scheme take from the kinetic energy.
    pub(super) fn damped(
        &self,
        [before, after]: [&Motion; 2],
        way: &(dyn Fn(usize) -> f64 + Sync),
        dissipates: bool,
    ) -> f64 {
        let masses = &*self.masses;
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

    /// Makes the internal forces (n_degrees_of_freedom) of a motion those that supports and loads balance: the bonds' with inertia and damping, and
    /// at restraints the external ones.
    pub(super) fn balance_forces(&self, motion: &Motion, internal: &mut [f64]) {
        let restraints = self.problem.problem.loads.restraints();
        for (dof, value) in internal.iter_mut().enumerate() {
            *value = match self.masses[dof] > 0.0 && restraints.acts_on(dof) {
                true => motion.external[dof],
                false => {
                    let inertia = self.masses[dof] * motion.acceleration[dof];
                    motion.internal[dof] + inertia + motion.damping[dof]
                }
            };
        }
    }
}
