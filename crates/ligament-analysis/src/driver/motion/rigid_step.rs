//! Rigid bodies with a mass in implicit steps: Newmark's scheme for their displacements, with their loads and energies.
//!
//! M a' = (1 - d) (F' + M g) + d (F + M g) with the force F of the contacts, the acceleration g without contacts, and q' = q~ + beta dt^2 a'.
//! Divided by 1 - d this is a spring and a force on the body in an equilibrium of the step, as for the points ([`newmark`](super::newmark)).

use ligament_model::surface::Vector;
use ligament_model::tensor::{dot, minus};

use super::newmark::Newmark;
use crate::balanced::Balanced;
use crate::load_program::RigidLoad;
use crate::motion::contact::{ContactProblem, RigidMotion};
use crate::motion::rigid::add;
use crate::state::State;

/// Velocity and acceleration of each rigid body, zero of those with a prescribed motion, shape (n_rigid), m/s and m/s^2.
pub(super) type RigidRates = Vec<[Vector; 2]>;

/// A rigid body with a mass.
struct Free {
    /// Number among all rigid bodies.
    body: usize,
    mass: f64,
    /// Acceleration without contacts, m/s^2.
    acceleration: Vector,
}

/// Rigid bodies with a mass of a problem.
fn free(problem: &ContactProblem) -> impl Iterator<Item = Free> {
    let bodies = problem.rigid_bodies.iter().enumerate();
    bodies.filter_map(|(body, it)| match it.motion {
        RigidMotion::Prescribed { .. } => None,
        RigidMotion::Free {
            mass, acceleration, ..
        } => Some(Free {
            body,
            mass,
            acceleration,
        }),
    })
}

impl Free {
    /// Force of contacts and of the own acceleration in a balanced state, N.
    fn force(&self, problem: &ContactProblem, balanced: &Balanced) -> Vector {
        let mut force = balanced.touching.on_rigid_bodies(problem)[self.body];
        add(&mut force, self.mass, self.acceleration);
        force
    }
}

/// Rates at time zero, with the forces of a state then.
pub(super) fn at_start(problem: &ContactProblem, balanced: &Balanced) -> RigidRates {
    let mut rates = vec![[Vector::default(); 2]; problem.rigid_bodies.len()];
    for it in free(problem) {
        let velocity = problem.rigid_bodies[it.body].motion.velocity(0.0);
        let force = it.force(problem, balanced);
        rates[it.body] = [velocity, force.map(|force| force / it.mass)];
    }
    rates
}

/// Springs and forces on the bodies in a step from a balanced state; the springs alone without one.
pub(super) fn loads(
    problem: &ContactProblem,
    scheme: &Newmark,
    from: Option<(&State, &Balanced, &RigidRates)>,
) -> Vec<RigidLoad> {
    let of_body = |it: Free| {
        let stiffness = it.mass * scheme.acceleration() / (1.0 - scheme.dissipation);
        let mut force = Vector::default();
        if let Some((state, balanced, rates)) = from {
            add(
                &mut force,
                stiffness,
                predicted(scheme, state, rates, it.body),
            );
            add(&mut force, it.mass, it.acceleration);
            add(&mut force, scheme.of_start(), it.force(problem, balanced));
        }
        RigidLoad {
            body: it.body,
            stiffness,
            force,
        }
    };
    free(problem).map(of_body).collect()
}

/// Rates after a step from a state and its rates to another state.
pub(super) fn after(
    problem: &ContactProblem,
    scheme: &Newmark,
    (before, rates): (&State, &RigidRates),
    now: &State,
) -> RigidRates {
    let mut after = rates.clone();
    let (dt, gamma) = (scheme.step, scheme.gamma());
    for it in free(problem) {
        let [velocity, acceleration] = &mut after[it.body];
        let from = predicted(scheme, before, rates, it.body);
        let changed = minus(displacement(now, it.body), from);
        add(velocity, dt * (1.0 - gamma), *acceleration);
        *acceleration = changed.map(|it| scheme.acceleration() * it);
        add(velocity, dt * gamma, *acceleration);
    }
    after
}

/// Kinetic energy of the bodies, J.
pub(super) fn kinetic_energy(problem: &ContactProblem, rates: &RigidRates) -> f64 {
    free(problem).fold(0.0, |sum, it| {
        let [velocity, _] = rates[it.body];
        sum + 0.5 * it.mass * dot(velocity, velocity)
    })
}

/// Works over a step, J.
#[derive(Default)]
pub(super) struct Works {
    /// Of the accelerations of the bodies.
    pub(super) of_accelerations: f64,
    /// Of contacts and accelerations.
    pub(super) of_all: f64,
}

/// Works on the bodies over a step.
pub(super) fn works(
    problem: &ContactProblem,
    before: (&State, &Balanced),
    now: (&State, &Balanced),
) -> Works {
    let mut works = Works::default();
    for it in free(problem) {
        let way = minus(
            displacement(now.0, it.body),
            displacement(before.0, it.body),
        );
        let mut mean = it.force(problem, before.1).map(|force| 0.5 * force);
        add(&mut mean, 0.5, it.force(problem, now.1));
        works.of_accelerations += it.mass * dot(it.acceleration, way);
        works.of_all += dot(mean, way);
    }
    works
}

/// Displacement q~ of a body that the rates of a state predict for the end of a step.
fn predicted(scheme: &Newmark, state: &State, rates: &RigidRates, body: usize) -> Vector {
    let [velocity, acceleration] = rates[body];
    let (dt, beta) = (scheme.step, scheme.beta());
    let mut place = displacement(state, body);
    add(&mut place, dt, velocity);
    add(&mut place, (0.5 - beta) * dt * dt, acceleration);
    place
}

fn displacement(state: &State, body: usize) -> Vector {
    state.rigid.get(body).copied().unwrap_or_default()
}
