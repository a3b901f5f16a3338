//! Newmark's scheme with the averaging of Hilber and others (Hilber 1977): coefficients, and the loads of a step as those of an equilibrium.
//!
//! M a' + (1 - d) (C v' + f(u') - F') + d (C v + f(u) - F) = 0 with u' = u~ + beta dt^2 a', u~ = u + dt v + (1/2 - beta) dt^2 a, v' = v~ + gamma dt a',
//! v~ = v + (1 - gamma) dt a, beta = (1 + d)^2/4, gamma = 1/2 + d, for the dissipation 0 <= d <= 1/3; d = 0 is the trapezoidal rule.
//!
//! Divided by 1 - d, and with damping alpha M + beta_K K + D, this is an equilibrium of the bonds under forces and between springs to the ground.

use std::sync::Arc;

use ligament_model::thermal::ThermalStrain;

use crate::internal::InternalForces;
use crate::load_program::{BoundaryGroup, Control, LoadProgram, RigidLoad};
use crate::motion::{Damping, MotionProblem};
use crate::restraints::{Restraint, Restraints};

/// Coefficients of a step.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Newmark {
    /// Time step, s.
    pub(super) step: f64,
    /// Dissipation d.
    pub(super) dissipation: f64,
    pub(super) damping: Damping,
}

impl Newmark {
    pub(super) fn beta(&self) -> f64 {
        0.25 * (1.0 + self.dissipation).powi(2)
    }

    pub(super) fn gamma(&self) -> f64 {
        0.5 + self.dissipation
    }

    /// Change of the acceleration with the displacement, 1/(beta dt^2).
    pub(super) fn acceleration(&self) -> f64 {
        1.0 / (self.beta() * self.step * self.step)
    }

    /// Change of the velocity with the displacement, gamma/(beta dt).
    pub(super) fn velocity(&self) -> f64 {
        self.gamma() / (self.beta() * self.step)
    }

    /// Factor 1 + beta_K gamma/(beta dt) of the stiffness, by which the equations of a step are divided.
    pub(super) fn of_stiffness(&self) -> f64 {
        1.0 + self.damping.stiffness * self.velocity()
    }

    /// Share d/(1 - d) of the forces at the start in those of a step.
    pub(super) fn of_start(&self) -> f64 {
        self.dissipation / (1.0 - self.dissipation)
    }

    /// Stiffness of inertia and damping by mass between a mass and the ground, N/m.
    pub(super) fn ground(&self, mass: f64) -> f64 {
        let inertia = self.acceleration() / (1.0 - self.dissipation);
        mass * (inertia + self.damping.mass * self.velocity()) / self.of_stiffness()
    }

    /// Restraints of a step for the masses of the degrees of freedom: those of the loads, the dashpots, and the inertia.
    pub(super) fn restraints(&self, problem: &MotionProblem, masses: &[f64]) -> Restraints {
        let layout = problem.problem.system.layout;
        let factor = 1.0 / self.of_stiffness();
        let loads = &problem.problem.loads;
        let mut list = loads.restraints().scaled(factor);
        list.extend(problem.dashpots.iter().map(|it| {
            let displacements = layout.range(it.point);
            let displacements = displacements.filter(|&dof| !layout.component(dof).is_rotation());
            let degrees_of_freedom: Vec<u32> = displacements.map(|dof| dof as u32).collect();
            let n = degrees_of_freedom.len();
            // A symmetric matrix has the same rows and columns.
            let block = it.damping.view((0, 0), (n, n));
            Restraint {
                stiffness: block.iter().map(|c| factor * self.velocity() * c).collect(),
                degrees_of_freedom,
            }
        }));
        let ground = masses.iter().map(|&mass| self.ground(mass)).collect();
        Restraints::new(layout, list).with_ground(ground)
    }
}

/// Loads of an implicit step as those of an equilibrium: the loads at its end, forces from its start, and the springs of its inertia.
#[derive(Debug)]
pub(super) struct StepLoads {
    pub(super) base: Arc<dyn LoadProgram>,
    pub(super) restraints: Arc<Restraints>,
    /// Factor on the forces of the loads.
    pub(super) factor: f64,
    /// Forces from the start of the step, shape (n_degrees_of_freedom), N and N m.
    pub(super) added: Vec<f64>,
    /// Springs and forces on rigid bodies with a mass.
    pub(super) rigid: Vec<RigidLoad>,
}

impl LoadProgram for StepLoads {
    fn is_in_time(&self) -> bool {
        true
    }

    fn on_rigid_bodies(&self) -> &[RigidLoad] {
        &self.rigid
    }

    fn is_prescribed(&self, degree_of_freedom: usize) -> bool {
        self.base.is_prescribed(degree_of_freedom)
    }

    fn restraints(&self) -> &Arc<Restraints> {
        &self.restraints
    }

    fn prescribe(&self, time: f64, displacement: &mut [f64]) {
        self.base.prescribe(time, displacement);
    }

    fn forces(&self, time: f64, degrees_of_freedom: &[u32]) -> Vec<f64> {
        let mut forces = self.base.forces(time, degrees_of_freedom);
        for (force, &dof) in forces.iter_mut().zip(degrees_of_freedom) {
            *force = self.factor * *force + self.added[dof as usize];
        }
        forces
    }

    fn thermal_strain(&self, time: f64) -> ThermalStrain<'_> {
        self.base.thermal_strain(time)
    }

    fn temperature_change(&self, time: f64) -> Vec<f64> {
        self.base.temperature_change(time)
    }

    fn temperature_factor(&self, time: f64) -> f64 {
        self.base.temperature_factor(time)
    }

    fn control_factor(&self, time: f64) -> f64 {
        self.base.control_factor(time)
    }

    /// All degrees of freedom, because inertia acts on all.
    fn loaded_degrees_of_freedom(&self) -> Vec<u32> {
        (0..self.added.len() as u32).collect()
    }

    fn reactions(&self, time: f64, internal_forces: &[f64]) -> Vec<f64> {
        self.base.reactions(time, internal_forces)
    }

    fn groups(&self) -> &[BoundaryGroup] {
        self.base.groups()
    }

    fn given_resultants(&self, time: f64) -> Vec<Vec<f64>> {
        self.base.given_resultants(time)
    }

    fn control(&self) -> &Control {
        self.base.control()
    }

    fn control_displacement(&self, time: f64, displacement: &[f64]) -> f64 {
        self.base.control_displacement(time, displacement)
    }

    fn control_force(&self, time: f64, internal: &InternalForces) -> f64 {
        self.base.control_force(time, internal)
    }
}
